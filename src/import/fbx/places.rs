//! Where the parts of a model stand in an FBX file: lines of text ones. Binary ones have none to show.

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
}

impl Places {
    /// `materials` and `subsets` are where these stand.
    pub(super) fn of(
        objects: &Objects<'_, '_>,
        nodes: &Nodes,
        rig: &Rig,
        [materials, subsets]: [Vec<Place>; 2],
    ) -> Self {
        let node = |joint: usize| nodes.objects[rig.node_of_joint[joint] as usize];
        let bones = rig.skeleton.joint_of_bone().iter();
        Self {
            bones: bones
                .map(|joint| objects.get(node(joint.index())).record.place)
                .collect(),
            materials,
            subsets,
        }
    }
}

impl diagnostic::Places for Places {
    fn line(&self, entry: Entry) -> Option<u32> {
        let place = match entry {
            Entry::Material(material) => self.materials.get(material as usize),
            Entry::Subset(subset) => self.subsets.get(subset as usize),
            Entry::Bone(bone) | Entry::Offset(bone) => self.bones.get(bone as usize),
            _ => None,
        };
        match place? {
            Place::At(position) => Some(position.line),
            Place::Offset(_) => None,
        }
    }
}
