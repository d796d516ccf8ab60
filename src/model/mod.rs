//! A model in our words, every index and order proved.
//!
//! A model knows no format: [`import`](crate::import) makes its parts of what a file says. [`Skeleton::new`], [`Track::new`] and
//! [`Model::checked`] prove them, or give a [`Fault`]. What is proved here no later stage looks at again.

mod bitangents;
mod bounds;
mod channel;
mod clip;
mod joint_names;
mod layers;
mod local_joint;
mod material;
mod mesh;
mod mirror;
mod names;
mod object;
mod reflectance;
mod sides;
mod skeleton;
mod space;
mod tangents;
mod track;
mod tree;

pub use bitangents::Green;
pub use bounds::Aabb;
pub(crate) use channel::unit as unit_rotation;
pub use channel::{Channel, ChannelValue, Way};
pub use clip::Clip;
pub use joint_names::{JointNames, SavedNames, hierarchy_fingerprint};
pub use layers::Layers;
pub use local_joint::LocalJoint;
pub use material::{AlphaMode, MapSlot, Material, MaterialMap, Reflectance, Sampling, Wrap};
pub(crate) use mesh::out_of_range as index_out_of_range;
pub use mesh::{Influences, Mesh, Submesh};
pub use mirror::{MirrorPair, mirror_pairs};
pub use names::one_word;
pub(crate) use names::{Taken, unique as unique_names, unique_words};
pub use object::{Object, Tag};
pub use reflectance::{FresnelSurface, MetallicSurface, roughness_from_power};
pub use skeleton::{JointIndex, Skeleton};
pub use space::{Front, Handedness, UpAxis, world_from_model};
pub use track::Track;
pub use tree::{JointTree, VertexCounts};

use crate::diagnostic::{Fault, codes};

/// A model that can be animated and drawn. After [`Model::checked`] no later stage can fail.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// At least as many as the submeshes name; may be empty when there are no submeshes.
    pub materials: Vec<Material>,
    /// Vertices and triangles, in the file's order and in the file's space (bind space).
    pub mesh: Mesh,
    /// Its parts as the file has them apart, one behind the other, and all of it; none where the file has one mesh.
    pub objects: Vec<Object>,
    /// Joints, parents first. Empty for a static model.
    pub skeleton: Skeleton,
    /// Named motions; none for a static model.
    pub clips: Vec<Clip>,
    /// The handedness of the file's space, found by the winding test.
    pub handedness: Handedness,
    /// The up axis of the file's space.
    pub up_axis: UpAxis,
    /// Which way characters of the file's format face.
    pub front: Front,
    /// Whose work it is, in the words of the file.
    pub copyright: Option<String>,
}

impl Model {
    /// Proves that the parts fit each other: see [`Mesh::check`]; a skinned model has influences for every vertex, and they name
    /// joints that are there; submeshes lie inside the mesh, have a material, and belong to one object each where there are any; clips have a track for each joint.
    ///
    /// # Errors
    /// When one of these does not hold.
    pub fn checked(self) -> Result<Self, Fault> {
        self.mesh.check()?;
        self.check_influences()?;
        self.check_submeshes()?;
        let joint_count = self.skeleton.joint_count();
        match self.clips.iter().position(|clip| clip.tracks.len() != joint_count) {
            None => Ok(self),
            Some(clip) => {
                let tracks = self.clips[clip].tracks.len();
                let message = format!("Clip {clip} has {tracks} tracks for {joint_count} joints; every joint has one.");
                Err(codes::TRACK_COUNT.says(message).into())
            }
        }
    }

    fn check_influences(&self) -> Result<(), Fault> {
        let influences = &self.mesh.influences;
        let joint_count = self.skeleton.joint_count();
        let vertex_count = self.mesh.vertex_count();
        if joint_count == 0 && influences.is_empty() {
            return Ok(());
        }
        if influences.len() != vertex_count {
            return Err(mesh::stream_length("influences", influences.len(), vertex_count));
        }
        for (vertex, influences) in influences.iter().enumerate() {
            if let Some(&joint) = influences.joints.iter().find(|&&joint| joint as usize >= joint_count) {
                let message = format!("Vertex {vertex} names joint {joint}, but there are {joint_count} joints.");
                return Err(codes::JOINT_OUT_OF_RANGE.says(message).into());
            }
        }
        Ok(())
    }

    fn check_submeshes(&self) -> Result<(), Fault> {
        let outside = self.mesh.submeshes.iter().position(|submesh| {
            let end = u64::from(submesh.triangle_start) + u64::from(submesh.triangle_count);
            end > self.mesh.triangle_count() as u64 || submesh.material as usize >= self.materials.len()
        });
        if let Some(submesh) = outside {
            let message = format!("Submesh {submesh} names triangles or a material that are not there.");
            return Err(codes::SUBMESH_OUT_OF_RANGE.says(message).into());
        }
        let ends = self.objects.iter().try_fold(0, |end, object| {
            let follows = object.submeshes.start == end && end <= object.submeshes.end;
            follows.then_some(object.submeshes.end)
        });
        if self.objects.is_empty() || ends == Some(self.mesh.submeshes.len()) {
            return Ok(());
        }
        let message = "The objects do not have each submesh once, in order.";
        Err(codes::SUBMESH_OUT_OF_RANGE.says(message).into())
    }

    /// Box of all vertices in bind space, also those that no triangle uses.
    pub fn bind_bounds(&self) -> Aabb {
        Aabb::from_points(self.mesh.positions.iter().copied())
    }
}
