//! Pictures with nothing behind the model: they can be laid over anything, and bring the shadows on the ground with them.

use bindpose::render::MaterialImages;
use bindpose::scene::{Background, Light, Pass, Passes, Theme, linear_from_srgb8, srgb8_from_linear};

use crate::gpu::{Gpu, Picture};
use crate::scenes::{FRONT, Scene, card};
use crate::sets::block;
use crate::still_life::{StillLifeMaps, still_life};

const SIZE: [u32; 2] = [160, 120];
/// Bytes, dithered on both sides, of a colour that was multiplied by an alpha of eight bits.
const ROUNDING: u8 = 3;

/// Laid over a colour in linear light.
fn laid_over(picture: &Picture, ground: u8) -> Picture {
    let pixel = |pixel: &[u8]| {
        let alpha = f32::from(pixel[3]) / 255.0;
        let over = |channel| linear_from_srgb8(channel) * alpha + linear_from_srgb8(ground) * (1.0 - alpha);
        [0, 1, 2].map(|channel: usize| srgb8_from_linear(over(pixel[channel])))
    };
    Picture {
        rgba: picture
            .rgba
            .chunks_exact(4)
            .flat_map(|rgba| {
                let [red, green, blue] = pixel(rgba);
                [red, green, blue, 255]
            })
            .collect(),
        ..*picture
    }
}

/// Draws the scene on nothing, and compares it with what is drawn on colours. Returns how many pixels are shadow and nothing else.
fn compare(gpu: &Gpu, what: &str, mut scene: Scene, maps: &[MaterialImages<'_>]) -> usize {
    let mut easel = gpu.easel(&scene, maps, SIZE);
    scene.options.background = Background::None;
    let cut_out = easel.draw(&scene);
    for ground in [255, 128] {
        scene.options.background = Background::Color([ground; 3]);
        let differs = easel
            .draw(&scene)
            .share_that_differs(&laid_over(&cut_out, ground), ROUNDING);
        assert!(differs < 0.001, "{what} over {ground}: {differs} of the pixels differ");
    }
    let is_shadow = |pixel: &&[u8]| pixel[..3] == [0; 3] && (10..=250).contains(&pixel[3]);
    cut_out.rgba.chunks_exact(4).filter(is_shadow).count()
}

on_both_backends! {
    /// Shadow, contact, smooth edges and edges that alpha cuts.
    fn laid_over_a_colour_it_is_the_picture_on_that_colour(gpu) {
        for light in Light::ALL {
            let mut card = Scene::of(card(FRONT)).three_quarter(Theme::Light);
            card.camera.pitch_radians = 0.6;
            let mut life = still_life();
            life.options.theme = Theme::Light;
            for (what, mut scene, maps) in [("card", card, None), ("block", block(), None), ("still life", life, Some(StillLifeMaps::new()))] {
                scene.options.light = light;
                scene.options.overlays = bindpose::scene::Overlays::none();
                let maps = maps.as_ref().map(StillLifeMaps::images);
                let shadow = compare(gpu, &format!("{what}, {light:?}"), scene, maps.as_ref().map_or(&[], |maps| &maps[..]));
                assert!(shadow > 100, "{what}, {light:?}: {shadow} pixels of shadow");
            }
        }
    }

    fn in_a_divided_picture_each_light_has_its_shadow(gpu) {
        let mut scene = block();
        scene.options.split = Some(0.5);
        let shadow = compare(gpu, "divided", scene, &[]);
        assert!(shadow > 50, "{shadow} pixels of shadow");
    }

    /// The contact shadow is in it without the first light's shadow, and with neither nothing is.
    fn shadows_that_are_left_out_are_not_in_it(gpu) {
        let mut scene = block();
        scene.options.background = Background::None;
        let mut easel = gpu.easel(&scene, &[], SIZE);
        let mut shadow = |passes| {
            scene.options.passes = passes;
            let picture = easel.draw(&scene);
            let [left, right] = [0, SIZE[0] - 1].map(|x| picture.pixel(x, 0));
            assert_eq!([left, right], [[0; 4]; 2], "far from the model nothing is");
            picture.rgba.chunks_exact(4).filter(|pixel| pixel[..3] == [0; 3] && pixel[3] > 10).count()
        };
        let without = Passes::all().with(Pass::Shadow, false);
        let [both, contact, none] = [Passes::all(), without, without.with(Pass::ContactShadow, false)].map(&mut shadow);
        assert!(both > contact && contact > 50 && none == 0, "{both} {contact} {none}");
    }
}
