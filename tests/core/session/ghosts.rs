//! Colours of ghosts.

use bindpose::session::GHOSTS_SRGB;
use bindpose::session::for_tests::{GHOST_ALPHA, ghost_color};

#[test]
fn ghosts_fade_away_from_now_on_both_sides() {
    let alphas: Vec<u8> = (0..5).map(|ghost| ghost_color(ghost, 2, 5)[3]).collect();
    assert!(alphas[0] < alphas[1] && alphas[2] > alphas[3] && alphas[3] > alphas[4]);
    assert_eq!((alphas[1], alphas[2]), (GHOST_ALPHA[0], GHOST_ALPHA[0]));
    assert_eq!(ghost_color(0, 2, 5)[..3], GHOSTS_SRGB[0]);
    assert_eq!(ghost_color(4, 2, 5)[..3], GHOSTS_SRGB[1]);
}
