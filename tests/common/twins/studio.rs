//! A surface in the studio: the twins of `studio.wgsl` and of the lookups in `environment.wgsl`, which say why.

use std::f32::consts::PI;

use bindpose::light::{BrdfTable, Prefiltered};
use glam::{FloatExt as _, Vec3};

use super::pbr::{
    dominant_direction, fresnel90, horizon_fade, multi_bounce, reflectance, sheen_albedo, sheen_lobe,
    specular_occlusion,
};

/// Twin of `LAMP_RADIANCE`: the lamp's, where a white surface that faces it shows 1.
pub(crate) const LAMP_RADIANCE: f32 = 40.863_458;

/// Twin of `COAT_FRESNEL0`: what the clear coat mirrors face on.
pub(crate) const COAT_FRESNEL0: f32 = 0.04;

/// A point of a surface as the light meets it. Directions are of unit length, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StudioSurface {
    /// Diffuse colour.
    pub(crate) albedo: Vec3,
    /// Mirrored fraction, face on.
    pub(crate) fresnel0: Vec3,
    /// The same at grazing angles; `None` where it follows from `fresnel0`.
    pub(crate) fresnel90: Option<f32>,
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
    /// The colour of fibres that lie over the surface; black without any.
    pub(crate) sheen: Vec3,
    /// 0.2 or more.
    pub(crate) sheen_roughness: f32,
    /// How much of it a clear coat covers, 0 … 1.
    pub(crate) coat: f32,
    /// Of the coat.
    pub(crate) coat_roughness: f32,
    /// Of the coat, on the side of the viewer; `None` where it is `smooth_normal`.
    pub(crate) coat_normal: Option<Vec3>,
}

/// White, without what is mirrored or lies over it, seen face on.
impl Default for StudioSurface {
    fn default() -> Self {
        Self {
            albedo: Vec3::ONE,
            fresnel0: Vec3::ZERO,
            fresnel90: None,
            roughness: 1.0,
            normal: Vec3::Y,
            smooth_normal: Vec3::Y,
            to_eye: Vec3::Y,
            ambient_occlusion: 1.0,
            sheen: Vec3::ZERO,
            sheen_roughness: 1.0,
            coat: 0.0,
            coat_roughness: 0.05,
            coat_normal: None,
        }
    }
}

/// Radiance towards the eye; linear, may exceed 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StudioRadiance {
    /// Of light that entered the surface and came back.
    pub(crate) scattered: Vec3,
    /// Of light that did not enter it.
    pub(crate) mirrored: Vec3,
    /// The fraction of light that does not enter, of what comes from all around.
    pub(crate) kept_out: f32,
}

impl StudioRadiance {
    /// What a layer leaves of it that gives back `share` of light from all around, here `light`.
    fn beneath(self, share: f32, light: Vec3) -> Self {
        let left = 1.0 - share;
        Self {
            scattered: self.scattered * left,
            mirrored: self.mirrored * left + light,
            kept_out: 1.0 - (1.0 - self.kept_out) * left,
        }
    }
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
        let given = self.studio_radiance(surface, lights);
        given.scattered + given.mirrored
    }

    /// The same, by what became of the light.
    pub(crate) fn studio_radiance(&self, surface: &StudioSurface, lights: &StudioLights) -> StudioRadiance {
        let n_dot_v = surface.normal.dot(surface.to_eye).clamp(1e-3, 1.0);
        let entry = self.brdf_table.lookup(n_dot_v, surface.roughness);
        let grazing = surface.fresnel90.unwrap_or_else(|| fresnel90(surface.fresnel0));
        let weights = reflectance(surface.albedo, surface.fresnel0, grazing, entry);

        let key = lights.key_color * lights.key_visible;
        let n_dot_l = surface.normal.dot(lights.to_key).max(0.0);
        let around = self.environment_diffuse(surface.normal) * multi_bounce(surface.ambient_occlusion, surface.albedo)
            + studio_rim(surface, n_dot_v, lights);
        let even = around + key * n_dot_l;
        let mirror = self.mirrored_light(surface, surface.normal, n_dot_v, surface.roughness, lights);
        let mut given = StudioRadiance {
            scattered: weights.diffuse * even,
            mirrored: weights.single * mirror + weights.multiple * even,
            kept_out: (weights.single + weights.multiple).max_element(),
        };
        if surface.sheen.max_element() > 0.0 {
            let share = sheen_albedo(n_dot_v, surface.sheen_roughness);
            let sum = surface.to_eye + lights.to_key;
            let n_dot_h = (surface.normal.dot(sum) / sum.dot(sum).max(1e-8).sqrt()).clamp(0.0, 1.0);
            let lobe = PI * sheen_lobe(n_dot_l, n_dot_v, n_dot_h, surface.sheen_roughness);
            let light = surface.sheen * (around * share + key * (n_dot_l * lobe));
            given = given.beneath(surface.sheen.max_element() * share, light);
        }
        if surface.coat > 0.0 {
            let normal = surface.coat_normal.unwrap_or(surface.smooth_normal);
            let coat_dot_v = normal.dot(surface.to_eye).clamp(1e-3, 1.0);
            let entry = self.brdf_table.lookup(coat_dot_v, surface.coat_roughness);
            let share = surface.coat * (COAT_FRESNEL0 * entry.x + entry.y);
            let mirror = self.mirrored_light(surface, normal, coat_dot_v, surface.coat_roughness, lights);
            given = given.beneath(share, share * mirror);
        }
        given
    }

    /// What a mirror of this normal and roughness shows.
    fn mirrored_light(
        &self,
        surface: &StudioSurface,
        normal: Vec3,
        n_dot_v: f32,
        roughness: f32,
        lights: &StudioLights,
    ) -> Vec3 {
        let alpha = roughness * roughness;
        let mirrored = (-surface.to_eye).reflect(normal);
        let towards = dominant_direction(normal, mirrored, alpha).normalize();
        let above = horizon_fade(mirrored, surface.smooth_normal);
        let seen = specular_occlusion(n_dot_v, surface.ambient_occlusion, alpha) * above;
        let lamp_share = self.brdf_table.lamp_lookup(towards, lights.to_key, roughness);
        let lamp_seen = lamp_share * LAMP_RADIANCE * above * lights.key_mirrored;
        self.environment_specular_light(towards, roughness) * seen
            + lights.key_color * (lights.key_visible * lamp_seen)
            + studio_rim(surface, n_dot_v, lights)
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

/// What a white surface shows of the rim.
fn studio_rim(surface: &StudioSurface, n_dot_v: f32, lights: &StudioLights) -> Vec3 {
    let edge = 1.0 - n_dot_v;
    let facing = surface.normal.dot(lights.to_rim).max(0.0) * (0.2 + 0.8 * edge * edge);
    lights.rim_color * (facing * surface.ambient_occlusion)
}
