//! Compressed blocks of 4 × 4 texels whose values follow from the formats' definitions by hand.
//!
//! Each has four equal rows; `…_ROW` is what one must decode to.

use bindpose::image::{ImageFormat, decode};

use super::dds::Dds;

/// Bits from the lowest on.
#[derive(Default)]
struct Bits {
    value: u128,
    len: u32,
}

impl Bits {
    fn push(mut self, value: u32, len: u32) -> Self {
        self.value |= u128::from(value) << self.len;
        self.len += len;
        self
    }

    fn block(self) -> Vec<u8> {
        assert_eq!(self.len, 128);
        self.value.to_le_bytes().to_vec()
    }
}

const RED_565: [u8; 2] = [0x00, 0xf8];
const BLUE_565: [u8; 2] = [0x1f, 0x00];

/// Red, larger as a number, then blue; indices 0, 1, 2, 3 in each row.
pub(super) const BC1_OPAQUE: [u8; 8] = [RED_565[0], RED_565[1], BLUE_565[0], BLUE_565[1], 0xe4, 0xe4, 0xe4, 0xe4];
/// Index 2 is two thirds of the first colour, index 3 one third.
pub(super) const BC1_OPAQUE_ROW: [[u8; 4]; 4] =
    [[255, 0, 0, 255], [0, 0, 255, 255], [170, 0, 85, 255], [85, 0, 170, 255]];

/// Blue, then red: three colours and a hole.
pub(super) const BC1_HOLES: [u8; 8] = [BLUE_565[0], BLUE_565[1], RED_565[0], RED_565[1], 0xe4, 0xe4, 0xe4, 0xe4];
pub(super) const BC1_HOLES_ROW: [[u8; 4]; 4] = [[0, 0, 255, 255], [255, 0, 0, 255], [128, 0, 128, 255], [0; 4]];

/// Alphas 0, 1, 2 and 15 of 15; colours as with four of them although blue is the smaller number.
pub(super) fn bc2() -> Vec<u8> {
    let alphas = [0x10, 0xf2].repeat(4);
    [alphas, BC1_HOLES.to_vec()].concat()
}
pub(super) const BC2_ROW: [[u8; 4]; 4] = [[0, 0, 255, 0], [255, 0, 0, 17], [85, 0, 170, 34], [170, 0, 85, 255]];
/// Divided by alpha; what is more than 1 then is cut.
pub(super) const BC2_STRAIGHT_ROW: [[u8; 4]; 4] = [[0; 4], [255, 0, 0, 17], [255, 0, 255, 34], [170, 0, 85, 255]];

/// 16 indices of 3 bits: 0, 1, 2 and 7 in each row.
fn indices_0127() -> [u8; 6] {
    let row: u64 = 1 << 3 | 2 << 6 | 7 << 9;
    let all = row | row << 12 | row << 24 | row << 36;
    let [a, b, c, d, e, f, ..] = all.to_le_bytes();
    [a, b, c, d, e, f]
}

/// From 210 to 0 in seven steps of 30.
fn eight_values() -> Vec<u8> {
    [&[210, 0], indices_0127().as_slice()].concat()
}

/// From 0 to 250 in five steps of 50, and the two ends.
fn six_values() -> Vec<u8> {
    [&[0, 250], indices_0127().as_slice()].concat()
}

/// From −1 to 1 in five steps of 0.4, and the two ends.
fn six_signed_values() -> Vec<u8> {
    [&[129, 127], indices_0127().as_slice()].concat()
}

pub(super) fn bc3() -> Vec<u8> {
    [eight_values(), BC1_OPAQUE.to_vec()].concat()
}
pub(super) const BC3_ROW: [[u8; 4]; 4] = [[255, 0, 0, 210], [0, 0, 255, 0], [170, 0, 85, 180], [85, 0, 170, 30]];
/// 170 × 255 / 180 and 85 × 255 / 180; the last is more than 1.
pub(super) const BC3_STRAIGHT_ROW: [[u8; 4]; 4] = [[255, 0, 0, 210], [0; 4], [241, 0, 120, 180], [255, 0, 255, 30]];

pub(super) fn bc4() -> Vec<u8> {
    eight_values()
}
pub(super) const BC4_ROW: [[u8; 4]; 4] = [
    [210, 210, 210, 255],
    [0, 0, 0, 255],
    [180, 180, 180, 255],
    [30, 30, 30, 255],
];

pub(super) fn bc4_signed() -> Vec<u8> {
    six_signed_values()
}
/// −1, 1, −0.6 and the upper end.
pub(super) const BC4_SIGNED_ROW: [[u8; 4]; 4] = [[0, 0, 0, 255], [255; 4], [51, 51, 51, 255], [255; 4]];

