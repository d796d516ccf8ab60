//! Where pictures and labels lie.

use bindpose::contact_sheet::for_tests::{Layout, Place};

/// Whether two places share a pixel.
fn meet(a: Place, b: Place) -> bool {
    (0..2).all(|axis| a.at[axis] < b.at[axis] + b.size[axis] && b.at[axis] < a.at[axis] + a.size[axis])
}

#[test]
fn places_lie_on_the_sheet_and_apart_from_each_other() {
    for (size, cells) in [
        ([1280, 720], [4, 3]),
        ([1280, 720], [1, 1]),
        ([300, 2000], [2, 17]),
        ([64, 64], [2, 1]),
        ([8192, 8192], [100, 3]),
    ] {
        let layout = Layout::new(size, cells).expect("has room");
        let count = (cells[0] * cells[1]) as usize;
        let places: Vec<Place> = (0..count)
            .flat_map(|index| <[Place; 2]>::from(layout.places(index).expect("is there")))
            .collect();
        for (index, place) in places.iter().enumerate() {
            assert!(
                (0..2).all(|axis| place.at[axis] + place.size[axis] <= size[axis]),
                "{place:?}"
            );
            assert!(places[..index].iter().all(|other| !meet(*place, *other)), "{place:?}");
        }
        assert_eq!(layout.places(count), None);
    }
}

#[test]
fn pictures_fill_most_of_a_sheet_and_go_along_its_rows() {
    let layout = Layout::new([1280, 720], [4, 3]).expect("has room");
    let [width, height] = layout.cell_size();
    assert!(width > 300 && height > 195, "{width} × {height}");
    let at = |index| layout.places(index).expect("is there").0.at;
    assert!(at(1)[0] > at(0)[0] && at(1)[1] == at(0)[1]);
    assert!(at(4)[1] > at(0)[1] && at(4)[0] == at(0)[0]);
}

#[test]
fn a_sheet_without_room_or_beyond_memory_is_refused() {
    let told = |size, cells| Layout::new(size, cells).map(|_| ()).map_err(|error| error.to_string());
    assert_eq!(
        told([100, 50], [8, 8]),
        Err("a sheet of 100 × 50 pixels has no room for 8 × 8 pictures of 8 × 8 pixels".into())
    );
    for cells in [[0, 1], [1, 0], [u32::MAX, u32::MAX], [101, 1]] {
        assert!(told([100, 50], cells).is_err(), "{cells:?}");
    }
    assert_eq!(
        told([100_000, 100_000], [1, 1]),
        Err("a sheet of 100000 × 100000 pixels is too large: at most 268435456 pixels in all".into())
    );
}
