//! What the books' demo needs of a model, beside its axes: see [`check::book`](crate::check::book).

use std::collections::HashSet;

use glam::Affine3A;

use super::edited::{Change, Edited, counted, with_tracks};
use super::error::EditError;
use super::space;
use crate::anim::{CompiledClip, PoseBuffers, skin_positions};
use crate::check::book::{DEMO_CLIP, DEMO_MATERIALS, DEMO_SCALE, MOST_BONES, MOST_VERTICES, SEEN_HEIGHTS};
use crate::diagnostic::codes;
use crate::model::{Aabb, Clip, Influences, JointIndex, JointNames, LocalJoint, Model, ModelError, Skeleton, Track};

/// The height of the books' soldier.
const SOLDIER_HEIGHT: f32 = 72.0;

/// What no edit makes small enough for the books' demo: [`EditError::TooManyVertices`] and [`EditError::TooManyBones`], where they hold.
pub fn too_large_for_book(model: &Model) -> impl Iterator<Item = EditError> {
    let vertices = model.mesh.vertex_count();
    let of_vertices = (vertices > MOST_VERTICES).then_some(EditError::TooManyVertices {
        vertices,
        most: MOST_VERTICES,
    });
    let added = needs_root(model);
    let bones = model.skeleton.joint_count() + usize::from(added);
    let of_bones = (bones > MOST_BONES).then_some(EditError::TooManyBones {
        bones,
        added,
        most: MOST_BONES,
    });
    of_vertices.into_iter().chain(of_bones)
}

/// The factor that makes a model as high as the books' soldier, where it is too small or too large to be seen. Its y is up. The height is
/// that of its first pose: the bind pose of other programs may lie down, or be of another size.
pub(super) fn scale(model: &Model) -> Option<f32> {
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    if let Some(clip) = model.clips.first() {
        pose.evaluate(&model.skeleton, &CompiledClip::new(clip), clip.start_secs);
    }
    let mut positions = Vec::new();
    skin_positions(&model.mesh, &pose.palette, &mut positions);
    let height = Aabb::from_points(positions).size().y;
    let is_seen = SEEN_HEIGHTS[0]..=SEEN_HEIGHTS[1];
    let factor = SOLDIER_HEIGHT / height;
    let is_small_or_large = model.skeleton.joint_count() > 0 && !is_seen.contains(&(height * DEMO_SCALE));
    (is_small_or_large && height > 0.0 && factor.is_finite()).then_some(factor)
}

/// Bones, keys and names as the demo takes them.
pub(super) fn shape(edited: &mut Edited) -> Result<(), EditError> {
    if edited.model.skeleton.joint_count() == 0 {
        name_materials(edited);
        return Ok(());
    }
    // Which clip the demo plays is told first.
    name_clips(edited);
    name_materials(edited);
    if needs_root(&edited.model) {
        add_root(edited).map_err(|_| EditError::Overflows)?;
    }
    order_bones(edited).map_err(|_| EditError::Overflows)?;
    give_keys(edited).map_err(|_| EditError::Overflows)?;
    Ok(())
}

/// Whether there are several roots, or vertices that no bone moves: the demo's shader gives these to bone 0.
fn needs_root(model: &Model) -> bool {
    let roots = model
        .skeleton
        .parents()
        .iter()
        .filter(|parent| parent.is_none())
        .count();
    roots > 0 && (roots > 1 || model.mesh.influences.iter().any(is_free))
}

/// Whether no bone moves a vertex.
fn is_free(influences: &Influences) -> bool {
    influences.weights == [0.0; 4]
}

/// Hangs all roots from a bone 0 that keeps still, and gives it the vertices that nothing moves.
fn add_root(edited: &mut Edited) -> Result<(), ModelError> {
    let model = &mut edited.model;
    let old = &model.skeleton;
    let roots = old.parents().iter().filter(|parent| parent.is_none()).count();
    let below = |joint: &Option<JointIndex>| Some(JointIndex(joint.map_or(0, |joint| joint.0 + 1)));
    let parents = [None].into_iter().chain(old.parents().iter().map(below));
    let joint_from_bind = [Affine3A::IDENTITY]
        .into_iter()
        .chain(old.joint_from_bind().iter().copied());
    let file_bones = [0].into_iter().chain(old.file_bones().iter().map(|bone| bone + 1));
    let rest: Vec<LocalJoint> = [LocalJoint::IDENTITY]
        .into_iter()
        .chain(old.rest().iter().copied())
        .collect();
    let names = [String::new()].into_iter().chain(space::names_of(old));
    let new = Skeleton::new(parents.collect(), joint_from_bind.collect(), file_bones.collect())?;
    model.skeleton = new.with_rest(&rest).with_names(names.collect());
    for clip in &mut model.clips {
        let root = Track::at_rest(LocalJoint::IDENTITY);
        *clip = with_tracks(clip, [root].into_iter().chain(clip.tracks.iter().cloned()).collect());
    }
    let mut freed = 0;
    for influences in &mut model.mesh.influences {
        if is_free(influences) {
            freed += 1;
            *influences = Influences {
                joints: [0; 4],
                weights: [1.0, 0.0, 0.0, 0.0],
            };
            continue;
        }
        for (joint, &weight) in influences.joints.iter_mut().zip(&influences.weights) {
            *joint = if weight > 0.0 { *joint + 1 } else { 0 };
        }
    }
    edited.names = renumbered(&edited.names, |bone| Some(bone + 1));
    let roots = counted(roots, "root hangs", "roots hang");
    edited.changes.push(Change::new(
        codes::BOOK_ROOTS.name,
        format!("There is a new bone 0 that keeps still; {roots} from it, and all bones have another number."),
    ));
    if freed > 0 {
        edited.changes.push(Change::new(
            codes::WEIGHTS_ALL_ZERO.name,
            format!(
                "{} on bone 0, since no other moved {}.",
                counted(freed, "vertex hangs", "vertices hang"),
                if freed == 1 { "it" } else { "them" }
            ),
        ));
    }
    Ok(())
}

