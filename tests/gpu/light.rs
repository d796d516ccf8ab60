//! The lights on the GPU, read back, against their twins on the CPU; and furnaces, with the textures really sampled.

mod book;
mod evaluate;
mod upload;

use bindpose::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, Prefiltered, Room as Studio};
use bindpose::render::device::Backend;
use glam::{Vec2, Vec3};

use crate::twins::pbr::{
    dominant_direction, fresnel90, horizon_fade, multi_bounce, reflectance, sheen_albedo, sheen_lobe,
    specular_occlusion, widened,
};
use crate::twins::studio::{EnvironmentLight, StudioLights, StudioSurface, own_light};
use crate::twins::tone_map::{exposed, tone_mapped};

const ANGLES: u32 = 32;
const ROUGHNESSES: u32 = 16;
const QUANTITIES: u32 = 15;

/// Formulas in f32 on both sides; devices may round roots and powers by a few digits, and narrow lobes enlarge that.
const FORMULA: f32 = 1e-3;
/// Coefficients in f32 and a polynomial.
const POLYNOMIAL: f32 = 1e-5;
/// Texels are half floats, and devices may place samples to 1/256 of a texel.
const TEXTURE: f32 = 0.013;

/// What a device is given.
struct Room<'a> {
    prefiltered: &'a Prefiltered,
    brdf_table: &'a BrdfTable,
    turn: (f32, f32),
    intensity: f32,
    key_color: Vec3,
    rim_color: Vec3,
}

impl Room<'_> {
    /// The value of one case, by the twins.
    fn on_cpu(&self, quantity: u32, n_dot_v: f32, roughness: f32) -> Vec3 {
        let alpha = roughness * roughness;
        let to_eye = Vec3::new((1.0 - n_dot_v * n_dot_v).sqrt(), n_dot_v, 0.0);
        let to_light = Vec3::new(-0.5, 0.6, 0.3).normalize();
        let environment = EnvironmentLight {
            prefiltered: self.prefiltered,
            brdf_table: self.brdf_table,
            turn: self.turn,
            intensity: self.intensity,
        };
        match quantity {
            0 => {
                let tilted = Vec3::new(n_dot_v - 0.5, 1.0, 0.2 * roughness).normalize();
                Vec3::new(
                    widened(roughness, n_dot_v * 0.2),
                    own_light(Vec3::Y, tilted, to_light),
                    own_light(tilted, Vec3::Y, to_eye),
                )
            }
            1 => {
                let scale_bias = Vec2::new(n_dot_v, roughness) * 0.5;
                let given = reflectance(Vec3::new(0.8, 0.5, 0.2), Vec3::new(0.04, 0.2, 0.6), 0.9, scale_bias);
                given.single + given.multiple * 2.0 + given.diffuse * 3.0
            }
            2 => {
                let tilted = Vec3::new(0.6, 0.5, 0.2).normalize();
                Vec3::new(
                    specular_occlusion(n_dot_v, roughness, alpha),
                    horizon_fade((-to_eye).reflect(tilted), Vec3::Y),
                    dominant_direction(Vec3::Y, (-to_eye).reflect(Vec3::Y), alpha).y,
                ) + multi_bounce(n_dot_v, Vec3::new(roughness, 0.5, 0.9))
            }
            3 => tone_mapped(exposed(Vec3::new(n_dot_v, roughness, 0.3) * 2.0, roughness * 4.0 - 2.0)),
            4 => environment.environment_diffuse(to_eye),
            5 => environment.environment_specular_light(mirrored(to_eye, roughness), roughness),
            6 => {
                let scale_bias = self.brdf_table.lookup(n_dot_v, roughness);
                scale_bias.extend(self.brdf_table.lamp_lookup(to_eye, to_light, roughness))
            }
            7 => {
                let sheen_roughness = 0.2 + 0.8 * roughness;
                Vec3::new(
                    sheen_albedo(n_dot_v, sheen_roughness),
                    sheen_lobe(roughness, n_dot_v, 1.0 - n_dot_v * roughness, sheen_roughness),
                    fresnel90(Vec3::splat(0.03 * n_dot_v)),
                )
            }
            _ => {
                let lights = StudioLights {
                    to_key: to_light,
                    key_color: self.key_color,
                    key_visible: 0.75,
                    key_mirrored: 0.9,
                    to_rim: Vec3::new(0.0, 0.6, -0.8),
                    rim_color: self.rim_color,
                };
                let plain = StudioSurface {
                    albedo: Vec3::ONE,
                    fresnel0: Vec3::splat(0.04),
                    roughness,
                    normal: Vec3::Y,
                    smooth_normal: Vec3::Y,
                    to_eye,
                    ..StudioSurface::default()
                };
                let shaded = StudioSurface {
                    albedo: Vec3::new(0.6, 0.4, 0.3),
                    normal: Vec3::new(0.1, 1.0, -0.2).normalize(),
                    ambient_occlusion: 0.6,
                    ..plain
                };
                let surface = match quantity {
                    8 => plain,
                    9 => StudioSurface {
                        fresnel0: Vec3::ONE,
                        ..plain
                    },
                    10 => StudioSurface {
                        coat: 1.0,
                        coat_roughness: 1.05 - roughness,
                        ..plain
                    },
                    11 => StudioSurface {
                        sheen: Vec3::ONE,
                        sheen_roughness: roughness.max(0.2),
                        ..plain
                    },
                    13 => StudioSurface {
                        fresnel90: Some(0.5),
                        sheen: Vec3::new(0.2, 0.5, 0.3),
                        sheen_roughness: 0.6,
                        coat: 0.75,
                        coat_roughness: 0.2,
                        ..shaded
                    },
                    _ => shaded,
                };
                let given = environment.studio_radiance(&surface, &lights);
                if quantity == 14 {
                    return given.scattered + given.kept_out;
                }
                environment.studio_light(&surface, &lights)
            }
        }
    }

    /// Whether the lookup of quantity 5 takes texels of two faces. OpenGL ES 3, WebGL2 and all others blend them, but
    /// natively wgpu opens desktop OpenGL, which does so only when told to, and wgpu does not tell it.
    fn filters_over_an_edge(&self, n_dot_v: f32, roughness: f32) -> bool {
        let (cos, sin) = self.turn;
        let to_eye = Vec3::new((1.0 - n_dot_v * n_dot_v).sqrt(), n_dot_v, 0.0);
        let Vec3 { x, y, z } = mirrored(to_eye, roughness);
        let mut sizes = [x * cos + z * sin, y, z * cos - x * sin].map(f32::abs);
        sizes.sort_by(f32::total_cmp);
        let level = (roughness * (2.0 - roughness) * (self.prefiltered.level_count() - 1) as f32).ceil();
        let side = self.prefiltered.side() as f32 / level.exp2();
        sizes[1] / sizes[2] > 1.0 - 1.0 / side
    }
}

