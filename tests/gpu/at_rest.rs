//! A picture at rest: the mean of many, each from another place within the pixel, under another point of the lamp, through another point
//! of the lens.

use bindpose::model::{AlphaMode, MapSlot};
use bindpose::render::for_tests::bytes_at_rest;
use bindpose::render::{Accumulator, Compositor, MaterialImages, PictureTarget, Renderer, SampleCount, Target};
use bindpose::scene::{
    Background, Light, Overlay, Overlays, Projection, Theme, ViewMode, linear_from_srgb8, srgb8_from_linear,
};
use glam::Vec3;

use crate::gltf_materials::{blended, over, unlit};
use crate::gpu::{Gpu, Picture, difference};
use crate::picture::{SURFACE_FORMAT, on_surface};
use crate::scenes::Scene;
use crate::sets::{Plate, floor, plates};
use crate::still_life::{StillLifeMaps, add_ball, still_life};
use crate::textures::{images, square};

const SIZE: [u32; 2] = [160, 120];

/// The mean of so many pictures of a scene.
fn mean(gpu: &Gpu, scene: &Scene, maps: &[MaterialImages<'_>], [width, height]: [u32; 2], samples: u32) -> Picture {
    let mut renderer = gpu.renderer();
    renderer.set_model(&scene.model).expect("test models are small");
    renderer.set_maps(maps);
    let mut target = PictureTarget::new([width, height]).with_mean_of(samples);
    let drawn = renderer.picture_into(&scene.frame(), &mut target).expect("it is small");
    let rgba = drawn.pixels_blocking().expect("it is small");
    Picture { width, height, rgba }
}

/// Differences of all colours, sorted.
fn differences(a: &Picture, b: &Picture) -> Vec<u8> {
    let colors = |picture: &Picture| {
        picture
            .rgba
            .chunks(4)
            .flat_map(|pixel| pixel[..3].to_vec())
            .collect::<Vec<_>>()
    };
    let mut all: Vec<_> = colors(a)
        .into_iter()
        .zip(colors(b))
        .map(|(a, b)| a.abs_diff(b))
        .collect();
    all.sort_unstable();
    all
}

fn average(values: &[u8]) -> f64 {
    values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64
}

/// The most that the mean of a block of 8 × 8 pixels differs.
fn block_difference(a: &Picture, b: &Picture) -> f64 {
    let mean_of = |picture: &Picture, left: u32, top: u32, channel: usize| {
        let block = (0..64).map(|index| picture.pixel(left + index % 8, top + index / 8)[channel]);
        average(&block.collect::<Vec<_>>())
    };
    let mut most = 0.0f64;
    for top in (0..a.height - 7).step_by(8) {
        for left in (0..a.width - 7).step_by(8) {
            for channel in 0..3 {
                most = most.max((mean_of(a, left, top, channel) - mean_of(b, left, top, channel)).abs());
            }
        }
    }
    most
}

/// How many pixels lie off edges, and the most that one of them changes. At an edge, of a thing or of its shadow,
/// colours differ by more than a little within two pixels, in either picture.
fn off_edges(a: &Picture, b: &Picture) -> (usize, u8) {
    const LITTLE: u8 = 20;
    let is_even = |picture: &Picture, x: u32, y: u32| {
        let around = (0..25).map(|index| picture.pixel(x + index % 5 - 2, y + index / 5 - 2));
        (0..3).all(|channel| {
            let values = around.clone().map(|pixel| pixel[channel]);
            let [least, most] = values.fold([255, 0], |[least, most], value| [value.min(least), value.max(most)]);
            most - least <= LITTLE
        })
    };
    let (mut count, mut most) = (0, 0);
    for y in 2..a.height - 2 {
        for x in 2..a.width - 2 {
            if is_even(a, x, y) && is_even(b, x, y) {
                count += 1;
                most = most.max(difference(a.pixel(x, y), b.pixel(x, y)));
            }
        }
    }
    (count, most)
}

/// So many pixels of each side made one, in linear light, by the filter of radius 1.5 pixels that the mean has.
fn reduced(picture: &Picture, times: u32) -> Picture {
    let window = |away: f32| {
        let wave = |order: f32| (order * std::f32::consts::PI * away).cos();
        let inside = 0.358_75 + 0.488_29 * wave(1.0) + 0.141_28 * wave(2.0) + 0.011_68 * wave(3.0);
        if away.abs() < 1.0 { inside } else { 0.0 }
    };
    let (radius, center) = (1.5 * times as f32, 0.5 * times as f32);
    // Places of the large picture along one axis, with their weights.
    let along = |at: u32, side: u32| -> Vec<(u32, f32)> {
        let middle = (at * times) as f32 + center;
        let places = (0..side).filter(|&place| ((place as f32 + 0.5) - middle).abs() < radius);
        places
            .map(|place| (place, window((place as f32 + 0.5 - middle) / radius)))
            .collect()
    };
    let [width, height] = [picture.width / times, picture.height / times];
    let mut rgba = Vec::new();
    for y in 0..height {
        let rows = along(y, picture.height);
        for x in 0..width {
            let columns = along(x, picture.width);
            let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
            for (row, by_row) in &rows {
                for (column, by_column) in &columns {
                    let [red, green, blue, _] = picture.pixel(*column, *row);
                    sum += Vec3::from([red, green, blue].map(linear_from_srgb8)) * (by_row * by_column);
                    weights += by_row * by_column;
                }
            }
            let [red, green, blue] = (sum / weights).to_array().map(srgb8_from_linear);
            rgba.extend([red, green, blue, 255]);
        }
    }
    Picture { width, height, rgba }
}

/// Panes that stand one behind the other, the first in front, and fill the view.
fn panes(colors: &[([u8; 3], f32)]) -> Scene {
    let pane = |index: usize| Plate {
        corner: Vec3::new(-4.0, 4.0, index as f32 * 0.1),
        along_u: Vec3::X * 8.0,
        along_v: Vec3::NEG_Y * 8.0,
        normal: Vec3::NEG_Z,
    };
    let mut model = plates(&(0..=colors.len()).map(pane).collect::<Vec<_>>());
    model.materials = colors.iter().map(|&(srgb, opacity)| blended(srgb, opacity)).collect();
    model.materials.push(unlit(WALL));
    let mut scene = Scene::of(model);
    scene.camera.projection = Projection::Orthographic;
    scene.camera.distance *= 0.1;
    scene
}

const WALL: [u8; 3] = [200, 200, 40];

/// Samples of a scene at rest, as a window has them, and what lies over their mean.
struct Rest<'a> {
    gpu: &'a Gpu,
    renderer: Renderer,
    target: Target,
    mean: Accumulator,
}

