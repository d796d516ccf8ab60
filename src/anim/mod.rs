//! From a clip and a time to a matrix palette, in buffers that the caller owns.

mod activity;
mod animated_bounds;
mod blend;
mod curve;
mod extreme_points;
mod joint_change;
mod keys;
mod local_to_model;
mod palette;
mod playback;
mod pose;
mod sample;
mod seam;
mod skin;
mod span;

pub use crate::model::{JointLanes, LocalJoint};
pub use activity::{JointActivity, activity};
pub use animated_bounds::animated_bounds;
pub use blend::blend;
pub use curve::{CurvePoint, CurveSpace, curve};
pub use extreme_points::extreme_points;
pub use keys::{Direction, key_times, merged_key_times, next_key, previous_key};
pub use local_to_model::local_to_model;
pub use palette::palette;
pub use playback::{LoopMode, MAX_SPEED, MIN_SPEED, Playback, WrapMode};
pub use pose::{LocalPose, ModelPose, Palette, PoseBuffers};
pub use sample::{sample, sample_joint};
pub use seam::{JointSeam, Seam, VISIBLE_SHARE, seam};
pub use skin::{SkinnedVertices, skin, skin_positions};
