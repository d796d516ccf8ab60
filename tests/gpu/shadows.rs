//! How soft the edges of the first light's shadows are.

use bindpose::render::{Renderer, RendererOptions};
use bindpose::scene::{Light, Projection, ViewMode};
use glam::Vec3;

use crate::gpu::{Gpu, Picture};
use crate::scenes::Scene;
use crate::sets::{Plate, floor, plates};

const SIZE: [u32; 2] = [160, 120];
const HEIGHT: f32 = 2.0;

/// The shadow's edge that is looked at, on the floor: it runs along z.
const EDGE: Vec3 = Vec3::new(0.5, 0.0, 0.2);
/// The book's first light falls aslant: of a width on the floor across that edge, this much is width across the light. It is the
/// light's y over the length of z as the light sees it, (1/√3) / √(2/3).
const ACROSS: f32 = std::f32::consts::FRAC_1_SQRT_2;
/// What the picture shows of the floor, as long as a scene is not scaled.
const VIEW_HEIGHT: f32 = 0.12 * HEIGHT;

/// A floor, a mast that gives the model its height, and a plate close above the floor. The edge of the plate's shadow from straight
/// above, in parallel.
fn scene(floor_half_size: f32, scale: f32) -> Scene {
    let mast = Plate {
        corner: Vec3::new(1.0, 0.0, 1.0),
        along_u: Vec3::X * 0.1,
        along_v: Vec3::Y * HEIGHT,
        normal: Vec3::NEG_Z,
    };
    // The light goes on by as much along x and z as it goes down.
    let above = 0.6;
    let lid = Plate {
        corner: Vec3::new(EDGE.x - above - 0.6, above, EDGE.z - above - 0.3),
        along_u: Vec3::X * 0.6,
        along_v: Vec3::Z * 0.6,
        normal: Vec3::Y,
    };
    let mut scene = Scene::of(plates(&[floor(floor_half_size), mast, lid])).scaled(scale);
    scene.options.light = Light::Book;
    scene.options.view_mode = ViewMode::Shadow;
    let camera = &mut scene.camera;
    camera.pitch_radians = std::f32::consts::FRAC_PI_2 - 1e-3;
    camera.projection = Projection::Orthographic;
    camera.target = EDGE * scale;
    camera.distance *= VIEW_HEIGHT * scale / camera.height_in_view();
    scene
}

/// Where the middle row first reaches a level of light, pixels.
fn crossing(picture: &Picture, level: f32) -> f32 {
    let at = |x: u32| f32::from(picture.pixel(x, SIZE[1] / 2)[0]) / 255.0;
    let x = (1..SIZE[0]).find(|&x| at(x) >= level).expect("the edge ends in light");
    let [before, here] = [at(x - 1), at(x)];
    assert!(before < level, "the edge begins in shadow");
    (x - 1) as f32 + (level - before) / (here - before)
}

/// Across the light, in heights of the model.
fn edge_width(gpu: &Gpu, scene: &Scene) -> f32 {
    let picture = gpu.draw(scene, SIZE[0], SIZE[1]);
    let pixels = crossing(&picture, 0.9) - crossing(&picture, 0.1);
    pixels * VIEW_HEIGHT / SIZE[1] as f32 * ACROSS / HEIGHT
}

on_both_backends! {
    fn a_smaller_map_shows_the_same_shadow_softer(gpu) {
        let scene = scene(1.2, 1.0);
        let with_side = |shadow_map_side| {
            let options = RendererOptions { samples: gpu.open.samples, shadow_map_side };
            let mut renderer = Renderer::new(&gpu.open.device, &gpu.open.queue, options);
            renderer.set_model(&scene.model).expect("small");
            let mut target = gpu.target(SIZE[0], SIZE[1]);
            renderer.render(&scene.frame(), &mut target);
            gpu.read(&target)
        };
        let [full, small] = [2048, 1024].map(with_side);
        assert!(full == gpu.draw(&scene, SIZE[0], SIZE[1]), "2048 unless said otherwise");
        assert!(full != small);
        // Its texels are twice as large: the edge moves by less than one.
        let moved = (crossing(&full, 0.5) - crossing(&small, 0.5)).abs();
        assert!(moved < 4.0, "{moved} pixels");
    }

    /// From 10 to 90 %: 2.4 texels of the demo's map, 2 · 18.03 / 2048 units each, of a figure 3.6 units tall. The taps lie evenly
    /// over a disc only on average, so a tenth more or less is allowed.
    fn the_books_edges_are_as_wide_as_the_demos_whatever_the_scene(gpu) {
        let demo = 2.4 * (2.0 * 18.03 / 2048.0) / 3.6;
        for (floor_half_size, scale) in [(1.2, 1.0), (1.7, 1.0), (1.2, 40.0), (1.2, 0.01)] {
            let found = edge_width(gpu, &scene(floor_half_size, scale));
            assert!((found / demo - 1.0).abs() < 0.1, "{found} for {demo}, floor {floor_half_size}, scale {scale}");
        }
    }
}
