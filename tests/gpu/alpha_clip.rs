//! What alpha cuts away, and what it must not.

use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;

use bindpose::image::{Image, decode};
use bindpose::model::AlphaMode;
use bindpose::render::{Renderer, SampleCount, Target};
use bindpose::scene::{Background, Pass, Passes, Theme};
use glam::{Affine3A, Vec2, Vec3};

use crate::gpu::{Gpu, Picture, difference};
use crate::scenes::Scene;
use crate::textures::{HEIGHT, WHITE, WIDTH, card, card_once, dds, diffuse, pixels_of_card, plain, square, texels};

const GREEN: [u8; 3] = [40, 160, 60];

fn green(alpha: u8) -> [u8; 4] {
    let [red, green, blue] = GREEN;
    [red, green, blue, alpha]
}

/// Nothing on the left, everything on the right.
fn half() -> Arc<Image> {
    square(16, |x, _| green(if x < 8 { 0 } else { 255 }))
}

fn clipped(mut scene: Scene) -> Scene {
    for material in &mut scene.model.materials {
        material.alpha = AlphaMode::clipped(true);
    }
    scene
}

fn without_model(mut scene: Scene) -> Scene {
    scene.model = Default::default();
    scene
}

fn draw(gpu: &Gpu, scene: &Scene, map: &Arc<Image>) -> Picture {
    gpu.draw_with_maps(scene, &diffuse(map), WIDTH, HEIGHT)
}

/// Left half as `left`, right half as `right`, but for the line between them.
fn compare_halves(scene: &Scene, found: &Picture, left: &Picture, right: &Picture) {
    let mut compared = 0;
    for (x, y, place) in pixels_of_card(scene) {
        if (place.x - 0.5).abs() > 0.06 && (0.06..0.94).contains(&place.x) {
            let expected = if place.x < 0.5 { left } else { right }.pixel(x, y);
            let found = found.pixel(x, y);
            assert!(
                difference(found, expected) <= 1,
                "({x}, {y}): {found:?} for {expected:?}"
            );
            compared += 1;
        }
    }
    assert!(compared > 500, "only {compared} pixels were compared");
}

