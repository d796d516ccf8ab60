//! Pictures by themselves: all of it, or an error in words.

use bindpose::render::{PictureTarget, Renderer};
use bindpose::scene::{Background, FrameOptions, Light, Overlay, Theme};
use glam::Vec3;

use crate::gpu::{Gpu, Picture};
use crate::scenes::{FRONT, Scene, bent_tube, card};
use crate::still_life::{StillLifeMaps, still_life};

fn refusal(gpu: &Gpu, size: [u32; 2]) -> String {
    let scene = Scene::of(card(FRONT));
    let refused = gpu.renderer().picture(&scene.frame(), size).err();
    refused.map_or_else(String::new, |error| error.to_string())
}

/// The still life on its grid, in shadow and in ambient occlusion.
fn still_life_on_grid(light: Light) -> Scene {
    let mut scene = still_life().three_quarter(Theme::Light);
    scene.options.light = light;
    scene.options.overlays.line_length = 0.1;
    scene
}

on_both_backends! {
    /// All pixels, but for the last step of their rounding, and for three in which an edge falls on a sample, whose place rounding decides.
    /// Where a line crosses a border of the 64 × 64 tiles in which Mesa draws with the CPU, it may lack a pixel or have one more: with lines,
    /// bands begin where tiles do, as those of the command line.
    fn a_picture_in_bands_is_the_whole_one(gpu) {
        let ([width, height], maps) = ([640, 480], StillLifeMaps::new());
        let (plain, lines): (fn(&mut FrameOptions), _) = (|_| (), |options: &mut FrameOptions| {
            for overlay in [Overlay::Bounds, Overlay::Axes, Overlay::Normals] {
                options.overlays.set(overlay, true);
            }
        });
        let divided: fn(&mut FrameOptions) = |options| options.split = Some(0.4);
        let before_sky: fn(&mut FrameOptions) = |options| options.background = Background::Sky;
        let through_lens: fn(&mut FrameOptions) = |options| options.aperture = 0.1;
        for (light, samples, rows, looks) in [
            (Light::Studio, 1, 100, plain),
            (Light::Studio, 5, 100, plain),
            (Light::Book, 1, 100, plain),
            (Light::Book, 2, 100, plain),
            (Light::Studio, 1, 100, divided),
            (Light::Studio, 3, 100, divided),
            (Light::Studio, 1, 100, before_sky),
            (Light::Studio, 3, 100, through_lens),
            (Light::Studio, 1, 128, lines),
            (Light::Studio, 3, 128, lines),
        ] {
            let mut scene = still_life_on_grid(light);
            looks(&mut scene.options);
            if scene.options.overlays.has(Overlay::Bounds) {
                let bones = &mut scene.seen_through;
                bones.line(Vec3::new(-1.9, 0.1, 0.0), Vec3::new(1.8, 1.3, 0.4), [255, 200, 40, 255]);
                bones.line(Vec3::new(0.0, 0.0, -1.8), Vec3::new(0.3, 1.6, 1.8), [40, 200, 255, 160]);
            }
            let mut renderer = gpu.renderer();
            renderer.set_model(&scene.model).expect("small");
            renderer.set_maps(&maps.images());
            let mut pixels = |target: &mut PictureTarget| {
                let picture = renderer.picture_into(&scene.frame(), target).expect("small");
                picture.pixels_blocking().expect("small")
            };
            let target = || PictureTarget::new([width, height]).with_mean_of(samples);
            let whole = pixels(&mut target());
            let (mut band, mut banded) = (target(), Vec::new());
            for top in (0..height).step_by(rows) {
                band.show(top..(top + rows as u32).min(height));
                banded.extend(pixels(&mut band));
            }
            let [whole, banded] = [whole, banded].map(|rgba| Picture { width, height, rgba });
            let [most, any] = [1, 0].map(|most| whole.share_that_differs(&banded, most));
            assert!(most < 1e-5 && any < 0.002, "{light:?}, {samples} samples, {:?}: {most} by more than 1, {any} by any", scene.options);
        }
    }

    fn a_picture_by_itself_is_what_a_target_shows(gpu) {
        let mut scene = bent_tube(0.5);
        for background in [Background::Backdrop, Background::None] {
            scene.options.background = background;
            let mut renderer = gpu.renderer();
            renderer.set_model(&scene.model).expect("small");
            let picture = renderer.picture(&scene.frame(), [123, 45]).expect("a small picture");
            assert_eq!(picture.pixels_blocking().expect("drawn"), gpu.draw(&scene, 123, 45).rgba);
        }
    }

    /// While a window stands still nothing is drawn, so it would keep what the picture took.
    fn what_a_large_picture_took_is_given_back(gpu) {
        let scene = bent_tube(0.5).three_quarter(Theme::Light);
        let mut easel = gpu.easel(&scene, &[], [200, 120]);
        let bytes = |renderer: &Renderer| {
            let of = |texture: &wgpu::Texture| {
                let texel = texture.format().block_copy_size(None).expect("whole texels");
                u64::from(texture.width() * texture.height() * texel)
            };
            renderer.view_textures().into_iter().map(of).sum::<u64>()
        };
        let before = easel.draw(&scene);
        let of_window = bytes(&easel.renderer);
        assert!(of_window > 0);
        let picture = easel.renderer.picture(&scene.frame(), [900, 700]).expect("it fits");
        assert_eq!(picture.pixels_blocking().expect("drawn"), gpu.draw(&scene, 900, 700).rgba);
        assert!(bytes(&easel.renderer) <= of_window, "{} of {of_window}", bytes(&easel.renderer));
        assert_eq!(easel.draw(&scene), before);
        let of_small = easel.renderer.picture(&scene.frame(), [100, 60]).expect("it fits");
        assert_eq!(of_small.pixels_blocking().expect("drawn"), gpu.draw(&scene, 100, 60).rgba);
        assert_eq!(bytes(&easel.renderer), of_window, "a small picture is drawn in the window's");
    }

    /// Nothing in view is no error: what proves the target is not in the picture.
    fn a_picture_of_nothing_is_transparent(gpu) {
        let mut scene = Scene::of(card(FRONT));
        scene.options.background = Background::None;
        scene.options.overlays = bindpose::scene::Overlays::none();
        let mut renderer = gpu.renderer();
        let picture = renderer.picture(&scene.frame(), [20, 10]).expect("a small picture");
        assert_eq!(picture.pixels_blocking(), Ok(vec![0; 20 * 10 * 4]));
    }

    /// Of a large one too where a thread may wait for the device; else of fewer, so that it answers in time.
    fn a_picture_is_of_as_many_samples_as_are_asked_for(gpu) {
        let scene = bent_tube(0.5);
        let frame = scene.frame();
        let of = |size| PictureTarget::new(size).with_mean_of(64);
        for size in [[640, 480], [3840, 2160]] {
            assert_eq!(of(size).samples_of(&frame), 64, "{size:?}");
        }
        assert_eq!(of([8192, 8192]).samples_of(&frame), 8);
        assert_eq!(of([8192, 8192]).waiting().samples_of(&frame), 64);
        let mut renderer = gpu.renderer();
        renderer.set_model(&scene.model).expect("small");
        let mut drawn = |mut target| renderer.picture_into(&frame, &mut target).expect("small").pixels_blocking();
        let of = |size| PictureTarget::new(size).with_mean_of(5);
        assert!(drawn(of([90, 60])) == drawn(of([90, 60]).waiting()), "it shows the same");
    }

    fn a_picture_that_the_device_does_not_take_is_refused_at_once(gpu) {
        let side = gpu.open.device.limits().max_texture_dimension_2d;
        assert_eq!(
            refusal(gpu, [side + 1, 5]),
            format!("a picture of {} × 5 pixels is too large: this GPU draws at most {side} pixels a side", side + 1)
        );
        let pixels = gpu.open.device.limits().max_buffer_size / 4;
        if u64::from(side) * u64::from(side) > pixels {
            assert_eq!(
                refusal(gpu, [side, side]),
                format!("a picture of {side} × {side} pixels is too large: this GPU draws at most {pixels} pixels in all")
            );
        }
    }
}
