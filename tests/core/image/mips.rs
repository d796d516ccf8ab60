//! Levels that are computed.

use bindpose::image::{Channels, Image, ImageFormat, MapKind, decode};

use super::blocks;
use super::dds::{CUBE_OF_SIX, Dds, LUMINANCE, RGB};
use super::level_texels;

fn image(width: u32, height: u32, texels: &[[u8; 4]]) -> Image {
    Image::from_rgba8(width, height, texels.as_flattened().to_vec(), "made").expect("the size fits")
}

const BLACK: [u8; 4] = [0, 0, 0, 255];
const WHITE: [u8; 4] = [255; 4];

#[test]
fn colours_are_averaged_as_light() {
    // Half the light of white is sRGB 188; the mean of the numbers would be 128.
    let checker = image(2, 2, &[BLACK, WHITE, WHITE, BLACK]).with_mips(MapKind::Diffuse);
    assert_eq!(checker.level_count(), 2);
    assert_eq!(level_texels(&checker, 0, 1), [[188, 188, 188, 255]]);
    assert!(checker.mips_generated());
    assert_eq!(checker.description(), "made 2 × 2, 2 mips made here");
}

#[test]
fn a_number_in_alpha_weights_no_colour() {
    let texels = [[255, 0, 0, 0], [0, 0, 255, 128]];
    let sheen = image(2, 1, &texels).with_mips(MapKind::Color);
    assert_eq!(level_texels(&sheen, 0, 0), texels);
    assert_eq!(level_texels(&sheen, 0, 1), [[188, 0, 188, 64]]);
    let [[red, _, blue, _]] = level_texels(&image(2, 1, &texels).with_mips(MapKind::Diffuse), 0, 1)[..] else {
        panic!("one texel")
    };
    assert!(
        red < 32 && blue > 240,
        "what is transparent has no colour: {red}, {blue}"
    );
}

#[test]
fn a_chain_goes_down_to_one_texel_and_keeps_the_mean() {
    // Columns black and white, 8 × 4: every level below is the same grey, without errors adding up.
    let texels: Vec<_> = (0..32)
        .map(|index| if index % 2 == 0 { BLACK } else { WHITE })
        .collect();
    let image = image(8, 4, &texels).with_mips(MapKind::Diffuse);
    assert_eq!(image.level_count(), 4);
    assert_eq!(level_texels(&image, 0, 0), texels);
    for (level, size) in [(1, (4, 2)), (2, (2, 1)), (3, (1, 1))] {
        assert_eq!(image.level_size(level), size);
        assert_eq!(
            level_texels(&image, 0, level),
            vec![[188, 188, 188, 255]; (size.0 * size.1) as usize]
        );
    }
}

//  5 texels for 2: each covers two and a half, so that none is lost
//  light  1    0    0    0    1      ->   1 / 2.5 = 0.4 each
//         5    0    0    0    0      ->   2 / 5 of it left, 0 right
#[test]
fn odd_sides_share_their_middle() {
    let row =
        |lit: &[usize]| -> Vec<[u8; 4]> { (0..5).map(|x| if lit.contains(&x) { WHITE } else { BLACK }).collect() };
    // sRGB of light 0.4 is 170, of 0.2 is 124.
    for (lit, expected) in [
        (vec![0, 4], [170, 170]),
        (vec![0], [170, 0]),
        (vec![2], [124, 124]),
        (vec![0, 1, 2, 3, 4], [255, 255]),
    ] {
        let wide = image(5, 1, &row(&lit)).with_mips(MapKind::Diffuse);
        let tall = image(1, 5, &row(&lit)).with_mips(MapKind::Diffuse);
        let values = |image| {
            level_texels(image, 0, 1)
                .iter()
                .map(|texel| texel[0])
                .collect::<Vec<_>>()
        };
        assert_eq!(
            (values(&wide), values(&tall)),
            (expected.to_vec(), expected.to_vec()),
            "{lit:?}"
        );
    }
    // 3 for 1: a third of the light each; sRGB of 1/3 is 156.
    let three = image(3, 3, &[BLACK, WHITE, BLACK].repeat(3)).with_mips(MapKind::Diffuse);
    assert_eq!(
        (three.level_count(), level_texels(&three, 0, 1)),
        (2, vec![[156, 156, 156, 255]])
    );
}

