//! `bindpose render` under other lights, in other modes, on other grounds: the page's menus as arguments.

use bindpose::scene::ViewMode;
use image::RgbaImage;

use crate::program::{FIGURE, run, scratch_folder, scratch_name, words};

fn draw(name: &str, arguments: &[&str]) -> RgbaImage {
    let path = scratch_name(&format!("look-{name}.png"));
    let maps = concat!(env!("CARGO_MANIFEST_DIR"), "/web/sample");
    let plain = ["render", FIGURE, "--textures", maps, "-o", &path];
    let look = words("--size 160x120 --no-grid");
    run(plain.iter().chain(&look).chain(arguments)).fine();
    image::open(&path).expect("is a picture").into_rgba8()
}

/// Share of the pixels in which some channel differs by more than a driver's rounding.
fn differs(a: &RgbaImage, b: &RgbaImage) -> f64 {
    let pixels = a.pixels().zip(b.pixels());
    let different = pixels.filter(|(a, b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 6));
    different.count() as f64 / f64::from(a.width() * a.height())
}

#[test]
fn every_view_mode_is_another_picture() {
    let modes = ViewMode::ALL.map(ViewMode::name);
    let pictures: Vec<_> = modes.iter().map(|mode| draw(mode, &["--view-mode", mode])).collect();
    for (index, picture) in pictures.iter().enumerate() {
        for (other, mode) in pictures[..index].iter().zip(&modes) {
            assert!(differs(picture, other) > 0.01, "{} is {mode}", modes[index]);
        }
    }
}

/// The divided picture is the book's on the left and the studio's on the right.
#[test]
fn a_split_shows_both_lights_side_by_side() {
    let [book, studio, split] = [
        draw("book", &["--split", "1"]),
        draw("studio", &["--light", "studio"]),
        draw("split", &["--split", "0.5"]),
    ];
    assert!(differs(&book, &studio) > 0.02);
    for (x, y, pixel) in split.enumerate_pixels() {
        let whole = if x < 80 { &book } else { &studio };
        let near = pixel
            .0
            .iter()
            .zip(whole.get_pixel(x, y).0)
            .all(|(a, b)| a.abs_diff(b) <= 6);
        // One column on either side of the line, where samples of one pixel would belong to both.
        assert!(near || x.abs_diff(80) <= 1, "({x}, {y})");
    }
}

#[test]
fn the_background_is_the_one_that_was_asked_for() {
    let corner = |picture: &RgbaImage| picture.get_pixel(0, 0).0;
    // So far from the model there is hardly a trace of the floor.
    let color = corner(&draw("color", &["--background", "#205080"]));
    let is_near = |(found, asked): (u8, u8)| found.abs_diff(asked) <= 1;
    assert!(color.into_iter().zip([0x20, 0x50, 0x80, 255]).all(is_near), "{color:?}");
    assert_eq!(corner(&draw("none", &["--background", "none"]))[3], 0);
    let shadow = |picture: RgbaImage| {
        picture
            .pixels()
            .filter(|pixel| pixel.0[..3] == [0; 3] && pixel.0[3] > 20)
            .count()
    };
    let kept = shadow(draw("kept-shadow", &["--transparent"]));
    let without = shadow(draw(
        "cut-shadow",
        &["--transparent", "--without", "shadow", "--without", "contact"],
    ));
    // A pixel of the model may be black too.
    assert!(kept > 50 && without < 5, "{kept} pixels of shadow, {without} without");
    let (sky, backdrop) = (draw("sky", &["--background", "sky"]), draw("backdrop", &[]));
    assert!(differs(&sky, &backdrop) > 0.3);
}

#[test]
fn lines_exposure_turn_and_steps_change_the_picture() {
    let plain = draw("plain", &[]);
    for (name, more) in [
        ("wireframe", &["--overlay", "wireframe"][..]),
        ("normals", &["--overlay", "normals"]),
        ("tangents", &["--overlay", "tangents"]),
        ("bounds", &["--overlay", "bounds"]),
        ("axes", &["--overlay", "axes"]),
        ("exposure", &["--exposure", "-1.5"]),
        ("turn", &["--turn", "120"]),
        ("no-shadow", &["--without", "shadow"]),
        ("no-reflections", &["--without", "reflections"]),
        ("no-contact", &["--without", "contact"]),
        ("no-ao", &["--without", "ao"]),
    ] {
        let share = differs(&plain, &draw(name, more));
        assert!(share > 0.0005, "{name}: {share}");
    }
}

#[test]
fn green_that_is_turned_round_leans_the_other_way() {
    let folder = scratch_folder("green");
    // All of its normals lean up.
    let map = RgbaImage::from_pixel(4, 4, [128, 200, 230, 255].into());
    map.save(folder.join("figure_norm.png")).expect("the folder is there");
    let maps = folder.to_string_lossy();
    let [up, down] = [&[][..], &["--flip-green"]].map(|more| {
        let path = folder
            .join(format!("{}.png", more.len()))
            .to_string_lossy()
            .into_owned();
        let plain = ["render", FIGURE, "--textures", &maps, "--size", "160x120", "-o", &path];
        run(plain.iter().chain(more)).fine();
        image::open(&path).expect("is a picture").into_rgba8()
    });
    let share = differs(&up, &down);
    assert!(share > 0.01, "{share}");
}

#[test]
fn names_that_are_none_are_answered_with_those_that_are() {
    #[rustfmt::skip]
    let cases = [
        (["--light", "lamp"], "[possible values: studio, book]"),
        (["--view-mode", "fancy"], "[possible values: lit, base-color, normal-map"),
        (["--overlay", "lines"], "[possible values: grid, wireframe, normals, tangents, bounds, axes]"),
        (["--without", "light"], "[possible values: shadow, reflections, contact, ao]"),
        (["--background", "blue"], "a colour such as #20262e"),
        (["--split", "2"], "a fraction from 0 to 1"),
        (["--exposure", "inf"], "a finite number"),
    ];
    for (arguments, expected) in cases {
        let refused = run(["render", FIGURE, "-o", "nothing.png"].iter().chain(&arguments));
        assert!(refused.refused(2).contains(expected), "{arguments:?}: {}", refused.err);
    }
}
