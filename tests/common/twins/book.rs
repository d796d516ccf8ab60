//! A surface under the light of the books' demos: the twin of `book.wgsl`, which says what each step means.
//!
//! Colours are sRGB-encoded here, and multiplied and added as they are: that is what the books do.

use glam::Vec3;

/// Twin of `BOOK_STRENGTH_0` to `BOOK_STRENGTH_2`: the three lights of the DirectX 12 book's character demo.
pub(crate) const BOOK_STRENGTHS: [Vec3; 3] = [Vec3::new(0.9, 0.9, 0.7), Vec3::splat(0.4), Vec3::splat(0.2)];

/// Twin of `BOOK_AMBIENT`: what comes from everywhere.
pub(crate) const BOOK_AMBIENT: Vec3 = Vec3::new(0.25, 0.25, 0.35);

/// A point of a surface of the DirectX 12 book. Directions are of unit length, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BookSurface {
    /// Diffuse colour.
    pub(crate) albedo: Vec3,
    /// Mirrored fraction, face on.
    pub(crate) fresnel0: Vec3,
    /// What [`shininess`] gives.
    pub(crate) shininess: f32,
    /// On the side of the viewer, with the normal map's bumps.
    pub(crate) normal: Vec3,
    /// Towards the viewer.
    pub(crate) to_eye: Vec3,
}

/// A point of a surface of the DirectX 11 book. Directions are of unit length, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PhongSurface {
    /// What the diffuse map has here.
    pub(crate) texel: Vec3,
    /// Of the material.
    pub(crate) ambient: Vec3,
    /// Of the material.
    pub(crate) diffuse: Vec3,
    /// Of the material.
    pub(crate) specular: Vec3,
    /// Specular exponent.
    pub(crate) power: f32,
    /// On the side of the viewer, with the normal map's bumps.
    pub(crate) normal: Vec3,
    /// Towards the viewer.
    pub(crate) to_eye: Vec3,
}

/// Twin of `shininess` in `surface.wgsl`: how smooth a surface is whose normal map has this alpha, 1 where it has none. All
/// 0 … 1. The studio takes 1 − shininess as roughness.
pub(crate) fn shininess(roughness: f32, gloss: f32) -> f32 {
    (1.0 - roughness) * gloss
}

/// What a surface mirrors at an angle, after Schlick. Up to 1 whatever it mirrors face on, as in the books.
pub(crate) fn schlick_fresnel(fresnel0: Vec3, cos_angle: f32) -> Vec3 {
    let grazing = 1.0 - cos_angle.clamp(0.0, 1.0);
    fresnel0 + (Vec3::ONE - fresnel0) * (grazing * grazing * grazing * grazing * grazing)
}

/// One light of the DirectX 12 book.
pub(crate) fn blinn_phong(surface: &BookSurface, to_light: Vec3, strength: Vec3) -> Vec3 {
    let lambert = to_light.dot(surface.normal).max(0.0);
    let power = surface.shininess * 256.0;
    let sum = surface.to_eye + to_light;
    let halfway = sum / sum.dot(sum).max(1e-8).sqrt();
    let cos_half = halfway.dot(surface.normal).max(1e-6);
    let lobe = (power + 8.0) / 8.0 * cos_half.powf(power);
    let specular = schlick_fresnel(surface.fresnel0, halfway.dot(to_light)) * lobe;
    let low = specular / (specular + Vec3::ONE);
    (surface.albedo + low) * strength * lambert
}

/// All lights of the DirectX 12 book: the first as far as it arrives (0 … 1), what comes from everywhere as far as the place is
/// open (0 … 1).
pub(crate) fn book_light(surface: &BookSurface, to_lights: [Vec3; 3], key_visible: f32, occlusion: f32) -> Vec3 {
    occlusion * BOOK_AMBIENT * surface.albedo
        + blinn_phong(surface, to_lights[0], BOOK_STRENGTHS[0]) * key_visible
        + blinn_phong(surface, to_lights[1], BOOK_STRENGTHS[1])
        + blinn_phong(surface, to_lights[2], BOOK_STRENGTHS[2])
}

/// Fraction of the sky that the DirectX 12 book mirrors. `mirrored` is where the mirrored ray goes, a unit vector.
pub(crate) fn book_reflectance(surface: &BookSurface, mirrored: Vec3) -> Vec3 {
    surface.shininess * schlick_fresnel(surface.fresnel0, surface.normal.dot(mirrored))
}

/// One light of the DirectX 11 book, without what comes from everywhere.
pub(crate) fn phong(surface: &PhongSurface, to_light: Vec3, strength: Vec3) -> Vec3 {
    let lambert = to_light.dot(surface.normal);
    if lambert <= 0.0 {
        return Vec3::ZERO;
    }
    let mirrored = (-to_light).reflect(surface.normal);
    let lobe = mirrored.dot(surface.to_eye).max(1e-6).powf(surface.power.max(1e-3));
    strength * (lambert * surface.diffuse * surface.texel + lobe * surface.specular)
}

/// All lights of the DirectX 11 book; fractions as in [`book_light`].
pub(crate) fn phong_light(surface: &PhongSurface, to_lights: [Vec3; 3], key_visible: f32, occlusion: f32) -> Vec3 {
    occlusion * BOOK_AMBIENT * surface.ambient * surface.texel
        + phong(surface, to_lights[0], BOOK_STRENGTHS[0]) * key_visible
        + phong(surface, to_lights[1], BOOK_STRENGTHS[1])
        + phong(surface, to_lights[2], BOOK_STRENGTHS[2])
}
