//! What glTF's extensions lay over a surface, in the picture, against its twin.

use bindpose::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, Prefiltered, Room};
use bindpose::model::{Layers, Material};
use bindpose::scene::{Background, Pass, Passes, linear_from_srgb8, srgb8_from_linear};
use glam::Vec3;

use crate::gltf_materials::{metallic_roughness, unlit};
use crate::gpu::{Gpu, difference};
use crate::textures::{HEIGHT, WIDTH, card_once};
use crate::twins::pbr::fresnel90;
use crate::twins::studio::{EnvironmentLight, StudioLights, StudioRadiance, StudioSurface};
use crate::twins::tone_map::{exposed, tone_mapped};

/// Bytes, dithered, from half floats that are filtered.
const ROUNDING: u8 = 3;

/// Turned away from the key and from the rim: only the environment lights it.
const NORMAL: Vec3 = Vec3::new(-0.6, -0.36, -0.714);

const BASE_COLOR: Vec3 = Vec3::new(0.6, 0.3, 0.1);
const NONE: Layers = Layers {
    ior: 1.5,
    specular: 1.0,
    specular_color: [1.0; 3],
    clearcoat: 0.0,
    clearcoat_roughness: 0.0,
    sheen_color: [0.0; 3],
    sheen_roughness: 0.0,
    transmission: 0.0,
};

/// The middle of a card of this material before a colour, in the environment alone.
fn drawn(gpu: &Gpu, material: Material, background: [u8; 3]) -> [u8; 4] {
    let mut scene = card_once();
    scene.model.mesh.normals.fill(NORMAL.normalize());
    scene.model.materials = vec![material];
    scene.options.background = Background::Color(background);
    scene.options.passes = Passes::none().with(Pass::Environment, true);
    gpu.draw(&scene, WIDTH, HEIGHT).middle()
}

/// What the twin makes of a material of [`BASE_COLOR`] that is no metal.
fn of_twin(layers: &Layers, roughness: f32) -> StudioRadiance {
    let prefiltered = Prefiltered::of(&Environment::coarse_studio(Room::Dark));
    let environment = EnvironmentLight {
        prefiltered: &prefiltered,
        brdf_table: &BrdfTable::new(BRDF_TABLE_SIDE),
        turn: (1.0, 0.0),
        intensity: 1.0,
    };
    let surface = StudioSurface {
        albedo: BASE_COLOR,
        fresnel0: layers.fresnel0().into(),
        fresnel90: Some(fresnel90(Vec3::splat(layers.boundary())) * layers.specular),
        roughness,
        normal: NORMAL.normalize(),
        smooth_normal: NORMAL.normalize(),
        to_eye: Vec3::NEG_Z,
        sheen: layers.sheen_color.into(),
        sheen_roughness: layers.sheen_roughness.max(0.2),
        coat: layers.clearcoat,
        coat_roughness: layers.clearcoat_roughness.max(0.045),
        ..StudioSurface::default()
    };
    let no_lights = StudioLights {
        to_key: Vec3::Y,
        key_color: Vec3::ZERO,
        key_visible: 0.0,
        key_mirrored: 1.0,
        to_rim: Vec3::Y,
        rim_color: Vec3::ZERO,
    };
    environment.studio_radiance(&surface, &no_lights)
}

fn bytes(linear: Vec3) -> [u8; 4] {
    let [red, green, blue] = linear.to_array().map(srgb8_from_linear);
    [red, green, blue, 255]
}

fn of_layers(layers: Layers, roughness: f32) -> Material {
    Material {
        layers,
        ..metallic_roughness(BASE_COLOR.to_array(), 0.0, roughness)
    }
}

on_both_backends! {
    fn layers_have_the_colours_of_the_twin(gpu) {
        for layers in [
            NONE,
            Layers { ior: 1.0, ..NONE },
            Layers { ior: 2.4, ..NONE },
            Layers { ior: 0.0, ..NONE },
            Layers { specular: 0.25, ior: 2.0, ..NONE },
            Layers { specular_color: [4.0, 1.0, 0.0], ..NONE },
            Layers { clearcoat: 1.0, ..NONE },
            Layers { clearcoat: 0.5, clearcoat_roughness: 0.4, ..NONE },
            Layers { sheen_color: [0.9, 0.5, 0.2], sheen_roughness: 0.5, ..NONE },
            Layers { sheen_color: [1.0; 3], clearcoat: 1.0, sheen_roughness: 1.0, ..NONE },
        ] {
            let found = drawn(gpu, of_layers(layers, 0.6), [0; 3]);
            let given = of_twin(&layers, 0.6);
            let expected = bytes(tone_mapped(exposed(given.scattered + given.mirrored, 0.0)));
            assert!(difference(found, expected) <= ROUNDING, "{layers:?}: {found:?} for {expected:?}");
        }
    }

    /// Less is seen of what glass scatters, as of anything that is blended, but all that it mirrors.
    fn what_glass_mirrors_is_seen_whole(gpu) {
        let behind: [u8; 3] = [30, 90, 160];
        for (transmission, solid) in [(1.0, 0.2), (0.5, 0.6)] {
            let layers = Layers { transmission, ..NONE };
            let found = drawn(gpu, of_layers(layers, 0.1), behind);
            let given = of_twin(&layers, 0.1);
            let shown = tone_mapped(exposed(given.scattered * solid + given.mirrored, 0.0));
            let opacity = shown.max_element().max(solid + (1.0 - solid) * given.kept_out);
            let expected = bytes(shown + Vec3::from(behind.map(linear_from_srgb8)) * (1.0 - opacity));
            assert!(difference(found, expected) <= ROUNDING, "{transmission}: {found:?} for {expected:?}");
        }
        let without = drawn(gpu, unlit([200, 100, 50]), behind);
        let glass = Material { layers: Layers { transmission: 1.0, ..NONE }, ..unlit([200, 100, 50]) };
        assert_eq!(drawn(gpu, glass, behind), without, "no light goes through what is unlit");
    }
}
