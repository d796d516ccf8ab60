//! Colours, typed and taken apart.

use bindpose::ui::for_tests::{from_hex, hex, hsv_from_srgb, srgb_from_hsv};

#[test]
fn hexadecimal_colours_are_read_as_people_write_them() {
    assert_eq!(from_hex("#5aa9FF"), Some([0x5A, 0xA9, 0xFF]));
    assert_eq!(from_hex(" 5aa9ff "), Some([0x5A, 0xA9, 0xFF]));
    assert_eq!(from_hex("#fa0"), Some([0xFF, 0xAA, 0x00]));
    for bad in ["", "#", "#12", "#1234567", "red", "#12345g", "+12345", "１２３"] {
        assert_eq!(from_hex(bad), None, "{bad:?}");
    }
    assert_eq!(hex([0x05, 0xA9, 0xFF]), "#05a9ff");
}

#[test]
fn known_colours_are_taken_apart() {
    let cases = [
        ([0, 0, 0], [0.0, 0.0, 0.0]),
        ([255, 255, 255], [0.0, 0.0, 1.0]),
        ([255, 0, 0], [0.0, 1.0, 1.0]),
        ([0, 255, 0], [1.0 / 3.0, 1.0, 1.0]),
        ([0, 0, 255], [2.0 / 3.0, 1.0, 1.0]),
        ([255, 255, 0], [1.0 / 6.0, 1.0, 1.0]),
    ];
    for (srgb, hsv) in cases {
        let found = hsv_from_srgb(srgb);
        let off = found.iter().zip(hsv).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(off < 1e-6, "{srgb:?}: {found:?}");
    }
}

#[test]
fn what_was_taken_apart_comes_together_again() {
    for red in (0..=255).step_by(15) {
        for green in (0..=255).step_by(15) {
            for blue in (0..=255).step_by(15) {
                let srgb = [red as u8, green as u8, blue as u8];
                assert_eq!(srgb_from_hsv(hsv_from_srgb(srgb)), srgb);
            }
        }
    }
}
