//! Lines over the model and beside it.

use bindpose::scene::{Light, Overlay, Overlays, Projection};
use glam::{Vec2, Vec3};

use crate::gpu::{Easel, Gpu, Picture, difference};
use crate::scenes::{FRONT, Scene, bent_tube, card};
use crate::sets::UNIT_BOX;

const SIZE: [u32; 2] = [160, 120];

/// How much the picture changes at a point of the world or in the pixels beside it.
fn change_at(scene: &Scene, before: &Picture, after: &Picture, point: Vec3) -> u8 {
    let [x, y] = scene.pixel_of(point, SIZE);
    let around = (0..9).map(|index| [x + index % 3 - 1, y + index / 3 - 1]);
    around
        .map(|pixel| difference(before.at(pixel), after.at(pixel)))
        .max()
        .unwrap_or(0)
}

/// The scene without overlays and with this one.
fn with(gpu: &Gpu, scene: &mut Scene, overlay: Overlay) -> [Picture; 2] {
    let mut easel: Easel<'_> = gpu.easel(scene, &[], SIZE);
    let mut overlays = Overlays::none();
    overlays.line_length = scene.options.overlays.line_length;
    [false, true].map(|visible| {
        scene.options.overlays = overlays;
        scene.options.overlays.set(overlay, visible);
        easel.draw(scene)
    })
}

/// Of a picture, how many pixels another changes.
fn changed(before: &Picture, after: &Picture) -> f64 {
    before.share_that_differs(after, 2)
}

