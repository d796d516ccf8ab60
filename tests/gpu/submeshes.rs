//! Parts that are left out, and the part that stands out.

use bindpose::scene::{Light, Theme, ViewMode};
use glam::Vec3;

use crate::gpu::{Picture, difference};
use crate::scenes::{BLUE, FRONT, Scene, bent_tube, card, material};
use crate::sets::{SIZE, corner, shelter};

/// The scene without a submesh, its bounds as they were.
fn without(mut scene: Scene, submesh: usize) -> Scene {
    scene.model.mesh.submeshes.remove(submesh);
    scene
}

on_both_backends! {
    /// In the picture, in the shadow, in the occlusion, in the contact.
    fn what_is_hidden_is_gone_from_everything(gpu) {
        for (scene, submesh) in [(shelter as fn() -> Scene, 1), (corner, 1), (|| bent_tube(0.5).three_quarter(Theme::Light), 1)] {
            let mut hidden = scene();
            hidden.hidden = (0..submesh + 1).map(|index| index == submesh).collect();
            let mut missing = without(scene(), submesh);
            let (mut whole, mut easel) = (gpu.easel(&hidden, &[], SIZE), gpu.easel(&missing, &[], SIZE));
            for light in Light::ALL {
                for mode in [ViewMode::Lit, ViewMode::Shadow, ViewMode::AmbientOcclusion] {
                    for options in [&mut hidden.options, &mut missing.options] {
                        (options.light, options.view_mode) = (light, mode);
                    }
                    assert_eq!(whole.draw(&hidden), easel.draw(&missing), "{light:?} {mode:?}");
                }
            }
        }
    }

    fn a_list_that_is_too_long_or_too_short_hides_what_it_names(gpu) {
        let mut scene = Scene::of(card(FRONT));
        let mut easel = gpu.easel(&scene, &[], SIZE);
        let mut draw = |hidden: &[bool]| {
            scene.hidden = hidden.to_vec();
            easel.draw(&scene)
        };
        let all = draw(&[]);
        assert_eq!(draw(&[false, false, true, true]), all);
        let left = draw(&[false, true]);
        assert_eq!(draw(&[false, true, true]), left);
        assert_eq!(draw(&[true, true]), draw(&[true; 9]));
        assert!(all.share_that_differs(&left, 10) > 0.02);
    }

    fn what_stands_out_is_one_part_alone(gpu) {
        for light in Light::ALL {
            let mut scene = Scene::of(card(FRONT));
            scene.options.light = light;
            let mut easel = gpu.easel(&scene, &[], SIZE);
            let plain = easel.draw(&scene);
            scene.highlighted = Some(0);
            let picture = easel.draw(&scene);
            let (mut changed, mut middle) = (0, 0);
            for y in 0..SIZE[1] {
                for x in 0..SIZE[0] {
                    let differs = difference(plain.pixel(x, y), picture.pixel(x, y)) > 0;
                    // The left half is submesh 0; its edge shares the middle's samples.
                    assert!(!differs || x <= SIZE[0] / 2, "({x}, {y})");
                    changed += usize::from(differs);
                    middle += usize::from(plain.pixel(x, y) != plain.pixel(0, 0) && x < SIZE[0] / 2);
                }
            }
            assert!(changed > 500 && changed <= middle + 200, "{changed}");
            let left = picture.at(scene.pixel_of(Vec3::new(-0.5, 1.0, 0.0), SIZE));
            let before = plain.at(scene.pixel_of(Vec3::new(-0.5, 1.0, 0.0), SIZE));
            assert!(difference(left, before) > 15, "{left:?} {before:?}");
            scene.highlighted = Some(7);
            assert_eq!(easel.draw(&scene), plain, "no such part");
        }
    }

    /// A part behind another does not shine through, and a hidden one is not drawn for it.
    fn what_stands_out_keeps_its_place(gpu) {
        let mut scene = corner();
        scene.model.materials[1] = material("blue", BLUE);
        let mut easel = gpu.easel(&scene, &[], SIZE);
        let plain = easel.draw(&scene);
        scene.highlighted = Some(1);
        scene.hidden = vec![false, true];
        let hidden: Picture = easel.draw(&scene);
        scene.highlighted = None;
        assert_eq!(hidden, easel.draw(&scene));
        assert!(plain.share_that_differs(&hidden, 10) > 0.05);

        // The lid covers the middle of the floor, seen from above.
        let mut scene = shelter();
        let mut easel = gpu.easel(&scene, &[], SIZE);
        let plain = easel.draw(&scene);
        scene.highlighted = Some(0);
        let picture = easel.draw(&scene);
        let lid = scene.pixel_of(Vec3::Y, SIZE);
        let floor = scene.pixel_of(Vec3::new(-1.2, 0.0, -1.2), SIZE);
        assert_eq!(plain.at(lid), picture.at(lid));
        assert!(difference(plain.at(floor), picture.at(floor)) > 5);
    }
}
