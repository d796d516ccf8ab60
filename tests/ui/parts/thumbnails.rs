//! Small pictures of maps.

use bindpose::image::Image;
use bindpose::ui::for_tests::{rebuilt_z, small_picture};

#[test]
fn a_direction_straight_out_of_the_map_is_blue() {
    assert_eq!(rebuilt_z(128, 128), 255);
    assert_eq!(rebuilt_z(255, 128), 128);
    assert_eq!(rebuilt_z(255, 255), 128, "longer than 1");
}

#[test]
fn a_large_picture_without_levels_is_averaged() {
    let texels = [[0, 8, 7, 0], [10, 8, 7, 255]].concat().repeat(200);
    let image = Image::from_rgba8(200, 2, texels, "PNG").expect("a picture");
    let small = small_picture(&image).expect("a thumbnail");
    assert_eq!(
        (small.size, small.pixels[5]),
        ([50, 1], egui::Color32::from_rgb(5, 8, 7))
    );
}

#[test]
fn a_small_picture_is_shown_as_it_is() {
    let image = Image::from_rgba8(64, 2, [9, 8, 7, 0].repeat(128), "PNG").expect("a picture");
    let small = small_picture(&image).expect("64 texels");
    assert_eq!(
        (small.size, small.pixels[5]),
        ([64, 2], egui::Color32::from_rgb(9, 8, 7))
    );
}
