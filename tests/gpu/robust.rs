//! Models and pictures at the ends of what there is give no error on any device.

use bindpose::anim::Palette;
use bindpose::model::Model;
use bindpose::render::ProbeError;
use bindpose::render::device;
use bindpose::scene::{Aabb, Background, Light, Overlay, Overlays, Passes, Theme, ViewMode};
use glam::{Affine3A, Vec3};

use crate::gpu::Gpu;
use crate::scenes::{FRONT, Scene, bent_tube, card, tube};
use crate::textures::cube;

/// Runs `work` and fails with what the device has to say about it.
fn without_errors<T>(gpu: &Gpu, what: &str, work: impl FnOnce() -> T) -> T {
    let device = &gpu.open.device;
    let scopes = [
        wgpu::ErrorFilter::Validation,
        wgpu::ErrorFilter::OutOfMemory,
        wgpu::ErrorFilter::Internal,
    ]
    .map(|filter| device.push_error_scope(filter));
    let done = work();
    for scope in scopes.into_iter().rev() {
        if let Some(error) = pollster::block_on(scope.pop()) {
            panic!("{what}: {error}");
        }
    }
    done
}

/// Everything at once that can be drawn over a scene.
fn with_all_lines(mut scene: Scene) -> Scene {
    for overlay in Overlay::ALL {
        scene.options.overlays.set(overlay, true);
    }
    scene.highlighted = Some(0);
    scene
}

/// Draws under both lights and split, in a property, and on nothing.
fn draw_every_way(gpu: &Gpu, what: &str, scene: Scene, size: [u32; 2]) {
    let mut scene = with_all_lines(scene);
    without_errors(gpu, what, || {
        let mut easel = gpu.easel(&scene, &[], size);
        for light in Light::ALL {
            scene.options.light = light;
            easel.draw(&scene);
        }
        scene.options.split = Some(0.5);
        easel.draw(&scene);
        scene.options.background = Background::None;
        for mode in ViewMode::ALL {
            scene.options.view_mode = mode;
            easel.draw(&scene);
        }
    });
}

