//! Where the parts of a model stand in a glTF file, as JSON pointers, and back.

use super::skeleton::Rig;
use crate::diagnostic::{self, Entry};
use crate::gltf::{Effort, Root};

/// What stands where.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    /// Of each bone, by its number; a joint that stands in for another has its node.
    nodes: Vec<u32>,
    /// Mesh and primitive of each submesh.
    primitives: Vec<[u32; 2]>,
    materials: u32,
    /// The animation of each clip.
    animations: Vec<u32>,
    /// What reading took.
    pub(crate) effort: Effort,
}

impl Places {
    /// Of a model of this skeleton.
    pub(super) fn of(
        root: &Root,
        rig: &Rig,
        (primitives, animations): (Vec<[u32; 2]>, Vec<u32>),
        effort: Effort,
    ) -> Self {
        let nodes = rig.skeleton.joint_of_bone().iter();
        Self {
            nodes: nodes.map(|joint| rig.node_of_joint[joint.index()]).collect(),
            primitives,
            materials: root.materials().len() as u32,
            animations,
            effort,
        }
    }
}

impl diagnostic::Places for Places {
    fn pointer(&self, entry: Entry) -> Option<String> {
        match entry {
            Entry::Material(material) => (material < self.materials).then(|| format!("/materials/{material}")),
            Entry::Subset(subset) => {
                let [mesh, primitive] = self.primitives.get(subset as usize)?;
                Some(format!("/meshes/{mesh}/primitives/{primitive}"))
            }
            Entry::Bone(bone) | Entry::Offset(bone) => Some(format!("/nodes/{}", self.nodes.get(bone as usize)?)),
            Entry::Clip(clip) => Some(format!("/animations/{}", self.animations.get(clip as usize)?)),
            _ => None,
        }
    }

    fn entry_at(&self, pointer: &str) -> Option<Entry> {
        let mut parts = pointer.split('/').skip(1);
        let mut next = || parts.next();
        let list = next()?;
        let index: u32 = next()?.parse().ok()?;
        match list {
            "materials" => (index < self.materials).then_some(Entry::Material(index)),
            "nodes" => {
                let bone = self.nodes.iter().position(|&node| node == index)?;
                Some(Entry::Bone(bone as u32))
            }
            "animations" => {
                let clip = self.animations.iter().position(|&animation| animation == index)?;
                Some(Entry::Clip(clip as u32))
            }
            "meshes" if next()? == "primitives" => {
                let primitive: u32 = next()?.parse().ok()?;
                let subset = self.primitives.iter().position(|&part| part == [index, primitive])?;
                Some(Entry::Subset(subset as u32))
            }
            _ => None,
        }
    }
}
