//! What must hold for any picture, whatever the look.

use bindpose::anim::Palette;
use bindpose::model::AlphaMode;
use bindpose::render::{Compositor, Renderer, SampleCount, Target};
use bindpose::scene::{Background, Light, Overlays, Passes, Projection, Theme};
use glam::{Affine3A, Vec3};

use crate::gpu::{Gpu, Picture, difference, drawn};
use crate::scenes::{FRONT, Facing, Scene, bent_tube, card, tube};

/// `backdrop, centre` of the dark theme.
const DARK_CENTER: [u8; 4] = [0x33, 0x38, 0x42, 255];
/// Dithering moves a channel to a neighbour, and rounding may take another.
const ROUNDING: u8 = 2;

const MIRROR_Z: Affine3A = Affine3A::from_cols(glam::Vec3A::X, glam::Vec3A::Y, glam::Vec3A::NEG_Z, glam::Vec3A::ZERO);
const MIRROR_X: Affine3A = Affine3A::from_cols(glam::Vec3A::NEG_X, glam::Vec3A::Y, glam::Vec3A::Z, glam::Vec3A::ZERO);

fn is_red([red, _, blue, _]: [u8; 4]) -> bool {
    red > 80 && red > 2 * blue
}

fn is_blue([red, _, blue, _]: [u8; 4]) -> bool {
    blue > 80 && blue > 2 * red
}

/// Colours left and right of the middle.
fn halves(picture: &Picture) -> ([u8; 4], [u8; 4]) {
    let (x, y) = (picture.width / 2, picture.height / 2);
    (picture.pixel(x - 8, y), picture.pixel(x + 8, y))
}