impl<'a> Rest<'a> {
    fn new(gpu: &'a Gpu, scene: &Scene, [width, height]: [u32; 2]) -> Self {
        let device = &gpu.open.device;
        let mut renderer = Renderer::with_samples(device, &gpu.open.queue, SampleCount::One);
        renderer.set_model(&scene.model).expect("small");
        let target = Target::with_samples(device, width, height, SampleCount::One).with_layer();
        let mean = Accumulator::new(device, &target);
        Self {
            gpu,
            renderer,
            target,
            mean,
        }
    }

    fn shown(&self, is_mean: bool) -> Picture {
        let (device, queue) = (&self.gpu.open.device, &self.gpu.open.queue);
        let mut compositor = Compositor::new(device, SURFACE_FORMAT);
        compositor.prepare(device, queue, &self.target, is_mean.then_some(&self.mean));
        on_surface(self.gpu, &compositor, self.target.size())
    }
}

/// So many steps from pixel to pixel on each side tell the slope of a profile.
const STEPS_BESIDE: usize = 8;

on_both_backends! {
    fn the_mean_of_64_is_that_of_1024_and_is_no_other_picture_than_the_first(gpu) {
        let (maps, size) = (StillLifeMaps::new(), [96, 72]);
        for (light, theme, most) in [(Light::Studio, Theme::Light, 1024), (Light::Book, Theme::Dark, 256)] {
            let mut scene = still_life().three_quarter(theme);
            scene.camera.distance *= 1.2;
            scene.options.light = light;
            let [first, few, many] = [1, 64, most].map(|samples| mean(gpu, &scene, &maps.images(), size, samples));
            let off = differences(&few, &many);
            let noise = (off.iter().map(|&off| f64::from(off).powi(2)).sum::<f64>() / off.len() as f64).sqrt();
            assert!(average(&off) < 1.0 && noise < 4.0, "{light:?}: mean {}, r.m.s. {noise}", average(&off));
            let changed = differences(&first, &many);
            let median = changed[changed.len() / 2];
            assert!(median <= 1 && average(&changed) < 4.0, "{light:?}: {median}, {}", average(&changed));
            let most = block_difference(&first, &many);
            assert!(most < 24.0, "{light:?}: resting pops by {most}");
        }
    }

    fn resting_changes_no_pixel_off_edges_much(gpu) {
        let maps = StillLifeMaps::new();
        let ways = [(Light::Studio, Theme::Light), (Light::Studio, Theme::Dark), (Light::Book, Theme::Light)];
        for (light, theme) in ways {
            let mut scene = still_life().three_quarter(theme);
            scene.options.light = light;
            let [first, rested] = [1, 64].map(|samples| mean(gpu, &scene, &maps.images(), SIZE, samples));
            let (count, most) = off_edges(&first, &rested);
            let pixels = (SIZE[0] * SIZE[1]) as usize;
            assert!(count > pixels / 2, "{light:?} {theme:?}: {count} of {pixels} pixels are off edges");
            assert!(most <= 24, "{light:?} {theme:?}: one of them changes by {most}");
        }
    }

    /// Without maps, whose levels go with the pixels.
    fn a_picture_of_four_times_the_pixels_shows_the_same(gpu) {
        let mut scene = still_life().three_quarter(Theme::Light);
        scene.camera.distance *= 1.2;
        // In still smaller ones polished metal turns by so much within a pixel that it is drawn rougher, so that it does not glitter.
        let size = [240, 180];
        let small = mean(gpu, &scene, &[], size, 64);
        let large = mean(gpu, &scene, &[], size.map(|side| side * 4), 16);
        let off = differences(&small, &reduced(&large, 4));
        let high = off[off.len() * 99 / 100];
        assert!(average(&off) < 1.0 && high <= 6, "mean {}, 99 of 100 within {high}", average(&off));
    }

    /// The edge of a lid high over a floor: a penumbra of 300 pixels.
    fn a_penumbra_has_no_steps(gpu) {
        let lid = Plate {
            corner: Vec3::new(0.0, 1.0, -3.0),
            along_u: Vec3::X * 3.0,
            along_v: Vec3::Z * 6.0,
            normal: Vec3::Y,
        };
        let mut scene = Scene::of(plates(&[floor(3.2), lid]));
        let camera = &mut scene.camera;
        camera.projection = Projection::Orthographic;
        camera.pitch_radians = 1.2;
        camera.distance *= 0.3 / camera.height_in_view();
        let to_key = bindpose::render::for_tests::StudioLights::beside(camera, 0.0).to_key;
        camera.target = Vec3::new(-to_key.x / to_key.y, 0.0, 0.0);
        scene.options.view_mode = ViewMode::Shadow;
        let picture = mean(gpu, &scene, &[], [600, 240], 64);
        // Of many rows, which have other noise.
        let light = |x: u32| average(&(0..240).map(|y| picture.pixel(x, y)[0]).collect::<Vec<_>>());
        let profile: Vec<_> = (0..600).map(light).collect();
        assert!(profile[0] > 250.0 && profile[599] < 5.0, "lit, then dark: {} {}", profile[0], profile[599]);
        let width = profile.iter().filter(|light| (13.0..242.0).contains(*light)).count();
        assert!(width >= 300, "{width} pixels wide");
        // Beside the slope of the profile there, by the places a few pixels away on both sides, no step.
        let steps: Vec<_> = profile.windows(2).map(|pair| pair[0] - pair[1]).collect();
        let excess = |around: &[f64]| (around[STEPS_BESIDE] - around.iter().sum::<f64>() / around.len() as f64).abs();
        let most = steps.windows(2 * STEPS_BESIDE + 1).map(excess).fold(0.0, f64::max);
        assert!(most <= 1.0, "a step of {most} more than the slope");
    }

    fn what_is_seen_through_hair_is_as_if_it_were_sorted(gpu) {
        let half = square(4, |_, _| [255, 255, 255, 128]);
        let textured = [images([(MapSlot::Diffuse, &half)]), images([(MapSlot::Diffuse, &half)])];
        let layers = [([230, 30, 30], 1.0), ([30, 60, 230], 1.0)];
        let scene = panes(&layers);
        let shown = mean(gpu, &scene, &textured, [64, 48], 64);
        let part = 128.0 / 255.0;
        let wanted = over(WALL, &[([30, 60, 230], part), ([230, 30, 30], part)]);
        let colors: Vec<_> = (0..3).map(|channel| average(&shown.rgba.iter().skip(channel).step_by(4).copied().collect::<Vec<_>>())).collect();
        for (found, wanted) in colors.iter().zip(wanted) {
            assert!((found - f64::from(wanted)).abs() < 6.0, "{colors:?} for {wanted:?}");
        }
        let noise = shown.rgba.chunks(4).map(|pixel| f64::from(difference([pixel[0], pixel[1], pixel[2], 255], wanted)).powi(2));
        let noise = (noise.sum::<f64>() / (64.0 * 48.0)).sqrt();
        assert!(noise < 8.0, "{noise}");

        // Panes of one alpha stay sorted.
        let shown = mean(gpu, &panes(&[([230, 30, 30], part), ([30, 60, 230], part)]), &[], [64, 48], 16);
        assert!(difference(shown.middle(), wanted) <= 3, "{:?} for {wanted:?}", shown.middle());
    }

    fn a_cut_edge_is_smooth(gpu) {
        let halves = square(2, |x, _| [255, 255, 255, if x == 0 { 255 } else { 0 }]);
        let mut scene = panes(&[([230, 30, 30], 1.0)]);
        scene.model.materials[0].alpha = AlphaMode::Mask { cutoff: 0.5 };
        scene.camera.target.x += 0.0037;
        let shown = mean(gpu, &scene, &[images([(MapSlot::Diffuse, &halves)])], [64, 48], 64);
        let greens: Vec<_> = (24..40).map(|x| shown.pixel(x, 24)[1]).collect();
        assert!(greens[0] < 40 && greens[15] > 190 && greens.is_sorted_by(|a, b| *a <= b.saturating_add(2)), "{greens:?}");
        assert!(greens.iter().any(|green| (60..180).contains(green)), "{greens:?}");
    }

    /// Which pixels of a line are seen is decided by the depth of the first sample, wherever the others lie within their pixels.
    fn lines_over_a_mean_are_those_over_a_single_picture(gpu) {
        let mut scene = still_life().three_quarter(Theme::Light);
        let mut rest = Rest::new(gpu, &scene, SIZE);
        scene.options.background = Background::Color([128; 3]);
        scene.options.overlays = Overlays::none();
        let changed = |[before, after]: [Picture; 2]| -> Vec<bool> {
            let pixels = before.rgba.chunks(4).zip(after.rgba.chunks(4));
            pixels.map(|(before, after)| before[..3].iter().zip(after).any(|(a, b)| a.abs_diff(*b) > 12)).collect()
        };
        let draw_single = |rest: &mut Rest<'_>, scene: &Scene| {
            rest.renderer.render(&scene.frame(), &mut rest.target);
            rest.shown(false)
        };
        let mut with_lines = scene.frame();
        for overlay in [Overlay::Wireframe, Overlay::Bounds] {
            with_lines.options.overlays.set(overlay, true);
        }
        let single = [draw_single(&mut rest, &scene), {
            rest.renderer.render(&with_lines, &mut rest.target);
            rest.shown(false)
        }];
        for _ in 0..7 {
            rest.renderer.accumulate(&with_lines, &mut rest.target, &mut rest.mean);
        }
        assert!(rest.target.lacks_layer(with_lines.has_overlays()) && rest.target.can_draw_over([true; 2]));
        let before = rest.shown(true);
        let draws = rest.renderer.render_over_mean(&with_lines, &mut rest.target).draws;
        assert!(draws > 0 && draws < 8, "the model stays: {draws}");
        let over = rest.shown(true);
        rest.renderer.accumulate(&with_lines, &mut rest.target, &mut rest.mean);
        assert!(!rest.target.lacks_layer(with_lines.has_overlays()), "it lies over the next samples too");
        let (single, over) = (changed(single), changed([before, over]));
        let count = single.iter().filter(|is_changed| **is_changed).count();
        let other = single.iter().zip(&over).filter(|(a, b)| a != b).count();
        assert!(count > 1000 && other < count / 20, "{other} of {count} pixels of lines are others");
    }

    fn all_textures_of_a_picture_at_rest_are_in_the_sum_that_says_how_large_it_may_be(gpu) {
        let mut scene = still_life().three_quarter(Theme::Light);
        for overlay in Overlay::ALL {
            scene.options.overlays.set(overlay, true);
        }
        for light in Light::ALL {
            scene.options.light = light;
            let mut rest = Rest::new(gpu, &scene, SIZE);
            for _ in 0..2 {
                rest.renderer.accumulate(&scene.frame(), &mut rest.target, &mut rest.mean);
            }
            rest.renderer.render_over_mean(&scene.frame(), &mut rest.target);
            let mut textures = rest.target.textures();
            textures.extend(rest.mean.textures());
            // Ambient occlusion is drawn with a depth of the target.
            let of_view = rest.renderer.view_textures().into_iter();
            let others: Vec<_> = of_view.filter(|texture| !textures.contains(texture)).collect();
            textures.extend(others);
            let bytes = |texture: &&wgpu::Texture| {
                let texel = texture.format().block_copy_size(None).expect("whole texels");
                u64::from(texture.width() * texture.height() * texture.sample_count() * texel)
            };
            let (sum, pixels) = (textures.iter().map(bytes).sum::<u64>(), u64::from(SIZE[0] * SIZE[1]));
            // One of a single texel may stand for what is not there.
            assert!((0..8).contains(&sum.wrapping_sub(pixels * bytes_at_rest())), "{light:?}: {sum} of {textures:?}");
        }
    }

    /// Three balls in a row that goes away from the viewer.
    fn what_is_not_in_focus_is_blurred(gpu) {
        let mut model = plates(&[floor(6.0)]);
        for ball in [-3.0f32, 0.0, 3.0] {
            add_ball(&mut model.mesh, Vec3::new(ball, 0.5, ball), 0.5);
        }
        model.materials = vec![unlit([20; 3]), unlit([240; 3]), unlit([240; 3]), unlit([240; 3])];
        let mut scene = Scene::of(model);
        scene.camera.target = Vec3::new(0.0, 0.5, 0.0);
        scene.camera.distance = 10.0;
        scene.camera.pitch_radians = 0.25;
        let sharp = mean(gpu, &scene, &[], SIZE, 64);
        scene.options.aperture = 0.15;
        // Pixels that are neither the ball's colour nor the floor's.
        let soft_pixels = |picture: &Picture, columns: std::ops::Range<u32>| {
            let pixels = columns.flat_map(|x| (0..SIZE[1]).map(move |y| [x, y]));
            pixels.filter(|&at| (110..200).contains(&picture.at(at)[1])).count()
        };
        let thirds = [0..53, 53..106, 106..160];
        let of = |picture: &Picture| thirds.clone().map(|columns| soft_pixels(picture, columns));
        let [near, middle, far] = of(&sharp);
        let [soft_near, same_middle, soft_far] = of(&mean(gpu, &scene, &[], SIZE, 64));
        assert!(soft_near > 2 * near && soft_far > 2 * far, "{soft_near} {soft_far} for {near} {far}");
        assert!(same_middle < middle * 3 / 2, "{same_middle} for {middle}");
        scene.options.focus = Some(Vec3::new(-3.0, 0.5, -3.0));
        let [same_near, soft_middle, _] = of(&mean(gpu, &scene, &[], SIZE, 64));
        assert!(same_near < near * 3 / 2 && soft_middle > 3 * middle / 2, "{same_near} {soft_middle}");
        // In parallel projection a lens has no place.
        scene.camera.projection = Projection::Orthographic;
        let through_lens = mean(gpu, &scene, &[], SIZE, 16);
        scene.options.aperture = 0.0;
        assert!(average(&differences(&through_lens, &mean(gpu, &scene, &[], SIZE, 16))) < 0.6);
    }
}
