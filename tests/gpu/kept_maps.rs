//! Shadow, contact, geometry and occlusion are drawn again whenever what they show is different, and only then.

use bindpose::render::MaterialImages;
use bindpose::scene::{Light, Theme};
use glam::{Affine3A, Vec3};

use crate::scenes::{Scene, bent, bent_tube};
use crate::textures::{card_once, diffuse, square};

const NO_MAPS: &[MaterialImages<'_>] = &[];
const SIZE: [u32; 2] = [96, 72];

/// A change of what is in the picture, with its name.
type Change = (&'static str, fn(&mut Scene));

const CHANGES: [Change; 9] = [
    ("another pose", |scene| scene.palette = bent(0.9)),
    ("another camera", |scene| scene.camera.yaw_radians += 0.4),
    ("another light", |scene| scene.options.light = Light::Book),
    ("the book's lights turned", |scene| {
        scene.options.book_lights_turn_radians = 1.0;
    }),
    ("two lights", |scene| scene.options.split = Some(0.4)),
    ("the divider moved", |scene| scene.options.split = Some(0.6)),
    ("the model moved", |scene| {
        scene.world_from_model = Affine3A::from_translation(Vec3::Y * 0.4) * scene.world_from_model;
    }),
    ("brighter", |scene| scene.options.exposure_stops = 1.0),
    ("nothing in view", |scene| {
        scene.hidden = vec![true; scene.model.mesh.submeshes.len()];
    }),
];

on_both_backends! {
    fn a_picture_after_others_is_the_same_as_the_first_of_a_renderer(gpu) {
        let mut scene = bent_tube(0.3).three_quarter(Theme::Light);
        let mut easel = gpu.easel(&scene, NO_MAPS, SIZE);
        let mut before = easel.draw(&scene);
        for (what, change) in CHANGES {
            change(&mut scene);
            let after = easel.draw(&scene);
            assert!(after.rgba != before.rgba, "{what}: the picture is another one");
            assert!(after.rgba == easel.draw(&scene).rgba, "{what}: drawn once more");
            assert!(after.rgba == gpu.easel(&scene, NO_MAPS, SIZE).draw(&scene).rgba, "{what}: drawn by a new renderer");
            before = after;
        }
    }

    fn a_material_that_begins_to_cut_has_another_shadow(gpu) {
        let map = square(16, |x, _| [40, 160, 60, if x < 8 { 0 } else { 255 }]);
        let maps = diffuse(&map);
        let mut scene = card_once().three_quarter(Theme::Light);
        let mut easel = gpu.easel(&scene, &maps, SIZE);
        let before = easel.draw(&scene);
        scene.model.materials[0].alpha_clip = true;
        easel.renderer.set_materials(&scene.model.materials);
        let after = easel.draw(&scene);
        assert!(after.rgba != before.rgba && after.rgba == gpu.easel(&scene, &maps, SIZE).draw(&scene).rgba);
    }
}
