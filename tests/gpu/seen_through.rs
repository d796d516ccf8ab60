//! What is drawn over the model or in place of its colours: shapes in the world, colours of vertices, other poses.

use bindpose::scene::OverlayGeometry;
use glam::Vec3;

use crate::gpu::difference;
use crate::scenes::{FRONT, Scene, bent, bent_tube, card};

const SIZE: [u32; 2] = [160, 120];
const GREEN: [u8; 4] = [20, 200, 40, 255];
const WHITE: [u8; 4] = [255; 4];

/// A square across the view, at a depth.
fn square(out: &mut OverlayGeometry, center: Vec3, half: f32, color: [u8; 4]) {
    let corner = |x: f32, y: f32| center + Vec3::new(x * half, y * half, 0.0);
    out.triangle([corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0)], color);
    out.triangle([corner(-1.0, -1.0), corner(1.0, 1.0), corner(1.0, -1.0)], color);
}

on_both_backends! {
    /// The card faces the viewer, so the colours are seen as they are, and between two of them their mean.
    fn vertices_show_the_colours_that_were_made_for_them(gpu) {
        let mut scene = Scene::of(card(FRONT));
        let half = scene.model.mesh.vertex_count() / 2;
        scene.colors_srgb = [vec![GREEN; half], vec![WHITE; half]].concat();
        let mut easel = gpu.easel(&scene, &[], SIZE);
        let picture = easel.draw(&scene);
        for (x, expected) in [(-0.5, GREEN), (0.5, WHITE)] {
            let found = picture.at(scene.pixel_of(Vec3::new(x, 1.0, 0.0), SIZE));
            assert!(difference(found, expected) <= 2, "{found:?} for {expected:?}");
        }
        scene.colors_srgb = vec![WHITE; 2 * half];
        let found = easel.draw(&scene).at(scene.pixel_of(Vec3::new(-0.5, 1.0, 0.0), SIZE));
        assert!(difference(found, WHITE) <= 2, "other colours are taken up: {found:?}");
        scene.colors_srgb.clear();
        let found = easel.draw(&scene).at(scene.pixel_of(Vec3::new(-0.5, 1.0, 0.0), SIZE));
        assert!(difference(found, WHITE) > 60, "without colours the card is its own: {found:?}");
    }

    /// A square and a line behind the card show through it; of two squares the nearer hides the other, in whatever order.
    fn shapes_are_seen_through_the_model_and_hide_each_other(gpu) {
        let mut scene = Scene::of(card(FRONT));
        let behind = Vec3::new(0.0, 1.0, 0.4);
        for nearer_first in [false, true] {
            scene.seen_through.clear();
            let mut squares = [(behind, GREEN), (behind - Vec3::Z * 0.2, WHITE)];
            if nearer_first {
                squares.reverse();
            }
            for (center, color) in squares {
                let half = if color == WHITE { 0.2 } else { 0.4 };
                square(&mut scene.seen_through, center, half, color);
            }
            let picture = gpu.draw(&scene, SIZE[0], SIZE[1]);
            let at = |x: f32| picture.at(scene.pixel_of(behind + Vec3::X * x, SIZE));
            assert!(difference(at(0.0), WHITE) <= 2, "{:?}", at(0.0));
            assert!(difference(at(0.32), GREEN) <= 2, "{:?}", at(0.32));
            assert!(difference(at(0.6), GREEN) > 60, "beside it is the card");
        }
        scene.seen_through.clear();
        let line = gpu.draw(&scene, SIZE[0], SIZE[1]);
        scene.seen_through.line(Vec3::new(-0.8, 1.0, 0.5), Vec3::new(0.8, 1.0, 0.5), WHITE);
        let with_line = gpu.draw(&scene, SIZE[0], SIZE[1]);
        let [x, y] = scene.pixel_of(Vec3::new(0.4, 1.0, 0.5), SIZE);
        let change = (y - 1..=y + 1).map(|y| difference(line.at([x, y]), with_line.at([x, y]))).max();
        assert!(change > Some(40), "{change:?}");
    }

    /// A ghost bent the other way is seen where the model is not, and the model stays as it was where it is alone.
    fn ghosts_show_other_poses(gpu) {
        let mut scene = bent_tube(0.6);
        let mut easel = gpu.easel(&scene, &[], SIZE);
        let alone = easel.draw(&scene);
        scene.ghosts = vec![bent(-0.6)];
        let with_ghost = easel.draw(&scene);
        let red = |before: [u8; 4], after: [u8; 4]| after[0] > before[0].saturating_add(25) && after[2] <= before[2];
        let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
        let reddened = pixels.filter(|&pixel| red(alone.at(pixel), with_ghost.at(pixel))).count();
        assert!(reddened > 150, "{reddened} pixels");
        scene.ghosts.clear();
        assert_eq!(easel.draw(&scene).share_that_differs(&alone, 0), 0.0, "it is gone again");
    }
}