pub(super) fn bc5() -> Vec<u8> {
    [eight_values(), six_values()].concat()
}
pub(super) const BC5_ROW: [[u8; 4]; 4] = [[210, 0, 0, 255], [0, 250, 0, 255], [180, 50, 0, 255], [30, 255, 0, 255]];

/// Green as −128 throughout, which is −1 too.
pub(super) fn bc5_signed() -> Vec<u8> {
    [six_signed_values(), vec![128, 128, 0, 0, 0, 0, 0, 0]].concat()
}
pub(super) const BC5_SIGNED_ROW: [[u8; 4]; 4] = [[0, 0, 0, 255], [255, 0, 0, 255], [51, 0, 0, 255], [255, 0, 0, 255]];

/// Mode 6: from black to 128, 64, 32 and from alpha 254 to alpha 254, indices 0, 4, 8 and 15 of 15 in each row.
pub(super) fn bc7() -> Vec<u8> {
    let mut bits = Bits::default().push(1 << 6, 7);
    for (first, second) in [(0, 128), (0, 64), (0, 32), (254, 254)] {
        bits = bits.push(first / 2, 7).push(second / 2, 7);
    }
    // The lowest bit of each end.
    bits = bits.push(0, 1).push(0, 1);
    for texel in 0..16 {
        // The first index has a bit less, since its highest is 0.
        bits = bits.push([0, 4, 8, 15][texel % 4], if texel == 0 { 3 } else { 4 });
    }
    bits.block()
}
/// Index 4 weighs 17 of 64 and index 8 weighs 34: 128 × 17 / 64 = 34; 32 × 17 / 64 = 8.5, rounded up.
pub(super) const BC7_ROW: [[u8; 4]; 4] = [[0, 0, 0, 254], [34, 17, 9, 254], [68, 34, 17, 254], [128, 64, 32, 254]];

/// The mode with one region and two ends of 10 bits, both the same.
fn bc6h_constant(rgb: [u32; 3]) -> Vec<u8> {
    let mut bits = Bits::default().push(0b00011, 5);
    for value in rgb.into_iter().chain(rgb) {
        bits = bits.push(value, 10);
    }
    bits.push(0, 32).push(0, 31).block()
}

/// 495 is (495 × 64 + 32) × 31 / 64 = 0x3c00, half float 1; 1023 is the largest, 65 504.
pub(super) fn bc6h() -> Vec<u8> {
    bc6h_constant([495, 0, 1023])
}

/// −247 is (247 × 64 + 32) × 31 / 32 = 0x3bf1 and a sign; 511 is the largest, 65 504.
pub(super) fn bc6h_signed() -> Vec<u8> {
    bc6h_constant([1024 - 247, 511, 0])
}

/// Half floats 1, 0, 2 and 0.5.
pub(super) const HALF_TEXEL: [u8; 8] = [0x00, 0x3c, 0, 0, 0x00, 0x40, 0x00, 0x38];
pub(super) const HALF_RGBA8: [u8; 4] = [255, 0, 255, 128];

#[test]
fn floats_keep_values_beyond_one_and_below_zero() {
    for (format, texels, expected) in [
        (10, [HALF_TEXEL; 16].concat(), [1.0, 0.0, 2.0, 0.5]),
        (95, bc6h(), [1.0, 0.0, 65_504.0, 1.0]),
        (96, bc6h_signed(), [-0.992_675_8, 65_504.0, 0.0, 1.0]),
    ] {
        let image = decode(&Dds::dxgi(format, 4, 4).file(&texels), "sky.dds").expect("the file is sound");
        assert!(image.format().is_float());
        let values = image.to_rgba32f(0, 0).expect("the level is there");
        assert_eq!(values, [expected; 16].concat(), "format {format}");
    }
}

#[test]
fn eight_bit_values_become_floats_from_0_to_1() {
    let image = decode(&Dds::dxgi(83, 4, 4).file(&bc5()), "norm.dds").expect("the file is sound");
    assert_eq!(image.format(), ImageFormat::Bc5);
    let values = image.to_rgba32f(0, 0).expect("the level is there");
    assert_eq!(values[..4], [210.0 / 255.0, 0.0, 0.0, 1.0]);
}

#[test]
fn compressed_files_keep_their_blocks_for_the_gpu() {
    for (format, block) in [
        (72, BC1_OPAQUE.to_vec()),
        (78, bc3()),
        (83, bc5()),
        (95, bc6h()),
        (98, bc7()),
    ] {
        let image = decode(&Dds::dxgi(format, 4, 4).file(&block), "map.dds").expect("the file is sound");
        assert_eq!((image.data(), image.format().block_side()), (block.as_slice(), 4));
    }
}
