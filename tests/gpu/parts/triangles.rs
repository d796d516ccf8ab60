//! Edges, and what of indices was drawn.

use bindpose::render::for_tests::{Drawn, edges};

#[test]
fn two_triangles_of_a_square_have_five_edges() {
    let found: Vec<u32> = edges(&[0, 1, 2, 2, 1, 3]).flatten().collect();
    assert_eq!(found, [0, 1, 0, 2, 1, 2, 1, 3, 2, 3]);
}

#[test]
fn each_index_is_drawn_once_in_as_few_ranges_as_can_be() {
    // A fixed sequence of ranges within 64 indices, empty ones too.
    let mut seed = 1_u32;
    let mut next = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        seed >> 26
    };
    for _ in 0..50 {
        let (mut drawn, mut is_drawn) = (Drawn::default(), [false; 128]);
        for _ in 0..12 {
            let start = next();
            let range = start..start + next() % 16;
            let missing = drawn.missing(&range);
            let parts = drawn.add(&range);
            assert_eq!(missing, parts);
            let fresh: Vec<u32> = range.clone().filter(|&index| !is_drawn[index as usize]).collect();
            assert_eq!(parts.iter().cloned().flatten().collect::<Vec<_>>(), fresh, "{range:?}");
            is_drawn[range.start as usize..range.end as usize].fill(true);
            let all: Vec<u32> = (0..128).filter(|&index| is_drawn[index as usize]).collect();
            assert_eq!(drawn.ranges().flatten().collect::<Vec<_>>(), all);
            let gaps = all.windows(2).filter(|pair| pair[1] - pair[0] > 1).count();
            assert_eq!(drawn.ranges().count(), if all.is_empty() { 0 } else { gaps + 1 });
        }
    }
}

#[test]
fn the_same_range_thousands_of_times_is_drawn_once() {
    let mut drawn = Drawn::default();
    let parts = (0..20_000).flat_map(|_| drawn.add(&(3..9)));
    assert_eq!(parts.collect::<Vec<_>>(), std::slice::from_ref(&(3..9)));
}
