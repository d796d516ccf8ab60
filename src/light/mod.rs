//! Light: what surrounds a model, how surfaces give it back, and how the result becomes colours of a screen.
//!
//! ```text
//! Environment -> Prefiltered -> textures and coefficients (for the GPU)
//!    studio, daylight, from_image   levels by roughness, irradiance
//! ```
//! [`pbr`], [`studio`], [`book`] and [`tone_map`] are the twins of the shaders of the same names: same functions, same steps.
//!
//! Radiance is linear and in units where 1 shows as white. Direct lights are given as what a white surface that faces them
//! shows, so their Lambert 1/π is in them already. The books' light alone works with encoded colours.
//!
//! ```
//! use bindpose::light::{Environment, Prefiltered};
//! use glam::Vec3;
//!
//! let studio = Prefiltered::of(&Environment::studio());
//! let (above, below) = (studio.irradiance().towards(Vec3::Y), studio.irradiance().towards(Vec3::NEG_Y));
//! assert!(above.min_element() > 2.0 * below.max_element());
//! ```

pub mod book;
mod brdf_table;
mod cube;
mod daylight;
mod environment;
mod irradiance;
mod low_discrepancy;
pub mod pbr;
mod prefilter;
pub mod studio;
mod studio_set;
pub mod tone_map;

pub use brdf_table::{BRDF_TABLE_SIDE, BrdfTable, brdf_table};
pub use environment::Environment;
pub use irradiance::Irradiance;
pub use prefilter::Prefiltered;
