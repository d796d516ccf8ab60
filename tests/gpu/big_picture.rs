//! Pictures by themselves: all of it, or an error in words.

use bindpose::scene::Background;

use crate::gpu::Gpu;
use crate::scenes::{FRONT, Scene, bent_tube, card};

fn refusal(gpu: &Gpu, size: [u32; 2]) -> String {
    let scene = Scene::of(card(FRONT));
    let refused = gpu.renderer().picture(&scene.frame(), size).err();
    refused.map_or_else(String::new, |error| error.to_string())
}

on_both_backends! {
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

    /// Nothing in view is no error: what proves the target is not in the picture.
    fn a_picture_of_nothing_is_transparent(gpu) {
        let mut scene = Scene::of(card(FRONT));
        scene.options.background = Background::None;
        scene.options.overlays = bindpose::scene::Overlays::none();
        let mut renderer = gpu.renderer();
        let picture = renderer.picture(&scene.frame(), [20, 10]).expect("a small picture");
        assert_eq!(picture.pixels_blocking(), Ok(vec![0; 20 * 10 * 4]));
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
