//! Radiance pictures, and the cubes that they become.

use bindpose::image::{Channels, Image, ImageFormat, ImageKind, MapKind, check, cube_side, decode};
use glam::Vec3;

use crate::radiance::{direction, header, panorama, rgbe};

fn cube(bytes: &[u8]) -> Image {
    decode(bytes, "sky.hdr").unwrap_or_else(|error| panic!("{error}"))
}

/// The light of the texel in the middle of each face.
fn middles(image: &Image) -> Vec<[f32; 3]> {
    let middle = ((image.height() / 2) * image.width() + image.width() / 2) as usize;
    let of_face = |face| {
        let texels = image.to_rgba32f(face, 0).expect("the level is there");
        [0, 1, 2].map(|channel| texels[middle * 4 + channel])
    };
    (0..6).map(of_face).collect()
}

/// As bright along each axis as these say: +x, −x, +y, −y, +z, −z.
fn along_axes(towards: Vec3) -> Vec3 {
    let [x, y, z] = towards.to_array();
    let strengths = [x, -x, y, -y, z, -z].map(|along| along.max(0.0).powi(2));
    let colors = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];
    let sum: f32 = strengths
        .into_iter()
        .zip(colors)
        .map(|(strength, color)| strength * color)
        .sum();
    Vec3::new(sum, 100.0 * sum, 0.5 * sum)
}

fn assert_along_axes(image: &Image, words: &str) {
    for (face, ([red, green, blue], expected)) in middles(image)
        .into_iter()
        .zip([1.0, 2.0, 4.0, 8.0, 16.0, 32.0])
        .enumerate()
    {
        let near = |value: f32, expected: f32, by: f32| (value / expected - 1.0).abs() < by;
        assert!(
            near(green, 100.0 * expected, 0.03),
            "{words}, face {face}: {green} for {}",
            100.0 * expected
        );
        // The common exponent leaves these few bits.
        assert!(
            near(red, expected, 0.7) && blue <= expected,
            "{words}, face {face}: {red} {blue}"
        );
    }
}

#[test]
fn a_panorama_becomes_the_cube_that_shows_the_same() {
    let bytes = panorama(256, along_axes);
    let image = cube(&bytes);
    assert_eq!(
        (image.kind(), image.format(), image.channels()),
        (ImageKind::Cube, ImageFormat::Rgbe, Channels::Rgb)
    );
    assert_eq!(image.description(), "Radiance 64 × 64 cube, 1 mip");
    assert_eq!((cube_side(&bytes), cube_side(b"#?RGBE\n")), (Some(64), Some(0)));
    assert_along_axes(&image, "as it is");
    let mips = image.with_mips(MapKind::Diffuse);
    assert_eq!((mips.level_count(), mips.format()), (7, ImageFormat::Rgbe));
    let last = mips.to_rgba32f(5, 6).expect("the level is there");
    let mean: f32 = middles(&mips)[5][1];
    assert!(
        last[1] > 0.4 * mean && last[1] < mean,
        "{} of {mean} in the middle",
        last[1]
    );
}

#[test]
fn rows_may_come_from_below_and_from_the_right_and_be_exposed() {
    let plain = panorama(64, along_axes);
    let texels = &plain[header(64, 32).len()..];
    let rows: Vec<&[u8]> = texels.chunks(64 * 4).collect();
    let turned: Vec<u8> = rows.iter().rev().copied().flatten().copied().collect();
    let mirrored: Vec<u8> = rows
        .iter()
        .flat_map(|row| row.as_chunks::<4>().0.iter().rev().copied().flatten())
        .collect();
    for (size, texels) in [("+Y 32 +X 64", turned), ("-Y 32 -X 64", mirrored)] {
        let head = format!("#?RGBE\nEXPOSURE=2\nSOFTWARE=x\nEXPOSURE= 0.5\n\n{size}\n");
        let bytes = [head.as_bytes(), &texels].concat();
        assert_eq!(cube(&bytes).data(), cube(&plain).data(), "{size}");
    }
    let head = b"#?RADIANCE\nEXPOSURE=4\n\n-Y 32 +X 64\n";
    let exposed = cube(&[head, texels].concat());
    let quarter: Vec<_> = middles(&cube(&plain)).into_iter().map(|light| light[1] / 4.0).collect();
    let found: Vec<_> = middles(&exposed).into_iter().map(|light| light[1]).collect();
    assert_eq!(found, quarter);
}

/// A row with each channel by itself: the first three bytes as they are, the rest as a run where it is one.
fn in_runs(row: &[[u8; 4]]) -> Vec<u8> {
    let mut bytes = vec![2, 2, (row.len() >> 8) as u8, row.len() as u8];
    for channel in 0..4 {
        let mut rest: Vec<u8> = row.iter().map(|texel| texel[channel]).collect();
        while let Some(&first) = rest.first() {
            let same = rest.iter().take(127).take_while(|&&value| value == first).count();
            if same > 1 {
                bytes.extend([128 + same as u8, first]);
                rest.drain(..same);
            } else {
                let count = rest.len().min(3);
                bytes.push(count as u8);
                bytes.extend(rest.drain(..count));
            }
        }
    }
    bytes
}

