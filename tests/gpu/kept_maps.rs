//! Shadow, contact, geometry and occlusion are drawn again whenever what they show is different, and only then.

use bindpose::model::AlphaMode;
use bindpose::render::MaterialImages;
use bindpose::scene::{Light, Theme};
use glam::{Affine3A, Vec3};

use crate::scenes::{Scene, bent, bent_tube};
use crate::textures::{card_once, diffuse, square};

const NO_MAPS: &[MaterialImages<'_>] = &[];
const SIZE: [u32; 2] = [96, 72];

/// A change of what is in the picture, with its name.
type Change = (&'static str, fn(&mut Scene));

const CHANGES: [Change; 13] = [
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
    ("a crowd came", |scene| {
        scene.add_to_crowd(Affine3A::from_translation(Vec3::X), &bent(0.2));
        scene.add_to_crowd(Affine3A::from_translation(Vec3::NEG_X), &bent(0.4));
    }),
    ("one of the crowd moved", |scene| {
        scene.crowd[1].world_from_model = Affine3A::from_translation(Vec3::Z);
    }),
    ("one of the crowd is posed anew", |scene| {
        scene.crowd_palettes[2..].copy_from_slice(&bent(-0.6).0);
    }),
    ("one of the crowd is out of sight", |scene| scene.in_sight = 1),
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

    /// What was drawn tells it: the indices of each pass for each instance.
    fn maps_of_a_crowd_are_kept_while_it_stands(gpu) {
        let mut scene = bent_tube(0.3);
        scene.options.light = Light::Book;
        scene.add_to_crowd(Affine3A::from_translation(Vec3::X), &bent(0.2));
        scene.add_to_crowd(Affine3A::from_translation(Vec3::NEG_X), &bent(0.4));
        let indices = scene.model.mesh.indices.len() as u64;
        let mut renderer = gpu.renderer();
        let mut target = gpu.target(SIZE[0], SIZE[1]);
        renderer.set_model(&scene.model).expect("small");
        let mut drawn = |scene: &Scene| renderer.render(&scene.frame(), &mut target).vertices / indices;
        let (picture, geometry, shadow) = (3, 3, 3);
        assert_eq!(drawn(&scene), picture + geometry + shadow);
        assert_eq!(drawn(&scene), picture);
        scene.camera.yaw_radians += 0.2;
        scene.crowd.swap(0, 1);
        assert_eq!(drawn(&scene), picture + geometry, "another camera, which sees them in another order");
        scene.in_sight = 1;
        assert_eq!(drawn(&scene), 2 + 2, "fewer in sight");
        scene.crowd[1].world_from_model = Affine3A::from_translation(Vec3::Z);
        assert_eq!(drawn(&scene), 2 + 2 + shadow, "one moved out of sight");
        scene.crowd_palettes[1] = Affine3A::IDENTITY;
        assert_eq!(drawn(&scene), 2 + 2 + shadow, "one posed anew");
        scene.ghosts = vec![bent(0.8)];
        assert_eq!(drawn(&scene), 2 + 1, "a ghost is in the picture alone");
    }

    fn a_material_that_begins_to_cut_has_another_shadow(gpu) {
        let map = square(16, |x, _| [40, 160, 60, if x < 8 { 0 } else { 255 }]);
        let maps = diffuse(&map);
        let mut scene = card_once().three_quarter(Theme::Light);
        let mut easel = gpu.easel(&scene, &maps, SIZE);
        let before = easel.draw(&scene);
        scene.model.materials[0].alpha = AlphaMode::clipped(true);
        easel.renderer.set_materials(&scene.model.materials);
        let after = easel.draw(&scene);
        assert!(after.rgba != before.rgba && after.rgba == gpu.easel(&scene, &maps, SIZE).draw(&scene).rgba);
    }
}
