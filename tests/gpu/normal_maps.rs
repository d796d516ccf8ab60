//! What a normal map does to the light. The key stands over the viewer's right shoulder: what leans to the right or up is lit.

use std::sync::Arc;

use bindpose::image::Image;
use glam::{Affine3A, Vec3A, Vec4};

use crate::gpu::{Gpu, Picture};
use crate::scenes::Scene;
use crate::textures::{HEIGHT, WIDTH, card_once, dds, normal, plain};

const MIRROR_X: Affine3A = Affine3A::from_cols(Vec3A::NEG_X, Vec3A::Y, Vec3A::Z, Vec3A::ZERO);

/// A direction that leans along u or v by half a right angle and a bit less, z = 0.8.
const LEAN: u8 = 204;
const BACK: u8 = 51;
const UP: u8 = 230;

const FLAT: [u8; 4] = [128, 128, 255, 255];
const TO_RIGHT: [u8; 4] = [LEAN, 128, UP, 255];
const TO_LEFT: [u8; 4] = [BACK, 128, UP, 255];
/// v goes down.
const DOWNWARDS: [u8; 4] = [128, LEAN, UP, 255];
const UPWARDS: [u8; 4] = [128, BACK, UP, 255];

fn draw(gpu: &Gpu, scene: &Scene, texel: [u8; 4]) -> Picture {
    draw_map(gpu, scene, &plain(texel))
}

fn draw_map(gpu: &Gpu, scene: &Scene, map: &Arc<Image>) -> Picture {
    gpu.draw_with_maps(scene, &normal(map), WIDTH, HEIGHT)
}

/// A grey card, so that nothing is too bright to compare.
fn grey_card() -> Scene {
    let mut scene = card_once();
    scene.model.materials[0].diffuse = [0.58; 3];
    scene
}

/// How bright the middle of the card is with a map of this texel.
fn light(gpu: &Gpu, scene: &Scene, texel: [u8; 4]) -> u8 {
    draw(gpu, scene, texel).middle()[1]
}

fn same(a: &Picture, b: &Picture) -> bool {
    a.share_that_differs(b, 1) == 0.0
}

/// Much brighter.
fn outshines(bright: u8, dim: u8) -> bool {
    bright > dim.saturating_add(10)
}

on_both_backends! {
    fn a_flat_map_changes_nothing(gpu) {
        let scene = grey_card();
        assert!(same(&draw(gpu, &scene, FLAT), &gpu.draw(&scene, WIDTH, HEIGHT)));
    }

    fn what_leans_to_the_key_is_lit(gpu) {
        let scene = grey_card();
        let flat = light(gpu, &scene, FLAT);
        assert!(outshines(light(gpu, &scene, TO_RIGHT), flat) && outshines(flat, light(gpu, &scene, TO_LEFT)));
        assert!(outshines(light(gpu, &scene, UPWARDS), flat) && outshines(flat, light(gpu, &scene, DOWNWARDS)));
    }

    /// The sign of the tangent says where the bitangent goes, and so does the switch for the green channel.
    fn green_turns_with_the_sign_of_the_tangent_and_with_the_switch(gpu) {
        let scene = grey_card();
        let mut other_sign = grey_card();
        for tangent in &mut other_sign.model.mesh.tangents {
            tangent.w = -1.0;
        }
        let mut switched = grey_card();
        switched.options.normal_green_flipped = true;
        assert!(outshines(light(gpu, &other_sign, DOWNWARDS), light(gpu, &other_sign, UPWARDS)));
        assert!(outshines(light(gpu, &switched, DOWNWARDS), light(gpu, &switched, UPWARDS)));
        assert!(same(&draw(gpu, &other_sign, TO_RIGHT), &draw(gpu, &scene, TO_RIGHT)));
        let mut both = other_sign;
        both.options.normal_green_flipped = true;
        assert!(same(&draw(gpu, &both, UPWARDS), &draw(gpu, &scene, UPWARDS)));
    }

    /// In a mirror left and right change places; up stays up.
    fn a_mirrored_card_is_lit_as_a_card_with_the_mirrored_map(gpu) {
        let mirrored = || grey_card().in_world(MIRROR_X);
        for (texel, image) in [(TO_RIGHT, TO_LEFT), (TO_LEFT, TO_RIGHT), (UPWARDS, UPWARDS), (DOWNWARDS, DOWNWARDS)] {
            // 204 and 51 are not quite as far from the middle, and so are the two pictures.
            let (found, expected) = (draw(gpu, &mirrored(), texel), draw(gpu, &grey_card(), image));
            assert_eq!(found.share_that_differs(&expected, 3), 0.0, "{texel:?}");
        }
    }

    /// Seen from behind, what leans to +x leans to the viewer's left, and being a dent there it is lit as leaning right.
    fn relief_seen_from_behind_is_inside_out(gpu) {
        let mut scene = grey_card();
        scene.camera.yaw_radians = std::f32::consts::PI;
        assert!(outshines(light(gpu, &scene, TO_RIGHT), light(gpu, &scene, TO_LEFT)));
        assert!(outshines(light(gpu, &scene, DOWNWARDS), light(gpu, &scene, UPWARDS)));
    }

    /// Red and green alone: the same relief as with the blue that belongs to them.
    fn two_channels_are_enough(gpu) {
        let scene = grey_card();
        // Both ends of a block's ramp are the value; three levels of one block each.
        let block = |[red, green]: [u8; 2]| [[red, red, 0, 0, 0, 0, 0, 0], [green, green, 0, 0, 0, 0, 0, 0]].concat();
        for texel in [TO_RIGHT, UPWARDS] {
            let pair = dds(b"BC5U", [0; 2], 4, &block([texel[0], texel[1]]).repeat(3));
            let (two, three) = (draw_map(gpu, &scene, &pair), draw(gpu, &scene, texel));
            assert_eq!(two.share_that_differs(&three, 2), 0.0, "{texel:?}");
        }
    }

    fn without_a_tangent_the_normal_stays(gpu) {
        let scene = grey_card();
        let without_map = gpu.draw(&scene, WIDTH, HEIGHT);
        for tangent in [Vec4::ZERO, Vec4::new(0.0, 0.0, 1.0, 1.0), Vec4::new(f32::NAN, 0.0, 0.0, 1.0)] {
            let mut degenerate = grey_card();
            degenerate.model.mesh.tangents = vec![tangent; 4];
            assert!(same(&draw(gpu, &degenerate, TO_RIGHT), &without_map), "{tangent}");
        }
    }

    /// The tangent of the file is brought square to the normal: only its direction along the surface counts.
    fn a_slanted_tangent_gives_the_same_relief(gpu) {
        let mut slanted = grey_card();
        slanted.model.mesh.tangents = vec![Vec4::new(0.6, 0.0, 0.8, 1.0); 4];
        for texel in [TO_RIGHT, UPWARDS] {
            assert!(same(&draw(gpu, &slanted, texel), &draw(gpu, &grey_card(), texel)));
        }
    }
}
