//! Numbers of bones.

use bindpose::model::Aabb;
use bindpose::ui::for_tests::{Digits, fitted};

#[test]
fn numbers_fit_nine_characters_and_zero_has_no_sign() {
    let cases = [
        (0.0, "0.00000"),
        (-1e-9, "0.00000"),
        (-12.345_678, "-12.34568"),
        (-123.456_78, "-123.4568"),
        (1_234_567.0, "1234567.0"),
        (-12_345_678.0, "-12345678"),
        (3e12, "3.00e12"),
        (f32::NAN, "–"),
    ];
    for (number, text) in cases {
        assert_eq!(fitted(number, 5), text);
    }
}

#[test]
fn decimals_follow_from_the_size_of_the_model() {
    let of_reach = |reach: f32| {
        Digits::for_bounds(&Aabb {
            min: glam::Vec3::new(-0.1, -reach, 0.0),
            max: glam::Vec3::splat(0.1),
        })
    };
    for (reach, small, large) in [
        (1.8, "0.50000", "-7.20000"),
        (70.0, "0.5000", "-280.0000"),
        (3_000.0, "0.50", "-12000.00"),
        (1e9, "0", "-4.00e9"),
    ] {
        let [first, second, _] = of_reach(reach).matrix(3, [0.5, -4.0 * reach, 0.0]);
        assert_eq!((first.as_str(), second.as_str()), (small, large), "{reach}");
    }
    assert_eq!(Digits::for_bounds(&Aabb::EMPTY), Digits::default());
    assert_eq!(of_reach(1.8).place_of(-0.00001), "0.0000");
}

#[test]
fn rounding_errors_print_as_zero_and_small_models_keep_their_numbers() {
    let of_reach = |reach: f32| {
        Digits::for_bounds(&Aabb {
            min: glam::Vec3::ZERO,
            max: glam::Vec3::splat(reach),
        })
    };
    let noise = [9e-6, -9e-6, 3e-5];
    assert_eq!(of_reach(1.0).matrix(0, noise), ["0.00000", "0.00000", "0.00003"]);
    assert_eq!(
        of_reach(2.0).matrix(3, [1.9e-5, -1.9e-5, 3e-5]),
        ["0.00000", "0.00000", "0.00003"]
    );
    assert_eq!(of_reach(0.01).matrix(3, noise), ["0.00001", "-0.00001", "0.00003"]);
}
