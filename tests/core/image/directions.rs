//! Normal maps as pictures of directions.

use bindpose::export::directions;
use bindpose::image::{Image, decode};

use super::dds::{Dds, RGB};

#[test]
fn a_direction_of_two_numbers_gets_its_third() {
    let texels = [128, 128, 255, 128, 255, 255];
    let dds = Dds::masked(RGB, 16, [0xff, 0xff00, 0, 0], 3, 1).file(&texels);
    let image = decode(&dds, "norm.dds").expect("the file is sound");
    let z: Vec<u8> = directions(&image, false)
        .chunks_exact(4)
        .map(|texel| texel[2])
        .collect();
    assert_eq!(z, [255, 128, 128]);
}

#[test]
fn green_is_turned_and_gloss_left_out() {
    let image = Image::from_rgba8(2, 1, vec![10, 20, 30, 40, 50, 0, 70, 255], "test").expect("two texels");
    assert_eq!(directions(&image, false), [10, 20, 30, 255, 50, 0, 70, 255]);
    assert_eq!(directions(&image, true), [10, 235, 30, 255, 50, 255, 70, 255]);
}
