//! The light of the books' demos in the picture, against its twin; and both lights side by side.

use bindpose::model::{Material, Reflectance};
use bindpose::scene::{Light, Pass, Passes, Theme, ViewMode};
use glam::{Quat, Vec3};

use crate::gpu::{Gpu, difference};
use crate::scenes::{FRONT, Scene, bent_tube, card as two_halves, material};
use crate::textures::{HEIGHT, WHITE, WIDTH, card_once, cube, diffuse, plain};
use crate::twins::book::{BookSurface, PhongSurface, book_light, phong_light};

/// Bytes, dithered.
const ROUNDING: u8 = 2;

const NORMAL: Vec3 = Vec3::new(0.36, 0.48, -0.8);

/// A card whose normals lean to the right and up, under the book's light alone: nothing is mirrored and nothing shades.
fn leaning(material: Material) -> Scene {
    let mut scene = card_once();
    scene.model.mesh.normals.fill(NORMAL);
    scene.model.materials[0] = material;
    scene.options.light = Light::Book;
    scene.options.passes = Passes::none();
    scene
}

/// The values in which materials of the first book differ from those of the second.
#[derive(Clone, Copy)]
struct Phong {
    ambient: [f32; 3],
    specular: [f32; 3],
    spec_power: f32,
    reflectivity: [f32; 3],
}

const PHONG: Phong = Phong {
    ambient: [0.4; 3],
    specular: [0.3; 3],
    spec_power: 4.0,
    reflectivity: [0.2; 3],
};

fn phong_material(values: Phong) -> Material {
    Material {
        reflectance: Reflectance::Phong {
            ambient: values.ambient,
            specular: values.specular,
            spec_power: values.spec_power,
            reflectivity: values.reflectivity,
        },
        diffuse: [0.5, 0.4, 0.3],
        ..material("old", WHITE)
    }
}

/// Towards the lights of the demo after they turned about y.
fn to_lights(turn_radians: f32) -> [Vec3; 3] {
    [
        Vec3::new(0.57735, -0.57735, 0.57735),
        Vec3::new(-0.57735, -0.57735, 0.57735),
        Vec3::new(0.0, -0.707, -0.707),
    ]
    .map(|direction| Quat::from_rotation_y(turn_radians) * -direction.normalize())
}

fn assert_shows(gpu: &Gpu, scene: &Scene, expected: Vec3, what: &str) {
    let found = gpu.draw(scene, WIDTH, HEIGHT).middle();
    let [red, green, blue] = expected
        .to_array()
        .map(|channel| (channel.clamp(0.0, 1.0) * 255.0).round() as u8);
    assert!(
        difference(found, [red, green, blue, 255]) <= ROUNDING,
        "{what}: {found:?} for {expected}"
    );
}

/// How bright the middle of the card is, all channels together.
fn brightness(gpu: &Gpu, scene: &Scene) -> u32 {
    gpu.draw(scene, WIDTH, HEIGHT).middle()[..3]
        .iter()
        .map(|&channel| u32::from(channel))
        .sum()
}

