//! What a diffuse map looks like on a surface.

use std::sync::Arc;

use bindpose::image::{Image, MapKind};
use bindpose::model::AlphaMode;
use bindpose::scene::{Background, ViewMode};
use glam::Vec2;

use crate::gpu::{Gpu, Picture, difference, without_blocks};
use crate::scenes::Scene;
use crate::textures::{
    HEIGHT, WHITE, WIDTH, card, card_once, dds, diffuse, linear, normal, pixels_of_card, plain, square,
};

const ONE: [u8; 3] = [200, 40, 90];
const OTHER: [u8; 3] = [30, 120, 220];

fn draw(gpu: &Gpu, scene: &Scene) -> Picture {
    gpu.draw(scene, WIDTH, HEIGHT)
}

fn draw_with(gpu: &Gpu, scene: &Scene, map: &Arc<Image>) -> Picture {
    gpu.draw_with_maps(scene, &diffuse(map), WIDTH, HEIGHT)
}

/// Every pixel of the card that is `expected` to be known, and that there are many of them.
fn compare(scene: &Scene, found: &Picture, tolerance: u8, expected: impl Fn(u32, u32, Vec2) -> Option<[u8; 4]>) {
    let mut compared = 0;
    for (x, y, place) in pixels_of_card(scene) {
        let Some(expected) = expected(x, y, place) else {
            continue;
        };
        let found = found.pixel(x, y);
        assert!(
            difference(found, expected) <= tolerance,
            "({x}, {y}): {found:?} for {expected:?}"
        );
        compared += 1;
    }
    assert!(compared > 500, "only {compared} pixels were compared");
}

/// A small generator of bytes, the same everywhere.
fn random_bytes(seed: u64, count: usize) -> Vec<u8> {
    let mut state = seed;
    let next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 56) as u8
    };
    std::iter::repeat_with(next).take(count).collect()
}

