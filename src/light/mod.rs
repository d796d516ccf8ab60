//! The light of the environment: radiance from each direction, filtered for rough and for diffuse surfaces.
//!
//! ```text
//! Environment -> Prefiltered -> textures and coefficients (for the GPU)
//!    studio, daylight, from_image   levels by roughness, irradiance
//! ```
//! Radiance is linear and in units where 1 shows as white.
//!
//! ```
//! use bindpose::light::{Environment, Prefiltered, Room};
//! use glam::Vec3;
//!
//! let studio = Prefiltered::of(&Environment::coarse_studio(Room::Dark));
//! let (above, below) = (studio.irradiance().towards(Vec3::Y), studio.irradiance().towards(Vec3::NEG_Y));
//! assert!(above.min_element() > 2.0 * below.max_element());
//! ```
//!
//! Specular light is the split sum (Karis 2013) with the energy of many bounces kept (Fdez-Agüera 2019). Filtering is done on the CPU,
//! since WebGL2 promises no float targets.

mod brdf_table;
mod cube;
mod environment;
mod prefilter;
mod sky_lamp;
mod studio_set;

pub use brdf_table::{BRDF_TABLE_SIDE, BrdfTable, LAMP_RADIUS_RADIANS, brdf_table};
pub use environment::{Environment, sound_radiance};
pub use prefilter::{Irradiance, Prefiltered};
pub use sky_lamp::SkyLamp;
pub use studio_set::{Room, RoomLights};