on_both_backends! {
    fn the_same_frame_gives_the_same_bytes(gpu) {
        let scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
        let mut renderer = gpu.renderer();
        renderer.set_model(&scene.model).expect("small");
        let mut target = gpu.target(160, 100);
        renderer.render(&scene.frame(), &mut target);
        let first = gpu.read(&target);
        renderer.render(&scene.frame(), &mut target);
        assert_eq!(first, gpu.read(&target));
    }

    fn right_of_the_picture_is_plus_x_from_the_front(gpu) {
        let (left, right) = halves(&gpu.draw(&Scene::of(card(FRONT)), 160, 100));
        assert!(is_blue(left) && is_red(right), "{left:?} {right:?}");
        let mirrored = Scene::of(card(FRONT)).in_world(MIRROR_X);
        let (left, right) = halves(&gpu.draw(&mirrored, 160, 100));
        assert!(is_red(left) && is_blue(right), "{left:?} {right:?}");
    }

    /// A right-handed file is the mirror image of a left-handed one; mirrored back it looks the same, light included.
    fn a_mirrored_file_looks_as_its_twin(gpu) {
        let left_handed = gpu.draw(&Scene::of(card(FRONT)), 160, 100);
        let facing = Facing { normal_z: 1.0, clockwise: true };
        let right_handed = gpu.draw(&Scene::of(card(facing)).in_world(MIRROR_Z), 160, 100);
        assert_eq!(left_handed.share_that_differs(&right_handed, 1), 0.0);
    }

    /// Normals decide which side is lit: triangles wound the wrong way change nothing.
    fn wrongly_wound_triangles_are_drawn_and_lit_alike(gpu) {
        let right = gpu.draw(&Scene::of(card(FRONT)), 160, 100);
        let wrong = gpu.draw(&Scene::of(card(Facing { clockwise: false, ..FRONT })), 160, 100);
        assert_eq!(right.share_that_differs(&wrong, 1), 0.0);
    }

    /// Seen from behind, a card with alpha clip is lit as one that faces that way.
    fn both_sides_of_a_clipped_material_are_lit(gpu) {
        let from_behind = |facing| {
            let mut scene = Scene::of(card(facing));
            scene.camera.yaw_radians = std::f32::consts::PI;
            for material in &mut scene.model.materials {
                material.alpha = AlphaMode::clipped(true);
            }
            gpu.draw(&scene, 160, 100)
        };
        let back = from_behind(FRONT);
        let (left, right) = halves(&back);
        assert!(is_red(left) && is_blue(right), "{left:?} {right:?}");
        let front_of_turned = from_behind(Facing { normal_z: 1.0, clockwise: false });
        assert!(back.share_that_differs(&front_of_turned, 2) < 0.01);
    }

    fn the_lightest_row_of_the_backdrop_has_the_colour_of_the_theme(gpu) {
        let mut scene = Scene::of(bindpose::model::Model::default());
        let dark = gpu.draw(&scene, 200, 200);
        // ndc y = 0.06
        assert!(difference(dark.pixel(100, 94), DARK_CENTER) <= ROUNDING, "{:?}", dark.pixel(100, 94));
        let top = dark.pixel(100, 0);
        assert!(top[0] < DARK_CENTER[0] - 8, "{top:?}");
        scene.options.theme = Theme::Light;
        let light = gpu.draw(&scene, 200, 200);
        assert!(difference(light.pixel(100, 94), [0xEB, 0xED, 0xF0, 255]) <= ROUNDING);
    }

    fn nothing_is_behind_a_transparent_picture(gpu) {
        let mut scene = Scene::of(card(FRONT)).three_quarter(Theme::Light);
        scene.options.background = Background::None;
        scene.options.passes = Passes::none();
        let picture = gpu.draw(&scene, 160, 100);
        for (x, y) in [(0, 0), (159, 0), (0, 99), (159, 99)] {
            assert_eq!(picture.pixel(x, y), [0, 0, 0, 0]);
        }
        assert_eq!(picture.middle()[3], 255);

        // Straight alpha: where the edge covers a part of a pixel, the colour is still the card's, not mixed with black.
        let edges: Vec<&[u8]> = picture.rgba.chunks_exact(4).filter(|pixel| (1..=254).contains(&pixel[3])).collect();
        assert!(edges.len() > 20, "the card's edge is antialiased");
        for pixel in edges {
            assert!(pixel[0] > 60 || pixel[2] > 60, "{pixel:?}");
        }
    }

    fn a_resized_target_draws_as_a_new_one(gpu) {
        let scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
        let mut renderer = gpu.renderer();
        renderer.set_model(&scene.model).expect("small");
        let mut target = gpu.target(64, 48);
        for (width, height) in [(101, 37), (1, 1), (64, 200)] {
            target.resize(&gpu.open.device, [width, height], [width, height]);
            assert_eq!(target.size(), [width, height]);
            renderer.render(&scene.frame(), &mut target);
            assert_eq!(gpu.read(&target), gpu.draw(&scene, width, height));
        }
        target.resize(&gpu.open.device, [0, 0], [0, 0]);
        assert_eq!(target.size(), [1, 1]);
    }

    /// While a picture moves it may be smaller than at rest.
    fn a_picture_in_a_corner_of_its_textures_is_the_same_as_in_textures_of_its_own(gpu) {
        for light in Light::ALL {
            let mut scene = bent_tube(0.5).three_quarter(Theme::Dark);
            (scene.options.light, scene.options.split) = (light, Some(0.5));
            let mut easel = gpu.renderer();
            easel.set_model(&scene.model).expect("small");
            let mut target = gpu.target(1, 1);
            for size in [[64, 48], [150, 100], [33, 70]] {
                target.resize(&gpu.open.device, size, [150, 100]);
                easel.render(&scene.frame(), &mut target);
                let alone = gpu.draw(&scene, size[0], size[1]);
                assert_eq!(target.size(), size);
                assert_eq!(gpu.read(&target).share_that_differs(&alone, 0), 0.0, "{light:?} {size:?}");
            }
        }
    }

    /// Textures of ambient occlusion have as much room as the target, and are made anew when it is, or when a window became much smaller.
    fn a_picture_that_changes_its_size_keeps_its_textures(gpu) {
        let scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
        let device = &gpu.open.device;
        let mut renderer = gpu.renderer();
        renderer.set_model(&scene.model).expect("small");
        let mut textures = |target: &mut Target, size: [u32; 2], largest| {
            target.resize(device, size, largest);
            renderer.render(&scene.frame(), target);
            renderer.view_textures().into_iter().cloned().collect::<Vec<_>>()
        };
        let (mut target, mut plain) = (gpu.target(1, 1), Target::with_samples(device, 1, 1, SampleCount::One));
        let first = textures(&mut target, [200, 100], [200, 100]);
        assert_eq!(first.len(), 4, "normals, depth, occlusion, and half blurred");
        for width in (201..256).step_by(9) {
            assert_eq!(textures(&mut target, [width, 100], [width, 100]), first, "{width} wide");
        }
        // A picture that moves, with fewer and fewer pixels.
        for scale in [0.85, 0.7, 0.6, 0.5] {
            let size = [256.0, 100.0].map(|side: f32| (side * scale) as u32);
            assert_eq!(textures(&mut plain, size, size), first, "at {scale}");
            assert_eq!(textures(&mut target, size, [256, 100]), first, "at {scale}, with smooth edges");
        }
        let wide = textures(&mut target, [257, 100], [257, 100]);
        assert!(wide != first && wide.iter().all(|texture| texture.width() == 192), "{wide:?}");
        let large = textures(&mut target, [1000, 500], [1000, 500]);
        let small = textures(&mut target, [100, 50], [100, 50]);
        assert!(small[0].width() < large[0].width(), "{small:?}");
        assert_eq!(gpu.read(&target), gpu.draw(&scene, 100, 50));
    }

    /// Where a device has no multisampling: the same picture but for edges.
    fn one_sample_a_pixel_is_enough_for_a_picture(gpu) {
        let scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
        let device = &gpu.open.device;
        let mut renderer = Renderer::with_samples(device, &gpu.open.queue, SampleCount::One);
        renderer.set_model(&scene.model).expect("small");
        let mut target = Target::with_samples(device, 160, 100, SampleCount::One);
        renderer.render(&scene.frame(), &mut target);
        let differs = gpu.read(&target).share_that_differs(&gpu.draw(&scene, 160, 100), 4);
        assert!(differs < 0.03, "{differs}");
    }

    /// A slow device has a target with fewer samples for a picture that moves.
    fn one_renderer_draws_into_targets_with_one_sample_and_with_more(gpu) {
        let scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
        let (device, queue) = (&gpu.open.device, &gpu.open.queue);
        let mut alone = Renderer::with_samples(device, queue, SampleCount::One);
        let mut both = gpu.renderer();
        let mut targets = [SampleCount::One, gpu.open.samples].map(|samples| Target::with_samples(device, 160, 100, samples));
        let pictures = targets.each_mut().map(|target| {
            both.set_model(&scene.model).expect("small");
            both.render(&scene.frame(), target);
            gpu.read(target)
        });
        alone.set_model(&scene.model).expect("small");
        alone.render(&scene.frame(), &mut targets[0]);
        assert_eq!(pictures, [gpu.read(&targets[0]), gpu.draw(&scene, 160, 100)]);
        assert!(pictures[0] != pictures[1], "edges differ");
    }

    fn a_cleared_model_is_gone(gpu) {
        let scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
        let mut renderer = gpu.renderer();
        let mut target = gpu.target(160, 100);
        renderer.render(&scene.frame(), &mut target);
        let empty = gpu.read(&target);
        renderer.set_model(&scene.model).expect("small");
        renderer.render(&scene.frame(), &mut target);
        assert!(gpu.read(&target).share_that_differs(&empty, 8) > 0.05);
        renderer.clear_model();
        renderer.render(&scene.frame(), &mut target);
        assert_eq!(gpu.read(&target), empty);
    }

    fn the_model_darkens_the_ground_behind_it(gpu) {
        let mut scene = bent_tube(0.6).three_quarter(Theme::Light);
        let greens = |scene: &Scene| -> Vec<u8> {
            let picture = gpu.draw(scene, 320, 200);
            picture.rgba.chunks_exact(4).map(|pixel| pixel[1]).collect()
        };
        let with = greens(&scene);
        let passes = std::mem::replace(&mut scene.options.passes, Passes::none());
        let unshaded = greens(&scene);
        scene.model.mesh = Default::default();
        let nothing = greens(&scene);
        scene.options.passes = passes;
        let bare = greens(&scene);
        let is_ground = |at: &usize| unshaded[*at].abs_diff(nothing[*at]) <= 2;
        let darkened = (0..bare.len()).filter(is_ground).filter(|&at| with[at] < bare[at].saturating_sub(20));
        assert!(darkened.count() > 200, "the shadow shows beside the tube");
    }

    /// Grid, shadow, depth: all follow the size by powers of ten.
    fn a_model_of_any_size_looks_the_same(gpu) {
        for projection in [Projection::Perspective { fov_y_radians: 0.6 }, Projection::Orthographic] {
            let scene = |scale| {
                let mut scene = Scene::of(card(FRONT)).three_quarter(Theme::Light);
                scene.camera.projection = projection;
                gpu.draw(&scene.scaled(scale), 160, 100)
            };
            let one = scene(1.0);
            for scale in [0.01, 0.1, 1000.0, 10_000.0] {
                let differs = one.share_that_differs(&scene(scale), 6);
                assert!(differs < 0.005, "{scale}: {differs}");
            }
        }
    }

    /// Joints that do not move, no palette at all, and a mesh without joints: three ways to the same picture.
    fn bind_pose_looks_alike_with_and_without_joints(gpu) {
        let mut scene = Scene::of(tube()).three_quarter(Theme::Dark);
        let without_palette = gpu.draw(&scene, 160, 100);
        scene.palette = Palette(vec![Affine3A::IDENTITY; 2]);
        let unmoved = gpu.draw(&scene, 160, 100);
        scene.model.skeleton = Default::default();
        scene.model.mesh.influences.clear();
        let without_joints = gpu.draw(&scene, 160, 100);
        assert_eq!(without_palette, without_joints);
        assert!(unmoved.share_that_differs(&without_joints, 2) < 0.001);
    }

    fn a_palette_moves_the_model_and_its_shadow(gpu) {
        let straight = gpu.draw(&bent_tube(0.0).three_quarter(Theme::Light), 160, 100);
        let bent = gpu.draw(&bent_tube(0.9).three_quarter(Theme::Light), 160, 100);
        assert!(straight.share_that_differs(&bent, 10) > 0.05);
    }

    /// As the palette of a model with fewer joints would, while a larger one is coming.
    fn joints_that_the_palette_lacks_stay(gpu) {
        let mut scene = Scene::of(tube()).three_quarter(Theme::Dark);
        scene.palette = Palette(vec![Affine3A::IDENTITY; 2]);
        let whole = gpu.draw(&scene, 160, 100);
        scene.palette.0.truncate(1);
        assert_eq!(gpu.draw(&scene, 160, 100), whole);
    }

    fn models_without_triangles_draw_nothing(gpu) {
        let empty = bindpose::model::Model::default();
        let mut no_triangles = card(FRONT);
        no_triangles.mesh.submeshes[0].triangle_count = 0;
        no_triangles.mesh.submeshes.truncate(1);
        let mut scene = Scene::of(empty);
        let bare = gpu.draw(&scene, 64, 64);
        scene.model = no_triangles;
        assert_eq!(gpu.draw(&scene, 64, 64), bare);
    }

    /// From straight above and from below the ground: no horizon in view, rays that never meet it.
    fn steep_and_low_cameras_give_a_picture(gpu) {
        for pitch_radians in [std::f32::consts::FRAC_PI_2, -0.4, 0.0] {
            let mut scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
            scene.camera.pitch_radians = pitch_radians;
            scene.camera.target = Vec3::new(0.0, 0.5, 0.0);
            let picture = gpu.draw(&scene, 96, 64);
            // A NaN would be stored as black.
            let black = picture.rgba.chunks_exact(4).filter(|pixel| pixel[..3] == [0, 0, 0]).count();
            assert_eq!(black, 0, "pitch {pitch_radians}");
        }
    }

    fn the_compositor_shows_the_bytes_of_the_picture(gpu) {
        let scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
        let mut renderer = gpu.renderer();
        renderer.set_model(&scene.model).expect("small");
        let mut target = gpu.target(64, 40);
        renderer.render(&scene.frame(), &mut target);
        let surface = composite(gpu, &target);
        assert_eq!(surface.share_that_differs(&gpu.read(&target), 1), 0.0);
    }

    /// What lies beside the picture in its textures does not shine in: it is black.
    fn the_compositor_stretches_a_part_of_a_texture(gpu) {
        let mut scene = Scene::of(card(FRONT)).three_quarter(Theme::Dark);
        scene.options.background = Background::Color([200, 100, 50]);
        scene.options.overlays = Overlays::none();
        let mut renderer = gpu.renderer();
        let mut target = gpu.target(1, 1);
        target.resize(&gpu.open.device, [50, 40], [128, 128]);
        renderer.render(&scene.frame(), &mut target);
        let surface = composite(gpu, &target);
        assert_eq!([surface.width, surface.height], [128, 128]);
        for pixel in surface.rgba.chunks_exact(4) {
            assert!(pixel[0].abs_diff(200) <= 3 && pixel[2].abs_diff(50) <= 3 && pixel[3] == 255, "{pixel:?}");
        }
    }
}

