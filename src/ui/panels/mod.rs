//! What the panels say: the model and its parts, findings, bones, light, export, help.

pub(super) mod cost;
pub(super) mod crowd;
pub(super) mod error_card;
pub(super) mod export;
pub(super) mod findings;
pub(super) mod help;
pub(super) mod light;
pub(super) mod model_panel;
pub(super) mod overlays;
pub(super) mod picture;
pub(super) mod skeleton;
pub(super) mod submesh_panel;
pub(super) mod textures;
pub(super) mod thumbnails;
