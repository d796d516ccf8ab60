//! Parts that tests look at one by one.

pub use super::affordable::bytes_at_rest;
pub use super::band::half;
pub use super::blending::Center;
pub use super::environment::Lamps;
pub use super::instances::rows;
pub use super::light_fit::{CONTACT_MAP_SIZE, ContactFit, ShadowFit, StudioLights, light_axes, to_book_lights};
pub use super::light_maps::{CONTACT_BLURS, occlusion_blurs};
pub use super::maps::{first_fitting_level, fitting};
pub use super::read_back::make_alpha_straight;
pub use super::samples::{lamp_offset, lens_offset, pixel_offset};
pub use super::timing::sums;
pub use super::triangles::{DrawRange, Drawn, edges};
pub use super::uniforms::{SHADOW_TAPS, instance_size, light_uniform};