#[test]
fn clear_texels_lend_no_colour() {
    // Green leaves over clear magenta: the edge stays green.
    let leaf = image(2, 1, &[[0, 200, 0, 255], [255, 0, 255, 0]]).with_mips(MapKind::Diffuse);
    let [r, g, b, a] = level_texels(&leaf, 0, 1)[0];
    assert!(
        r <= 8 && g.abs_diff(200) <= 1 && b <= 8 && a.abs_diff(128) <= 1,
        "{:?}",
        [r, g, b, a]
    );
    // Where all is clear the colour is kept, so that filtering finds it.
    let clear = image(2, 1, &[[0, 200, 0, 0]; 2]).with_mips(MapKind::Diffuse);
    assert_eq!(level_texels(&clear, 0, 1), [[0, 200, 0, 0]]);
}

#[test]
fn means_of_directions_are_the_shorter_the_more_these_differ() {
    // 45° to the left and to the right: straight ahead, 0.7 of it. Alpha is gloss: a plain mean.
    let normals = image(2, 1, &[[218, 128, 218, 100], [37, 128, 218, 200]]).with_mips(MapKind::Normal);
    assert_eq!(level_texels(&normals, 0, 1), [[128, 128, 218, 150]]);
    // Opposite ones cancel out: no direction is left, and shaders take the surface's own.
    let opposed = image(2, 1, &[[255, 128, 128, 255], [0, 127, 127, 255]]).with_mips(MapKind::Normal);
    assert_eq!(level_texels(&opposed, 0, 1), [[128, 128, 128, 255]]);
    // Those of the file count as unit vectors, whatever their length.
    let short = image(2, 1, &[[173, 128, 173, 255]; 2]).with_mips(MapKind::Normal);
    assert_eq!(level_texels(&short, 0, 1), [[218, 128, 218, 255]]);
}

#[test]
fn of_two_channels_z_is_rebuilt_before_averaging() {
    // x of 0.8 and −0.8 with z of 0.6: straight ahead, of length 0.6. x of 0.8 and 0 with z of 0.6 and 1: 0.4, 0.8, of length 0.894.
    for (x, expected, length) in [([229, 26], 128, 153), ([229, 128], 185, 228)] {
        let dds = Dds::masked(RGB, 16, [0xff, 0xff00, 0, 0], 2, 1).file(&[x[0], 128, x[1], 128]);
        let image = decode(&dds, "norm.dds").expect("the file is sound");
        assert_eq!(image.channels(), Channels::RedGreen);
        let image = image.with_mips(MapKind::Normal);
        let [r, g, b, _] = level_texels(&image, 0, 1)[0];
        assert!(
            r.abs_diff(expected) <= 1 && g.abs_diff(128) <= 1 && b.abs_diff(length) <= 1,
            "{r} {g} {b}"
        );
        assert!(
            level_texels(&image, 0, 0).iter().all(|texel| texel[2] == 255),
            "of unit length"
        );
    }
}

#[test]
fn linear_floats_are_averaged_as_they_are() {
    let one_zero = [
        0x00, 0x3c, 0x00, 0x3c, 0x00, 0x3c, 0x00, 0x3c, 0, 0, 0, 0, 0, 0, 0x00, 0x3c,
    ];
    let image = decode(&Dds::dxgi(10, 2, 1).file(&one_zero), "sky.dds").expect("the file is sound");
    let image = image.with_mips(MapKind::Diffuse);
    assert_eq!(image.format(), ImageFormat::Rgba16Float);
    assert_eq!(image.to_rgba32f(0, 1), Some(vec![0.5, 0.5, 0.5, 1.0]));
    // Compressed ones keep their values beyond 1.
    let image = decode(&Dds::dxgi(95, 4, 4).file(&blocks::bc6h()), "sky.dds").expect("the file is sound");
    let image = image.with_mips(MapKind::Diffuse);
    assert_eq!((image.format(), image.level_count()), (ImageFormat::Rgba16Float, 3));
    assert_eq!(image.to_rgba32f(0, 2), Some(vec![1.0, 0.0, 65_504.0, 1.0]));
}

#[test]
fn compressed_pictures_are_decoded_and_every_face_gets_its_chain() {
    let mut dds = Dds::four_cc(b"DXT1", 4, 4);
    dds.caps2 = CUBE_OF_SIX;
    // Face by face red and blue in turn.
    let faces: Vec<u8> = (0..6)
        .flat_map(|face| {
            if face % 2 == 0 {
                [0, 0xf8, 0, 0, 0, 0, 0, 0]
            } else {
                [0x1f, 0, 0, 0, 0, 0, 0, 0]
            }
        })
        .collect();
    let image = decode(&dds.file(&faces), "cube.dds")
        .expect("the file is sound")
        .with_mips(MapKind::Diffuse);
    assert_eq!(
        (image.format(), image.level_count(), image.channels()),
        (ImageFormat::Rgba8, 3, Channels::Rgb)
    );
    assert_eq!(image.description(), "BC1 4 × 4 cube, 3 mips made here");
    for face in 0..6 {
        let colour = if face % 2 == 0 {
            [255, 0, 0, 255]
        } else {
            [0, 0, 255, 255]
        };
        assert_eq!(level_texels(&image, face, 2), [colour]);
    }
}

