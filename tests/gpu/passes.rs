//! A pass that is left out takes its own effect with it and nothing else.

use bindpose::model::Reflectance;
use bindpose::render::MaterialImages;
use bindpose::scene::{Background, Light, Pass, Passes, Theme};
use glam::Vec3;

use crate::gpu::{Gpu, Picture, difference};
use crate::scenes::{FRONT, Scene, card};
use crate::sets::{OPEN_EDGE_CORNER, SIZE, block, corner, shadow_of_lid, shelter};

const NO_MAPS: &[MaterialImages<'_>] = &[];

/// The scene with everything, and with one pass left out.
fn with_and_without(gpu: &Gpu, scene: &mut Scene, pass: Pass) -> [Picture; 2] {
    let mut easel = gpu.easel(scene, NO_MAPS, SIZE);
    [Passes::all(), Passes::all().with(pass, false)].map(|passes| {
        scene.options.passes = passes;
        easel.draw(scene)
    })
}

/// Green at a point of the world in both pictures.
fn green(pictures: &[Picture; 2], scene: &Scene, point: Vec3) -> [u8; 2] {
    [0, 1].map(|index: usize| pictures[index].at(scene.pixel_of(point, SIZE))[1])
}

/// A card on the ground, seen from above at its front.
fn on_ground(theme: Theme) -> Scene {
    let mut scene = Scene::of(card(FRONT)).three_quarter(theme);
    scene.options.overlays = bindpose::scene::Overlays::none();
    scene.camera.pitch_radians = 0.6;
    scene
}

on_both_backends! {
    fn shadow_darkens_what_the_first_light_does_not_reach(gpu) {
        for light in Light::ALL {
            let mut scene = shelter();
            scene.options.light = light;
            let pictures = with_and_without(gpu, &mut scene, Pass::Shadow);
            let shadow = shadow_of_lid(light);
            let [with, without] = green(&pictures, &scene, shadow);
            assert!(with.saturating_add(25) < without, "{light:?}: {with} {without}");
            for open in [Vec3::Y, Vec3::new(-shadow.x, 0.0, -shadow.z)] {
                let [with, without] = green(&pictures, &scene, open);
                assert!(with.abs_diff(without) <= 1, "{light:?} at {open}: {with} {without}");
            }
        }
    }

    fn the_shadow_on_the_ground_goes_with_it(gpu) {
        for light in Light::ALL {
            let mut scene = on_ground(Theme::Light);
            scene.options.light = light;
            scene.options.passes = Passes::all();
            let pictures = with_and_without(gpu, &mut scene, Pass::Shadow);
            let darker = pictures[0].rgba.chunks_exact(4).zip(pictures[1].rgba.chunks_exact(4));
            let darker = darker.filter(|(with, without)| with[1].saturating_add(8) < without[1]).count();
            assert!(darker > 40, "{light:?}: {darker} pixels");
            let lighter = pictures[0].rgba.iter().zip(&pictures[1].rgba);
            assert_eq!(lighter.filter(|(with, without)| **with > without.saturating_add(1)).count(), 0, "{light:?}");
        }
    }

    fn occlusion_darkens_corners(gpu) {
        for light in Light::ALL {
            let mut scene = corner();
            scene.options.light = light;
            let pictures = with_and_without(gpu, &mut scene, Pass::AmbientOcclusion);
            let [open, edge, corner] = OPEN_EDGE_CORNER;
            for point in [edge, corner] {
                let [with, without] = green(&pictures, &scene, point);
                assert!(with.saturating_add(3) < without, "{light:?} at {point}: {with} {without}");
            }
            let [with, without] = green(&pictures, &scene, open);
            assert!(with.abs_diff(without) <= 6, "{light:?}: {with} {without}");
        }
    }

    /// With the first light's shadow and without it.
    fn contact_darkens_the_ground_under_the_model(gpu) {
        for shadow in [true, false] {
            let mut scene = block();
            scene.options.theme = Theme::Light;
            let mut easel = gpu.easel(&scene, NO_MAPS, SIZE);
            let [with, without] = [true, false].map(|contact| {
                scene.options.passes = Passes::all().with(Pass::Shadow, shadow).with(Pass::ContactShadow, contact);
                easel.draw(&scene)
            });
            let pictures = [with, without];
            // On the side of the light, where the block throws no shadow.
            let [near, bare] = green(&pictures, &scene, Vec3::new(0.0, 0.0, -1.03));
            assert!(near.saturating_add(4) < bare, "{near} {bare}");
            let [near, bare] = green(&pictures, &scene, Vec3::new(0.0, 1.0, -1.0));
            assert_eq!(near, bare, "the model itself");
            let [near, bare] = green(&pictures, &scene, Vec3::new(0.0, 0.0, -1.6));
            assert_eq!(near, bare, "the ground before it");
        }
        // The demo has none.
        let mut scene = block();
        scene.options.light = Light::Book;
        let [with, without] = with_and_without(gpu, &mut scene, Pass::ContactShadow);
        assert_eq!(with, without);
    }

    fn without_reflections_what_is_matt_stays(gpu) {
        let matt = Reflectance::Fresnel { fresnel0: [0.0; 3], roughness: 1.0 };
        let smooth = Reflectance::Fresnel { fresnel0: [0.9; 3], roughness: 0.3 };
        for light in Light::ALL {
            for (reflectance, mirrors) in [(matt, false), (smooth, true)] {
                let mut scene = on_ground(Theme::Dark);
                scene.options.light = light;
                for material in &mut scene.model.materials {
                    material.reflectance = reflectance;
                }
                let [with, without] = with_and_without(gpu, &mut scene, Pass::Environment);
                if mirrors {
                    assert!(with.share_that_differs(&without, 6) > 0.05, "{light:?}");
                } else {
                    assert_eq!(with, without, "{light:?}");
                }
                assert_eq!(with.pixel(0, 0), without.pixel(0, 0), "{light:?}: what is behind stays");
            }
        }
    }

    /// A metal shows the mean of its environment then, never black.
    fn without_reflections_metal_is_not_black(gpu) {
        let mut scene = on_ground(Theme::Dark);
        for material in &mut scene.model.materials {
            material.diffuse = [0.0; 3];
            material.reflectance = Reflectance::Fresnel { fresnel0: [0.9; 3], roughness: 0.3 };
        }
        let [_, without] = with_and_without(gpu, &mut scene, Pass::Environment);
        let middle = without.at(scene.pixel_of(Vec3::new(0.5, 1.0, 0.0), SIZE));
        assert!(middle[..3].iter().all(|&channel| channel > 90), "{middle:?}");
    }

    fn a_picture_without_any_pass_is_whole(gpu) {
        for light in Light::ALL {
            let mut scene = on_ground(Theme::Dark);
            scene.options.light = light;
            scene.options.passes = Passes::none();
            scene.options.background = Background::Color([9, 9, 9]);
            let picture = gpu.draw(&scene, SIZE[0], SIZE[1]);
            let at = |x: f32| picture.at(scene.pixel_of(Vec3::new(x, 1.0, 0.0), SIZE));
            assert!(difference(at(-0.5), at(0.5)) > 40, "{light:?}: blue and red");
            // Nothing shades the ground either.
            assert_eq!(picture.at(scene.pixel_of(Vec3::new(0.0, 0.0, -0.03), SIZE)), [9, 9, 9, 255]);
        }
    }
}
