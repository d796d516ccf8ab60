//! Other names for clips and bones.

use std::collections::HashSet;

use super::edited::{Change, Edited};
use super::error::EditError;

/// Renames clips, all at once: two may exchange their names.
pub(super) fn rename_clips(edited: &mut Edited, names: &[(String, String)]) -> Result<(), EditError> {
    let clips = &mut edited.model.clips;
    let known: Vec<String> = clips.iter().map(|clip| clip.name.clone()).collect();
    for (old, new) in names {
        let Some(clip) = known.iter().position(|name| name == old) else {
            return Err(EditError::UnknownClip {
                asked: old.clone(),
                known,
            });
        };
        let new: String = new.chars().filter(|letter| !letter.is_control()).collect();
        let new = new.trim();
        if new.is_empty() {
            return Err(EditError::Refused(
                "A clip cannot be named \"\": that is no name.".into(),
            ));
        }
        if clips[clip].name != new {
            new.clone_into(&mut clips[clip].name);
            edited.changes.push(Change::new(
                "clip-renamed",
                format!("Clip \"{old}\" is named \"{new}\"."),
            ));
        }
    }
    let mut taken = HashSet::new();
    match clips.iter().find(|clip| !taken.insert(clip.name.as_str())) {
        Some(clip) if !names.is_empty() => Err(EditError::Refused(format!(
            "A clip cannot be named \"{}\": another one is.",
            clip.name
        ))),
        _ => Ok(()),
    }
}

/// Names bones by their numbers in the file.
pub(super) fn rename_bones(edited: &mut Edited, names: &[(u32, String)]) -> Result<(), EditError> {
    let skeleton = &edited.model.skeleton;
    for (bone, name) in names {
        let Some(&joint) = skeleton.joint_of_bone().get(*bone as usize) else {
            let bone_count = skeleton.joint_count();
            return Err(EditError::Refused(format!(
                "There is no bone {bone}; there are {bone_count}."
            )));
        };
        let before = edited.names.get(*bone).or(skeleton.name(joint)).map(str::to_owned);
        edited.names.set(*bone, name);
        let after = edited.names.get(*bone).or(skeleton.name(joint));
        if after != before.as_deref() {
            let message = match after {
                Some(name) => format!("Bone {bone} is named \"{name}\"."),
                None => format!("Bone {bone} has no name."),
            };
            edited.changes.push(Change::new("bone-renamed", message));
        }
    }
    Ok(())
}
