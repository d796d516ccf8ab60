//! Where the parts of a model stand in an FBX file: lines of text ones, bytes of binary ones.

use super::nodes::Nodes;
use super::objects::Objects;
use crate::diagnostic::{self, Entry};
use crate::fbx::Place;
use crate::import::scene::Rig;

/// What stands where.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    /// Of each bone, by its number.
    bones: Vec<Place>,
    materials: Vec<Place>,
    /// Of the geometry of each subset.
    subsets: Vec<Place>,
    /// Of the stack of each clip.
    clips: Vec<Place>,
}

impl Places {
    /// `materials`, `subsets` and `clips` are where these stand.
    pub(super) fn of(
        objects: &Objects<'_, '_>,
        nodes: &Nodes,
        rig: &Rig,
        [materials, subsets, clips]: [Vec<Place>; 3],
    ) -> Self {
        let node = |joint: usize| nodes.objects[rig.node_of_joint[joint] as usize];
        let bones = rig.skeleton.joint_of_bone().iter();
        Self {
            bones: bones
                .map(|joint| objects.get(node(joint.index())).record.place)
                .collect(),
            materials,
            subsets,
            clips,
        }
    }

    fn place(&self, entry: Entry) -> Option<Place> {
        let (places, index) = match entry {
            Entry::Material(material) => (&self.materials, material),
            Entry::Subset(subset) => (&self.subsets, subset),
            Entry::Bone(bone) | Entry::Offset(bone) => (&self.bones, bone),
            Entry::Clip(clip) | Entry::Track { clip, .. } | Entry::Key { clip, .. } => (&self.clips, clip),
            _ => return None,
        };
        places.get(index as usize).copied()
    }
}

impl diagnostic::Places for Places {
    fn line(&self, entry: Entry) -> Option<u32> {
        match self.place(entry)? {
            Place::At(position) => Some(position.line),
            Place::Offset(_) => None,
        }
    }

    fn byte_offset(&self, entry: Entry) -> Option<u64> {
        match self.place(entry)? {
            Place::Offset(offset) => Some(offset),
            Place::At(_) => None,
        }
    }
}