#[test]
fn runs_of_both_kinds_are_the_same_as_whole_texels() {
    let light = |towards: Vec3| {
        if towards.y > 0.0 {
            Vec3::new(1.0, 2.0, 3.0)
        } else {
            along_axes(towards)
        }
    };
    let plain = panorama(512, light);
    let rows = || plain[header(512, 256).len()..].as_chunks::<4>().0.chunks(512);
    let by_channel: Vec<u8> = rows().flat_map(in_runs).collect();
    // A run of 300 is its 44 and its 1 · 256 in two texels.
    let old = |row: &[[u8; 4]]| {
        let is_even = row.iter().all(|texel| *texel == row[0]);
        let run = [row[0], [1, 1, 1, 255], [1, 1, 1, 1]];
        if is_even {
            run.as_flattened().to_vec()
        } else {
            row.as_flattened().to_vec()
        }
    };
    let with_repeats: Vec<u8> = rows().flat_map(old).collect();
    assert!(by_channel.len() < plain.len() * 3 / 4 && with_repeats.len() < plain.len() * 6 / 10);
    for (words, rows) in [("by channel", by_channel), ("repeated", with_repeats)] {
        let bytes = [header(512, 256), rows].concat();
        assert_eq!(cube(&bytes).data(), cube(&plain).data(), "{words}");
        // Wherever it ends, that is told.
        for length in (0..bytes.len()).step_by(997) {
            let error = decode(&bytes[..length], "sky.hdr").expect_err("it is cut");
            assert!(
                ["image-cut", "image-empty", "image-unrecognized"].contains(&error.code),
                "{words}, {length}: {error}"
            );
        }
    }
}

#[test]
fn a_wide_panorama_is_averaged_and_its_faces_have_1024_texels() {
    // Rows alternate between 0 and 2: each square of four has the mean 1.
    let mut bytes = header(8192, 4096);
    let rows = [Vec3::ZERO, Vec3::splat(2.0)].map(|light| in_runs(&vec![rgbe(light); 8192]));
    (0..2048).for_each(|_| bytes.extend(rows.concat()));
    let image = cube(&bytes);
    assert_eq!((image.width(), cube_side(&bytes)), (1024, Some(1024)));
    assert_eq!(middles(&image), [[1.0; 3]; 6]);
    assert_eq!(image.level(2, 0).map(|texels| &texels[..4]), Some(&rgbe(Vec3::ONE)[..]));
}

#[test]
fn what_is_no_sound_panorama_is_told() {
    let of = |head: &str| {
        check(head.as_bytes(), "a.hdr")
            .expect_err("it is not sound")
            .to_string()
    };
    let sized = |size: &str| of(&format!("#?RADIANCE\n\n{size}\n"));
    let cases = [
        (
            of("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 2 +X 4\n"),
            "a.hdr: the Radiance file holds pixels of the format 32-bit_rle_xyze, which is not read",
        ),
        (
            of("#?RADIANCE\nEXPOSURE=1"),
            "a.hdr: the Radiance file ends or is damaged in its header",
        ),
        (
            sized("-Y 4096 +X 8194"),
            "a.hdr: a panorama of 8194 × 4096 cannot be shown; it may have at most 8192 × 4096",
        ),
        (
            sized("-Y 0 +X 0"),
            "a.hdr: a panorama of 0 × 0 cannot be shown; it may have at most 8192 × 4096",
        ),
        (
            sized("-Y 100 +X 100"),
            "a.hdr: a panorama of the whole sky is twice as wide as high, and this one is 100 × 100",
        ),
        (
            sized("+X 4 -Y 2"),
            "a.hdr: the Radiance file gives its size as \"+X 4 -Y 2\", not as \"-Y 1024 +X 2048\", which is not read",
        ),
        (
            sized("-Y 99999999999 +X 4"),
            "a.hdr: the Radiance file gives its size as \"-Y 99999999999 +X 4\", which are no two numbers, which is not read",
        ),
    ];
    for (found, expected) in cases {
        assert_eq!(found, expected);
    }
    let mut bytes = header(32, 16);
    // A run that is longer than its row, one of nothing, and a repeat before the first texel.
    for row in [&[2, 2, 0, 32, 128 + 33, 7][..], &[2, 2, 0, 32, 0, 7], &[1, 1, 1, 4]] {
        let length = bytes.len();
        bytes.extend(row.iter().chain(&[0; 4096]));
        let error = decode(&bytes, "a.hdr").expect_err("it is damaged");
        assert_eq!(
            error.to_string(),
            "a.hdr: the Radiance file ends or is damaged in its row 0 of 16"
        );
        bytes.truncate(length);
    }
}

#[test]
fn the_directions_of_the_helper_are_those_of_the_format() {
    // The middle of the picture looks along +z, a quarter to the right along +x.
    assert!(direction(1024, 512, 256).distance(Vec3::Z) < 0.01 && direction(1024, 768, 256).distance(Vec3::X) < 0.01);
}
