//! Each view mode shows what it says.

use bindpose::scene::{Light, ViewMode, srgb8_from_linear};
use glam::{Vec2, Vec3};

use crate::gpu::{Picture, difference};
use crate::scenes::{FRONT, Scene, bent_tube, card as two_halves};
use crate::sets::{OPEN_EDGE_CORNER, ROW, SIZE, corner, row, shadow_of_lid, shelter};
use crate::textures::{HEIGHT, WHITE, WIDTH, card, card_once, dds, diffuse, linear, normal, pixels_of_card, plain};

const LEANING: [u8; 4] = [204, 128, 230, 255];
/// Numbers are rounded to bytes once; 127.5 may go both ways.
const ROUNDING: u8 = 1;

fn showing(mut scene: Scene, mode: ViewMode) -> Scene {
    scene.options.view_mode = mode;
    scene
}

fn assert_shows(picture: &Picture, [red, green, blue]: [u8; 3]) {
    let (found, expected) = (picture.middle(), [red, green, blue, 255]);
    assert!(difference(found, expected) <= ROUNDING, "{found:?} for {expected:?}");
}

/// The checker as its documentation has it, for a surface that faces the viewer.
fn checker(place: Vec2) -> [u8; 4] {
    let field = (place * 8.0).floor();
    let shade = if (field.x + field.y) % 2.0 == 0.0 { 1.0 } else { 0.55 };
    let color = Vec3::new(0.15 + 0.8 * place.x, 0.15 + 0.8 * place.y, 0.35) * shade;
    let [red, green, blue] = color.to_array().map(|channel| (channel * 255.0).round() as u8);
    [red, green, blue, 255]
}

