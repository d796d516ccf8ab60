//! What joints are called.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::model::{JointIndex, JointNames, MirrorPair, SavedNames, mirror_pairs};
use crate::session::Session;

/// A command about names. A joint that the model does not have is ignored.
#[derive(Clone, Debug, PartialEq)]
pub enum NameCommand {
    /// Names a joint; an empty name removes the name.
    Rename {
        joint: JointIndex,
        name: String,
    },
    /// Takes the names of [`Session::proposed_names`](crate::session::Session::proposed_names).
    AcceptMirrored,
    /// Replaces all names by saved ones, if those belong to the same hierarchy.
    Import(SavedNames),
    Clear,
}

impl Session {
    pub(in crate::session) fn apply_to_names(&mut self, command: NameCommand) {
        let mut names = JointNames::clone(&self.content.names);
        match command {
            NameCommand::Rename { joint, name } => {
                if let Some(bone) = self.bone_of(joint) {
                    names.set(bone, &name);
                }
            }
            NameCommand::AcceptMirrored => {
                for (bone, name) in self.proposed_names() {
                    names.set(bone as u32, &name);
                }
            }
            NameCommand::Import(saved) => {
                let kept = self
                    .open_model()
                    .and_then(|open| JointNames::from_saved(&saved, &open.model.skeleton));
                names = kept.unwrap_or(names);
            }
            NameCommand::Clear => names = JointNames::default(),
        }
        self.replace_names(names);
    }

    pub(in crate::session) fn replace_names(&mut self, names: JointNames) {
        if names != *self.content.names {
            self.content.names = Arc::new(names);
            self.content.changes.names = true;
        }
    }

    /// What joints are called.
    pub fn joint_names(&self) -> &JointNames {
        &self.content.names
    }

    /// Counts changes of the names: another number, other names to keep.
    pub fn joint_names_revision(&self) -> u64 {
        self.revisions.names
    }

    /// The names as plain data, to keep; nothing without a model.
    pub fn saved_joint_names(&self) -> Option<SavedNames> {
        let open = self.open_model()?;
        Some(self.content.names.saved(&open.model.skeleton))
    }

    /// The name that a person gave to a joint, or else the file.
    pub fn joint_name(&self, joint: JointIndex) -> Option<&str> {
        let given = self.content.names.get(self.bone_of(joint)?);
        given.or_else(|| self.open_model()?.model.skeleton.name(joint))
    }

    /// What a joint is called: its name, or `Bone 12` by its number in the file.
    pub fn joint_label(&self, joint: JointIndex) -> String {
        match self.joint_name(joint) {
            Some(name) => name.to_owned(),
            None => format!("Bone {}", self.bone_number(joint)),
        }
    }

    /// Number and name of a joint, `12 Left hand`; without a name `Bone 12`.
    pub fn numbered_joint_label(&self, joint: JointIndex) -> String {
        match self.joint_name(joint) {
            Some(name) => format!("{} {name}", self.bone_number(joint)),
            None => self.joint_label(joint),
        }
    }

    /// The number of a joint in the file.
    pub fn bone_number(&self, joint: JointIndex) -> u32 {
        self.bone_of(joint).unwrap_or(joint.0)
    }

    fn bone_of(&self, joint: JointIndex) -> Option<u32> {
        let bones = self.open_model()?.model.skeleton.file_bones();
        bones.get(joint.index()).copied()
    }

    /// Joints that mirror each other in the bind pose.
    pub fn mirror_pairs(&self) -> Vec<MirrorPair> {
        let Some(open) = self.open_model() else {
            return Vec::new();
        };
        mirror_pairs(
            &open.model.skeleton,
            self.selection.joints.tree(),
            self.world_from_model(),
        )
    }

    /// Names for the other sides of mirrored joints of which one has a name, by the joint's number in the file.
    pub fn proposed_names(&self) -> BTreeMap<usize, String> {
        match self.open_model() {
            // Without a name there is nothing to mirror, and no need to search.
            Some(open) if !self.content.names.is_empty() => {
                self.content.names.mirrored(&open.model.skeleton, &self.mirror_pairs())
            }
            _ => BTreeMap::new(),
        }
    }
}