/// Numbers the bones with parents first, where they are not.
fn order_bones(edited: &mut Edited) -> Result<(), ModelError> {
    let old = &edited.model.skeleton;
    let bones = old.file_bones();
    let is_before = |(joint, parent): (usize, &Option<JointIndex>)| {
        parent.is_none_or(|parent| bones[parent.index()] < bones[joint])
    };
    if old.parents().iter().enumerate().all(is_before) {
        return Ok(());
    }
    let joint_of_bone = old.joint_of_bone().to_vec();
    let new = Skeleton::new(
        old.parents().to_vec(),
        old.joint_from_bind().to_vec(),
        (0..old.joint_count() as u32).collect(),
    )?;
    let new = new.with_rest(old.rest()).with_names(space::names_of(old).collect());
    edited.names = renumbered(&edited.names, |bone| {
        joint_of_bone.get(bone as usize).map(|joint| joint.0)
    });
    edited.model.skeleton = new;
    edited.changes.push(Change::new(
        codes::BONES_REORDERED.name,
        "Bones are numbered anew, so that parents come first.",
    ));
    Ok(())
}

fn renumbered(names: &JointNames, new: impl Fn(u32) -> Option<u32>) -> JointNames {
    let mut renumbered = JointNames::default();
    for (&bone, name) in names.all() {
        if let Some(bone) = u32::try_from(bone).ok().and_then(&new) {
            renumbered.set(bone, name);
        }
    }
    renumbered
}

/// At least one key for each bone, and the first at 0 s, where the demo begins. A model without clips gets one that keeps still.
fn give_keys(edited: &mut Edited) -> Result<(), ModelError> {
    let model = &mut edited.model;
    if model.clips.is_empty() {
        let still = model.skeleton.rest().iter().map(|&rest| Track::new([(0.0, rest)]));
        model.clips.push(Clip::new(DEMO_CLIP, still.collect::<Result<_, _>>()?));
        edited.changes.push(Change::new(
            codes::BOOK_CLIP_NAME.name,
            format!("There is a clip \"{DEMO_CLIP}\" now, in which it stands still; there was none."),
        ));
    }
    for clip in &mut model.clips {
        let start_secs = clip.start_secs;
        let resting = clip.tracks.iter().filter(|track| !track.has_keys()).count();
        if start_secs == 0.0 && resting == 0 {
            continue;
        }
        let keyed = |track: &Track| match track.has_keys() {
            true => track.sooner(start_secs),
            false => Track::new([(0.0, track.key(0))]),
        };
        let tracks = clip.tracks.iter().map(keyed).collect::<Result<_, _>>()?;
        *clip = with_tracks(clip, tracks);
        if resting > 0 {
            edited.changes.push(Change::new(
                codes::TRACK_EMPTY.name,
                format!(
                    "{} a key at rest in \"{}\".",
                    counted(resting, "bone gets", "bones get"),
                    clip.name
                ),
            ));
        }
        if start_secs != 0.0 {
            edited.changes.push(Change::new(
                "clip-shifted",
                format!("\"{}\" begins at 0 s, not at {start_secs} s.", clip.name),
            ));
        }
    }
    Ok(())
}

/// A word for each clip, and the demo's for one of them.
fn name_clips(edited: &mut Edited) {
    let clips = &mut edited.model.clips;
    let mut names = words(clips.iter().map(|clip| clip.name.as_str()));
    if let (false, Some(first)) = (names.iter().any(|name| name == DEMO_CLIP), names.first_mut()) {
        DEMO_CLIP.clone_into(first);
    }
    for (clip, name) in clips.iter_mut().zip(names) {
        if clip.name != name {
            let message = format!("Clip \"{}\" is named \"{name}\".", clip.name);
            edited.changes.push(Change::new(codes::BOOK_CLIP_NAME.name, message));
            clip.name = name;
        }
    }
}

fn name_materials(edited: &mut Edited) {
    let materials = &mut edited.model.materials;
    // One of the demo's own names would take the place of its material.
    let free = |name: &str| format!("{name}{}", if DEMO_MATERIALS.contains(&name) { "_2" } else { "" });
    let free: Vec<String> = materials.iter().map(|material| free(&material.name)).collect();
    let names = words(free.iter().map(String::as_str));
    for (material, name) in materials.iter_mut().zip(names) {
        if material.name != name {
            let message = format!("Material \"{}\" is named \"{name}\".", material.name);
            edited.changes.push(Change::new("material-renamed", message));
            material.name = name;
        }
    }
}

/// One word for each name, none twice: the loaders end a name at a blank. Names that are words already keep theirs.
fn words<'a>(names: impl Iterator<Item = &'a str> + Clone) -> Vec<String> {
    let word = |name: &str| -> String {
        let is_end = |letter: char| letter.is_whitespace() || letter.is_control() || "{}".contains(letter);
        let word = name.replace(is_end, "_");
        if word.is_empty() { "_".to_owned() } else { word }
    };
    let mut taken: HashSet<String> = names
        .clone()
        .filter(|name| word(name) == **name)
        .map(str::to_owned)
        .collect();
    let named = names.map(|name| {
        let word = word(name);
        if word == name || taken.insert(word.clone()) {
            return word;
        }
        let free = (2..)
            .map(|number| format!("{word}_{number}"))
            .find(|word| !taken.contains(word));
        let free = free.unwrap_or(word);
        taken.insert(free.clone());
        free
    });
    named.collect()
}
