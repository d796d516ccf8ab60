//! Where the figures of a crowd stand.

use bindpose::session::MAX_CROWD;
use bindpose::session::for_tests::{JITTER, fraction, noise, place};
use glam::Vec2;

#[test]
fn the_others_stand_beside_and_behind_the_first_each_in_a_place_of_its_own() {
    let places: Vec<Vec2> = (0..MAX_CROWD).map(|index| place(7, index)).collect();
    assert_eq!(places[0], Vec2::ZERO);
    let mut cells: Vec<_> = places
        .iter()
        .map(|place| (place.x.round() as i32, place.y.round() as i32))
        .collect();
    assert_eq!(cells[1..6], [(-1, 0), (1, 0), (-1, 1), (1, 1), (0, 1)]);
    assert_eq!(cells[6..9], [(-2, 0), (2, 0), (-2, 1)]);
    assert!(
        cells
            .iter()
            .all(|&(aside, behind)| aside.abs() <= 23 && (0..=23).contains(&behind))
    );
    cells.sort_unstable();
    cells.dedup();
    assert_eq!(cells.len(), MAX_CROWD);
    let off = |place: &Vec2| (*place - place.round()).abs().max_element();
    assert!(places.iter().all(|place| off(place) <= JITTER));
    assert!(places.iter().filter(|place| off(place) > JITTER / 2.0).count() > MAX_CROWD / 2);
}

#[test]
fn noise_is_spread_evenly_and_another_seed_has_other_noise() {
    for seed in [0, 1, 2, u32::MAX] {
        let mut tenths = [0; 10];
        for index in 0..1_000 {
            tenths[(fraction(noise(seed, index, 1)) * 10.0) as usize] += 1;
        }
        assert!(tenths.iter().all(|&count| (60..150).contains(&count)), "{tenths:?}");
    }
    assert_eq!(
        (0..1_000)
            .filter(|&index| noise(1, index, 0) == noise(2, index, 0))
            .count(),
        0
    );
}
