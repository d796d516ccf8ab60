//! What the GPU tells of the time that passes take, where it tells any.

use std::time::Instant;

use bindpose::render::device::Backend;
use bindpose::render::{Accumulator, MaterialImages, SampleCount, Target};
use bindpose::scene::{FrameCost, Light, Pass, Passes, Theme, TimedPass};

use crate::gpu::{Gpu, gl, vulkan, without_blocks};
use crate::scenes::{Scene, bent, bent_tube};

const NO_MAPS: &[MaterialImages<'_>] = &[];
const SIZE: [u32; 2] = [320, 240];
/// More than the frames whose times may be under way.
const FRAMES: u32 = 8;

/// Draws some frames, each in another pose, one at a time. Returns what the last was told, and the longest that one took, seconds.
fn last_cost(gpu: &Gpu, scene: &mut Scene) -> (FrameCost, f32) {
    let mut easel = gpu.easel(scene, NO_MAPS, SIZE);
    let mut target = gpu.target(SIZE[0], SIZE[1]);
    let mut longest_secs = 0.0_f32;
    let mut cost = FrameCost::default();
    for frame in 0..FRAMES {
        scene.palette = bent(0.1 * frame as f32);
        let start = Instant::now();
        cost = easel.renderer.render(&scene.frame(), &mut target);
        let done = gpu.open.device.poll(wgpu::PollType::wait_indefinitely());
        done.expect("the device is there");
        longest_secs = longest_secs.max(start.elapsed().as_secs_f32());
    }
    (cost, longest_secs)
}

fn scene() -> Scene {
    let mut scene = bent_tube(0.0).three_quarter(Theme::Dark);
    scene.options.passes = Passes::all();
    scene
}

#[test]
fn each_pass_that_is_drawn_takes_time_and_all_together_no_more_than_the_frame() {
    let mut scene = scene();
    for split in [None, Some(0.5)] {
        scene.options.split = split;
        let (cost, frame_secs) = last_cost(vulkan(), &mut scene);
        let secs = cost.gpu_secs.expect("Mesa's Vulkan tells times");
        assert!(secs.iter().all(|&secs| secs > 0.0), "{secs:?}");
        assert!(secs.iter().sum::<f32>() <= frame_secs, "{secs:?} in {frame_secs}");
    }
}

#[test]
fn a_pass_that_is_not_drawn_takes_none() {
    let mut scene = scene();
    scene.options.light = Light::Book;
    scene.options.passes = Passes::all().with(Pass::AmbientOcclusion, false);
    let secs = last_cost(vulkan(), &mut scene).0.gpu_secs.expect("times");
    for (pass, secs) in TimedPass::ALL.into_iter().zip(secs) {
        let is_drawn = matches!(pass, TimedPass::ShadowMap | TimedPass::Picture);
        assert_eq!(secs > 0.0, is_drawn, "{pass:?}: {secs}");
    }
}

#[test]
fn the_first_frames_wait_for_no_answer() {
    let scene = scene();
    let gpu = vulkan();
    let mut easel = gpu.easel(&scene, NO_MAPS, SIZE);
    let mut target = gpu.target(SIZE[0], SIZE[1]);
    let cost = easel.renderer.render(&scene.frame(), &mut target);
    assert_eq!(cost.gpu_secs, None);
    // Many more than may be under way.
    for _ in 0..20 {
        easel.renderer.render(&scene.frame(), &mut target);
    }
    gpu.read(&target);
}

/// The samples of a picture at rest, by which their second is counted.
#[test]
fn the_samples_of_a_mean_take_time_where_the_device_tells_it() {
    let scene = scene();
    for gpu in [vulkan(), gl()] {
        let mut renderer = gpu.renderer();
        renderer.set_model(&scene.model).expect("small");
        let mut target = Target::with_samples(&gpu.open.device, SIZE[0], SIZE[1], SampleCount::One);
        let mut mean = Accumulator::new(&gpu.open.device, &target);
        let start = Instant::now();
        let mut before = 0.0;
        for sample in 0..FRAMES {
            renderer.accumulate(&scene.frame(), &mut target, &mut mean);
            let done = gpu.open.device.poll(wgpu::PollType::wait_indefinitely());
            done.expect("the device is there");
            let secs = mean.gpu_secs();
            match gpu.backend {
                Backend::Vulkan if sample > 1 => assert!(secs.is_some_and(|secs| secs > before), "{sample}: {secs:?}"),
                Backend::Vulkan => {}
                Backend::Gl => assert_eq!(secs, None),
            }
            before = secs.unwrap_or(0.0);
        }
        // The times of the one before stand for the last.
        assert!(f64::from(before) <= 2.0 * start.elapsed().as_secs_f64(), "{before} s");
        mean.restart();
        assert_eq!(mean.gpu_secs(), None);
    }
}

#[test]
fn a_device_that_tells_no_times_draws_the_same() {
    let mut scene = scene();
    for (gpu, backend) in [(vulkan(), Backend::Vulkan), (gl(), Backend::Gl)] {
        let untimed = without_blocks(backend);
        assert_eq!(last_cost(&untimed, &mut scene).0.gpu_secs, None);
        assert!(gpu.draw(&scene, SIZE[0], SIZE[1]) == untimed.draw(&scene, SIZE[0], SIZE[1]));
    }
    assert_eq!(last_cost(gl(), &mut scene).0.gpu_secs, None, "GL would wait for them");
}