/// Changes bones, of which the last has this index.
type Wrong = (&'static str, fn(&mut [Affine3A], usize));

/// Tries the device with bones that were changed.
fn probe_with(gpu: &Gpu, change: impl FnOnce(&mut Palette)) -> Result<(), ProbeError> {
    let mut bones = device::probe_bones();
    change(&mut bones);
    pollster::block_on(device::probe(&gpu.open.device, &gpu.open.queue, &bones, async || {}))
}

on_both_backends! {
    fn the_probe_notices_wrong_bones_and_wrong_depths(gpu) {
        assert_eq!(probe_with(gpu, |_| {}), Ok(()));
        let wrong: [Wrong; 5] = [
            ("no bones at all", |bones, _| bones.fill(Affine3A::ZERO)),
            ("the first row for the second", |bones, last| bones[last] = bones[0]),
            ("the second row for the first", |bones, last| bones[0] = bones[last]),
            ("rows exchanged, the farther one drawn first", |bones, last| bones.swap(0, last)),
            // What a device without a depth test draws.
            ("the second one over the first", |bones, last| bones[last].translation.z = 0.1),
        ];
        for (what, change) in wrong {
            let found = probe_with(gpu, |bones| change(&mut bones.0, device::probe_bones().0.len() - 1));
            assert!(matches!(found, Err(ProbeError::WrongPicture { .. })), "{what}: {found:?}");
        }
    }

    /// A wait in one thread may take up what another waits for.
    fn threads_read_from_one_device_at_once(gpu) {
        let scene = bent_tube(0.6);
        let mut renderer = gpu.renderer();
        renderer.set_model(&scene.model).expect("small");
        let mut target = gpu.target(8, 8);
        renderer.render(&scene.frame(), &mut target);
        let picture = gpu.read(&target);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| (0..500).for_each(|_| assert_eq!(gpu.read(&target), picture)));
            }
        });
    }

    fn small_and_odd_pictures(gpu) {
        for size in [[1, 1], [3, 5], [2, 1], [1, 7]] {
            draw_every_way(gpu, &format!("{size:?}"), bent_tube(0.5).three_quarter(Theme::Dark), size);
        }
        let mut scene = with_all_lines(bent_tube(0.5).three_quarter(Theme::Dark));
        scene.options.split = Some(0.3);
        let picture = without_errors(gpu, "641x359", || gpu.draw(&scene, 641, 359));
        assert_eq!(picture.middle()[3], 255);
    }

    fn models_that_lack_something(gpu) {
        let mut no_materials = card(FRONT);
        no_materials.materials.clear();
        let mut no_streams = card(FRONT);
        no_streams.mesh.normals.clear();
        no_streams.mesh.tangents.clear();
        no_streams.mesh.tex_coords.clear();
        let mut no_submeshes = card(FRONT);
        no_submeshes.mesh.submeshes.clear();
        let mut no_triangles = card(FRONT);
        no_triangles.mesh.indices.clear();
        no_triangles.mesh.submeshes.clear();
        let mut joints_alone = Model { skeleton: tube().skeleton, ..Model::default() };
        joints_alone.materials = card(FRONT).materials;
        for (what, model) in [
            ("nothing", Model::default()),
            ("no materials", no_materials),
            ("no streams", no_streams),
            ("no submeshes", no_submeshes),
            ("no triangles", no_triangles),
            ("joints alone", joints_alone),
        ] {
            let mut scene = Scene::of(model);
            scene.palette = Palette(vec![Affine3A::IDENTITY; 2]);
            draw_every_way(gpu, what, scene, [24, 16]);
        }
    }

    fn bounds_that_are_no_box(gpu) {
        let boxes = [
            Aabb::EMPTY,
            Aabb { min: Vec3::NAN, max: Vec3::NAN },
            Aabb { min: Vec3::ZERO, max: Vec3::ZERO },
            Aabb { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY },
            Aabb { min: Vec3::splat(-1e30), max: Vec3::splat(1e30) },
            Aabb { min: Vec3::splat(-1e-30), max: Vec3::splat(1e-30) },
            Aabb { min: Vec3::new(0.0, f32::NAN, 0.0), max: Vec3::ONE },
        ];
        for world_bounds in boxes {
            let mut scene = bent_tube(0.3);
            scene.world_bounds = world_bounds;
            draw_every_way(gpu, &format!("{world_bounds:?}"), scene, [24, 16]);
        }
    }

    fn numbers_that_are_none(gpu) {
        let mut scene = bent_tube(0.3);
        scene.palette.0[1] = Affine3A::from_translation(Vec3::NAN);
        scene.model.mesh.positions[3] = Vec3::INFINITY;
        scene.model.mesh.normals[5] = Vec3::NAN;
        scene.options.exposure_stops = f32::INFINITY;
        scene.options.environment_turn_radians = f32::NAN;
        scene.options.book_lights_turn_radians = f32::NAN;
        scene.options.split = Some(f32::NAN);
        draw_every_way(gpu, "not a number", scene, [24, 16]);
    }

    /// One renderer, one after another: what the one leaves behind is none of the next one's business.
    fn a_renderer_takes_models_maps_and_skies_in_any_order(gpu) {
        let scenes = [bent_tube(0.4), Scene::of(Model::default()), Scene::of(card(FRONT))];
        without_errors(gpu, "in any order", || {
            let mut renderer = gpu.renderer();
            let mut target = gpu.target(40, 30);
            for (index, scene) in scenes.iter().chain(&scenes).enumerate() {
                renderer.set_model(&scene.model).expect("small");
                let mut frame = scene.frame();
                frame.options.light = Light::ALL[index % 2];
                frame.options.passes = if index % 3 == 0 { Passes::none() } else { Passes::all() };
                frame.options.overlays = Overlays::none();
                renderer.set_sky((index % 2 == 1).then(|| cube(4, [[index as u8 * 30; 3]; 6])).as_ref());
                renderer.render(&frame, &mut target);
                renderer.set_materials(&[]);
                let size = [40 + index as u32, 30];
                target.resize(&gpu.open.device, size, size);
                renderer.render(&frame, &mut target);
            }
            // The last again, by itself.
            let last = gpu.read(&target);
            let mut fresh = gpu.easel(&scenes[2], &[], [45, 30]);
            fresh.renderer.set_sky(Some(&cube(4, [[150; 3]; 6])));
            let mut scene = Scene::of(card(FRONT));
            scene.options.light = Light::ALL[1];
            assert_eq!(fresh.draw(&scene), last);
        });
    }
}