on_both_backends! {
    fn the_picture_has_the_colours_of_the_twin(gpu) {
        for (turn_radians, roughness) in [(0.0, 0.5), (0.8, 0.9), (2.0, 1.0), (std::f32::consts::PI, 0.2)] {
            let (albedo, fresnel0) = (Vec3::new(0.5, 0.4, 0.3), Vec3::new(0.02, 0.1, 0.3));
            let mut scene = leaning(Material {
                reflectance: Reflectance::Fresnel { fresnel0: fresnel0.to_array(), roughness },
                diffuse: albedo.to_array(),
                ..material("new", WHITE)
            });
            scene.options.book_lights_turn_radians = turn_radians;
            let surface = BookSurface {
                albedo,
                fresnel0,
                shininess: 1.0 - roughness,
                normal: NORMAL,
                to_eye: Vec3::NEG_Z,
            };
            let expected = book_light(&surface, to_lights(turn_radians), 1.0, 1.0);
            assert_shows(gpu, &scene, expected, &format!("turned by {turn_radians}, roughness {roughness}"));
        }
    }

    /// The texel is multiplied as it is stored, not as light.
    fn colours_are_multiplied_as_they_are_encoded(gpu) {
        let texel = [100_u8, 150, 200];
        let scene = leaning(Material {
            reflectance: Reflectance::Fresnel { fresnel0: [0.0; 3], roughness: 1.0 },
            diffuse: [0.5, 1.0, 1.0],
            ..material("new", WHITE)
        });
        let map = plain([100, 150, 200, 255]);
        let found = gpu.draw_with_maps(&scene, &diffuse(&map), WIDTH, HEIGHT).middle();
        let surface = BookSurface {
            albedo: Vec3::from(texel.map(|channel| f32::from(channel) / 255.0)) * Vec3::new(0.5, 1.0, 1.0),
            fresnel0: Vec3::ZERO,
            shininess: 0.0,
            normal: NORMAL,
            to_eye: Vec3::NEG_Z,
        };
        let expected = book_light(&surface, to_lights(0.0), 1.0, 1.0).to_array();
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((f32::from(found) - expected * 255.0).abs() <= f32::from(ROUNDING), "{found} for {expected}");
        }
    }

    fn materials_of_the_first_book_are_lit_by_phong(gpu) {
        for turn_radians in [0.0, 1.1, 2.6] {
            let mut scene = leaning(phong_material(PHONG));
            scene.options.book_lights_turn_radians = turn_radians;
            let surface = PhongSurface {
                texel: Vec3::ONE,
                ambient: Vec3::splat(0.4),
                diffuse: Vec3::new(0.5, 0.4, 0.3),
                specular: Vec3::splat(0.3),
                power: 4.0,
                normal: NORMAL,
                to_eye: Vec3::NEG_Z,
            };
            let expected = phong_light(&surface, to_lights(turn_radians), 1.0, 1.0);
            assert_shows(gpu, &scene, expected, &format!("turned by {turn_radians}"));
        }
    }

    fn every_value_of_a_phong_material_counts(gpu) {
        let of = |values: Phong| {
            let mut scene = leaning(phong_material(values));
            scene.options.passes = Passes::all();
            brightness(gpu, &scene)
        };
        let base = of(PHONG);
        assert!(of(Phong { ambient: [1.0; 3], ..PHONG }) > base + 20, "more ambient is brighter");
        assert!(of(Phong { specular: [0.9; 3], ..PHONG }) > base + 20, "more specular is brighter");
        // The eye is beside every mirrored light.
        assert!(of(Phong { spec_power: 60.0, ..PHONG }) + 10 < base, "a narrower lobe passes the eye");
        assert!(of(Phong { reflectivity: [0.6; 3], ..PHONG }) > base + 20, "the sky is mirrored");
    }

    /// A smooth card mirrors the sky of the side to which it leans, times shininess and Fresnel share.
    fn the_sky_is_mirrored(gpu) {
        let mut scene = leaning(Material {
            reflectance: Reflectance::Fresnel { fresnel0: [1.0; 3], roughness: 0.5 },
            ..material("mirror", [0.0; 3])
        });
        // The mirrored ray goes to (0.576, 0.768, -0.28): up.
        let map = cube(8, [[0; 3], [0; 3], [200, 100, 40], [0; 3], [0; 3], [0; 3]]);
        let mut easel = gpu.easel(&scene, &[], [WIDTH, HEIGHT]);
        assert!(easel.renderer.set_sky(Some(&map)));
        let without = easel.draw(&scene).middle();
        scene.options.passes = Passes::none().with(Pass::Environment, true);
        let with = easel.draw(&scene).middle();
        for ((with, without), sky) in with.into_iter().zip(without).zip([200.0, 100.0, 40.0]) {
            let added = f32::from(with) - f32::from(without);
            assert!(with == 255 || (added - sky * 0.5).abs() <= 3.0, "{added} for half of {sky}");
        }
        assert!(with[2] < 255 && with[2] > without[2]);
    }

    fn edited_materials_show_as_if_they_had_been_there(gpu) {
        for light in Light::ALL {
            let mut scene = Scene::of(two_halves(FRONT));
            scene.options.light = light;
            let mut easel = gpu.easel(&scene, &[], [96, 64]);
            let before = easel.draw(&scene);
            let reflectance = Reflectance::Fresnel { fresnel0: [0.3; 3], roughness: 0.2 };
            scene.model.materials[0] = Material { reflectance, ..material("blue", [0.1, 0.5, 0.1]) };
            scene.model.materials[1] = phong_material(PHONG);
            easel.renderer.set_materials(&scene.model.materials);
            let edited = easel.draw(&scene);
            assert!(before.share_that_differs(&edited, 10) > 0.05, "{light:?}");
            assert_eq!(edited, gpu.draw(&scene, 96, 64), "{light:?}");
        }
    }

    /// Whatever is shown, and in whatever order the lights were asked for.
    fn a_split_picture_is_the_halves_of_two(gpu) {
        let mut scene = bent_tube(0.6).three_quarter(Theme::Light);
        let (width, height) = (117, 80);
        let mut easel = gpu.easel(&scene, &[], [width, height]);
        for mode in [ViewMode::Lit, ViewMode::AmbientOcclusion, ViewMode::Shadow] {
            scene.options.view_mode = mode;
            let [studio, book] = Light::ALL.map(|light| {
                scene.options.light = light;
                easel.draw(&scene)
            });
            // The light in force is on the right.
            for (light, on_left, on_right) in [(Light::Studio, &book, &studio), (Light::Book, &studio, &book)] {
                scene.options.light = light;
                for (share, left) in [(0.0, 0), (0.43, 50), (0.5, 59), (1.0, 117)] {
                    scene.options.split = Some(share);
                    let split = easel.draw(&scene);
                    for y in 0..height {
                        for x in 0..width {
                            let expected = if x < left { on_left } else { on_right };
                            // Where the pixel beside it is not drawn, a derivative may differ by a little.
                            let [found, expected] = [split.pixel(x, y), expected.pixel(x, y)];
                            let most = u8::from(x.abs_diff(left) <= 1);
                            assert!(difference(found, expected) <= most, "{mode:?} at ({x}, {y}), split {share}: {found:?} for {expected:?}");
                        }
                    }
                }
            }
            scene.options.split = None;
        }
    }

    fn exposure_is_the_studios_alone(gpu) {
        let mut scene = card_once();
        scene.model.materials[0].diffuse = [0.1; 3];
        let mut easel = gpu.easel(&scene, &[], [WIDTH, HEIGHT]);
        for light in Light::ALL {
            scene.options.light = light;
            let [dark, as_it_is, bright] = [-1.0, 0.0, 1.0].map(|stops| {
                scene.options.exposure_stops = stops;
                easel.draw(&scene)
            });
            let middles = [&dark, &as_it_is, &bright].map(|picture| picture.middle()[1]);
            if light == Light::Studio {
                // A stop is a factor of 2 in light: of about 1.37 in these bytes.
                assert!(middles.is_sorted_by(|a, b| f32::from(*b) > 1.2 * f32::from(*a)), "{middles:?}");
                assert_eq!(dark.pixel(0, 0), bright.pixel(0, 0), "the backdrop is no light");
            } else {
                assert_eq!(dark, bright);
            }
        }
    }

    /// A white card under the first light and in its own colours: nothing of the studio's tone map is in it.
    fn a_card_that_is_lit_fully_burns_out_as_in_the_book(gpu) {
        let mut scene = leaning(material("white", WHITE));
        scene.model.mesh.normals.fill(to_lights(0.0)[0]);
        assert_eq!(gpu.draw(&scene, WIDTH, HEIGHT).middle()[0], 255);
    }
}
