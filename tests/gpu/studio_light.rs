//! The studio's light in the picture, against its twin.

use std::sync::Arc;

use bindpose::image::Image;
use bindpose::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, Prefiltered, Room};
use bindpose::model::{Material, Reflectance};
use bindpose::scene::{Light, Pass, Passes, srgb8_from_linear};
use glam::Vec3;

use crate::gpu::difference;
use crate::scenes::{Scene, material};
use crate::textures::{HEIGHT, WIDTH, card_once, dds, normal as flat, plain};
use crate::twins::book::shininess;
use crate::twins::studio::{EnvironmentLight, StudioLights, StudioSurface};
use crate::twins::tone_map::{exposed, tone_mapped};

/// Bytes, dithered, from half floats that are filtered.
const ROUNDING: u8 = 3;

/// Turned away from the key, which stands above at the right, and from the rim behind: only the environment lights it.
const NORMAL: Vec3 = Vec3::new(-0.6, -0.36, -0.714);

on_both_backends! {
    fn the_picture_has_the_colours_of_the_twin(gpu) {
        let prefiltered = Prefiltered::of(&Environment::coarse_studio(Room::Dark));
        let brdf_table = BrdfTable::new(BRDF_TABLE_SIDE);
        let environment = EnvironmentLight {
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
            key_mirrored: 1.0,
            to_rim: Vec3::Y,
            rim_color: Vec3::ZERO,
        };
        let normal = NORMAL.normalize();
        let (plastic, metal) = ((Vec3::new(0.5, 0.3, 0.1), Vec3::splat(0.04)), (Vec3::ZERO, Vec3::new(0.9, 0.6, 0.3)));
        for ((albedo, fresnel0), roughness, gloss, stops) in [
            (plastic, 0.9, 255, 0.0),
            (plastic, 0.3, 255, 1.0),
            (metal, 0.2, 255, 0.0),
            (metal, 0.6, 255, -1.0),
            (metal, 0.1, 190, 0.0),
            (metal, 0.3, 100, 0.0),
            (plastic, 0.2, 0, 1.0),
        ] {
            let mut scene = card_once();
            scene.model.mesh.normals.fill(normal);
            scene.model.materials[0] = Material {
                reflectance: Reflectance::Fresnel { fresnel0: fresnel0.to_array(), roughness },
                ..material("card", albedo.to_array())
            };
            scene.options.exposure_stops = stops;
            scene.options.passes = Passes::none().with(Pass::Environment, true);
            let map = plain([128, 128, 255, gloss]);
            let found = gpu.draw_with_maps(&scene, &flat(&map), WIDTH, HEIGHT).middle();
            let surface = StudioSurface {
                albedo,
                fresnel0,
                roughness: 1.0 - shininess(roughness, f32::from(gloss) / 255.0),
                normal,
                smooth_normal: normal,
                to_eye: Vec3::NEG_Z,
                ..StudioSurface::default()
            };
            let shown = tone_mapped(exposed(environment.studio_light(&surface, &no_lights), stops));
            let [red, green, blue] = shown.to_array().map(srgb8_from_linear);
            let expected = [red, green, blue, 255];
            assert!(
                difference(found, expected) <= ROUNDING,
                "fresnel {fresnel0}, roughness {roughness}, gloss {gloss}, {stops} stops: {found:?} for {expected:?}"
            );
        }
    }

    /// Bytes where alpha would be are no gloss when the file says that there is no alpha.
    fn only_alpha_of_the_file_is_gloss(gpu) {
        let metal = Reflectance::Fresnel { fresnel0: [0.9, 0.7, 0.4], roughness: 0.2 };
        let draw = |scene: &Scene, image: &Arc<Image>| gpu.draw_with_maps(scene, &flat(image), WIDTH, HEIGHT);
        // Blue, green, red and nothing: three levels of a side of 4.
        let texels = |alpha: u8| [255, 128, 128, alpha].repeat(16 + 4 + 1);
        // Alpha at both ends of its ramp; colour at both ends of its own, the flat normal in 5, 6 and 5 bits.
        let block = |alpha: u8| [[alpha, alpha, 0, 0, 0, 0, 0, 0], [0x1f, 0x84, 0x1f, 0x84, 0, 0, 0, 0]].concat();
        let of_two = [[128, 128, 0, 0, 0, 0, 0, 0]; 2].concat();
        let none = [
            ("B8G8R8X8", dds(b"DX10", [88, 0], 4, &texels(0)), dds(b"DX10", [88, 0], 4, &texels(255))),
            (
                "opaque BC3",
                dds(b"DX10", [77, 3], 4, &block(0).repeat(3)),
                dds(b"DX10", [77, 0], 4, &block(255).repeat(3)),
            ),
            ("BC5", dds(b"BC5U", [0; 2], 4, &of_two.repeat(3)), plain([128, 128, 255, 255])),
        ];
        for light in Light::ALL {
            let mut scene = card_once();
            scene.model.materials[0].reflectance = metal;
            scene.model.materials[0].diffuse = [0.1; 3];
            scene.options.light = light;
            for (name, without, full) in &none {
                let differs = draw(&scene, without).share_that_differs(&draw(&scene, full), 2);
                assert_eq!(differs, 0.0, "{name}, {light:?}");
            }
            for (name, gloss, full) in [
                ("B8G8R8A8", dds(b"DX10", [87, 0], 4, &texels(0)), dds(b"DX10", [87, 0], 4, &texels(255))),
                ("BC3", dds(b"DXT5", [0; 2], 4, &block(0).repeat(3)), dds(b"DXT5", [0; 2], 4, &block(255).repeat(3))),
            ] {
                let differs = draw(&scene, &gloss).share_that_differs(&draw(&scene, &full), 5);
                assert!(differs > 0.1, "{name}, {light:?}: {differs}");
            }
            scene.model.materials[0].reflectance = Reflectance::Phong {
                ambient: [0.5; 3],
                specular: [0.5; 3],
                spec_power: 30.0,
                reflectivity: [0.5; 3],
            };
            let [dull, full] = [0, 255].map(|alpha| draw(&scene, &plain([128, 128, 255, alpha])));
            assert_eq!(dull, full, "the DirectX 11 book reads no gloss");
        }
    }
}
