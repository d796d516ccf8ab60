//! Surface parameters, colours linear unless named `_srgb`.

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name to show, unique in the model.
    pub name: String,
    /// Diffuse colour as the file has it, linear.
    pub diffuse: [f32; 3],
    /// The part in which the books differ.
    pub reflectance: Reflectance,
    /// Cut by alpha and drawn from both sides.
    pub alpha_clip: bool,
    /// Name of the diffuse map as the file has it.
    pub diffuse_map: Option<String>,
    /// Name of the normal map as the file has it.
    pub normal_map: Option<String>,
}

impl Material {
    /// The alpha below which the books cut.
    pub const ALPHA_CLIP: f32 = 0.1;
}

/// How a material reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reflectance {
    /// DirectX 12 book.
    Fresnel {
        /// Reflectance at normal incidence, linear.
        fresnel0: [f32; 3],
        /// 0 smooth … 1 rough.
        roughness: f32,
    },
    /// DirectX 11 book.
    Phong {
        /// Ambient reflectance.
        ambient: [f32; 3],
        /// Specular reflectance.
        specular: [f32; 3],
        /// Specular exponent.
        spec_power: f32,
        /// Scale of the mirrored sky.
        reflectivity: [f32; 3],
    },
}
