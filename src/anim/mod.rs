//! From a clip and a time to a matrix palette, in buffers that the caller owns.

mod animated_bounds;
mod blend_to_rest;
mod explain;
mod extreme_points;
mod inspect;
mod local_to_model;
mod palette;
mod playback;
mod pose;
mod sample;
mod skin;
mod skin_view;
mod table;
mod trails;

pub use crate::model::{JointLanes, LocalJoint};
pub use animated_bounds::animated_bounds;
pub use blend_to_rest::blend_to_rest;
pub use explain::{ExplainedInfluence, VertexExplanation, explain_vertex};
pub use extreme_points::extreme_points;
pub use inspect::{JointReadout, KeyRow, RowMatrix, TransformParts, key_rows, key_table};
pub use local_to_model::local_to_model;
pub use palette::palette;
pub use playback::{LoopMode, Playback};
pub use pose::{LocalPose, ModelPose, Palette, PoseBuffers};
pub use sample::sample;
pub use skin::{SkinnedVertices, skin, skin_positions};
pub use skin_view::{SkinView, Stretch, dominant_joints, influence_counts, joint_weights};
pub use trails::{GhostPlan, Trails, ghost_times, palettes_at};