on_both_backends! {
    /// Two squares side by side: their outlines and a diagonal each.
    fn wires_run_along_edges(gpu) {
        let mut scene = Scene::of(card(FRONT));
        let [before, after] = with(gpu, &mut scene, Overlay::Wireframe);
        let at = |x: f32, y: f32| change_at(&scene, &before, &after, Vec3::new(x, y, 0.0));
        // From (-1, 0) to (0, 2), and the line between the squares.
        for (x, y) in [(-0.5, 1.0), (-0.25, 1.5), (0.5, 1.0), (0.0, 1.0), (-1.0, 1.0), (0.5, 2.0)] {
            assert!(at(x, y) > 12, "({x}, {y}): {}", at(x, y));
        }
        for (x, y) in [(-0.75, 1.5), (-0.25, 0.5), (0.25, 1.5), (0.75, 0.5)] {
            assert_eq!(at(x, y), 0, "({x}, {y})");
        }
    }

    /// Vertices that no triangle uses stand before those of the squares, so many that the texture of the vertices has longer rows than of few.
    fn wires_of_many_vertices_are_those_of_few(gpu) {
        let few = with(gpu, &mut Scene::of(card(FRONT)), Overlay::Wireframe);
        let mut model = card(FRONT);
        let before = 300_000;
        let mesh = &mut model.mesh;
        mesh.positions = [vec![Vec3::ZERO; before], mesh.positions.clone()].concat();
        mesh.normals = [vec![Vec3::NEG_Z; before], mesh.normals.clone()].concat();
        mesh.tangents = [vec![Vec3::X.extend(1.0); before], mesh.tangents.clone()].concat();
        mesh.tex_coords = vec![Vec2::ZERO; mesh.positions.len()];
        mesh.indices.iter_mut().for_each(|index| *index += before as u32);
        let many = with(gpu, &mut Scene::of(model), Overlay::Wireframe);
        assert!(changed(&few[0], &few[1]) > 0.01);
        assert_eq!(changed(&few[1], &many[1]), 0.0);
    }

    fn normals_and_tangents_stand_on_vertices(gpu) {
        let mut scene = Scene::of(card(FRONT));
        // From above at the left, so that what stands towards the viewer has a length in the picture.
        scene.camera.yaw_radians = 0.9;
        scene.camera.pitch_radians = 0.5;
        scene.options.overlays.line_length = 0.25;
        let length = 0.25 * scene.world_bounds.radius();
        let outside = Vec3::new(-1.0, 2.0, 0.0);
        for (overlay, along) in [(Overlay::Normals, Vec3::NEG_Z), (Overlay::Tangents, Vec3::X)] {
            let [before, after] = with(gpu, &mut scene, overlay);
            let at = |share: f32| change_at(&scene, &before, &after, outside + along * length * share);
            assert!(at(0.3) > 30 && at(0.8) > 30, "{overlay:?}: {} {}", at(0.3), at(0.8));
            assert_eq!(at(1.4), 0, "{overlay:?}: beyond its end");
            assert_eq!(at(-0.5), 0, "{overlay:?}: before its start");
        }
    }

    fn normals_follow_the_pose(gpu) {
        let mut bent = bent_tube(0.9);
        bent.options.overlays.line_length = 0.1;
        let [before, after] = with(gpu, &mut bent, Overlay::Normals);
        assert!(changed(&before, &after) > 0.01);
        // The tube's upper end is bent to the left: nothing is where it stood.
        assert_eq!(change_at(&bent, &before, &after, Vec3::new(0.5, 3.8, 0.0)), 0);
    }

    fn the_box_is_drawn_along_its_edges(gpu) {
        let mut scene = Scene::of(bindpose::model::Model::default());
        scene.world_bounds = UNIT_BOX;
        scene.camera.distance = 6.0;
        scene.camera.yaw_radians = -0.6;
        scene.camera.pitch_radians = 0.4;
        let [before, after] = with(gpu, &mut scene, Overlay::Bounds);
        for (x, y, z) in [(1.0, 1.0, 0.3), (-1.0, 1.0, -0.3), (0.2, -1.0, -1.0), (1.0, 0.1, -1.0), (0.4, 1.0, 1.0)] {
            let change = change_at(&scene, &before, &after, Vec3::new(x, y, z));
            assert!(change > 40, "({x}, {y}, {z}): {change}");
        }
        assert_eq!(change_at(&scene, &before, &after, Vec3::new(0.3, 1.0, 0.4)), 0, "inside the upper face");
    }

    /// Red, green and blue, through the model.
    fn axes_have_their_colours_and_show_through(gpu) {
        for light in Light::ALL {
            let mut scene = Scene::of(card(FRONT));
            scene.camera.projection = Projection::Orthographic;
            // All three lie over the red half then.
            scene.camera.yaw_radians = -0.5;
            scene.camera.pitch_radians = 0.3;
            scene.options.light = light;
            let [before, after] = with(gpu, &mut scene, Overlay::Axes);
            let length = 0.5 * scene.world_bounds.radius();
            for (index, axis) in Vec3::AXES.into_iter().enumerate() {
                let point = axis * length * 0.6;
                let [x, y] = scene.pixel_of(point, SIZE);
                let around = (0..9).map(|index| [x + index % 3 - 1, y + index / 3 - 1]);
                let is_tinted = around.map(|pixel| [before.at(pixel), after.at(pixel)]).any(|[before, after]| {
                    let gain = |channel: usize| i32::from(after[channel]) - i32::from(before[channel]);
                    (0..3).all(|other| other == index || gain(index) > gain(other) + 20)
                });
                assert!(is_tinted, "{light:?} {axis}");
                assert!(change_at(&scene, &before, &after, point) > 30);
                assert_eq!(change_at(&scene, &before, &after, axis * length * 1.3), 0, "{axis}: beyond its end");
            }
        }
    }

    /// Lines are the same over both lights, and a line keeps clear of what is in front of it.
    fn wires_behind_the_model_are_hidden(gpu) {
        let mut scene = bent_tube(0.0);
        scene.palette.0[0] = glam::Affine3A::IDENTITY;
        let [before, after] = with(gpu, &mut scene, Overlay::Bounds);
        // The back edge of the box's floor passes behind the tube.
        let behind = Vec3::new(0.0, 0.0, 1.0);
        let hidden = scene.pixel_of(behind, SIZE);
        assert_eq!(before.at(hidden), after.at(hidden));
        assert!(change_at(&scene, &before, &after, Vec3::new(1.6, 0.0, 1.0)) > 30);
    }
}
