//! Maps that are larger than the device takes.

use std::borrow::Cow;

use bindpose::image::{Image, MapKind};
use bindpose::render::for_tests::{first_fitting_level, fitting};

fn grey(width: u32, height: u32) -> Image {
    let texels = vec![128; (width * height * 4) as usize];
    Image::from_rgba8(width, height, texels, "").expect("a small image")
}

#[test]
fn an_image_larger_than_the_device_starts_at_a_smaller_level() {
    let image = grey(64, 8).with_mips(MapKind::Diffuse);
    for (limit, first) in [(64, 0), (63, 1), (32, 1), (16, 2), (1, 6)] {
        let fitting = fitting(&image, MapKind::Diffuse, limit);
        assert_eq!(first_fitting_level(&fitting, limit), first, "limit {limit}");
    }
}

#[test]
fn an_image_that_fits_is_not_copied() {
    for image in [grey(64, 8).with_mips(MapKind::Normal), grey(64, 8), grey(1, 1)] {
        assert!(matches!(fitting(&image, MapKind::Normal, 64), Cow::Borrowed(_)));
    }
}

#[test]
fn an_image_whose_levels_are_all_too_large_gets_smaller_ones() {
    let image = grey(64, 8);
    let fitting = fitting(&image, MapKind::Diffuse, 32);
    assert_eq!((fitting.width(), fitting.height(), fitting.level_count()), (32, 4, 6));
}