on_both_backends! {
    fn alpha_cuts_where_the_material_says_so(gpu) {
        for background in [Background::Backdrop, Background::None] {
            let scene = || {
                let mut scene = card_once();
                scene.options.background = background;
                scene
            };
            let bare = gpu.draw(&without_model(scene()), WIDTH, HEIGHT);
            let whole = draw(gpu, &scene(), &plain(green(255)));
            compare_halves(&scene(), &draw(gpu, &clipped(scene()), &half()), &bare, &whole);
            compare_halves(&scene(), &draw(gpu, &scene(), &half()), &whole, &whole);
        }
    }

    /// A tenth is the limit.
    fn a_little_alpha_is_enough(gpu) {
        let bare = gpu.draw(&without_model(card_once()), WIDTH, HEIGHT);
        let whole = draw(gpu, &card_once(), &plain(green(255)));
        let map = square(16, |x, _| green(if x < 8 { 23 } else { 29 }));
        compare_halves(&card_once(), &draw(gpu, &clipped(card_once()), &map), &bare, &whole);
    }

    /// A file whose header has no mask for alpha may have 0 there.
    fn a_map_without_alpha_cuts_nothing(gpu) {
        let mut words = [0u32; 31];
        words[..7].copy_from_slice(&[124, 0x1007, 4, 4, 0, 0, 0]);
        words[18..26].copy_from_slice(&[32, 0x40, 0, 32, 0xff_0000, 0xff00, 0xff, 0]);
        words[26] = 0x1000;
        let mut file = b"DDS ".to_vec();
        file.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        let [red, green_, blue] = GREEN;
        file.extend([blue, green_, red, 0].repeat(16));
        let map = Arc::new(decode(&file, "bgrx.dds").expect("a file as the books have them"));
        let whole = draw(gpu, &card_once(), &plain(green(255)));
        assert_eq!(draw(gpu, &clipped(card_once()), &map), whole);

        // BC3 blocks of alpha 0 and one colour; the header says that alpha is 1.
        let block = [0, 0, 0, 0, 0, 0, 0, 0, 0xe0, 0x07, 0xe0, 0x07, 0, 0, 0, 0];
        let [said_opaque, said_nothing] = [3, 0].map(|alpha_mode| dds(b"DX10", [77, alpha_mode], 4, &block.repeat(3)));
        assert!(!said_opaque.has_alpha() && said_nothing.has_alpha());
        let whole = draw(gpu, &card_once(), &said_opaque);
        assert_eq!(draw(gpu, &clipped(card_once()), &said_opaque), whole);
        let bare = gpu.draw(&without_model(card_once()), WIDTH, HEIGHT);
        assert_eq!(draw(gpu, &clipped(card_once()), &said_nothing), bare);
    }

    fn what_is_cut_away_casts_no_shadow(gpu) {
        // From above, so that no shadow is seen through what is cut away.
        let scene = || {
            let mut scene = card_once().three_quarter(Theme::Light);
            scene.camera.pitch_radians = 1.45;
            scene
        };
        let bare = gpu.draw(&without_model(scene()), WIDTH, HEIGHT);
        assert_eq!(draw(gpu, &clipped(scene()), &plain(green(0))), bare);

        let dark = |picture: &Picture| {
            let pairs = picture.rgba.chunks_exact(4).zip(bare.rgba.chunks_exact(4));
            let is_shadow = |(with, without): &(&[u8], &[u8])| {
                with[0].abs_diff(with[1]) < 24 && with[0].saturating_add(30) < without[0]
            };
            pairs.filter(is_shadow).count()
        };
        // Clear at both sides, so that no line of what repeats shows there.
        let half = square(16, |x, _| green(if (8..15).contains(&x) { 255 } else { 0 }));
        let (whole, cut) = (dark(&draw(gpu, &scene(), &half)), dark(&draw(gpu, &clipped(scene()), &half)));
        assert!(whole > 60 && cut > 15 && cut < whole * 3 / 4, "{cut} of {whole} pixels of shadow");
    }

    /// A card that lies just above the ground, of which alpha leaves the middle, is as near to it as one that is no
    /// wider: through the holes the ground is seen. By two maps and by all of them, cut and blended.
    fn what_is_cut_away_touches_nothing(gpu) {
        let lying = Affine3A::from_translation(Vec3::Y * 0.01) * Affine3A::from_rotation_x(FRAC_PI_2);
        let scene = |alpha, width| {
            let mut scene = card_once().in_world(lying).three_quarter(Theme::Light);
            scene.model.mesh.positions.iter_mut().for_each(|position| position.x *= width);
            scene.world_bounds.min.y = 0.0;
            scene.world_bounds.max.y = 1.0;
            (scene.camera.pitch_radians, scene.camera.yaw_radians) = (1.3, 0.0);
            scene.options.passes = Passes::none().with(Pass::ContactShadow, true);
            scene.model.materials[0].double_sided = true;
            scene.model.materials[0].alpha = alpha;
            scene
        };
        let narrow = draw(gpu, &scene(AlphaMode::Opaque, 0.5), &plain(green(255)));
        let middle = Arc::new(texels(64, |x, _| green(if (16..48).contains(&x) { 255 } else { 0 })));
        for alpha in [AlphaMode::clipped(true), AlphaMode::Mask { cutoff: 0.5 }, AlphaMode::Blend] {
            let mut scene = scene(alpha, 1.0);
            let found = draw(gpu, &scene, &middle);
            // At the edges of the card itself. What it leaves open is a tenth of the picture.
            let differs = found.share_that_differs(&narrow, 6);
            assert!(differs < 0.02, "{alpha:?}: {differs} of the pixels differ");
            scene.options.passes = Passes::none();
            let dark = draw(gpu, &scene, &middle).share_that_differs(&found, 6);
            assert!(dark > 0.01, "{alpha:?}: {dark} of the pixels are darker near the card");
        }
    }

    /// A slanted line through an alpha ramp: with four samples a pixel the edge takes colours between, and stays opaque.
    fn cut_edges_are_smooth(gpu) {
        let scene = clipped(card(WHITE, [Vec2::new(0.0, 0.0), Vec2::new(0.9, 0.9)]));
        let map = square(64, |x, y| green(((x * 2 + y) * 255 / 189).saturating_sub(80).min(255) as u8));
        let background = without_model(card_once());
        let bare = gpu.draw(&background, WIDTH, HEIGHT);
        let whole = draw(gpu, &card(WHITE, [Vec2::ZERO, Vec2::ONE]), &plain(green(255)));
        let between = |picture: &Picture| {
            let pixels = pixels_of_card(&scene);
            pixels
                .filter(|&(x, y, _)| {
                    let far_from = |other: &Picture| difference(picture.pixel(x, y), other.pixel(x, y)) > 10;
                    far_from(&bare) && far_from(&whole)
                })
                .count()
        };
        assert_eq!(gpu.open.samples, SampleCount::Four);
        let smooth = draw(gpu, &scene, &map);
        assert!(between(&smooth) > 20, "{}", between(&smooth));
        assert!(smooth.rgba.iter().skip(3).step_by(4).all(|&alpha| alpha == 255));

        let device = &gpu.open.device;
        let mut renderer = Renderer::with_samples(device, &gpu.open.queue, SampleCount::One);
        renderer.set_model(&scene.model).expect("small");
        renderer.set_maps(&diffuse(&map));
        let mut target = Target::with_samples(device, WIDTH, HEIGHT, SampleCount::One);
        renderer.render(&scene.frame(), &mut target);
        assert_eq!(between(&gpu.read(&target)), 0, "with one sample a pixel is whole or nothing");

        // On nothing too: there the edge has alphas between, and the colour of the card.
        let mut scene = scene;
        scene.options.background = Background::None;
        scene.options.passes = Passes::none();
        let on_nothing = draw(gpu, &scene, &map);
        let inside = pixels_of_card(&scene).filter(|(_, _, place)| place.min_element() > 0.05 && place.max_element() < 0.95);
        let edge: Vec<_> = inside.map(|(x, y, _)| on_nothing.pixel(x, y)).filter(|pixel| (1..255).contains(&pixel[3])).collect();
        assert!(edge.len() > 20, "{}", edge.len());
        assert!(edge.iter().all(|[red, green, blue, _]| green > red && green > blue), "{edge:?}");
    }
}
