//! The rim with panels: eframe brings frames and input, egui draws over the picture, and its controls are elements of the page too.

mod calls;
mod canvas;
mod contrast;
mod exporting;
mod face;
mod frames;
mod handing_over;
mod joint_names;
mod mirror;
mod pictures;
mod run;
mod saving;

pub(super) use crate::app::App;
pub(super) use face::{Face, books};
pub(super) use frames::Frames;
pub(super) use run::run;
