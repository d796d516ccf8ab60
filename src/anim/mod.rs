//! From a clip and a time to a matrix palette, in buffers that the caller owns.
//!
//! A [`Clip`](crate::model::Clip) has its tracks as the file has them. [`CompiledClip`] is the same motion laid out for
//! sampling; what poses a clip takes it, what reads keys takes the clip.

mod activity;
mod blend;
mod buffers;
mod compile;
mod crowd;
mod curve;
mod extent;
mod inspect;
mod keys;
mod lanes;
mod loop_gap;
mod playback;
mod pose;
mod sample;
mod skin;
mod skin_view;
mod span;
mod straight;
mod trails;
mod vertex_groups;

pub use crate::model::LocalJoint;
pub(crate) use activity::JointChange;
pub use activity::{JointActivity, activity};
pub use blend::{blend, blend_to_bind};
pub use buffers::PoseBuffers;
pub use compile::CompiledClip;
pub use crowd::{ClipPose, CrowdPalettes};
pub use curve::{Curve, CurvePoint, CurveSpace};
pub use extent::Extent;
pub use inspect::{
    ExplainedInfluence, JointReadout, KeyRow, RowMatrix, TransformParts, VertexExplanation, explain_vertex, key_rows,
    key_table,
};
pub use keys::{Direction, key_times, merged_key_times, merged_key_times_of, next_key, previous_key};
pub use lanes::{JointLanes, MatrixLanes};
pub use loop_gap::{JointGap, LoopGap, VISIBLE_FRACTION, loop_gap};
pub use playback::{LoopMode, MAX_SPEED, MIN_SPEED, Playback, WrapMode};
pub use pose::{LocalPose, ModelPose, Palette, local_to_model, palette};
pub use sample::{sample, sample_joint};
pub(crate) use skin::skin_position;
pub use skin::{SkinnedVertices, skin, skin_positions};
pub use skin_view::{SkinView, Stretch, dominant_joint, dominant_joints, influence_counts, joint_weights};
pub use straight::{MOST_ERROR as STRAIGHT_ERROR, straight};
pub use trails::{GHOST_STEP_FRAMES, GhostPlan, MOST_GHOSTS, Trails, ghost_times, palettes_at};
pub use vertex_groups::VertexGroups;
