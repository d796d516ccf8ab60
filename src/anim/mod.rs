//! From a clip and a time to a matrix palette, in buffers that the caller owns.

mod pose;

pub use pose::{LocalPose, ModelPose, Palette, PoseBuffers};
