//! How a surface gives light back: the twin of `pbr.wgsl`, which says what each function means; and the lobe itself, which shaders know
//! from tables alone.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

/// GGX: how densely micro-facets face `halfway`, per steradian. Both vectors are of unit length.
pub(crate) fn ggx_distribution(normal: Vec3, halfway: Vec3, alpha: f32) -> f32 {
    let sine = normal.cross(halfway);
    let scaled_cos = normal.dot(halfway) * alpha;
    let ratio = alpha / (sine.dot(sine) + scaled_cos * scaled_cos);
    ratio * ratio / PI
}

/// Smith's height-correlated shadowing and masking of GGX over 4 (n·l) (n·v). Both cosines are above 0.
pub(crate) fn smith_visibility(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    let squared = alpha * alpha;
    let towards_light = n_dot_v * (n_dot_l * n_dot_l * (1.0 - squared) + squared).sqrt();
    let towards_eye = n_dot_l * (n_dot_v * n_dot_v * (1.0 - squared) + squared).sqrt();
    0.5 / (towards_light + towards_eye)
}

/// What a surface mirrors at grazing angles.
pub(crate) fn fresnel90(fresnel0: Vec3) -> f32 {
    fresnel0.dot(Vec3::splat(50.0 / 3.0)).clamp(0.0, 1.0)
}

/// What a surface mirrors at an angle, after Schlick.
pub(crate) fn fresnel_schlick(fresnel0: Vec3, cos_angle: f32) -> Vec3 {
    let grazing = 1.0 - cos_angle.clamp(0.0, 1.0);
    let squared = grazing * grazing;
    fresnel0.lerp(Vec3::splat(fresnel90(fresnel0)), squared * squared * grazing)
}

/// The fraction of mirrored light of one direction, per steradian, after one bounce. `n_dot_l` and `n_dot_v` are above 0.
pub(crate) fn specular_lobe(
    normal: Vec3,
    to_eye: Vec3,
    to_light: Vec3,
    n_dot_l: f32,
    n_dot_v: f32,
    fresnel0: Vec3,
    alpha: f32,
) -> Vec3 {
    let sum = to_eye + to_light;
    let halfway = sum / sum.dot(sum).max(1e-8).sqrt();
    let lobe = ggx_distribution(normal, halfway, alpha) * smith_visibility(n_dot_l, n_dot_v, alpha);
    fresnel_schlick(fresnel0, to_eye.dot(halfway)) * lobe
}

/// What becomes of light that falls on a surface evenly from all around. With an albedo of 1 the weights sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reflectance {
    /// Mirrored in one bounce.
    pub(crate) single: Vec3,
    /// Mirrored after more bounces between the micro-facets, so without direction.
    pub(crate) multiple: Vec3,
    /// Entered the surface and came back.
    pub(crate) diffuse: Vec3,
}

/// The weights for one view and roughness, of which `scale_bias` comes from the [table](bindpose::light::BrdfTable). `at_grazing` is what
/// is mirrored at grazing angles.
pub(crate) fn reflectance(albedo: Vec3, fresnel0: Vec3, at_grazing: f32, scale_bias: Vec2) -> Reflectance {
    let grazing = Vec3::splat(at_grazing);
    let single = fresnel0 * scale_bias.x + grazing * scale_bias.y;
    let average = fresnel0 + (grazing - fresnel0) / 21.0;
    let trapped = 1.0 - (scale_bias.x + scale_bias.y).min(1.0);
    let boost = Vec3::ONE / (Vec3::ONE - average.min(Vec3::ONE) * trapped);
    let multiple = single * (boost - Vec3::ONE);
    let diffuse = albedo * (Vec3::ONE - single - multiple).max(Vec3::ZERO);
    Reflectance {
        single,
        multiple,
        diffuse,
    }
}

/// The fraction of one direction's light that a sheen gives back, per steradian. `n_dot_v` is above 0.
pub(crate) fn sheen_lobe(n_dot_l: f32, n_dot_v: f32, n_dot_h: f32, roughness: f32) -> f32 {
    let inverse = 1.0 / (roughness * roughness);
    let sine = (1.0 - n_dot_h * n_dot_h).max(1e-6).sqrt();
    let distribution = (2.0 + inverse) * sine.powf(inverse) / TAU;
    distribution / (4.0 * (n_dot_l + n_dot_v - n_dot_l * n_dot_v))
}

/// What [`sheen_lobe`] gives back of light from all around, at most 1.
pub(crate) fn sheen_albedo(n_dot_v: f32, roughness: f32) -> f32 {
    let level = -0.335 - 0.324 * roughness + 0.206 / roughness;
    let slope = 0.455 * roughness - 1.343 / roughness;
    (level + slope * n_dot_v - 0.579 * roughness * n_dot_v.sqrt())
        .exp()
        .min(1.0)
}

/// Where the lobe of a rough surface is strongest; not of unit length.
pub(crate) fn dominant_direction(normal: Vec3, mirrored: Vec3, alpha: f32) -> Vec3 {
    let smoothness = 1.0 - alpha;
    normal.lerp(mirrored, smoothness * (smoothness.sqrt() + alpha))
}

/// Fraction of the reflected environment that a point sees whose ambient occlusion is `occlusion`, 0 … 1.
pub(crate) fn specular_occlusion(n_dot_v: f32, occlusion: f32, alpha: f32) -> f32 {
    let seen = (n_dot_v + occlusion).max(1e-4);
    (seen.powf((-16.0 * alpha - 1.0).exp2()) - 1.0 + occlusion).clamp(0.0, 1.0)
}

/// Fades out mirrored directions that a bump turns below the surface itself.
pub(crate) fn horizon_fade(mirrored: Vec3, smooth_normal: Vec3) -> f32 {
    let above = (1.0 + 1.3 * mirrored.dot(smooth_normal)).clamp(0.0, 1.0);
    above * above
}

/// What ambient occlusion leaves of the light on a surface of this albedo.
pub(crate) fn multi_bounce(visible: f32, albedo: Vec3) -> Vec3 {
    let a = 2.0404 * albedo - 0.3324;
    let b = -4.7951 * albedo + 0.6417;
    let c = 2.7552 * albedo + 0.6903;
    Vec3::splat(visible).max(((visible * a + b) * visible + c) * visible)
}

/// Roughness with `widening` added to the square of alpha.
pub(crate) fn widened(roughness: f32, widening: f32) -> f32 {
    let alpha = roughness * roughness;
    (alpha * alpha + widening).clamp(0.0, 1.0).sqrt().sqrt()
}