#[test]
fn a_picture_of_4k_is_drawn_smaller_and_a_usual_one_is_not() {
    for (size, least, most) in [
        ([1920, 1080], 1.0, 1.0),
        ([2560, 1440], 1.0, 1.0),
        ([3840, 2160], 0.75, 0.9),
    ] {
        let scale = Target::affordable_scale(size, SampleCount::Four);
        assert!((least..=most).contains(&scale), "{size:?}: {scale}");
    }
}

#[test]
fn textures_are_kept_while_a_window_is_resized() {
    let gpu = crate::gpu::vulkan();
    let device = &gpu.open.device;
    let mut target = gpu.target(1, 1);
    let kept = (500..600)
        .filter(|&width| target.resize(device, [width, 300], [width, 300]))
        .count();
    assert_eq!(kept, 98, "new ones for 500 and for 513");
    assert!(
        target.resize(device, [400, 300], [400, 300]),
        "a little too large is no harm"
    );
    assert!(!target.resize(device, [100, 100], [100, 100]), "much too large is");
}

/// Composites onto a surface and reads that.
fn composite(gpu: &Gpu, target: &Target) -> Picture {
    let mut compositor = Compositor::new(&gpu.open.device, SURFACE_FORMAT);
    compositor.prepare(&gpu.open.device, &gpu.open.queue, target, None);
    on_surface(gpu, &compositor, [target.texture().width(), target.texture().height()])
}

/// As egui's, which is not sRGB.
pub(crate) const SURFACE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// What a compositor brings onto a surface of this size.
pub(crate) fn on_surface(gpu: &Gpu, compositor: &Compositor, [width, height]: [u32; 2]) -> Picture {
    let rgba = drawn(gpu, SURFACE_FORMAT, [width, height], |pass| {
        // As egui hands it to a paint callback.
        let mut pass: wgpu::RenderPass<'static> = pass.forget_lifetime();
        compositor.paint(&mut pass);
    });
    Picture { width, height, rgba }
}
