//! Sizes, mips, cubes and arrays.

use bindpose::image::{Image, ImageKind, decode};

use super::blocks::{BC1_OPAQUE, bc2};
use super::dds::{CUBE_OF_SIX, Dds, RGB};
use super::{level_texels, texels};

fn read(bytes: &[u8]) -> Image {
    decode(bytes, "map.dds").expect("the file is sound")
}

/// A block of BC1 in one colour.
fn solid(colour_565: u16) -> Vec<u8> {
    let [low, high] = colour_565.to_le_bytes();
    vec![low, high, 0, 0, 0, 0, 0, 0]
}

const RED: u16 = 0xf800;
const GREEN: u16 = 0x07e0;
const BLUE: u16 = 0x001f;
const WHITE: u16 = 0xffff;

//  a 6 × 5 picture of four blocks: the right ones are cut to 2 columns, the lower ones to 1 row
//  R R R R G G
//  R R R R G G
//  R R R R G G
//  R R R R G G
//  B B B B W W
#[test]
fn blocks_are_cut_at_the_edges() {
    let image =
        read(&Dds::four_cc(b"DXT1", 6, 5).file(&[solid(RED), solid(GREEN), solid(BLUE), solid(WHITE)].concat()));
    let [red, green, blue, white] = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255; 4]];
    let upper = [red, red, red, red, green, green];
    let lower = [blue, blue, blue, blue, white, white];
    assert_eq!(texels(&image), [upper, upper, upper, upper, lower].concat());
}

#[test]
fn sizes_need_no_power_of_two() {
    for (width, height) in [(1_u32, 1_u32), (2, 1), (1, 3), (3, 3), (5, 7), (208, 256), (13, 4)] {
        let block_count = width.div_ceil(4) * height.div_ceil(4);
        let image = read(&Dds::four_cc(b"DXT3", width, height).file(&bc2().repeat(block_count as usize)));
        assert_eq!((image.width(), image.height()), (width, height));
        assert_eq!(
            image.to_rgba8(0, 0).map(|texels| texels.len()),
            Some((width * height * 4) as usize)
        );
    }
    let grey = Dds::masked(super::dds::LUMINANCE, 8, [0xff, 0, 0, 0], 3, 2).file(&[1, 2, 3, 4, 5, 6]);
    let values: Vec<_> = texels(&read(&grey)).iter().map(|texel| texel[0]).collect();
    assert_eq!(values, [1, 2, 3, 4, 5, 6]);
}

#[test]
fn a_mip_count_of_0_means_1() {
    for mip_count in [0, 1] {
        let image = read(&Dds::four_cc(b"DXT1", 4, 4).mips(mip_count).file(&BC1_OPAQUE));
        assert_eq!((image.level_count(), image.mips_generated()), (1, false));
        assert_eq!(image.level(0, 1), None);
    }
}

#[test]
fn levels_halve_and_never_vanish() {
    //  8 × 2, 4 × 1, 2 × 1, 1 × 1
    let levels: Vec<u8> = [16, 4, 2, 1]
        .into_iter()
        .zip(1..)
        .flat_map(|(len, value)| vec![value; len])
        .collect();
    let file = Dds::masked(super::dds::LUMINANCE, 8, [0xff, 0, 0, 0], 8, 2)
        .mips(4)
        .file(&levels);
    let image = read(&file);
    assert_eq!(image.description(), "L8 8 × 2, 4 mips");
    for (level, size) in [(0, (8, 2)), (1, (4, 1)), (2, (2, 1)), (3, (1, 1))] {
        assert_eq!(image.level_size(level), size);
        let value = level as u8 + 1;
        let count = (size.0 * size.1) as usize;
        assert_eq!(level_texels(&image, 0, level), vec![[value, value, value, 255]; count]);
    }
    assert_eq!(
        (image.level(0, 4), image.to_rgba8(0, 4), image.to_rgba32f(1, 0)),
        (None, None, None)
    );
}

#[test]
fn small_levels_of_compressed_pictures_take_a_block_each() {
    let levels = [
        solid(RED),
        solid(RED),
        solid(RED),
        solid(RED),
        solid(GREEN),
        solid(BLUE),
        solid(WHITE),
    ]
    .concat();
    let image = read(&Dds::four_cc(b"DXT1", 8, 8).mips(4).file(&levels));
    for (level, colour) in [
        (0, [255, 0, 0, 255]),
        (1, [0, 255, 0, 255]),
        (2, [0, 0, 255, 255]),
        (3, [255; 4]),
    ] {
        assert!(
            level_texels(&image, 0, level).iter().all(|&texel| texel == colour),
            "level {level}"
        );
    }
}

#[test]
fn cubes_have_six_faces_with_their_levels() {
    // Each face: 2 × 2 of one grey and 1 × 1 of another.
    let faces: Vec<u8> = (0..6)
        .flat_map(|face| [face * 10, face * 10, face * 10, face * 10, face * 10 + 1])
        .collect();
    let mut old = Dds::masked(super::dds::LUMINANCE, 8, [0xff, 0, 0, 0], 2, 2).mips(2);
    old.caps2 = CUBE_OF_SIX;
    let mut dx10 = Dds::dxgi(61, 2, 2).mips(2);
    dx10.dx10 = Some([61, 3, 4, 1, 0]);
    for file in [old.file(&faces), dx10.file(&faces)] {
        let image = read(&file);
        assert_eq!((image.kind(), image.face_count()), (ImageKind::Cube, 6));
        assert_eq!(image.description(), "L8 2 × 2 cube, 2 mips");
        for face in 0..6 {
            assert_eq!(level_texels(&image, face, 0)[3][0], face as u8 * 10);
            assert_eq!(level_texels(&image, face, 1)[0][0], face as u8 * 10 + 1);
        }
        assert_eq!(image.level(6, 0), None);
    }
}

#[test]
fn of_an_array_the_first_slice_is_shown() {
    let mut dds = Dds::dxgi(61, 2, 1).mips(2);
    dds.dx10 = Some([61, 3, 0, 3, 0]);
    let image = read(&dds.file(&[1, 2, 3, 4, 5, 6, 7, 8, 9]));
    assert_eq!((image.kind(), image.face_count()), (ImageKind::Array { slices: 3 }, 1));
    assert_eq!(image.description(), "L8 2 × 1, first of 3 slices, 2 mips");
    assert_eq!(texels(&image), [[1, 1, 1, 255], [2, 2, 2, 255]]);
    assert_eq!(level_texels(&image, 0, 1), [[3, 3, 3, 255]]);
}

#[test]
fn of_an_array_of_cubes_the_first_is_shown() {
    let mut dds = Dds::dxgi(61, 1, 1);
    dds.dx10 = Some([61, 3, 4, 2, 0]);
    let image = read(&dds.file(&[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]));
    assert_eq!((image.kind(), image.data().len()), (ImageKind::Cube, 6 * 4));
    assert_eq!(level_texels(&image, 5, 0), [[6, 6, 6, 255]]);
}

#[test]
fn bytes_after_the_texels_are_left_alone() {
    let image = read(&Dds::masked(RGB, 24, [0xff, 0xff00, 0xff_0000, 0], 1, 1).file(&[1, 2, 3, 99, 99]));
    assert_eq!(image.data(), [1, 2, 3, 255]);
}
