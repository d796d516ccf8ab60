//! Maps: the committed pictures, their channels, and that they repeat.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use bindpose::format::LineMap;
use bindpose::import::m3d;
use bindpose::{image, scene};
use sample_figure::SampleMap;

use super::FIGURE;

static MAPS: LazyLock<Vec<SampleMap>> = LazyLock::new(sample_figure::maps);

#[test]
fn the_committed_maps_are_reproduced() {
    let mut download = 0;
    for map in &*MAPS {
        let committed = std::fs::read(sample_figure::folder().join(map.name))
            .expect("cargo run --package sample-figure writes the file that is missing");
        download += committed.len();
        // Texels, not bytes: another encoder may pack them otherwise.
        let picture = image::decode(&committed, map.name).expect("the project's own file is well formed");
        assert_eq!(
            (picture.width(), picture.height()),
            (map.side, map.side),
            "{}",
            map.name
        );
        assert!(
            picture.to_rgba8(0, 0).as_deref() == Some(map.rgba.as_slice()),
            "web/sample/{} is not what is made: cargo run --package sample-figure writes it anew",
            map.name
        );
    }
    assert!(download < 700_000, "{download} bytes of maps");
}

#[test]
fn the_materials_and_the_page_name_every_map() {
    let named = FIGURE
        .materials
        .iter()
        .flat_map(|material| [&material.diffuse_map, &material.normal_map]);
    let named: BTreeSet<&str> = named.flatten().map(String::as_str).collect();
    let made: BTreeSet<&str> = MAPS.iter().map(|map| map.name).collect();
    assert_eq!(named, made);
    let page = std::fs::read_to_string(sample_figure::folder().join("../boot.js")).expect("web/boot.js");
    for name in made {
        assert!(
            page.contains(&format!("\"{name}\": \"sample/{name}\"")),
            "the page leaves out {name}"
        );
    }
}

#[test]
fn without_its_maps_each_material_keeps_its_colour() {
    let (model, _) = m3d::from_document(&FIGURE, &LineMap::default()).expect("the figure is sound");
    for (index, material) in model.materials.iter().enumerate() {
        assert_eq!(
            scene::display_color(index, material),
            material.base_color(),
            "{}",
            material.name
        );
    }
}

#[test]
fn diffuse_maps_leave_the_materials_their_colours() {
    // Without its maps a material shows its own colour, so with them it must be about the same.
    for map in MAPS.iter().filter(|map| map.name.ends_with("_diff.png")) {
        let mut sums = [0; 3];
        for texel in map.rgba.chunks_exact(4) {
            assert_eq!(texel[3], u8::MAX, "{}", map.name);
            for (sum, channel) in sums.iter_mut().zip(texel) {
                *sum += u32::from(*channel);
            }
        }
        let means = sums.map(|sum| sum / (map.side * map.side));
        assert!(
            means.iter().all(|mean| (185..=255).contains(mean)),
            "{}: {means:?}",
            map.name
        );
    }
}

#[test]
fn normal_maps_hold_unit_directions_and_polish() {
    for map in MAPS.iter().filter(|map| map.name.ends_with("_norm.png")) {
        let (mut least, mut most) = (u8::MAX, 0);
        for texel in map.rgba.chunks_exact(4) {
            let [x, y, z] = [0, 1, 2].map(|channel| f64::from(texel[channel]) / 127.5 - 1.0);
            let length = (x * x + y * y + z * z).sqrt();
            // Half a step of each of three channels.
            assert!((length - 1.0).abs() < 0.008 && z > 0.2, "{}: {texel:?}", map.name);
            (least, most) = (least.min(texel[3]), most.max(texel[3]));
        }
        assert!(least < 130 && most > 200, "{}: polish {least} … {most}", map.name);
    }
}

#[test]
fn green_points_down_the_picture_as_in_directx() {
    let trim = MAPS.iter().find(|map| map.name == "trim_norm.png").expect("made above");
    // The groove along the border runs through the first and the last row: below it the relief rises on the way down, so
    // its normal leans back up; above it falls.
    let green = |row: u32| {
        let texel = (row * trim.side + trim.side / 2) as usize * 4;
        trim.rgba[texel + 1]
    };
    assert!(green(3) < 100, "{}", green(3));
    assert!(green(trim.side - 4) > 155, "{}", green(trim.side - 4));
}

#[test]
fn maps_repeat_without_an_edge() {
    for map in &*MAPS {
        let row = |row: u32| {
            let start = (row % map.side * map.side * 4) as usize;
            map.rgba[start..start + map.side as usize * 4].iter().copied()
        };
        let step = |from: u32| -> u64 {
            row(from)
                .zip(row(from + 1))
                .map(|(a, b)| u64::from(a.abs_diff(b)))
                .sum()
        };
        let greatest = (0..map.side - 1).map(step).max().expect("more than one row");
        // Grooves run along the edge, and both their flanks are steep.
        let over_edge = step(map.side - 1) as f64 / greatest as f64;
        assert!(over_edge < 1.1, "{}: {over_edge} of the greatest step inside", map.name);
    }
}
