//! From a clip and a time to a matrix palette, in buffers that the caller owns.

mod animated_bounds;
mod extreme_points;
mod local_to_model;
mod palette;
mod playback;
mod pose;
mod sample;
mod skin;

pub use crate::model::LocalJoint;
pub use animated_bounds::animated_bounds;
pub use extreme_points::extreme_points;
pub use local_to_model::local_to_model;
pub use palette::palette;
pub use playback::{LoopMode, Playback};
pub use pose::{LocalPose, ModelPose, Palette, PoseBuffers};
pub use sample::sample;
pub use skin::{SkinnedVertices, skin, skin_positions};
