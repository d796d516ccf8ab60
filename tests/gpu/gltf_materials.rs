//! Materials with what glTF has beyond the books: metalness, more maps and how each is sampled, colours of vertices, blending.

use std::sync::Arc;

use bindpose::image::Image;
use bindpose::light::{BRDF_TABLE_SIDE, BrdfTable, Environment, Prefiltered, Room};
use bindpose::model::{AlphaMode, MapSlot, Material, MaterialMap, Reflectance, Sampling, Wrap};
use bindpose::render::MaterialImages;
use bindpose::scene::{Background, Light, Pass, Passes, Theme, ViewMode, linear_from_srgb8, srgb8_from_linear};
use glam::{Affine2, Affine3A, Quat, Vec2, Vec2Swizzles as _, Vec3, Vec4};

use crate::gpu::{Gpu, Picture, difference};
use crate::scenes::Scene;
use crate::sets::{Plate, floor, plates};
use crate::still_life::add_ball;
use crate::textures::{HEIGHT, WIDTH, card, card_once, images, linear, numbers, pixels_of_card, plain, square};
use crate::twins::book::{BookSurface, book_light};
use crate::twins::studio::{EnvironmentLight, StudioLights, StudioSurface};
use crate::twins::tone_map::{exposed, tone_mapped};

/// Bytes, dithered, from half floats that are filtered.
const ROUNDING: u8 = 3;

/// Turned away from the key and from the rim: only the environment lights it.
const NORMAL: Vec3 = Vec3::new(-0.6, -0.36, -0.714);

/// Seen from its front alone, as glTF has it where nothing else is said.
pub(crate) fn metallic_roughness(diffuse: [f32; 3], metallic: f32, roughness: f32) -> Material {
    Material {
        diffuse,
        double_sided: false,
        reflectance: Reflectance::MetallicRoughness { metallic, roughness },
        ..Material::default()
    }
}

/// A material that shows its colour without light.
pub(crate) fn unlit(srgb: [u8; 3]) -> Material {
    Material {
        unlit: true,
        ..metallic_roughness(linear(srgb), 0.0, 1.0)
    }
}

fn of_material(mut scene: Scene, material: Material) -> Scene {
    scene.model.materials = vec![material];
    scene
}

/// What glTF makes of a colour: diffuse and Fresnel0.
fn of_metal(base_color: Vec3, metallic: f32) -> (Vec3, Vec3) {
    (
        base_color * (1.0 - metallic),
        Vec3::splat(0.04).lerp(base_color, metallic),
    )
}

fn byte(value: u8) -> f32 {
    f32::from(value) / 255.0
}

/// The sampled names of maps that need not exist.
fn named(sampling: Sampling) -> Option<MaterialMap> {
    Some(MaterialMap {
        name: "map".into(),
        sampling,
    })
}

/// A material with a diffuse map that is sampled so, and the map: red, green, blue and white from the top left, two texels by two.
fn quarters(sampling: Sampling) -> (Material, Arc<Image>) {
    let material = Material {
        diffuse_map: named(sampling),
        ..unlit([255; 3])
    };
    let texels = [RED, GREEN, BLUE, [255; 4]];
    let image = Image::from_rgba8(2, 2, texels.concat(), "test").expect("four texels");
    (material, Arc::new(image))
}

const RED: [u8; 4] = [200, 30, 30, 255];
const GREEN: [u8; 4] = [30, 200, 30, 255];
const BLUE: [u8; 4] = [30, 30, 200, 255];

