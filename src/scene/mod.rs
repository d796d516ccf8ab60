//! What is drawn, and from where: plain data for a renderer.

mod appearance;
mod bone_picking;
mod bone_shapes;
mod bones;
mod camera;
mod cost;
mod flight;
mod frame;
mod framing;
mod ground;
mod pick;
mod ray;
mod shots;
mod sight;
mod skin_colors;
mod tint;

pub use crate::model::Aabb;
pub use appearance::{Background, Detail, Light, Overlay, Overlays, Pass, Passes, Theme, ViewMode, map_kind};
pub use bone_picking::{LabelPlace, Screen, label_places, pick_joint};
pub use bone_shapes::{AXES_SRGB, BoneColors, BoneStyle, MarkedJoints, append_bones, append_marked_bones};
pub use bones::{Bone, Bones};
pub use camera::{Camera, DEFAULT_FOV_Y_RADIANS, MAX_PITCH_RADIANS, Projection, ViewPreset};
pub use cost::{FrameCost, TimedPass};
pub use frame::{
    Crowd, CrowdInstance, FrameOptions, Ghosts, OverlayGeometry, OverlayVertex, RenderFrame, VertexColors,
};
pub use framing::{Insets, swept_about_y};
pub use ground::Ground;
pub use pick::{Hit, pick, value_at};
pub use ray::Ray;
pub use shots::{Frames, MOST_SHOTS, Shot};
pub use sight::Sight;
pub use skin_colors::{LegendStop, colors_of_counts, colors_of_joints, colors_of_values, joint_colors, legend};
pub use tint::{display_color, linear_from_srgb8, srgb8_from_linear, stand_in_color};
