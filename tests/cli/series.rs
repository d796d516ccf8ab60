//! `bindpose render` of many pictures: through the clip, around the model, on a sheet, with ghosts.

use std::path::Path;

use image::{RgbaImage, imageops};

use crate::program::{FIGURE, bindpose, fixture, run, run_command, scratch, scratch_folder, words};
use crate::render::{draw, extent, share_that_differs};

/// Draws into a folder, and gives what was printed.
fn fill(folder: &Path, file: &str, arguments: &[&str]) -> String {
    let path = folder.to_str().expect("UTF-8");
    run(["render", file, "-o", path].iter().chain(arguments)).fine()
}

/// Names of all files of a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder was made");
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.expect("can be listed").file_name();
    let mut names: Vec<String> = entries
        .map(|entry| name(entry).to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// `frame-0000.png` and so on.
fn frames(count: usize) -> Vec<String> {
    (0..count).map(|index| format!("frame-{index:04}.png")).collect()
}

fn bytes(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn picture(path: &Path) -> RgbaImage {
    image::open(path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
        .into_rgba8()
}

/// The walk has 32 steps of 1/30 s.
const WALK: [&str; 4] = ["--clip", "Walk", "--size", "64x48"];

#[test]
fn frames_go_through_the_clip_and_leave_its_end_out() {
    let folder = scratch_folder("frames");
    std::fs::write(folder.join("notes.txt"), "mine").expect("writes");
    std::fs::write(folder.join("frame-0001.png"), "of an earlier run").expect("writes");
    std::fs::write(folder.join("frame-0009.png"), "of a longer run").expect("writes");
    let printed = fill(&folder, FIGURE, &[&WALK[..], &["--frames", "4"]].concat());
    assert!(
        printed.contains("frames: 4 pictures of 64x48, Walk from 0.000 s to 0.800 s, drawn by "),
        "{printed}"
    );
    let mut expected = frames(4);
    expected.extend(["frame-0009.png", "notes.txt"].map(str::to_owned));
    assert_eq!(names(&folder), expected, "what is not of this run stays");
    assert_eq!(bytes(&folder.join("notes.txt")), b"mine");

    // Each is the picture that its time alone gives: START + i * LENGTH / N, to the byte.
    let clips = run(["info", FIGURE, "--json"]).json()["clips"].take();
    let walk = clips
        .as_array()
        .and_then(|clips| clips.iter().find(|clip| clip["name"] == "Walk"));
    let end_secs = walk
        .and_then(|walk| walk["end_secs"].as_f64())
        .expect("the walk has an end") as f32;
    for (index, name) in frames(4).iter().enumerate() {
        let time = ((index as f64 * f64::from(end_secs) / 4.0) as f32).to_string();
        let alone = scratch(&format!("alone-{index}.png"));
        fill(&alone, FIGURE, &[&WALK[..], &["--time", &time]].concat());
        assert!(bytes(&folder.join(name)) == bytes(&alone), "{name} at {time} s");
    }
}

#[test]
fn a_rate_makes_as_many_frames_as_begin_before_the_end() {
    for (rate, count) in [("3", 4), ("30", 32), ("0.5", 1)] {
        let folder = scratch(&format!("rate-{rate}"));
        fill(&folder, FIGURE, &["--clip", "Walk", "--size", "16x16", "--fps", rate]);
        assert_eq!(names(&folder), frames(count), "{rate}");
    }
}

#[test]
fn every_kind_of_picture_has_the_same_bytes_every_time() {
    for (name, arguments) in [
        ("frames", &["--frames", "3"][..]),
        ("turn", &["--turntable", "3", "--light", "book"]),
        ("both", &["--turntable", "3", "--frames", "2", "--crowd", "3"]),
        ("ghosts", &["--frames", "2", "--ghosts", "2", "--transparent"]),
    ] {
        let [first, second] = ["first", "second"].map(|run| {
            let folder = scratch(&format!("{name}-{run}"));
            fill(&folder, FIGURE, &[&WALK[..], arguments].concat());
            folder
        });
        assert_eq!(names(&first), names(&second), "{name}");
        assert!(names(&first).len() > 1, "{name}");
        for file in names(&first) {
            assert!(
                bytes(&first.join(&file)) == bytes(&second.join(&file)),
                "{name}: {file}"
            );
        }
    }
    let [first, second] = ["first.png", "second.png"].map(|run| {
        let sheet = scratch(&format!("sheet-{run}"));
        fill(&sheet, FIGURE, &["--size", "200x150", "--sheet", "2x2"]);
        bytes(&sheet)
    });
    assert!(first == second, "the sheet");
}

#[test]
fn a_turntable_looks_from_all_sides_and_the_model_stays_in_its_middle() {
    let folder = scratch("turntable");
    let turn = words("--clip Walk --size 90x120 --view front --transparent --turntable 4");
    let printed = fill(&folder, FIGURE, &turn);
    assert!(
        printed.contains(": 4 pictures of 90x120, Walk at 0 s, all round, "),
        "{printed}"
    );
    assert_eq!(names(&folder), frames(4));
    let pictures: Vec<_> = frames(4).iter().map(|name| picture(&folder.join(name))).collect();
    for (index, picture) in pictures.iter().enumerate() {
        let [left, right, top, bottom] = extent(picture).expect("something is drawn");
        assert!(left > 0 && right < 89 && top > 0 && bottom < 119, "{index}");
        let middle = (left + right) / 2;
        assert!((25..65).contains(&middle) && bottom - top > 70, "{index}: {middle}");
        for other in &pictures[..index] {
            assert!(share_that_differs(picture, other, 24) > 0.05, "{index}");
        }
    }
    // Right and left of a figure are outlines of each other, turned round.
    let [from_right, from_left] = [&pictures[1], &pictures[3]].map(|picture| extent(picture).expect("is drawn"));
    let mirrored = [89 - from_left[1], 89 - from_left[0]];
    assert!(from_right[0].abs_diff(mirrored[0]) < 8 && from_right[1].abs_diff(mirrored[1]) < 8);
}

#[test]
fn a_clip_and_a_turntable_go_on_together() {
    let folder = scratch("together");
    let printed = fill(
        &folder,
        FIGURE,
        &[&WALK[..], &["--turntable", "4", "--frames", "2"]].concat(),
    );
    assert!(
        printed.contains(": 4 pictures of 64x48, Walk from 0.000 s to 0.533 s, all round, "),
        "{printed}"
    );
    let turned = scratch("turned");
    fill(
        &turned,
        FIGURE,
        &[&WALK[..], &["--turntable", "4", "--time", "0"]].concat(),
    );
    // The clip begins again with the third picture, which is the one of the turn alone; the second has another pose.
    let same = |index: usize| bytes(&folder.join(&frames(4)[index])) == bytes(&turned.join(&frames(4)[index]));
    assert_eq!([0, 1, 2, 3].map(same), [true, false, true, false]);
}

/// The sheet's own ground, dark.
const GROUND: [u8; 4] = [0x18, 0x1b, 0x21, 255];

#[test]
fn a_sheet_has_every_picture_and_a_label_under_each() {
    let arguments = words("--clip Walk --size 360x260 --sheet 2x2 --frames 3");
    let (sheet, printed) = draw("sheet.png", FIGURE, &arguments);
    assert_eq!(sheet.dimensions(), (360, 260));
    let told = printed
        .split("360x260, 3 pictures of ")
        .nth(1)
        .expect("says the size of its pictures");
    let cell = told.split(',').next().expect("a size");
    assert!(told.contains("Walk from 0.000 s to 0.711 s, drawn by "), "{printed}");

    // The same pictures in a folder are found on the sheet, to the pixel.
    let folder = scratch("cells");
    fill(&folder, FIGURE, &["--clip", "Walk", "--size", cell, "--frames", "3"]);
    let [first, second, third] = [0, 1, 2].map(|index| picture(&folder.join(&frames(3)[index])));
    let (width, height) = first.dimensions();
    let at = |x: u32, y: u32| imageops::crop_imm(&sheet, x, y, width, height).to_image();
    let is_ground = |x: u32, y: u32| sheet.get_pixel(x, y).0 == GROUND;
    let left = (0..360).find(|&x| !is_ground(x, 60)).expect("a picture");
    let top = (0..260).find(|&y| !is_ground(60, y)).expect("a picture");
    let right = (left + width..360).find(|&x| !is_ground(x, 60)).expect("the second");
    // Between both ends of a label is nothing.
    let middle = left + width / 2;
    let below = (top + height..260).find(|&y| !is_ground(middle, y)).expect("the third");
    assert!(at(left, top) == first && at(right, top) == second && at(left, below) == third);

    // Under each picture is text at both ends of its label, and where there is no picture is nothing.
    let inked = |x: u32, y: u32, columns: u32| {
        let label = (y + height..y + height + 14).flat_map(|y| (x..x + columns).map(move |x| (x, y)));
        label.filter(|&(x, y)| sheet.get_pixel(x, y).0[2] > 90).count()
    };
    for (x, y) in [(left, top), (right, top), (left, below)] {
        assert!(inked(x, y, width / 3) > 20, "the time at {x}, {y}");
        assert!(inked(x + width - width / 3, y, width / 3) > 20, "the frame at {x}, {y}");
    }
    let empty = imageops::crop_imm(&sheet, right, below, 360 - right, 260 - below).to_image();
    assert!(empty.pixels().all(|pixel| pixel.0 == GROUND));
}

#[test]
fn a_sheet_alone_shows_the_clip_and_with_a_turntable_a_model_without_one() {
    let (_, printed) = draw("whole.png", FIGURE, &words("--clip Walk --size 200x200 --sheet 2x2"));
    assert!(
        printed.contains(", 4 pictures of ") && printed.contains("Walk from 0.000 s to 0.800 s"),
        "{printed}"
    );
    let still = fixture("good/d3d11_static.m3d");
    let round = words("--size 200x100 --sheet 2x1 --turntable 2 --transparent");
    let (sheet, printed) = draw("round.png", &still, &round);
    assert!(
        printed.contains(", 2 pictures of ") && printed.contains(", all round, "),
        "{printed}"
    );
    assert_eq!(sheet.get_pixel(0, 0).0, [0; 4], "no ground");
    assert!(extent(&sheet).is_some());
}

#[test]
fn ghosts_stand_before_and_after_where_the_clip_has_poses() {
    let plain = ["--clip", "Walk", "--size", "160x120", "--view", "right"];
    // Pixels that are bluer, and that are yellower, than without ghosts.
    let tinted = |name: &str, time: &str| {
        let at = [&plain[..], &["--time", time]].concat();
        let (without, _) = draw(&format!("{name}-plain.png"), FIGURE, &at);
        let more = [&at[..], &["--ghosts", "2", "--ghost-step", "4"]].concat();
        let (with, _) = draw(&format!("{name}.png"), FIGURE, &more);
        let mut counts = [0, 0];
        for (a, b) in without.pixels().zip(with.pixels()) {
            let tint = |pixel: &image::Rgba<u8>| i32::from(pixel[2]) - i32::from(pixel[0]);
            counts[0] += usize::from(tint(b) - tint(a) > 30);
            counts[1] += usize::from(tint(a) - tint(b) > 30);
        }
        counts
    };
    let [past, future] = tinted("ghosts-middle", "0.5");
    assert!(past > 50 && future > 50, "{past} {future}");
    let [past, future] = tinted("ghosts-start", "0");
    assert!(past == 0 && future > 50, "{past} {future}");
}

#[test]
fn a_picture_is_replaced_whole_and_nothing_is_left_beside_it() {
    let folder = scratch_folder("whole");
    let path = folder.join("picture.png");
    std::fs::write(&path, "an older picture").expect("writes");
    let told = fill(&path, FIGURE, &["--size", "16x16"]);
    assert!(told.contains("16x16"), "{told}");
    assert_eq!(picture(&path).dimensions(), (16, 16));
    // A folder stands in the picture's place.
    let taken = folder.join("taken.png");
    std::fs::create_dir_all(&taken).expect("makes a folder");
    for arguments in [&["--size", "16x16"][..], &["--size", "99x99", "--sheet", "2x2"]] {
        let run = run([&["render", FIGURE, "-o", taken.to_str().expect("UTF-8")], arguments].concat());
        assert_eq!(run.code, Some(2));
        assert!(run.err.contains("taken.png cannot be written: "), "{}", run.err);
    }
    assert_eq!(names(&folder), ["picture.png", "taken.png"]);
    assert_eq!(names(&taken), Vec::<String>::new());
}

#[test]
fn a_pipe_hears_nothing_of_the_progress() {
    let folder = scratch("piped");
    let path = folder.to_str().expect("UTF-8");
    let run = run(["render", FIGURE, "-o", path, "--size", "16x16", "--frames", "5"]);
    assert_eq!((run.code, run.err.as_str()), (Some(0), ""));
}

/// `script` runs a command in a terminal of its own, and hands on what that shows.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_is_told_how_far_it_is() {
    let folder = scratch("shown");
    let command = format!(
        "{} render {FIGURE} -o {} --size 400x300 --frames 12",
        env!("CARGO_BIN_EXE_bindpose"),
        folder.display()
    );
    let mut script = std::process::Command::new("script");
    let shown = run_command(script.args(["-qec", &command, "/dev/null"]).env("TERM", "xterm")).fine();
    assert!(shown.contains(" of 12 pictures, "), "{shown}");
    assert_eq!(names(&folder), frames(12));
}

#[test]
fn the_help_says_how_a_film_is_made() {
    let help = run_command(bindpose().args(["render", "--help"])).fine();
    for word in words("--frames --fps --turntable --sheet --ghosts")
        .into_iter()
        .chain(["ffmpeg -framerate 30"])
    {
        assert!(help.contains(word), "{word} is not in\n{help}");
    }
}
