//! A surface in the studio: the twins of `studio.wgsl` and of the lookups in `environment.wgsl`, which say why.

use std::f32::consts::PI;

use bindpose::light::{BrdfTable, Prefiltered};
use glam::Vec3;

use super::pbr::{Reflectance, dominant_direction, horizon_fade, reflectance, specular_lobe, specular_occlusion};

/// Twin of `KEY_SIZE`: by how much of alpha the key's mirror image is spread.
pub(crate) const KEY_SIZE: f32 = 0.08;

/// The key light of the studio, a little warm: what a white surface that faces it shows.
pub(crate) const KEY_COLOR: Vec3 = Vec3::new(1.00, 0.975, 0.93);

/// The rim light of the studio, cool: from behind, opposite to the key.
pub(crate) const RIM_COLOR: Vec3 = Vec3::new(0.50, 0.66, 0.95);

/// A point of a surface as the light meets it. Directions are of unit length, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StudioSurface {
    /// Diffuse colour.
    pub(crate) albedo: Vec3,
    /// Mirrored fraction, face on.
    pub(crate) fresnel0: Vec3,
    /// 0 smooth, 1 rough; with the gloss of the normal map, if it has any: 1 − [`shininess`](super::book::shininess).
    pub(crate) roughness: f32,
    /// On the side of the viewer, with the normal map's bumps.
    pub(crate) normal: Vec3,
    /// The same without.
    pub(crate) smooth_normal: Vec3,
    /// Towards the viewer.
    pub(crate) to_eye: Vec3,
    /// Fraction of the environment that the point sees, 0 … 1.
    pub(crate) ambient_occlusion: f32,
}

/// The direct lights at a point. Colours are what a white surface that faces the light shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StudioLights {
    /// Unit, in the world.
    pub(crate) to_key: Vec3,
    /// Of the key.
    pub(crate) key_color: Vec3,
    /// 0 in shadow, 1 lit.
    pub(crate) key_visible: f32,
    /// Unit, in the world; behind the model.
    pub(crate) to_rim: Vec3,
    /// Of the rim.
    pub(crate) rim_color: Vec3,
}

/// What the bindings of `environment.wgsl` hold.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EnvironmentLight<'a> {
    /// The environment, filtered.
    pub(crate) prefiltered: &'a Prefiltered,
    /// How surfaces reflect it.
    pub(crate) brdf_table: &'a BrdfTable,
    /// Cosine and sine of the turn from the world: the world's `(cos, 0, sin)` is the environment's x.
    pub(crate) turn: (f32, f32),
    /// Multiplies all its light.
    pub(crate) intensity: f32,
}

impl EnvironmentLight<'_> {
    /// Radiance towards the eye; linear, may exceed 1.
    pub(crate) fn studio_light(&self, surface: &StudioSurface, lights: &StudioLights) -> Vec3 {
        let n_dot_v = surface.normal.dot(surface.to_eye).clamp(1e-3, 1.0);
        let scale_bias = self.brdf_table.lookup(n_dot_v, surface.roughness);
        let weights = reflectance(surface.albedo, surface.fresnel0, scale_bias);
        self.studio_environment(surface, &weights, n_dot_v)
            + studio_key(surface, &weights, n_dot_v, lights)
            + studio_rim(surface, &weights, n_dot_v, lights)
    }

    fn studio_environment(&self, surface: &StudioSurface, weights: &Reflectance, n_dot_v: f32) -> Vec3 {
        let alpha = surface.roughness * surface.roughness;
        let mirrored = (-surface.to_eye).reflect(surface.normal);
        let towards = dominant_direction(surface.normal, mirrored, alpha);
        let seen = specular_occlusion(n_dot_v, surface.ambient_occlusion, alpha)
            * horizon_fade(mirrored, surface.smooth_normal);
        let mirror_light = self.environment_specular_light(towards, surface.roughness) * seen;
        let diffuse_light = self.environment_diffuse(surface.normal) * surface.ambient_occlusion;
        weights.single * mirror_light + (weights.multiple + weights.diffuse) * diffuse_light
    }

    /// What a white surface with this normal shows.
    pub(crate) fn environment_diffuse(&self, normal: Vec3) -> Vec3 {
        let normal = self.environment_from_world(normal);
        self.prefiltered.irradiance().towards(normal) * self.intensity
    }

    /// What a mirror of this roughness shows in a direction of any length but 0.
    pub(crate) fn environment_specular_light(&self, direction: Vec3, roughness: f32) -> Vec3 {
        let towards = self.environment_from_world(direction);
        self.prefiltered.sample(towards, roughness) * self.intensity
    }

    fn environment_from_world(&self, direction: Vec3) -> Vec3 {
        let (cos, sin) = self.turn;
        Vec3::new(
            direction.x * cos + direction.z * sin,
            direction.y,
            direction.z * cos - direction.x * sin,
        )
    }
}

fn studio_key(surface: &StudioSurface, weights: &Reflectance, n_dot_v: f32, lights: &StudioLights) -> Vec3 {
    let n_dot_l = surface.normal.dot(lights.to_key);
    if n_dot_l <= 0.0 {
        return Vec3::ZERO;
    }
    let alpha = (surface.roughness * surface.roughness + KEY_SIZE).min(1.0);
    let &StudioSurface {
        normal,
        to_eye,
        fresnel0,
        ..
    } = surface;
    let lobe = specular_lobe(normal, to_eye, lights.to_key, n_dot_l, n_dot_v, fresnel0, alpha);
    lights.key_color * (lights.key_visible * n_dot_l) * (weights.diffuse + PI * weights.boost * lobe)
}

fn studio_rim(surface: &StudioSurface, weights: &Reflectance, n_dot_v: f32, lights: &StudioLights) -> Vec3 {
    let edge = 1.0 - n_dot_v;
    let facing = surface.normal.dot(lights.to_rim).max(0.0) * (0.2 + 0.8 * edge * edge);
    let given_back = weights.diffuse + weights.single + weights.multiple;
    lights.rim_color * (facing * surface.ambient_occlusion) * given_back
}
