//! What is behind the model, and how the environment stands and turns.

use std::f32::consts::{FRAC_PI_2, PI};

use bindpose::image::{Image, decode};
use bindpose::model::{Model, Reflectance};
use bindpose::scene::{Background, Light, Pass, Passes, Projection, Theme};
use glam::Vec3;

use crate::gpu::{Picture, difference};
use crate::scenes::{FRONT, Scene, card};
use crate::sets::UNIT_BOX;
use crate::textures::{HEIGHT, WIDTH, card_once, cube, square};

const SIZE: [u32; 2] = [96, 72];
/// Bytes, dithered.
const ROUNDING: u8 = 1;

/// +x red, −x cyan, +y white, −y dark, +z green, −z blue.
const FACES: [[u8; 3]; 6] = [
    [200, 20, 20],
    [20, 180, 180],
    [230; 3],
    [60; 3],
    [20, 190, 40],
    [30, 40, 210],
];

/// A cube map of half floats, with a texel for each face, column and row.
pub(crate) fn float_cube(side: u32, texel: impl Fn(u32, u32, u32) -> [u16; 4]) -> Image {
    let mut words = [0; 31];
    words[..4].copy_from_slice(&[124, 0x1007, side, side]);
    words[18..21].copy_from_slice(&[32, 4, u32::from_le_bytes(*b"DX10")]);
    words[26..28].copy_from_slice(&[0x1008, 0xfe00]);
    // R16G16B16A16_FLOAT, flat textures, which are a cube.
    let dx10 = [10, 3, 4, 1, 0];
    let mut file = b"DDS ".to_vec();
    file.extend(words.iter().chain(&dx10).flat_map(|word: &u32| word.to_le_bytes()));
    let places = (0..6 * side * side).map(|index| (index / (side * side), index % side, index / side % side));
    file.extend(
        places
            .flat_map(|(face, x, y)| texel(face, x, y))
            .flat_map(u16::to_le_bytes),
    );
    decode(&file, "cube.dds").unwrap_or_else(|error| panic!("{error}"))
}

/// Nothing but what is behind, seen at these angles.
fn empty(background: Background, light: Light, yaw_radians: f32, pitch_radians: f32) -> Scene {
    let mut scene = Scene::of(Model::default());
    scene.world_bounds = UNIT_BOX;
    scene.camera.distance = 4.0;
    scene.camera.yaw_radians = yaw_radians;
    scene.camera.pitch_radians = pitch_radians;
    scene.options.background = background;
    scene.options.light = light;
    scene
}

fn assert_color(picture: &Picture, [red, green, blue]: [u8; 3], what: &str) {
    let found = picture.middle();
    assert!(
        difference(found, [red, green, blue, 255]) <= ROUNDING,
        "{what}: {found:?}"
    );
}

