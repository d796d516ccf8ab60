//! What glTF's extensions lay over a surface, in the picture, against its twin.

use std::sync::Arc;

use bindpose::image::Image;
use bindpose::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, Prefiltered, Room};
use bindpose::model::{Layers, MapSlot, Material, MaterialMap, Sampling};
use bindpose::scene::{Background, Pass, Passes, linear_from_srgb8, srgb8_from_linear};
use glam::Vec3;

use crate::gltf_materials::{metallic_roughness, unlit};
use crate::gpu::{Gpu, difference};
use crate::scenes::Scene;
use crate::textures::{HEIGHT, WIDTH, card_once, images, linear, plain};
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
    clearcoat_normal_scale: 1.0,
    sheen_color: [0.0; 3],
    sheen_roughness: 0.0,
    transmission: 0.0,
};

/// A card of this material before a colour, in the environment alone.
fn scene_of(material: Material, background: [u8; 3]) -> Scene {
    let mut scene = card_once();
    scene.model.mesh.normals.fill(NORMAL.normalize());
    scene.model.materials = vec![material];
    scene.options.background = Background::Color(background);
    scene.options.passes = Passes::none().with(Pass::Environment, true);
    scene
}

/// Its middle.
fn drawn(gpu: &Gpu, material: Material, background: [u8; 3]) -> [u8; 4] {
    gpu.draw(&scene_of(material, background), WIDTH, HEIGHT).middle()
}

/// The same before black with one map, so much brighter.
fn drawn_with(gpu: &Gpu, material: &Material, map: Option<(MapSlot, &Arc<Image>)>, stops: f32) -> [u8; 4] {
    let mut scene = scene_of(material.clone(), [0; 3]);
    scene.options.exposure_stops = stops;
    gpu.draw_with_maps(&scene, &[images(map)], WIDTH, HEIGHT).middle()
}

/// What the twin makes of a material of [`BASE_COLOR`] that is no metal.
fn of_twin(layers: &Layers, roughness: f32) -> StudioRadiance {
    of_colored_twin(BASE_COLOR, layers, roughness, None)
}

/// The same of another colour, with a coat whose normal is another.
fn of_colored_twin(albedo: Vec3, layers: &Layers, roughness: f32, coat_normal: Option<Vec3>) -> StudioRadiance {
    let prefiltered = Prefiltered::of(&Environment::coarse_studio(Room::Dark));
    let environment = EnvironmentLight {
        prefiltered: &prefiltered,
        brdf_table: &BrdfTable::new(BRDF_TABLE_SIDE),
        turn: (1.0, 0.0),
        intensity: 1.0,
    };
    let surface = StudioSurface {
        albedo,
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
        coat_normal,
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

    /// A map multiplies its number, and channels that are not read change nothing. On black and bright, since layers give little light.
    fn maps_multiply_the_numbers_of_layers(gpu) {
        const STOPS: f32 = 3.0;
        let plastic = Layers { specular_color: [8.0, 4.0, 8.0], ..NONE };
        let coated = Layers { specular: 0.0, clearcoat: 1.0, clearcoat_roughness: 1.0, ..NONE };
        let cloth = Layers { specular: 0.0, sheen_color: [0.9, 0.5, 0.2], sheen_roughness: 0.9, ..NONE };
        let texel = [60, 90, 128, 80];
        let image = plain(texel);
        let [red, green, _, alpha] = texel.map(|byte| f32::from(byte) / 255.0);
        let color = linear([60, 90, 128]);
        let times = |numbers: [f32; 3]| std::array::from_fn(|channel| numbers[channel] * color[channel]);
        let [in_color, in_red, in_green, in_alpha] = [0b0111, 0b0001, 0b0010, 0b1000];
        for (slot, channels, numbers, expected) in [
            (MapSlot::Specular, in_color, plastic, Layers { specular_color: times(plastic.specular_color), ..plastic }),
            (MapSlot::Specular, in_alpha, plastic, Layers { specular: alpha, ..plastic }),
            (MapSlot::Clearcoat, in_red, coated, Layers { clearcoat: red, ..coated }),
            (MapSlot::Clearcoat, in_green, coated, Layers { clearcoat_roughness: green, ..coated }),
            (MapSlot::Sheen, in_color, cloth, Layers { sheen_color: times(cloth.sheen_color), ..cloth }),
            (MapSlot::Sheen, in_alpha, cloth, Layers { sheen_roughness: 0.9 * alpha, ..cloth }),
        ] {
            let sampling = Sampling {
                channels: std::array::from_fn(|channel| channels >> channel & 1 == 1),
                ..Sampling::default()
            };
            let map = MaterialMap { name: "map".to_owned(), sampling };
            let without = Material { diffuse: [0.0; 3], ..of_layers(numbers, 0.6) };
            let mut material = without.clone();
            match slot {
                MapSlot::Specular => material.specular_map = Some(map),
                MapSlot::Clearcoat => material.clearcoat_map = Some(map),
                _ => material.sheen_map = Some(map),
            }
            let found = drawn_with(gpu, &material, Some((slot, &image)), STOPS);
            let given = of_colored_twin(Vec3::ZERO, &expected, 0.6, None);
            let shown = bytes(tone_mapped(exposed(given.scattered + given.mirrored, STOPS)));
            assert!(difference(found, shown) <= ROUNDING, "{slot:?} {channels:b}: {found:?} for {shown:?}");
            let without = drawn_with(gpu, &without, None, STOPS);
            assert!(difference(found, without) > 2 * ROUNDING, "{slot:?} {channels:b} is seen: {found:?}, {without:?}");
            let lacking = drawn_with(gpu, &material, None, STOPS);
            assert!(difference(lacking, without) <= 1, "{slot:?}: a map that is not there is white");
        }
    }

    /// The coat has a normal map of its own, which bends nothing beneath it.
    fn the_coats_normal_map_bends_the_coat_alone(gpu) {
        let layers = Layers { clearcoat: 1.0, clearcoat_roughness: 0.3, ..NONE };
        // So bent the coat mirrors the bright wall to the left. The card's tangents run along x.
        let bent = Vec3::new(-0.53, 0.07, -0.84).normalize();
        let normal = NORMAL.normalize();
        let tangent = (Vec3::X - normal * normal.x).normalize();
        let in_map = Vec3::new(bent.dot(tangent), bent.dot(normal.cross(tangent)), bent.dot(normal));
        let [x, y, z] = in_map.to_array().map(|part| (part * 127.5 + 127.5).round() as u8);
        let image = plain([x, y, z, 255]);
        let material = |scale| Material {
            clearcoat_normal_map: Some("drops.png".into()),
            ..of_layers(Layers { clearcoat_normal_scale: scale, ..layers }, 0.6)
        };
        let found = drawn_with(gpu, &material(1.0), Some((MapSlot::ClearcoatNormal, &image)), 0.0);
        let given = of_colored_twin(BASE_COLOR, &layers, 0.6, Some(bent));
        let expected = bytes(tone_mapped(exposed(given.scattered + given.mirrored, 0.0)));
        assert!(difference(found, expected) <= ROUNDING, "{found:?} for {expected:?}");
        let straight = drawn(gpu, of_layers(layers, 0.6), [0; 3]);
        assert!(difference(found, straight) > 2 * ROUNDING, "{found:?} and {straight:?}");
        let flat = drawn_with(gpu, &material(0.0), Some((MapSlot::ClearcoatNormal, &image)), 0.0);
        assert!(difference(flat, straight) <= 1, "of no strength: {flat:?} and {straight:?}");
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
