//! What is open: files of a drop, their model and its maps, and all models that were opened before.

pub(super) mod archive;
pub(super) mod clip_swap;
pub(super) mod content;
pub(super) mod files;
pub(super) mod going_back;
pub(super) mod joining;
pub(super) mod load;
pub(super) mod maps;
pub(super) mod open_model;
pub(super) mod opening;
pub(super) mod showing;
pub(super) mod textures;
pub(super) mod underway;
pub(super) mod wish;
