//! The studio's light in the picture, against its twin.

use bindpose::light::studio::{StudioLights, StudioSurface, Surroundings};
use bindpose::light::tone_map::{exposed, tone_mapped};
use bindpose::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, Prefiltered};
use bindpose::model::{Material, Reflectance};
use bindpose::scene::{Pass, Passes, srgb8_from_linear};
use glam::Vec3;

use crate::gpu::difference;
use crate::scenes::material;
use crate::textures::{HEIGHT, WIDTH, card_once};

/// Bytes, dithered, from half floats that are filtered.
const ROUNDING: u8 = 3;

/// Turned away from the key, which stands above at the right, and from the rim behind: the surroundings alone are left.
const NORMAL: Vec3 = Vec3::new(-0.6, -0.36, -0.714);

on_both_backends! {
    fn the_picture_has_the_colours_of_the_twin(gpu) {
        let prefiltered = Prefiltered::of(&Environment::studio());
        let brdf_table = BrdfTable::new(BRDF_TABLE_SIDE);
        let surroundings = Surroundings {
            prefiltered: &prefiltered,
            brdf_table: &brdf_table,
            // For a viewer who looks along +z.
            turn: (1.0, 0.0),
            intensity: 1.0,
        };
        let no_lights = StudioLights {
            to_key: Vec3::Y,
            key_color: Vec3::ZERO,
            key_visible: 0.0,
            to_rim: Vec3::Y,
            rim_color: Vec3::ZERO,
        };
        let normal = NORMAL.normalize();
        let (plastic, metal) = ((Vec3::new(0.5, 0.3, 0.1), Vec3::splat(0.04)), (Vec3::ZERO, Vec3::new(0.9, 0.6, 0.3)));
        for ((albedo, fresnel0), roughness, stops) in
            [(plastic, 0.9, 0.0), (plastic, 0.3, 1.0), (metal, 0.2, 0.0), (metal, 0.6, -1.0)]
        {
            let mut scene = card_once();
            scene.model.mesh.normals.fill(normal);
            scene.model.materials[0] = Material {
                reflectance: Reflectance::Fresnel { fresnel0: fresnel0.to_array(), roughness },
                ..material("card", albedo.to_array())
            };
            scene.options.exposure_stops = stops;
            scene.options.passes = Passes::none().with(Pass::Environment, true);
            let found = gpu.draw(&scene, WIDTH, HEIGHT).middle();
            let surface = StudioSurface {
                albedo,
                fresnel0,
                roughness,
                normal,
                smooth_normal: normal,
                to_eye: Vec3::NEG_Z,
                ambient_occlusion: 1.0,
            };
            let shown = tone_mapped(exposed(surroundings.studio_light(&surface, &no_lights), stops));
            let [red, green, blue] = shown.to_array().map(srgb8_from_linear);
            let expected = [red, green, blue, 255];
            assert!(
                difference(found, expected) <= ROUNDING,
                "fresnel {fresnel0}, roughness {roughness}, {stops} stops: {found:?} for {expected:?}"
            );
        }
    }
}
