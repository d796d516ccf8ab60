//! Twins of the uniform structs of light.

use bytemuck::{Pod, Zeroable};

/// Twin of `Environment` in `environment.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Environment {
    /// Irradiance over π as spherical harmonics: [`Irradiance::to_uniform`](crate::light::Irradiance::to_uniform).
    pub sh: [[f32; 4]; 9],
    /// x of the direction in the world that is the environment's x, which lies flat and is of unit length.
    pub turn_cos: f32,
    /// Its z.
    pub turn_sin: f32,
    /// Multiplies all its light.
    pub intensity: f32,
    /// Levels of the mirror light's cube.
    pub specular_level_count: f32,
}
