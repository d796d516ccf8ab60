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
    assert!(download < 90_000, "{download} bytes of maps");
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
fn the_diffuse_map_leaves_the_materials_their_colours() {
    // Without its maps a material shows its own colour, so with them it must be about the same.
    let map = &MAPS[0];
    let mut sums = [0; 3];
    for texel in map.rgba.chunks_exact(4) {
        assert_eq!(texel[3], u8::MAX);
        for (sum, channel) in sums.iter_mut().zip(texel) {
            *sum += u32::from(*channel);
        }
    }
    let means = sums.map(|sum| sum / (map.side * map.side));
    assert!(means.iter().all(|mean| (200..=255).contains(mean)), "{means:?}");
}

#[test]
fn the_normal_map_holds_unit_directions_and_polish() {
    let (mut least, mut most) = (u8::MAX, 0);
    for texel in MAPS[1].rgba.chunks_exact(4) {
        let [x, y, z] = [0, 1, 2].map(|channel| f64::from(texel[channel]) / 127.5 - 1.0);
        let length = (x * x + y * y + z * z).sqrt();
        // Half a step of each of three channels.
        assert!((length - 1.0).abs() < 0.008 && z > 0.2, "{texel:?}");
        (least, most) = (least.min(texel[3]), most.max(texel[3]));
    }
    assert!(least < 130 && most > 200, "polish {least} … {most}");
}

#[test]
fn green_points_down_the_picture_as_in_directx() {
    // A groove that runs across is dark in its middle: above it the surface falls on the way down, so that its normal leans
    // down the picture, and below it leans up.
    let [tones, normals] = [&MAPS[0], &MAPS[1]];
    let side = tones.side as usize;
    let at = |map: &SampleMap, x: usize, y: usize, channel: usize| map.rgba[(y * side + x) * 4 + channel];
    let is_dark = |x: usize, y: usize| {
        (60..160).contains(&at(tones, x, y, 0)) && at(tones, x, y - 3, 0) == 255 && at(tones, x, y + 3, 0) == 255
    };
    let mut found = 0;
    for y in 4..side - 4 {
        for x in 4..side - 4 {
            // The middle row of a level groove.
            if (x - 4..=x + 4).all(|x| is_dark(x, y))
                && at(tones, x, y, 0) <= at(tones, x, y - 1, 0).min(at(tones, x, y + 1, 0))
            {
                found += 1;
                assert!(at(normals, x, y - 1, 1) > 128, "above {x} {y}");
                assert!(at(normals, x, y + 1, 1) < 127, "below {x} {y}");
            }
        }
    }
    assert!(found > 500, "{found} texels of grooves");
}