#[test]
fn levels_of_the_file_are_kept() {
    let file = Dds::masked(LUMINANCE, 8, [0xff, 0, 0, 0], 4, 4)
        .mips(2)
        .file(&[9; 16 + 4]);
    let image = decode(&file, "map.dds").expect("the file is sound");
    assert_eq!(image.clone().with_mips(MapKind::Diffuse), image);
    let single = Image::from_rgba8(1, 1, vec![1, 2, 3, 4], "made").expect("the size fits");
    assert_eq!(single.clone().with_mips(MapKind::Normal), single);
}

#[test]
fn a_level_is_reduced_to_a_limit_as_a_chain_would_be() {
    let texels: Vec<_> = (0..64)
        .map(|index| if index % 2 == 0 { BLACK } else { WHITE })
        .collect();
    let one = image(8, 8, &texels);
    let chain = one.clone().with_mips(MapKind::Diffuse);
    for (limit, side, level) in [(100, 8, 0), (8, 8, 0), (7, 4, 1), (2, 2, 2), (1, 1, 3)] {
        let reduced = one.reduced(0, MapKind::Diffuse, limit).expect("there is a level");
        assert_eq!(
            (reduced.width(), reduced.height(), reduced.level_count()),
            (side, side, 1)
        );
        assert_eq!(
            level_texels(&reduced, 0, 0),
            level_texels(&chain, 0, level),
            "limit {limit}"
        );
    }
    let of_second = chain.reduced(1, MapKind::Diffuse, 3).expect("there is a second level");
    assert_eq!(level_texels(&of_second, 0, 0), vec![[188, 188, 188, 255]; 4]);
    assert_eq!(one.reduced(1, MapKind::Diffuse, 4), None, "there is no second level");
}

#[test]
fn all_faces_of_a_cube_are_reduced_and_floats_stay_floats() {
    let cube = Dds {
        caps2: CUBE_OF_SIX,
        ..Dds::masked(LUMINANCE, 8, [0xff, 0, 0, 0], 4, 4)
    };
    let faces: Vec<u8> = (0..6).flat_map(|face| vec![40 * face; 16]).collect();
    let cube = decode(&cube.file(&faces), "cube.dds").expect("the cube is sound");
    let reduced = cube.reduced(0, MapKind::Diffuse, 2).expect("there is a level");
    assert_eq!((reduced.kind(), reduced.width()), (cube.kind(), 2));
    for face in 0..6 {
        let grey = 40 * face as u8;
        assert_eq!(level_texels(&reduced, face, 0), vec![[grey, grey, grey, 255]; 4]);
    }

    // Half floats: 0x3c00 is 1, 0x4200 is 3, 0x5000 is 32.
    let rows = [[0x3c00_u16, 0x3c00, 0x5000, 0x3c00], [0x4200, 0x3c00, 0x5000, 0x3c00]];
    let texels = rows.map(|texel| texel.repeat(2)).concat();
    let texels: Vec<u8> = texels.iter().flat_map(|value| value.to_le_bytes()).collect();
    let bright = decode(&Dds::dxgi(10, 2, 2).file(&texels), "bright.dds").expect("the picture is sound");
    let reduced = bright.reduced(0, MapKind::Diffuse, 1).expect("there is a level");
    assert_eq!(reduced.format(), ImageFormat::Rgba16Float);
    assert_eq!(reduced.to_rgba32f(0, 0), Some(vec![2.0, 1.0, 32.0, 1.0]));
}