on_both_backends! {
    /// Each texel shows as a material of that colour would: right place, repeated outside 0 … 1, decoded from sRGB.
    fn a_checker_repeats_in_its_own_colours(gpu) {
        let tex_coords = [Vec2::new(-1.0, -0.5), Vec2::new(2.0, 1.0)];
        let scene = card(WHITE, tex_coords);
        let is_one = |x: u32, y: u32| (x / 4 + y / 4).is_multiple_of(2);
        let map = square(8, |x, y| {
            let [red, green, blue] = if is_one(x, y) { ONE } else { OTHER };
            [red, green, blue, 255]
        });
        let [one, other] = [ONE, OTHER].map(|color| draw(gpu, &card(linear(color), tex_coords)));
        compare(&scene, &draw_with(gpu, &scene, &map), 1, |x, y, place| {
            let texel = (tex_coords[0] + place * (tex_coords[1] - tex_coords[0])) * 8.0;
            let from_border = (texel / 4.0 - (texel / 4.0).round()).abs().min_element() * 4.0;
            let [column, row] = [texel.x, texel.y].map(|at| at.floor().rem_euclid(8.0) as u32);
            let expected = if is_one(column, row) { &one } else { &other };
            // Nearer than that, filtering mixes the two.
            (from_border > 0.6).then(|| expected.pixel(x, y))
        });
    }

    fn the_material_colours_its_map(gpu) {
        let tint = [0.5, 0.8, 0.25];
        let texel = linear([180, 90, 140]);
        let product = [tint[0] * texel[0], tint[1] * texel[1], tint[2] * texel[2]];
        let once = [Vec2::ZERO, Vec2::ONE];
        let scene = card(tint, once);
        let expected = draw(gpu, &card(product, once));
        let found = draw_with(gpu, &scene, &plain([180, 90, 140, 255]));
        compare(&scene, &found, 1, |x, y, _| Some(expected.pixel(x, y)));
    }

    /// A white that waits for its map shows a tint; with the map it is white.
    fn a_map_that_is_there_needs_no_tint(gpu) {
        let mut scene = card_once();
        let white = draw(gpu, &scene);
        scene.model.materials[0].diffuse_map = Some("card.dds".into());
        let waiting = draw(gpu, &scene);
        assert!(difference(waiting.middle(), white.middle()) > 20);
        let found = draw_with(gpu, &scene, &plain([255; 4]));
        compare(&scene, &found, 1, |x, y, _| Some(white.pixel(x, y)));
    }

    /// Black and white texels far smaller than a pixel: the grey of half the light everywhere, no pattern.
    fn fine_detail_is_grey_from_afar(gpu) {
        let tex_coords = [Vec2::ZERO, Vec2::splat(16.0)];
        let scene = card(WHITE, tex_coords);
        let map = square(64, |x, y| if (x + y).is_multiple_of(2) { [255; 4] } else { [0, 0, 0, 255] });
        let grey = draw(gpu, &card([0.5; 3], tex_coords));
        compare(&scene, &draw_with(gpu, &scene, &map), 2, |x, y, _| Some(grey.pixel(x, y)));
    }

    fn maps_may_come_after_the_model_and_go_again(gpu) {
        let scene = card_once();
        let map = square(8, |x, y| [(x * 32) as u8, (y * 32) as u8, 90, 255]);
        let mut renderer = gpu.renderer();
        let mut target = gpu.target(WIDTH, HEIGHT);
        renderer.set_maps(&diffuse(&map));
        renderer.set_model(&scene.model).expect("small");
        let mut draw_now = |renderer: &mut bindpose::render::Renderer| {
            renderer.render(&scene.frame(), &mut target);
            gpu.read(&target)
        };
        let bare = draw(gpu, &scene);
        assert_eq!(draw_now(&mut renderer), bare, "maps that came before the model are not its own");
        renderer.set_maps(&diffuse(&map));
        let mapped = draw_now(&mut renderer);
        assert_eq!(mapped, draw_with(gpu, &scene, &map));
        assert!(mapped.share_that_differs(&bare, 20) > 0.1);
        renderer.set_maps(&[]);
        assert_eq!(draw_now(&mut renderer), bare);
        renderer.set_maps(&diffuse(&map));
        renderer.set_model(&scene.model).expect("small");
        assert_eq!(draw_now(&mut renderer), bare, "a new model starts without maps");
    }

    /// A header of DirectX 10 may say that alpha does not count, whatever the blocks hold: they go up, and it is not asked for.
    fn blocks_that_are_declared_opaque_have_no_holes(gpu) {
        let mut scene = card_once();
        scene.model.materials[0].alpha = AlphaMode::clipped(true);
        // The colour of a hole in BC1 is black.
        scene.options.background = Background::Color([255; 3]);
        let decodes = without_blocks(gpu.backend);
        for (dxgi, block_len) in [(71, 8), (74, 16), (77, 16), (98, 16)] {
            let mut bytes = random_bytes(7, (16 + 4 + 3) * block_len);
            for block in bytes.chunks_exact_mut(block_len) {
                block[0] |= 0x40;
            }
            let [cut, opaque] = [0, 3].map(|alpha_mode| dds(b"DX10", [dxgi, alpha_mode], 16, &bytes));
            assert!(cut.has_alpha() && !opaque.has_alpha());
            let (read, decoded) = (draw_with(gpu, &scene, &opaque), draw_with(&decodes, &scene, &opaque));
            assert_eq!(read.share_that_differs(&decoded, 2), 0.0, "{}", opaque.description());
            let with_holes = draw_with(gpu, &scene, &cut);
            // Little is clear enough to be cut away, and of BC7, which interpolates its alpha, nothing.
            let share = read.share_that_differs(&with_holes, 20);
            assert!(share > 1e-3 || dxgi == 98, "{}: {share}", cut.description());
        }
    }

    /// Any bits are blocks. A device that reads them shows what one shows for which they are decoded.
    fn blocks_look_the_same_decoded(gpu) {
        assert!(gpu.open.device.features().contains(wgpu::Features::TEXTURE_COMPRESSION_BC));
        let decodes = without_blocks(gpu.backend);
        assert!(!decodes.open.device.features().contains(wgpu::Features::TEXTURE_COMPRESSION_BC));
        let scene = card_once();
        for (code, dxgi, block_len) in [
            (b"DXT1", [0; 2], 8),
            (b"DXT3", [0; 2], 16),
            (b"DXT5", [0; 2], 16),
            (b"BC4U", [0; 2], 8),
            (b"BC5U", [0; 2], 16),
            (b"DX10", [98, 0], 16),
        ] {
            // 16, 8, 4, 2 and 1 texels a side.
            let mut bytes = random_bytes(7, (16 + 4 + 3) * block_len);
            for block in bytes.chunks_exact_mut(block_len) {
                // A BC7 block without any mode is none.
                block[0] |= 0x40;
            }
            let map = dds(code, dxgi, 16, &bytes);
            assert_eq!(map.level_count(), 5);
            let (read, decoded) = (draw_with(gpu, &scene, &map), draw_with(&decodes, &scene, &map));
            assert_eq!(read.share_that_differs(&decoded, 2), 0.0, "{}", map.description());
            assert!(read.share_that_differs(&draw(gpu, &scene), 20) > 0.1, "{}", map.description());
        }
    }

    /// The same of directions, whose two-channel blocks go up as they are.
    fn blocks_of_directions_look_the_same_decoded(gpu) {
        let decodes = without_blocks(gpu.backend);
        let mut scene = card_once();
        scene.options.view_mode = ViewMode::ShadingNormal;
        for (code, dxgi, block_len) in [
            (b"DXT1", [0; 2], 8),
            (b"DXT3", [0; 2], 16),
            (b"DXT5", [0; 2], 16),
            (b"BC5U", [0; 2], 16),
            (b"DX10", [98, 0], 16),
        ] {
            let mut bytes = random_bytes(7, (16 + 4 + 3) * block_len);
            for block in bytes.chunks_exact_mut(block_len) {
                block[0] |= 0x40;
                if code == b"BC5U" {
                    // Between 0.3 and 0.7, where z does not hang on the last digit of x and y.
                    for end in [0, 1, 8, 9] {
                        block[end] = 77 + block[end] % 102;
                    }
                    // Ends in falling order: six values between them, instead of 0 and 1 among them.
                    for ends in [0, 8] {
                        block[ends..ends + 2].sort_by(|a, b| b.cmp(a));
                        block[ends] = block[ends].max(block[ends + 1] + 1);
                    }
                }
            }
            let map = dds(code, dxgi, 16, &bytes);
            let [read, decoded] = [gpu, &decodes].map(|gpu| gpu.draw_with_maps(&scene, &normal(&map), WIDTH, HEIGHT));
            // Where the three cancel each other nearly, a direction hangs on their last digits.
            let share = read.share_that_differs(&decoded, 8);
            assert!(share < 0.005, "{}: {share}", map.description());
            assert!(read.share_that_differs(&draw(gpu, &scene), 10) > 0.1, "{}", map.description());
        }
    }

    /// Black and white columns, of which the next level has the mean.
    fn a_device_that_reads_no_blocks_leaves_levels_above_2048_out(gpu) {
        let columns = (0..4096 * 4).flat_map(|texel| [[255; 4], [0, 0, 0, 255]][texel % 2]);
        let image = Image::from_rgba8(4096, 4, columns.collect(), "test").expect("small");
        let map = Arc::new(image.with_mips(MapKind::Diffuse));
        let scene = card(linear([255; 3]), [Vec2::ZERO, Vec2::new(4.0 / 4096.0, 1.0)]);
        let spread = |gpu: &Gpu| {
            let picture = draw_with(gpu, &scene, &map);
            let row = pixels_of_card(&scene).filter(|&(_, y, _)| y == HEIGHT / 2);
            let greens: Vec<_> = row.map(|(x, y, _)| picture.pixel(x, y)[1]).collect();
            greens.iter().max().expect("pixels") - greens.iter().min().expect("pixels")
        };
        assert!(spread(gpu) > 80, "{}", spread(gpu));
        let decodes = without_blocks(gpu.backend);
        assert!(spread(&decodes) < 10, "{}", spread(&decodes));
    }

    /// Sides that are no multiple of four, and pictures of one texel.
    fn odd_sizes_are_drawn(gpu) {
        let scene = card_once();
        let expected = draw(gpu, &card(linear(ONE), [Vec2::ZERO, Vec2::ONE]));
        let [red, green, blue] = ONE;
        for (width, height) in [(1, 1), (3, 5), (1, 9), (100, 1)] {
            let texels = [red, green, blue, 255].repeat((width * height) as usize);
            let map = Arc::new(Image::from_rgba8(width, height, texels, "test").expect("small"));
            compare(&scene, &draw_with(gpu, &scene, &map), 1, |x, y, _| Some(expected.pixel(x, y)));
        }
    }
}
