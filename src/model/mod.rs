//! A model in our words, every index and order proved.

mod clip;
mod material;
mod mesh;
mod skeleton;
mod space;

pub use clip::{Clip, Track};
pub use material::{Material, Reflectance};
pub use mesh::{Influences, Mesh, Submesh};
pub use skeleton::{JointIndex, Skeleton};
pub use space::{Handedness, UpAxis, world_from_model};

/// A model that can be animated and drawn: after it exists no later stage can fail.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// At least as many as the submeshes name; may be empty when there are no submeshes.
    pub materials: Vec<Material>,
    /// Vertices and triangles, in the file's order and in the file's space (bind space).
    pub mesh: Mesh,
    /// Joints, parents first. Empty for a static model.
    pub skeleton: Skeleton,
    /// Named motions.
    pub clips: Vec<Clip>,
    /// The handedness of the file's space, found by the winding test.
    pub handedness: Handedness,
    /// The up axis of the file's space, as the dialect suggests.
    pub up_axis: UpAxis,
}
