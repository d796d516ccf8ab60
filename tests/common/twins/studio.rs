//! A surface in the studio: the twins of `studio.wgsl` and of the lookups in `environment.wgsl`, which say why.

use bindpose::light::{BrdfTable, Prefiltered};
use glam::{FloatExt as _, Vec3};

use super::pbr::{Reflectance, dominant_direction, horizon_fade, multi_bounce, reflectance, specular_occlusion};

/// Twin of `LAMP_RADIANCE`: the lamp's, where a white surface that faces it shows 1.
pub(crate) const LAMP_RADIANCE: f32 = 40.863_458;

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
    /// 1 when what mirrors shows it as a disc.
    pub(crate) key_mirrored: f32,
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
        let alpha = surface.roughness * surface.roughness;
        let mirrored = (-surface.to_eye).reflect(surface.normal);
        let towards = dominant_direction(surface.normal, mirrored, alpha).normalize();
        let above = horizon_fade(mirrored, surface.smooth_normal);

        let seen = specular_occlusion(n_dot_v, surface.ambient_occlusion, alpha) * above;
        let mirror_light = self.environment_specular_light(towards, surface.roughness) * seen;
        let diffuse_light =
            self.environment_diffuse(surface.normal) * multi_bounce(surface.ambient_occlusion, surface.albedo);
        let from_environment = weights.single * mirror_light + (weights.multiple + weights.diffuse) * diffuse_light;

        let n_dot_l = surface.normal.dot(lights.to_key).max(0.0);
        let lamp_share = self.brdf_table.lamp_lookup(towards, lights.to_key, surface.roughness);
        let from_key = lights.key_color
            * lights.key_visible
            * ((weights.diffuse + weights.multiple) * n_dot_l
                + weights.single * (lamp_share * LAMP_RADIANCE * above * lights.key_mirrored));
        from_environment + from_key + studio_rim(surface, &weights, n_dot_v, lights)
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

/// The part of the key's light that a surface does not keep from itself.
pub(crate) fn own_light(flat_normal: Vec3, smooth_normal: Vec3, to_key: Vec3) -> f32 {
    let smoothstep = |end: f32, start: f32, value: f32| {
        let t = value.remap(start, end, 0.0, 1.0).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let coarse = (8.0 * (1.0 - flat_normal.dot(smooth_normal))).clamp(0.02, 1.0);
    smoothstep(0.4 * coarse, 0.0, smooth_normal.dot(to_key)) * smoothstep(0.0, -0.1, flat_normal.dot(to_key))
}

fn studio_rim(surface: &StudioSurface, weights: &Reflectance, n_dot_v: f32, lights: &StudioLights) -> Vec3 {
    let edge = 1.0 - n_dot_v;
    let facing = surface.normal.dot(lights.to_rim).max(0.0) * (0.2 + 0.8 * edge * edge);
    let given_back = weights.diffuse + weights.single + weights.multiple;
    lights.rim_color * (facing * surface.ambient_occlusion) * given_back
}