/// The next smaller level as it is written down: each texel is the mean of what it covers, channel by channel.
fn textbook_half([width, height]: [usize; 2], texels: &[[f32; 4]]) -> Vec<[f32; 4]> {
    // Texels of a side with their weights in one of the smaller side.
    let covered = |side: usize, index: usize| {
        let (first, half) = (2 * index, side / 2);
        let part = |part: usize| part as f32 / side as f32;
        match side {
            1 => vec![(0, 1.0)],
            _ if side % 2 == 1 => vec![
                (first, part(half - index)),
                (first + 1, part(half)),
                (first + 2, part(index + 1)),
            ],
            _ => vec![(first, 0.5), (first + 1, 0.5)],
        }
    };
    let mut smaller = Vec::new();
    for row in 0..(height / 2).max(1) {
        for column in 0..(width / 2).max(1) {
            let mut mean = [0.0_f32; 4];
            for (y, row_weight) in covered(height, row) {
                for (x, column_weight) in covered(width, column) {
                    for (sum, value) in mean.iter_mut().zip(texels[y * width + x]) {
                        *sum += row_weight * column_weight * value;
                    }
                }
            }
            smaller.push(mean);
        }
    }
    smaller
}

fn textbook_read(kind: MapKind, [r, g, b, a]: [u8; 4]) -> [f32; 4] {
    match kind {
        MapKind::Color => {
            let [r, g, b] = [r, g, b].map(|value| textbook_light(f32::from(value) / 255.0));
            [r, g, b, f32::from(a) / 255.0]
        }
        MapKind::Diffuse => {
            let weight = 1.0 / 1024.0 + f32::from(a) / 255.0 * (1.0 - 1.0 / 1024.0);
            let [r, g, b] = [r, g, b].map(|value| textbook_light(f32::from(value) / 255.0) * weight);
            [r, g, b, weight]
        }
        MapKind::Normal => {
            let direction = [r, g, b].map(|value| f32::from(value) / 127.5 - 1.0);
            let length = direction.iter().map(|value| value * value).sum::<f32>().sqrt();
            let [x, y, z] = direction.map(|value| value / length);
            [x, y, z, f32::from(a) / 255.0]
        }
        MapKind::Data => [r, g, b, a].map(|value| f32::from(value) / 255.0),
    }
}

fn textbook_written(kind: MapKind, [x, y, z, w]: [f32; 4]) -> [u8; 4] {
    let unit = |value: f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
    // As many bytes as have a middle between them and the next that is not above the light.
    let middle = |byte| textbook_light((f32::from(byte) + 0.5) / 255.0);
    let middles: Vec<f32> = (0_u8..255).map(middle).collect();
    let byte = |light: f32| middles.iter().filter(|&&middle| middle <= light).count() as u8;
    match kind {
        MapKind::Color => [byte(x), byte(y), byte(z), unit(w)],
        MapKind::Diffuse => {
            let alpha = unit((w - 1.0 / 1024.0) / (1.0 - 1.0 / 1024.0));
            [byte(x / w), byte(y / w), byte(z / w), alpha]
        }
        MapKind::Normal => {
            let [x, y, z] = [x, y, z].map(|value| unit(value * 0.5 + 0.5));
            [x, y, z, unit(w)]
        }
        MapKind::Data => [x, y, z, w].map(unit),
    }
}

/// Linear light of an encoded value, 0 … 1 (IEC 61966-2-1).
fn textbook_light(value: f32) -> f32 {
    if value <= 0.040_45 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}

#[test]
fn every_byte_of_the_levels_is_that_of_the_textbook() {
    let mut state = 0x2545_f491_u32;
    let mut noise = move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state.to_le_bytes()
    };
    for [width, height] in [[32_u32, 16], [17, 9], [1, 7], [8, 1], [6, 5], [2, 2]] {
        for kind in MapKind::ALL {
            for clear in [false, true] {
                let texels: Vec<[u8; 4]> = (0..width * height)
                    .map(|index| {
                        let [r, g, b, a] = noise();
                        // Also texels without any alpha, and opposite directions that cancel out.
                        match index % 5 {
                            0 if clear => [r, g, b, 0],
                            1 if clear => [0, 0, 0, a],
                            2 if clear => [255, 255, 255, 255],
                            _ => [r, g, b, a],
                        }
                    })
                    .collect();
                let made = image(width, height, &texels).with_mips(kind);
                let mut size = [width as usize, height as usize];
                let mut values: Vec<[f32; 4]> = texels.iter().map(|&texel| textbook_read(kind, texel)).collect();
                for level in 1..made.level_count() {
                    values = textbook_half(size, &values);
                    size = size.map(|side| (side / 2).max(1));
                    let expected: Vec<[u8; 4]> = values.iter().map(|&value| textbook_written(kind, value)).collect();
                    let case = format!("{width} x {height}, {kind:?}, level {level}");
                    assert_eq!(level_texels(&made, 0, level), expected, "{case}");
                }
            }
        }
    }
}