fn draw(gpu: &Gpu, scene: &Scene, maps: &[MaterialImages<'_>]) -> Picture {
    gpu.draw_with_maps(scene, maps, WIDTH, HEIGHT)
}

/// Compares the card's pixels where `expected` says something about a place on it, 0 … 1 from its top left.
fn compare_card(scene: &Scene, picture: &Picture, what: &str, expected: impl Fn(Vec2) -> Option<[u8; 4]>) {
    let mut compared = 0;
    for (x, y, place) in pixels_of_card(scene) {
        if let Some(expected) = expected(place) {
            let found = picture.pixel(x, y);
            assert!(
                difference(found, expected) <= 2,
                "{what}, {place}: {found:?} for {expected:?}"
            );
            compared += 1;
        }
    }
    assert!(compared > 250, "{what}: only {compared} pixels were compared");
}

/// The quarter of the map of [`quarters`] at map coordinates 0 … 1; `None` near an edge.
fn quarter(at: Vec2) -> Option<[u8; 4]> {
    let from_edge = ((at * 2.0) - (at * 2.0).round()).abs();
    let index = usize::from(at.x > 0.5) + 2 * usize::from(at.y > 0.5);
    (from_edge.min_element() > 0.1).then_some([RED, GREEN, BLUE, [255; 4]][index])
}

/// Two upright squares of these materials, the second 1 behind the first, seen from the front.
fn panes(materials: [Material; 2]) -> Scene {
    let pane = |z: f32| Plate {
        corner: Vec3::new(-1.0, 2.0, z),
        along_u: Vec3::X * 2.0,
        along_v: Vec3::NEG_Y * 2.0,
        normal: Vec3::NEG_Z,
    };
    let mut scene = Scene::of(plates(&[pane(0.0), pane(1.0)]));
    scene.model.materials = materials.into();
    scene.options.background = Background::Color([0; 3]);
    scene
}

pub(crate) fn blended(srgb: [u8; 3], opacity: f32) -> Material {
    Material {
        opacity,
        alpha: AlphaMode::Blend,
        double_sided: true,
        ..unlit(srgb)
    }
}

/// Layers over each other, the last in front; sRGB, with alpha.
pub(crate) fn over(background: [u8; 3], layers: &[([u8; 3], f32)]) -> [u8; 4] {
    let decoded = |srgb: [u8; 3]| Vec3::from(srgb.map(linear_from_srgb8));
    let mixed = layers.iter().fold(decoded(background), |behind, &(srgb, alpha)| {
        behind.lerp(decoded(srgb), alpha)
    });
    let [red, green, blue] = mixed.to_array().map(srgb8_from_linear);
    [red, green, blue, 255]
}

on_both_backends! {
    fn metal_has_the_colours_of_the_twin_in_the_studio(gpu) {
        let prefiltered = Prefiltered::of(&Environment::coarse_studio(Room::Dark));
        let brdf_table = BrdfTable::new(BRDF_TABLE_SIDE);
        let environment = EnvironmentLight {
            prefiltered: &prefiltered,
            brdf_table: &brdf_table,
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
        let base_color = Vec3::new(0.8, 0.5, 0.2);
        for (metallic, roughness, texel, occlusion, strength, emissive) in [
            (0.0, 0.5, [255, 255, 255], 255, 1.0, [0.0; 3]),
            (1.0, 0.4, [255, 255, 255], 255, 1.0, [0.0; 3]),
            (0.5, 0.9, [255, 255, 255], 255, 1.0, [0.0; 3]),
            // Roughness in green, metalness in blue; red is nothing.
            (1.0, 1.0, [0, 128, 255], 255, 1.0, [0.0; 3]),
            (1.0, 0.8, [255, 200, 0], 100, 1.0, [0.0; 3]),
            (0.8, 0.6, [9, 180, 90], 60, 0.5, [0.1, 0.0, 0.3]),
        ] {
            let mut scene = of_material(card_once(), Material {
                metallic_roughness_map: named(Sampling::default()),
                occlusion_map: named(Sampling::default()),
                occlusion_strength: strength,
                emissive,
                ..metallic_roughness(base_color.to_array(), metallic, roughness)
            });
            scene.model.mesh.normals.fill(normal);
            scene.options.passes = Passes::none().with(Pass::Environment, true);
            let [red, green, blue] = texel;
            let (numbers, shade) = (plain([red, green, blue, 255]), plain([occlusion, 0, 0, 255]));
            let maps = [images([(MapSlot::MetallicRoughness, &numbers), (MapSlot::Occlusion, &shade)])];
            let found = draw(gpu, &scene, &maps).middle();
            let (albedo, fresnel0) = of_metal(base_color, metallic * byte(blue));
            let surface = StudioSurface {
                albedo,
                fresnel0,
                roughness: roughness * byte(green),
                normal,
                smooth_normal: normal,
                to_eye: Vec3::NEG_Z,
                ambient_occlusion: 1.0 + (byte(occlusion) - 1.0) * strength,
                ..StudioSurface::default()
            };
            let radiance = environment.studio_light(&surface, &no_lights) + Vec3::from(emissive);
            let [red, green, blue] = tone_mapped(exposed(radiance, 0.0)).to_array().map(srgb8_from_linear);
            let expected = [red, green, blue, 255];
            assert!(
                difference(found, expected) <= ROUNDING,
                "metallic {metallic}, roughness {roughness}, {texel:?}, {occlusion}: {found:?} for {expected:?}"
            );
        }
    }

    /// Fresnel0 and roughness follow from metalness.
    fn metal_has_the_colours_of_the_twin_in_the_book(gpu) {
        let normal = Vec3::new(0.36, 0.48, -0.8);
        let base_color = Vec3::new(0.6, 0.4, 0.2);
        for (metallic, roughness, emissive) in [(0.0, 0.5, [0.0; 3]), (1.0, 0.7, [0.0; 3]), (0.5, 0.9, [0.02, 0.0, 0.1])] {
            let mut scene = of_material(card_once(), Material {
                emissive,
                ..metallic_roughness(base_color.to_array(), metallic, roughness)
            });
            scene.model.mesh.normals.fill(normal);
            scene.options.light = Light::Book;
            scene.options.passes = Passes::none();
            let (albedo, fresnel0) = of_metal(base_color, metallic);
            let encoded = |color: Vec3| Vec3::from(color.to_array().map(|channel| byte(srgb8_from_linear(channel))));
            let surface = BookSurface {
                albedo: encoded(albedo),
                fresnel0,
                shininess: 1.0 - roughness,
                normal,
                to_eye: Vec3::NEG_Z,
            };
            let to_lights = [
                Vec3::new(-0.57735, 0.57735, -0.57735),
                Vec3::new(0.57735, 0.57735, -0.57735),
                Vec3::new(0.0, 0.707, 0.707),
            ];
            let to_lights = to_lights.map(Vec3::normalize);
            let shown = book_light(&surface, to_lights, 1.0, 1.0) + encoded(Vec3::from(emissive));
            let [red, green, blue] = shown.to_array().map(|channel| (channel.clamp(0.0, 1.0) * 255.0).round() as u8);
            let found = draw(gpu, &scene, &[]).middle();
            let expected = [red, green, blue, 255];
            assert!(difference(found, expected) <= ROUNDING, "metallic {metallic}: {found:?} for {expected:?}");
        }
    }

    fn roughness_is_the_numbers_times_the_maps(gpu) {
        let mut scene = of_material(card_once(), Material {
            metallic_roughness_map: named(Sampling::default()),
            ..metallic_roughness([0.5; 3], 0.0, 0.8)
        });
        scene.options.view_mode = ViewMode::Roughness;
        let map = plain([0, 128, 0, 255]);
        let maps = [images([(MapSlot::MetallicRoughness, &map)])];
        let expected = (0.8 * 128.0_f32).round() as u8;
        assert!(difference(draw(gpu, &scene, &maps).middle(), [expected, expected, expected, 255]) <= 1);
        // Alpha of its normal map is no gloss.
        let gloss = plain([128, 128, 255, 0]);
        assert!(difference(draw(gpu, &scene, &[images([(MapSlot::Normal, &gloss)])]).middle(), [204, 204, 204, 255]) <= 1);
    }

    fn metalness_is_the_number_times_the_maps(gpu) {
        let metal = |metallic| metallic_roughness([0.5; 3], metallic, 0.8);
        let mut scene = of_material(card_once(), Material {
            metallic_roughness_map: named(Sampling::default()),
            ..metal(0.8)
        });
        scene.options.view_mode = ViewMode::Metallic;
        let grey = |value: u8| [value, value, value, 255];
        // Roughness in green and occlusion in red are nothing to it.
        for (texel, expected) in [([255, 200, 128, 255], 102), ([0, 0, 255, 255], 204), ([255, 255, 0, 255], 0)] {
            let map = plain(texel);
            let found = draw(gpu, &scene, &[images([(MapSlot::MetallicRoughness, &map)])]).middle();
            assert!(difference(found, grey(expected)) <= 1, "{texel:?}: {found:?}");
        }
        assert!(difference(draw(gpu, &scene, &[]).middle(), grey(204)) <= 1, "without its map the number alone");
    }

    fn without_light_the_colour_is_the_same_under_both(gpu) {
        for light in Light::ALL {
            let mut scene = of_material(card_once(), unlit([180, 90, 40])).three_quarter(Theme::Light);
            scene.options.light = light;
            scene.options.exposure_stops = 2.0;
            let found = draw(gpu, &scene, &[]);
            let middle = scene.pixel_of(Vec3::Y, [WIDTH, HEIGHT]);
            assert!(difference(found.at(middle), [180, 90, 40, 255]) <= 1, "{light:?}: {:?}", found.at(middle));
        }
    }

    fn the_emissive_map_multiplies_the_light_that_it_gives(gpu) {
        let mut scene = of_material(card_once(), Material {
            emissive: [0.5, 0.5, 0.0],
            emissive_map: named(Sampling::default()),
            ..metallic_roughness([0.0; 3], 0.0, 1.0)
        });
        scene.options.light = Light::Book;
        scene.options.passes = Passes::none();
        let dark = draw(gpu, &of_material(card_once(), metallic_roughness([0.0; 3], 0.0, 1.0)), &[]).middle();
        assert!(dark[0] < 80, "{dark:?}");
        let map = plain([255, 128, 255, 255]);
        let without = draw(gpu, &scene, &[images([(MapSlot::Emissive, &plain([0, 0, 0, 255]))])]).middle();
        let found = draw(gpu, &scene, &[images([(MapSlot::Emissive, &map)])]).middle();
        let added = |channel: usize| i32::from(found[channel]) - i32::from(without[channel]);
        let expected = |light: f32| i32::from(srgb8_from_linear(light));
        assert!((added(0) - expected(0.5)).abs() <= 3, "{found:?} {without:?}");
        assert!((added(1) - expected(0.5 * linear_from_srgb8(128))).abs() <= 3, "{found:?} {without:?}");
        assert!(added(2).abs() <= 2, "{found:?} {without:?}");
    }

    /// Colours between vertices are mixed as light.
    fn colours_of_vertices_multiply(gpu) {
        let mut scene = of_material(card_once(), unlit([255; 3]));
        let (left, right) = (Vec4::new(1.0, 0.5, 0.0, 1.0), Vec4::new(0.0, 0.5, 0.25, 1.0));
        scene.model.mesh.colors = vec![left, left, right, right];
        let map = plain([255, 128, 255, 255]);
        let expected = |place: Vec2| {
            let color = left.lerp(right, place.x).truncate() * Vec3::new(1.0, linear_from_srgb8(128), 1.0);
            let [red, green, blue] = color.to_array().map(srgb8_from_linear);
            // Where the slope is steep, half a pixel is several steps.
            (color.max_element() < 0.9 && color.min_element() > 0.05).then_some([red, green, blue, 255])
        };
        compare_card(&scene, &draw(gpu, &scene, &[images([(MapSlot::Diffuse, &map)])]), "colours", expected);
    }

    fn each_map_is_sampled_its_own_way(gpu) {
        let nearest = Sampling { nearest: true, ..Sampling::default() };
        let check = |what: &str, sampling: Sampling, span: [Vec2; 2], expected: &dyn Fn(Vec2) -> Option<[u8; 4]>| {
            let (material, map) = quarters(sampling);
            let mut scene = of_material(card(crate::textures::WHITE, span), material);
            scene.model.mesh.second_tex_coords = scene.model.mesh.tex_coords.iter().map(|at| at.yx()).collect();
            compare_card(&scene, &draw(gpu, &scene, &[images([(MapSlot::Diffuse, &map)])]), what, expected);
        };
        let once = [Vec2::ZERO, Vec2::ONE];
        let thrice = [Vec2::NEG_ONE, Vec2::splat(2.0)];
        check("as it is", nearest, once, &quarter);
        check("second coordinates", Sampling { second_tex_coords: true, ..nearest }, once, &|at| quarter(at.yx()));
        // Turned by a quarter, twice as large, moved.
        let map_from_mesh = Affine2::from_scale_angle_translation(Vec2::splat(0.5), std::f32::consts::FRAC_PI_2, Vec2::new(0.75, 0.25));
        check("transformed", Sampling { map_from_mesh, ..nearest }, once, &|at| {
            quarter(Vec2::new(0.75 - 0.5 * at.y, 0.25 + 0.5 * at.x))
        });
        check("repeated", nearest, thrice, &|at| quarter((at * 3.0 - 1.0).rem_euclid(Vec2::ONE)));
        let wrap = [Wrap::Mirror, Wrap::Clamp];
        check("mirrored along u, clamped along v", Sampling { wrap, ..nearest }, thrice, &|at| {
            let [u, v] = (at * 3.0 - 1.0).to_array();
            let mirrored = if (0.0..1.0).contains(&u) { u } else { (u.abs() - 2.0 * f32::from(u > 1.0) * (u - 1.0)).abs() };
            quarter(Vec2::new(mirrored, v.clamp(0.0, 1.0))).filter(|_| (at.y * 3.0 - (at.y * 3.0).round()).abs() > 0.05)
        });
        // Filtered, the middle of four texels is their mean.
        let (material, map) = quarters(Sampling { map_from_mesh: Affine2::from_translation(Vec2::ZERO), ..Sampling::default() });
        let scene = of_material(card_once(), material);
        let middle = draw(gpu, &scene, &[images([(MapSlot::Diffuse, &map)])]).middle();
        let mean = |channel: usize| {
            let texels = [RED, GREEN, BLUE, [255; 4]];
            srgb8_from_linear(texels.iter().map(|texel| linear_from_srgb8(texel[channel])).sum::<f32>() / 4.0)
        };
        assert!(difference(middle, [mean(0), mean(1), mean(2), 255]) <= 12, "{middle:?}");
    }

    /// `scale` multiplies x and y of the map's directions.
    fn the_scale_of_normals_bends_them(gpu) {
        let map = plain([128 + 90, 128, 128 + 90, 255]);
        for scale in [0.0, 0.5, 1.0, 2.0] {
            let mut scene = of_material(card_once(), Material {
                normal_scale: scale,
                ..metallic_roughness([0.5; 3], 0.0, 1.0)
            });
            scene.options.view_mode = ViewMode::ShadingNormal;
            let found = draw(gpu, &scene, &[images([(MapSlot::Normal, &map)])]).middle();
            let texel = Vec3::new(218.0, 128.0, 218.0) / 127.5 - 1.0;
            // u goes along +x, the normal along -z.
            let normal = Vec3::new(texel.x * scale, 0.0, -texel.z).normalize();
            let [red, green, blue] = (normal * 0.5 + 0.5).to_array().map(|channel| (channel * 255.0).round() as u8);
            assert!(difference(found, [red, green, blue, 255]) <= 2, "{scale}: {found:?} for {normal}");
        }
    }

    /// By the opacity of the material and the alpha of vertices, without any map.
    fn a_mask_cuts_without_a_map(gpu) {
        let masked = |opacity: f32, cutoff: f32| Material {
            opacity,
            alpha: AlphaMode::Mask { cutoff },
            ..unlit([90, 180, 90])
        };
        let green = [90, 180, 90, 255];
        let mut nothing = card_once();
        nothing.model = Default::default();
        let bare = draw(gpu, &nothing, &[]);
        let whole = of_material(card_once(), masked(0.6, 0.5));
        compare_card(&whole, &draw(gpu, &whole, &[]), "above the cutoff", |_| Some(green));
        let gone = of_material(card_once(), masked(0.4, 0.5));
        assert_eq!(draw(gpu, &gone, &[]), bare, "below the cutoff");
        let mut half = of_material(card_once(), masked(1.0, 0.25));
        half.model.mesh.colors = [0.0, 0.0, 1.0, 1.0].map(|alpha| Vec4::new(1.0, 1.0, 1.0, alpha)).to_vec();
        let found = draw(gpu, &half, &[]);
        compare_card(&half, &found, "alpha of vertices", |at| (at.x > 0.3).then_some(green));
        let left = half.pixel_of(Vec3::new(-0.8, 1.0, 0.0), [WIDTH, HEIGHT]);
        assert_eq!(found.at(left), bare.at(left));
    }

    fn panes_blend_back_to_front_from_either_side(gpu) {
        let (red, blue) = ([220, 40, 40], [40, 60, 220]);
        for swapped in [false, true] {
            let mut scene = panes([blended(red, 0.5), blended(blue, 0.25)]);
            if swapped {
                scene.model.mesh.submeshes.swap(0, 1);
            }
            for (yaw, layers) in [
                (0.0, [(blue, 0.25), (red, 0.5)]),
                (std::f32::consts::PI, [(red, 0.5), (blue, 0.25)]),
            ] {
                scene.camera.yaw_radians = yaw;
                let found = draw(gpu, &scene, &[]).middle();
                let expected = over([0; 3], &layers);
                assert!(difference(found, expected) <= 2, "swapped {swapped}, from {yaw}: {found:?} for {expected:?}");
            }
        }
    }

    /// By where the bones moved them, and by where the instances stand.
    fn panes_are_sorted_as_they_are_posed(gpu) {
        use bindpose::anim::Palette;
        use bindpose::model::{Influences, JointIndex, Skeleton};
        let (red, blue) = ([220, 40, 40], [40, 60, 220]);
        let mut scene = panes([blended(red, 0.5), blended(blue, 0.25)]);
        let moved_by = |joint: u32| Influences { joints: [joint, 0, 0, 0], weights: [1.0, 0.0, 0.0, 0.0] };
        scene.model.mesh.influences = (0..8).map(|vertex| moved_by(vertex / 4)).collect();
        let skeleton = Skeleton::new(vec![None, Some(JointIndex(0))], vec![Affine3A::IDENTITY; 2], vec![0, 1]);
        scene.model.skeleton = skeleton.expect("two joints");
        // The first pane goes behind the second.
        scene.palette = Palette(vec![Affine3A::from_translation(Vec3::Z * 2.0), Affine3A::IDENTITY]);
        scene.world_bounds.max.z = 4.0;
        let found = draw(gpu, &scene, &[]).middle();
        let expected = over([0; 3], &[(red, 0.5), (blue, 0.25)]);
        assert!(difference(found, expected) <= 2, "{found:?} for {expected:?}");

        // Another instance stands between the two panes, in bind space: its first is at 0.5, its second at 1.5.
        let still = Palette(vec![Affine3A::IDENTITY; 2]);
        scene.palette = still.clone();
        scene.add_to_crowd(Affine3A::from_translation(Vec3::Z * 0.5), &still);
        let found = draw(gpu, &scene, &[]).middle();
        let expected = over([0; 3], &[(blue, 0.25), (blue, 0.25), (red, 0.5), (red, 0.5)]);
        assert!(difference(found, expected) <= 3, "{found:?} for {expected:?}");
        // Turned round, its second is before its first.
        scene.crowd[0].world_from_model = Affine3A::from_rotation_translation(Quat::from_rotation_y(std::f32::consts::PI), Vec3::Z * 1.5);
        let found = draw(gpu, &scene, &[]).middle();
        let expected = over([0; 3], &[(red, 0.5), (blue, 0.25), (blue, 0.25), (red, 0.5)]);
        assert!(difference(found, expected) <= 3, "{found:?} for {expected:?}");
    }

    /// Few are sorted, each pane by itself. Of many all first panes are one draw, and all second panes another. What has two sides takes
    /// a draw for each.
    fn a_crowd_of_panes_takes_few_draws(gpu) {
        let draws = |others: u32, double_sided: bool| {
            let pane = |srgb, opacity| Material { double_sided, ..blended(srgb, opacity) };
            let mut scene = panes([pane([220, 40, 40], 0.5), pane([40, 60, 220], 0.25)]);
            scene.options.passes = Passes::none();
            for other in 0..others {
                // Each a little behind the one before.
                let place = Vec3::new((other % 40) as f32 * 2.5, 0.0, 1.0 + other as f32 * 0.01);
                scene.add_to_crowd(Affine3A::from_translation(place), &bindpose::anim::Palette::default());
            }
            let mut renderer = gpu.renderer();
            renderer.set_model(&scene.model).expect("small");
            renderer.render(&scene.frame(), &mut gpu.target(WIDTH, HEIGHT))
        };
        // The opaque parts of all are drawn before, in one draw for each pane.
        for (others, blended) in [(0, 2), (1, 4), (63, 128), (64, 2), (999, 2)] {
            for (double_sided, sides) in [(false, 1), (true, 2)] {
                let cost = draws(others, double_sided);
                assert_eq!(cost.draws, sides * blended + 2, "{others} others, from both sides {double_sided}");
                let vertices = (sides + 1) * 12 * u64::from(others + 1);
                assert_eq!(cost.vertices, vertices, "{others} others: all are drawn");
            }
        }
    }

    /// Of many, too, each pane is before what is behind it of the same instance, from either side.
    fn of_many_panes_those_behind_come_first(gpu) {
        let (red, blue) = ([220, 40, 40], [40, 60, 220]);
        let mut scene = panes([blended(red, 0.5), blended(blue, 0.25)]);
        for other in 1..100 {
            let aside = Affine3A::from_translation(Vec3::X * 5.0 * f32::from(other as u8));
            scene.add_to_crowd(aside, &bindpose::anim::Palette::default());
        }
        for (yaw, layers) in [(0.0, [(blue, 0.25), (red, 0.5)]), (std::f32::consts::PI, [(red, 0.5), (blue, 0.25)])] {
            scene.camera.yaw_radians = yaw;
            let found = draw(gpu, &scene, &[]).middle();
            let expected = over([0; 3], &layers);
            assert!(difference(found, expected) <= 2, "from {yaw}: {found:?} for {expected:?}");
        }
    }

    /// Parts with alpha 1 of a blended material hide what is behind them, in whatever order they are drawn.
    fn what_is_opaque_of_a_blended_surface_hides(gpu) {
        let map = square(16, |x, _| [255, 255, 255, if x < 8 { 255 } else { 64 }]);
        let front = Material { diffuse_map: named(Sampling::default()), ..blended([220, 40, 40], 1.0) };
        let back = Material { alpha: AlphaMode::Opaque, opacity: 1.0, ..blended([40, 60, 220], 1.0) };
        let scene = panes([front, back]);
        let found = draw(gpu, &scene, &[images([(MapSlot::Diffuse, &map)]), MaterialImages::default()]);
        let at = |x: f32| found.at(scene.pixel_of(Vec3::new(x, 1.0, 0.0), [WIDTH, HEIGHT]));
        assert!(difference(at(-0.5), [220, 40, 40, 255]) <= 1, "{:?}", at(-0.5));
        let through = over([40, 60, 220], &[([220, 40, 40], 64.0 / 255.0)]);
        assert!(difference(at(0.4), through) <= 2, "{:?} for {through:?}", at(0.4));
    }

    fn a_blended_single_side_is_seen_from_its_front_alone(gpu) {
        let pane = |double_sided: bool| {
            let mut scene = of_material(card_once(), Material { double_sided, ..blended([220, 40, 40], 0.5) });
            scene.options.background = Background::Color([0; 3]);
            scene
        };
        let half = over([0; 3], &[([220, 40, 40], 0.5)]);
        for (double_sided, yaw, expected) in [
            (true, 0.0, half),
            (false, 0.0, half),
            (true, std::f32::consts::PI, half),
            (false, std::f32::consts::PI, [0, 0, 0, 255]),
        ] {
            let mut scene = pane(double_sided);
            scene.camera.yaw_radians = yaw;
            let found = draw(gpu, &scene, &[]).middle();
            assert!(difference(found, expected) <= 1, "double-sided {double_sided}, from {yaw}: {found:?}");
            // As a view mode, too.
            scene.options.view_mode = ViewMode::BaseColor;
            let found = draw(gpu, &scene, &[]).middle();
            let expected = if expected == half { [220, 40, 40, 255] } else { expected };
            assert!(difference(found, expected) <= 1, "{found:?}");
        }
    }

    fn on_nothing_what_is_blended_keeps_its_alpha(gpu) {
        let mut scene = of_material(card_once(), blended([220, 40, 40], 0.5));
        scene.options.background = Background::None;
        let found = draw(gpu, &scene, &[]).middle();
        assert!(difference(found, [220, 40, 40, 128]) <= 3, "{found:?}");
    }

    /// What is thinner than a half lets light through.
    fn thin_glass_casts_no_shadow(gpu) {
        let shadow = |opacity: f32| {
            let mut scene = crate::sets::shelter();
            scene.model.materials[1] = Material { opacity, alpha: AlphaMode::Blend, double_sided: true, ..metallic_roughness([0.4; 3], 0.0, 1.0) };
            scene.options.view_mode = ViewMode::Shadow;
            let picture = gpu.draw(&scene, crate::sets::SIZE[0], crate::sets::SIZE[1]);
            picture.at(scene.pixel_of(crate::sets::shadow_of_lid(Light::Studio), crate::sets::SIZE))
        };
        assert!(shadow(0.3)[0] > 240, "{:?}", shadow(0.3));
        assert!(shadow(0.7)[0] < 60, "{:?}", shadow(0.7));
    }

    /// Values that are edited later bring what they need with them.
    fn a_plain_material_can_be_edited_into_glass(gpu) {
        let plain_card = || {
            let mut scene = card_once();
            scene.options.background = Background::Color([0; 3]);
            scene
        };
        let glass = blended([220, 40, 40], 0.5);
        let scene = plain_card();
        let mut easel = gpu.easel(&scene, &[], [WIDTH, HEIGHT]);
        let before = easel.draw(&scene);
        easel.renderer.set_materials(std::slice::from_ref(&glass));
        assert_eq!(easel.draw(&scene), draw(gpu, &of_material(plain_card(), glass), &[]));
        easel.renderer.set_materials(&scene.model.materials);
        assert_eq!(easel.draw(&scene), before);
    }
}

/// A floor with, in two rows, plastic and metal balls from smooth to rough; a ball that glows in bands, one with dark seams, one in
/// colours of its vertices; before them a hanging that alpha cuts, with second texture coordinates, and a pane and a ball of glass.
pub(crate) fn gltf_still_life() -> Scene {
    let upright = |x: f32, z: f32, size: Vec2| Plate {
        corner: Vec3::new(x, size.y, z),
        along_u: Vec3::X * size.x,
        along_v: Vec3::NEG_Y * size.y,
        normal: Vec3::NEG_Z,
    };
    let mut model = plates(&[
        floor(2.4),
        upright(-2.2, -1.3, Vec2::new(1.1, 0.9)),
        upright(0.3, -1.4, Vec2::new(1.2, 1.1)),
    ]);
    let mesh = &mut model.mesh;
    mesh.second_tex_coords = mesh.tex_coords.iter().map(|at| *at * 3.0 - 1.0).collect();
    let plate_vertices = mesh.positions.len();
    let roughnesses = [0.1, 0.45, 0.9];
    for row in 0..2 {
        for column in 0..3 {
            let center = Vec3::new(-1.9 + 0.85 * column as f32, 0.38, 1.4 - 1.0 * row as f32);
            add_ball(mesh, center, 0.38);
        }
    }
    add_ball(mesh, Vec3::new(0.8, 0.45, 1.3), 0.45);
    add_ball(mesh, Vec3::new(1.8, 0.45, 1.0), 0.45);
    let first_colored = mesh.positions.len();
    add_ball(mesh, Vec3::new(0.9, 0.45, 0.1), 0.45);
    let colored = first_colored..mesh.positions.len();
    add_ball(mesh, Vec3::new(1.9, 0.5, -0.5), 0.5);
    mesh.second_tex_coords.resize(mesh.positions.len(), Vec2::ZERO);
    mesh.colors = vec![Vec4::ONE; mesh.positions.len()];
    for vertex in colored {
        let [x, y, z] = (mesh.normals[vertex] * 0.5 + 0.5).to_array();
        mesh.colors[vertex] = Vec4::new(x, y, z, 1.0);
    }
    assert_eq!(plate_vertices, 12);

    let gold = [1.0, 0.71, 0.29];
    let balls = (0..6).map(|index| match index / 3 {
        0 => metallic_roughness([0.6, 0.08, 0.06], 0.0, roughnesses[index % 3]),
        _ => metallic_roughness(gold, 1.0, roughnesses[index % 3]),
    });
    let second = Sampling {
        second_tex_coords: true,
        wrap: [Wrap::Mirror, Wrap::Repeat],
        ..Sampling::default()
    };
    let mut materials = vec![
        Material {
            diffuse_map: named(Sampling {
                map_from_mesh: Affine2::from_scale_angle_translation(Vec2::splat(4.0), 0.4, Vec2::ZERO),
                nearest: true,
                ..Sampling::default()
            }),
            ..metallic_roughness([0.8; 3], 0.0, 0.7)
        },
        Material {
            diffuse_map: named(second),
            alpha: AlphaMode::Mask { cutoff: 0.5 },
            double_sided: true,
            ..metallic_roughness([0.9; 3], 0.0, 0.8)
        },
        Material {
            opacity: 0.4,
            alpha: AlphaMode::Blend,
            double_sided: true,
            ..metallic_roughness([0.2, 0.5, 0.6], 0.0, 0.1)
        },
    ];
    materials.extend(balls);
    materials.extend([
        Material {
            emissive: [2.0, 1.2, 0.4],
            emissive_map: named(Sampling::default()),
            ..metallic_roughness([0.05; 3], 0.0, 0.6)
        },
        Material {
            occlusion_map: named(Sampling::default()),
            metallic_roughness_map: named(Sampling::default()),
            ..metallic_roughness([0.5, 0.55, 0.6], 1.0, 1.0)
        },
        metallic_roughness([1.0; 3], 0.0, 0.8),
        Material {
            opacity: 0.3,
            alpha: AlphaMode::Blend,
            ..metallic_roughness([0.7, 0.9, 0.5], 0.0, 0.05)
        },
    ]);
    for (index, material) in materials.iter_mut().enumerate() {
        material.name = index.to_string();
    }
    model.materials = materials;
    let mut scene = Scene::of(model);
    scene.camera.yaw_radians = -0.25;
    scene.camera.pitch_radians = 0.5;
    scene.camera.target = Vec3::new(0.0, 0.35, 0.0);
    scene.camera.distance = 7.4;
    scene
}

/// Maps of the glTF still life: a chessboard, leaves, bands of light, seams, patches of metal.
pub(crate) struct GltfMaps {
    board: Arc<Image>,
    leaves: Arc<Image>,
    bands: Arc<Image>,
    seams: Arc<Image>,
    patches: Arc<Image>,
}

impl GltfMaps {
    pub(crate) fn new() -> Self {
        Self {
            board: square(2, |x, y| {
                if (x + y) % 2 == 0 {
                    [90, 96, 110, 255]
                } else {
                    [210, 210, 200, 255]
                }
            }),
            leaves: square(32, |x, y| {
                let from_middle = Vec2::new(x as f32 - 15.5, y as f32 - 15.5).length();
                [110, 190, 80, (255.0 - 16.0 * from_middle).clamp(0.0, 255.0) as u8]
            }),
            bands: square(32, |_, y| if y % 8 < 3 { [255; 4] } else { [0, 0, 0, 255] }),
            seams: numbers(32, |x, y| [if x % 8 == 0 || y % 8 == 0 { 30 } else { 255 }, 0, 0, 255]),
            patches: numbers(32, |x, y| {
                let is_metal = (x / 8 + y / 8) % 2 == 0;
                [0, if is_metal { 60 } else { 220 }, if is_metal { 255 } else { 0 }, 255]
            }),
        }
    }

    /// In the order of the materials.
    pub(crate) fn images(&self) -> Vec<MaterialImages<'_>> {
        let mut maps = vec![MaterialImages::default(); 13];
        maps[0] = images([(MapSlot::Diffuse, &self.board)]);
        maps[1] = images([(MapSlot::Diffuse, &self.leaves)]);
        maps[9] = images([(MapSlot::Emissive, &self.bands)]);
        maps[10] = images([
            (MapSlot::Occlusion, &self.seams),
            (MapSlot::MetallicRoughness, &self.patches),
        ]);
        maps
    }
}