/// The direction in which quantity 5 looks up mirror light: many, all over the upper half.
fn mirrored(to_eye: Vec3, roughness: f32) -> Vec3 {
    to_eye + Vec3::Z * (roughness - 0.5)
}

/// Every case as quantity, n·v and roughness, in the order of the pixels.
fn cases() -> impl Iterator<Item = (u32, f32, f32)> {
    (0..QUANTITIES * ROUGHNESSES).flat_map(|row| {
        (0..ANGLES).map(move |column| {
            let n_dot_v = (column as f32 + 0.5) / ANGLES as f32;
            let roughness = (row % ROUGHNESSES) as f32 / (ROUGHNESSES - 1) as f32;
            (row / ROUGHNESSES, n_dot_v, roughness.max(0.05))
        })
    })
}

on_both_backends! {
    fn formulas_and_lookups_agree_with_their_twins(gpu) {
        let room = Room {
            prefiltered: &Prefiltered::of(&Environment::coarse_studio(Studio::Dark)),
            brdf_table: &BrdfTable::new(BRDF_TABLE_SIDE),
            turn: (0.6, -0.8),
            intensity: 1.25,
            key_color: Studio::Dark.lights().key,
            rim_color: Studio::Dark.lights().rim,
        };
        let found = room.on_gpu(gpu);
        assert_eq!(found.len(), cases().count());
        for ((quantity, n_dot_v, roughness), found) in cases().zip(found) {
            if quantity == 5 && gpu.backend == Backend::Gl && room.filters_over_an_edge(n_dot_v, roughness) {
                continue;
            }
            let expected = room.on_cpu(quantity, n_dot_v, roughness);
            let tolerance = match quantity {
                0..=3 | 7 => FORMULA,
                4 => POLYNOMIAL,
                _ => TEXTURE,
            };
            let error = (found - expected).abs().max_element() / expected.max_element().max(0.1);
            assert!(
                error <= tolerance,
                "quantity {quantity}, n·v {n_dot_v}, roughness {roughness}: {found} for {expected}, off by {error:e}"
            );
        }
    }
    fn a_white_surface_vanishes_in_a_white_room(gpu) {
        let room = Room {
            prefiltered: &Prefiltered::of(&Environment::from_fn(16, |_| Vec3::ONE)),
            brdf_table: &BrdfTable::new(BRDF_TABLE_SIDE),
            turn: (0.8, 0.6),
            intensity: 1.0,
            key_color: Vec3::ZERO,
            rim_color: Vec3::ZERO,
        };
        let white = |&((quantity, ..), _): &((u32, f32, f32), Vec3)| (8..12).contains(&quantity);
        let found: Vec<_> = cases().zip(room.on_gpu(gpu)).filter(white).collect();
        assert_eq!(found.len() as u32, 4 * ANGLES * ROUGHNESSES);
        for ((quantity, n_dot_v, roughness), found) in found {
            let error = (found - Vec3::ONE).abs().max_element();
            assert!(error < 0.02, "quantity {quantity}, n·v {n_dot_v}, roughness {roughness}: {found}");
        }
    }
}
