//! Bindpose: skinned `.m3d` models, from bytes to pixels.
//!
//! # Map
//! ```text
//! bytes -> Document -> Model -> LocalPose -> ModelPose -> Palette -> RenderFrame -> pixels
//!         format      import   anim::sample  local_to_model palette   scene          render
//! ```
//! [`session`] holds what is open and how it is looked at; commands change it, time moves it. The `ui` and the `web` page, the
//! command line and the tests are shells around that core, which knows no GPU, no window, no browser and no clock.
//!
//! # Conventions
//! - Matrices multiply column vectors and are named `to_from`: `model_from_bind = model_from_joint * joint_from_bind`.
//! - The world is left-handed with y up, clockwise triangles face the viewer, depth runs from 0 to 1.
//! - File data keeps the file's space; [`model::world_from_model`] brings it into the world.
//! - Times are in seconds (`_secs`), angles in radians, colours linear unless named `_srgb`.
//! - A file stores row-vector matrices row by row: the same 16 numbers are the columns of ours.
//!
//! # From a file to a palette
//! ```
//! use bindpose::anim::{CompiledClip, PoseBuffers};
//! use bindpose::format;
//! use bindpose::import::m3d;
//!
//! let bytes = std::fs::read("web/sample/figure.m3d")?;
//! let parsed = format::parse(&bytes)?;
//! let (model, diagnostics) = m3d::from_document(&parsed.document, &parsed.lines)?;
//! assert!(diagnostics.is_empty());
//!
//! let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
//! pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 0.25);
//! assert_eq!(pose.palette.0.len(), model.skeleton.joint_count());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod actions;
pub mod anim;
#[cfg(feature = "viewer")]
#[allow(missing_docs, reason = "used by this package alone, where a name says it")]
pub mod app;
pub mod check;
#[cfg(all(feature = "cli", not(target_arch = "wasm32")))]
pub mod cli;
#[cfg(feature = "render")]
#[allow(missing_docs, reason = "used by this package alone, where a name says it")]
pub mod contact_sheet;
pub mod diagnostic;
pub mod edit;
pub mod export;
pub mod fbx;
pub mod format;
pub mod gestures;
pub mod gltf;
pub mod image;
pub mod import;
pub mod light;
pub mod model;
mod modes;
#[cfg(feature = "render")]
#[allow(missing_docs, reason = "used by this package alone, where a name says it")]
pub mod painter;
#[cfg(feature = "render")]
#[allow(missing_docs, reason = "used by this package alone, where a name says it")]
pub mod render;
pub mod scene;
pub mod script;
#[allow(missing_docs, reason = "used by this package alone, where a name says it")]
pub mod session;
#[allow(missing_docs, reason = "used by this package alone, where a name says it")]
pub mod shaders;
pub mod slices;
pub mod sorting;
#[cfg(feature = "viewer")]
#[allow(missing_docs, reason = "used by this package alone, where a name says it")]
pub mod ui;
#[cfg(all(feature = "element", target_arch = "wasm32"))]
mod web;