on_both_backends! {
    fn one_colour_is_exact(gpu) {
        for light in Light::ALL {
            for color in [[0; 3], [255; 3], [1, 2, 3], [200, 100, 50], [17, 128, 254]] {
                let picture = gpu.draw(&empty(Background::Color(color), light, 0.3, 0.2), SIZE[0], SIZE[1]);
                let [red, green, blue] = color;
                assert!(picture.rgba.chunks_exact(4).all(|pixel| pixel == [red, green, blue, 255]), "{light:?} {color:?}");
            }
        }
    }

    fn nothing_is_alpha_0_under_both_lights(gpu) {
        for light in Light::ALL {
            let mut scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
            scene.options.background = Background::None;
            scene.options.light = light;
            let picture = gpu.draw(&scene, SIZE[0], SIZE[1]);
            assert_eq!(picture.pixel(0, 0), [0; 4]);
            assert_eq!(picture.middle()[3], 255);
        }
    }

    fn each_face_of_a_sky_is_where_its_axis_points(gpu) {
        let up = -FRAC_PI_2 + 0.01;
        // +x −x +y −y +z −z.
        let views = [(FRAC_PI_2, 0.0), (-FRAC_PI_2, 0.0), (0.0, up), (0.0, -up), (0.0, 0.0), (PI, 0.0)];
        let map = cube(16, FACES);
        let mut easel = gpu.easel(&empty(Background::Sky, Light::Book, 0.0, 0.0), &[], SIZE);
        assert!(easel.renderer.set_sky(Some(&map)));
        for ((yaw_radians, pitch_radians), face) in views.into_iter().zip(FACES) {
            let book = easel.draw(&empty(Background::Sky, Light::Book, yaw_radians, pitch_radians));
            assert_color(&book, face, "as it is under the book's light");
            let studio = easel.draw(&empty(Background::Sky, Light::Studio, yaw_radians, pitch_radians)).middle();
            let most = |color: &[u8]| (0..3).max_by_key(|&channel| color[channel]);
            assert!(face[0] == face[1] || most(&studio) == most(&face), "toned in the studio: {studio:?} of {face:?}");
            // A quarter turn to the left of the viewer's right: what was at +x is seen at −z.
            let mut turned = empty(Background::Sky, Light::Book, yaw_radians + FRAC_PI_2, pitch_radians);
            turned.options.environment_turn_radians = FRAC_PI_2;
            if pitch_radians == 0.0 {
                assert_color(&easel.draw(&turned), face, "turned with the sky");
            }
        }
        assert!(easel.renderer.set_sky(None));
        let own = easel.draw(&empty(Background::Sky, Light::Book, 0.0, 0.0)).middle();
        assert!(FACES.iter().all(|&[red, green, blue]| difference(own, [red, green, blue, 255]) > 3), "{own:?}");
    }

    /// Twice the side of the largest sky that is uploaded, and no mips.
    fn a_sky_that_is_too_large_is_averaged_down(gpu) {
        let mut easel = gpu.easel(&empty(Background::Sky, Light::Book, 0.0, 0.0), &[], SIZE);
        assert!(easel.renderer.set_sky(Some(&cube(2048, FACES))));
        for (yaw_radians, face) in [(FRAC_PI_2, FACES[0]), (-FRAC_PI_2, FACES[1]), (0.0, FACES[4]), (PI, FACES[5])] {
            let picture = easel.draw(&empty(Background::Sky, Light::Book, yaw_radians, 0.0));
            assert_color(&picture, face, "a large sky");
        }
    }

    /// Filtering would spread it over the texels beside it.
    fn what_is_no_radiance_of_a_sky_is_cleaned(gpu) {
        // Half floats: 0.2, 0.3, 0.4 and 1.
        let [low, between, high, one] = [0x3266, 0x34cd, 0x3666, 0x3c00];
        let sky = |odd: [u16; 4]| {
            float_cube(16, |face, x, y| {
                let index = ((x / 4 + y / 4) % 4) as usize;
                if face == 4 && x % 4 == 1 && y % 4 == 1 {
                    [odd[index], high, odd[(index + 1) % 4], one]
                } else {
                    [low, high, between, one]
                }
            })
        };
        let mut easel = gpu.easel(&empty(Background::Sky, Light::Book, 0.0, 0.0), &[], SIZE);
        for light in Light::ALL {
            // NaN, infinity, -3 and minus infinity; 0 and the largest.
            let [odd, clean] = [[0x7e00, 0x7c00, 0xc200, 0xfc00], [0, 0x7bff, 0, 0]].map(|odd| {
                assert!(easel.renderer.set_sky(Some(&sky(odd))));
                easel.draw(&empty(Background::Sky, light, 0.0, 0.0))
            });
            assert!(odd == clean, "{light:?}: {} of the pixels differ", odd.share_that_differs(&clean, 0));
            let channel = |channel: usize| clean.rgba.chunks_exact(4).map(move |pixel| pixel[channel]);
            assert!(channel(0).min() < Some(60) && channel(2).max() > Some(200), "{light:?}: odd texels are in view");
        }
    }

    fn a_flat_picture_is_no_sky(gpu) {
        let mut easel = gpu.easel(&empty(Background::Sky, Light::Book, 0.0, 0.0), &[], SIZE);
        let before = easel.draw(&empty(Background::Sky, Light::Book, 0.0, 0.0));
        assert!(!easel.renderer.set_sky(Some(&square(8, |_, _| [9; 4]))));
        assert_eq!(easel.draw(&empty(Background::Sky, Light::Book, 0.0, 0.0)), before);
    }

    /// The studio goes with the viewer, as round a turntable; the book's daylight stands in the world.
    fn the_studio_goes_with_the_viewer_and_daylight_stands(gpu) {
        let mut easel = gpu.easel(&empty(Background::Sky, Light::Book, 0.0, 0.0), &[], SIZE);
        let mut draw = |light, yaw_radians, turn_radians| {
            let mut scene = empty(Background::Sky, light, yaw_radians, 0.1);
            scene.options.environment_turn_radians = turn_radians;
            easel.draw(&scene)
        };
        let same = |a: &Picture, b: &Picture| a.share_that_differs(b, 3) < 0.01;
        for (light, stands) in [(Light::Studio, false), (Light::Book, true)] {
            let first = draw(light, 0.0, 0.0);
            assert_eq!(same(&draw(light, 0.8, 0.0), &first), !stands, "{light:?} walked round");
            assert_eq!(same(&draw(light, 0.8, 0.8), &first), stands, "{light:?} walked round and turned");
            assert!(!same(&draw(light, 0.0, 0.8), &first), "{light:?} turned");
        }
    }

    /// Two viewers, as far to the left of a face as to its right, with the studio turned back by as much: the same studio in the
    /// world, so the same light on what is matt. Key, rim and environment turn as one.
    fn the_studio_turns_as_one(gpu) {
        let seen = |yaw_radians: f32, turn_radians| {
            let mut scene = card_once();
            scene.model.materials[0].diffuse = [0.3; 3];
            scene.model.materials[0].reflectance = Reflectance::Fresnel { fresnel0: [0.0; 3], roughness: 1.0 };
            scene.model.mesh.normals.fill(Vec3::new(0.0, 0.6, -0.8));
            scene.camera.projection = Projection::Orthographic;
            scene.camera.yaw_radians = yaw_radians;
            scene.options.environment_turn_radians = turn_radians;
            scene.options.passes = Passes::all().with(Pass::AmbientOcclusion, false);
            gpu.draw(&scene, WIDTH, HEIGHT).middle()
        };
        for turn_radians in [0.0, 0.9, 2.4, -1.7] {
            let (left, right) = (seen(0.5, turn_radians - 0.5), seen(-0.5, turn_radians + 0.5));
            assert!(difference(left, right) <= 2, "turned by {turn_radians}: {left:?} {right:?}");
        }
        assert!(difference(seen(0.0, 0.0), seen(0.0, PI)) > 20, "turned round it is lit from behind");
    }
}