on_both_backends! {
    fn base_colour_is_the_materials_times_the_maps(gpu) {
        let texel = [120, 60, 200];
        let map = plain([120, 60, 200, 255]);
        let draw = |diffuse_color| {
            let scene = showing(card(diffuse_color, [Vec2::ZERO, Vec2::ONE]), ViewMode::BaseColor);
            gpu.draw_with_maps(&scene, &diffuse(&map), WIDTH, HEIGHT)
        };
        assert_eq!(draw(WHITE).middle(), [120, 60, 200, 255]);
        let half = linear(texel).map(|channel| srgb8_from_linear(channel * 0.5));
        assert_shows(&draw([0.5; 3]), half);
    }

    fn a_normal_map_is_shown_as_it_is(gpu) {
        let scene = showing(card_once(), ViewMode::NormalMap);
        assert_eq!(gpu.draw(&scene, WIDTH, HEIGHT).middle(), [128, 128, 255, 255]);
        for texel in [[128, 128, 255, 255], LEANING, [10, 200, 128, 255]] {
            assert_eq!(gpu.draw_with_maps(&scene, &normal(&plain(texel)), WIDTH, HEIGHT).middle(), texel);
        }
        // Of two channels the third follows.
        let block = [[204, 204, 0, 0, 0, 0, 0, 0], [128, 128, 0, 0, 0, 0, 0, 0]].concat();
        let pair = dds(b"BC5U", [0; 2], 4, &block.repeat(3));
        assert_shows(&gpu.draw_with_maps(&scene, &normal(&pair), WIDTH, HEIGHT), [204, 128, 230]);
    }

    fn the_shading_normal_is_the_vertexs_bent_by_the_map(gpu) {
        let scene = || showing(card_once(), ViewMode::ShadingNormal);
        assert_shows(&gpu.draw(&scene(), WIDTH, HEIGHT), [128, 128, 0]);
        let bent = |scene: &Scene, texel| gpu.draw_with_maps(scene, &normal(&plain(texel)), WIDTH, HEIGHT);
        // 204 is 0.6 to the right, 230 is 0.8 towards the viewer at −z; v goes down.
        assert_shows(&bent(&scene(), LEANING), [204, 128, 25]);
        assert_shows(&bent(&scene(), [128, 204, 230, 255]), [128, 51, 25]);
        let mut flipped = scene();
        flipped.options.normal_green_flipped = true;
        assert_shows(&bent(&flipped, [128, 204, 230, 255]), [128, 204, 25]);
    }

    fn the_tangent_is_the_vertexs_and_darker_where_it_mirrors(gpu) {
        let mut scene = showing(card_once(), ViewMode::Tangent);
        assert_shows(&gpu.draw(&scene, WIDTH, HEIGHT), [255, 128, 128]);
        for tangent in &mut scene.model.mesh.tangents {
            *tangent = Vec3::NEG_Y.extend(-1.0);
        }
        // 0.6 of (0.5, 0, 0.5).
        assert_shows(&gpu.draw(&scene, WIDTH, HEIGHT), [77, 0, 77]);
    }

    fn texture_coordinates_are_a_checker(gpu) {
        let scene = showing(card_once(), ViewMode::TexCoords);
        let picture = gpu.draw(&scene, WIDTH, HEIGHT);
        let mut compared = 0;
        for (x, y, place) in pixels_of_card(&scene) {
            let in_field = place * 8.0 - (place * 8.0).floor();
            if in_field.min_element() > 0.2 && in_field.max_element() < 0.8 {
                let (found, expected) = (picture.pixel(x, y), checker(place));
                assert!(difference(found, expected) <= 2, "{place}: {found:?} for {expected:?}");
                compared += 1;
            }
        }
        assert!(compared > 200, "{compared}");
        // What lies outside the first tile is paler.
        let next = showing(card(WHITE, [Vec2::ONE, Vec2::splat(2.0)]), ViewMode::TexCoords);
        let next = gpu.draw(&next, WIDTH, HEIGHT);
        let spread = |[red, green, blue, _]: [u8; 4]| u32::from(red.max(green).max(blue) - red.min(green).min(blue));
        let mut sums = [0, 0];
        for (x, y, _) in pixels_of_card(&scene).step_by(97) {
            let [next, first] = [&next, &picture].map(|picture| spread(picture.pixel(x, y)));
            assert!(next <= first + 2, "({x}, {y})");
            sums = [sums[0] + next, sums[1] + first];
        }
        let [next, first] = sums;
        assert!(next > 0 && 4 * next < 3 * first, "{next} and {first}");
    }

    fn nearer_is_lighter(gpu) {
        let picture = gpu.draw(&showing(row(), ViewMode::Depth), SIZE[0], SIZE[1]);
        let [near, between, far] = ROW.map(|middle| picture.at(row().pixel_of(middle, SIZE)));
        for grey in [near, between, far] {
            assert!(grey[0] == grey[1] && grey[1] == grey[2], "{grey:?}");
        }
        assert!(near[0] > 240 && far[0] < 15, "{near:?} {far:?}");
        assert!(between[0].abs_diff(128) <= 4, "{between:?}");
    }

    fn each_material_has_a_colour_of_its_own(gpu) {
        let mut scene = showing(row(), ViewMode::Material);
        scene.model.mesh.submeshes[2].material = 0;
        let picture = gpu.draw(&scene, SIZE[0], SIZE[1]);
        let [first, second, same] = ROW.map(|middle| picture.at(scene.pixel_of(middle, SIZE)));
        assert!(difference(first, second) > 60, "{first:?} {second:?}");
        assert!(difference(first, same) <= ROUNDING, "{first:?} {same:?}");
    }

    fn roughness_is_grey(gpu) {
        use bindpose::model::Reflectance;
        let mut scene = showing(card_once(), ViewMode::Roughness);
        scene.model.materials[0].reflectance = Reflectance::Fresnel { fresnel0: [0.04; 3], roughness: 0.4 };
        assert_shows(&gpu.draw(&scene, WIDTH, HEIGHT), [102; 3]);
        // The gloss, (1 - 0.4) * 128 / 255, is in the alpha of the normal map.
        let glossy = plain([128, 128, 255, 128]);
        for light in Light::ALL {
            scene.options.light = light;
            assert_shows(&gpu.draw_with_maps(&scene, &normal(&glossy), WIDTH, HEIGHT), [178; 3]);
        }
        scene.options.light = Light::Studio;
        // Of a power: (2 / (30 + 2)) to the fourth root is 1/2.
        scene.model.materials[0].reflectance = Reflectance::Phong {
            ambient: [0.5; 3],
            specular: [0.5; 3],
            spec_power: 30.0,
            reflectivity: [0.0; 3],
        };
        assert_shows(&gpu.draw(&scene, WIDTH, HEIGHT), [128; 3]);
        // That book reads no gloss.
        assert_shows(&gpu.draw_with_maps(&scene, &normal(&glossy), WIDTH, HEIGHT), [128; 3]);
    }

    fn the_books_materials_are_no_metal(gpu) {
        assert_shows(&gpu.draw(&showing(card_once(), ViewMode::Metallic), WIDTH, HEIGHT), [0; 3]);
    }

    fn shadow_falls_where_the_first_light_does_not_reach(gpu) {
        let mut scene = showing(shelter(), ViewMode::Shadow);
        let mut easel = gpu.easel(&scene, &[], SIZE);
        for light in Light::ALL {
            scene.options.light = light;
            let picture = easel.draw(&scene);
            let at = |point: Vec3| picture.at(scene.pixel_of(point, SIZE))[0];
            let shadow = shadow_of_lid(light);
            // Under the studio's lamp it is all penumbra, but for the middle.
            assert!(at(shadow) <= if light == Light::Studio { 40 } else { 0 }, "{light:?}: the middle of the shadow is {}", at(shadow));
            assert_eq!(at(Vec3::Y), 255, "{light:?}: the lid itself");
            // As far to the other side there is nothing above.
            assert_eq!(at(Vec3::new(-shadow.x, 0.0, -shadow.z)), 255, "{light:?}: the open floor");
            let grey = picture.rgba.chunks_exact(4).filter(|pixel| (20..236).contains(&pixel[0])).count();
            assert!(grey > 10, "{light:?}: the edge is soft");
        }
    }

    fn corners_are_darker_than_open_ground(gpu) {
        let mut scene = showing(corner(), ViewMode::AmbientOcclusion);
        let size = [240, 180];
        let mut easel = gpu.easel(&scene, &[], size);
        for light in Light::ALL {
            scene.options.light = light;
            let picture = easel.draw(&scene);
            let [open, edge, corner] = OPEN_EDGE_CORNER
                .map(|point| f32::from(picture.at(scene.pixel_of(point, size))[0]) / 255.0);
            assert!(open >= 0.95, "{light:?}: open ground {open}");
            assert!(edge < 0.9, "{light:?}: edge of two planes {edge}");
            assert!(corner < 0.8 && corner < edge - 0.05, "{light:?}: corner of three planes {corner}, edge {edge}");
        }
    }

    /// Properties have no light: the same picture under both, and with all passes off where they need none.
    fn properties_do_not_depend_on_the_light(gpu) {
        let mut scene = bent_tube(0.7);
        let mut easel = gpu.easel(&scene, &[], [96, 64]);
        for mode in ViewMode::ALL {
            scene.options.view_mode = mode;
            let [studio, book] = Light::ALL.map(|light| {
                scene.options.light = light;
                easel.draw(&scene)
            });
            let by_light = bindpose::scene::Pass::ALL.into_iter().any(|pass| mode.shows(pass));
            assert_eq!(studio.share_that_differs(&book, 0) > 0.0, by_light, "{mode:?}");
        }
    }

    fn no_two_modes_show_the_same(gpu) {
        let scene = || Scene::of(two_halves(FRONT)).three_quarter(bindpose::scene::Theme::Dark);
        let mut easel = gpu.easel(&scene(), &[], [96, 64]);
        let pictures = ViewMode::ALL.map(|mode| easel.draw(&showing(scene(), mode)));
        for (index, picture) in pictures.iter().enumerate() {
            for (other_index, other) in pictures[..index].iter().enumerate() {
                let (a, b) = (ViewMode::ALL[index], ViewMode::ALL[other_index]);
                // A lone card is open and lit all over.
                let both_white = [a, b].iter().all(|mode| matches!(mode, ViewMode::AmbientOcclusion | ViewMode::Shadow));
                assert!(both_white || picture.share_that_differs(other, 8) > 0.01, "{a:?} and {b:?}");
            }
        }
    }
}
