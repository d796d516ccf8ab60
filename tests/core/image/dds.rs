//! DDS files made by hand, and one of every layout that is read.

use bindpose::image::Channels;

use super::blocks;

pub(super) const RGB: u32 = 0x40;
pub(super) const ALPHA_PIXELS: u32 = 0x1;
pub(super) const ALPHA: u32 = 0x2;
pub(super) const LUMINANCE: u32 = 0x2_0000;
pub(super) const FOUR_CC: u32 = 0x4;

pub(super) const CUBE_OF_SIX: u32 = 0xfe00;

/// A header in the words of the format's description.
#[derive(Clone, Debug)]
pub(super) struct Dds {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) mip_count: u32,
    pub(super) flags: u32,
    pub(super) four_cc: u32,
    pub(super) bits: u32,
    pub(super) masks: [u32; 4],
    pub(super) caps2: u32,
    /// Format, dimension, flags, slices, alpha mode.
    pub(super) dx10: Option<[u32; 5]>,
}

impl Dds {
    /// A flat picture with a four-character code and a mip count of 0.
    pub(super) fn four_cc(code: &[u8; 4], width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            mip_count: 0,
            flags: FOUR_CC,
            four_cc: u32::from_le_bytes(*code),
            bits: 0,
            masks: [0; 4],
            caps2: 0,
            dx10: None,
        }
    }

    /// A flat picture by masks.
    pub(super) fn masked(flags: u32, bits: u32, masks: [u32; 4], width: u32, height: u32) -> Self {
        Self {
            flags,
            bits,
            masks,
            ..Self::four_cc(&[0; 4], width, height)
        }
    }

    /// A flat picture by a DXGI format.
    pub(super) fn dxgi(format: u32, width: u32, height: u32) -> Self {
        Self {
            dx10: Some([format, 3, 0, 1, 0]),
            ..Self::four_cc(b"DX10", width, height)
        }
    }

    pub(super) fn mips(self, mip_count: u32) -> Self {
        Self { mip_count, ..self }
    }

    /// The file with these texels.
    pub(super) fn file(&self, texels: &[u8]) -> Vec<u8> {
        let mut words = [0; 31];
        words[0] = 124;
        words[1] = 0x1007;
        words[2] = self.height;
        words[3] = self.width;
        words[6] = self.mip_count;
        words[18] = 32;
        words[19] = self.flags;
        words[20] = self.four_cc;
        words[21] = self.bits;
        words[22..26].copy_from_slice(&self.masks);
        words[26] = 0x1000;
        words[27] = self.caps2;
        let mut bytes = b"DDS ".to_vec();
        bytes.extend(
            words
                .iter()
                .chain(self.dx10.iter().flatten())
                .flat_map(|word| word.to_le_bytes()),
        );
        bytes.extend(texels);
        bytes
    }
}

/// A file of one layout and what its first texels must be.
pub(super) struct Fixture {
    pub(super) name: &'static str,
    pub(super) bytes: Vec<u8>,
    pub(super) description: &'static str,
    pub(super) channels: Channels,
    /// The first texels of the first row.
    pub(super) first: Vec<[u8; 4]>,
}

/// One file of every layout.
pub(super) fn every_layout() -> Vec<Fixture> {
    let mut fixtures = four_cc_fixtures();
    fixtures.extend(dxgi_fixtures());
    fixtures.extend(masked_fixtures());
    fixtures
}

fn four_cc_fixtures() -> Vec<Fixture> {
    use Channels::{Grey, RedGreen, Rgb, Rgba};
    #[rustfmt::skip]
    let rows = [
        ("DXT1", blocks::BC1_OPAQUE.to_vec(), "BC1", Rgb, blocks::BC1_OPAQUE_ROW),
        ("DXT1", blocks::BC1_HOLES.to_vec(), "BC1", Rgba, blocks::BC1_HOLES_ROW),
        ("DXT3", blocks::bc2(), "BC2", Rgba, blocks::BC2_ROW),
        ("DXT5", blocks::bc3(), "BC3", Rgba, blocks::BC3_ROW),
        ("DXT2", blocks::bc2(), "BC2", Rgba, blocks::BC2_STRAIGHT_ROW),
        ("DXT4", blocks::bc3(), "BC3", Rgba, blocks::BC3_STRAIGHT_ROW),
        ("ATI1", blocks::bc4(), "BC4", Grey, blocks::BC4_ROW),
        ("BC4U", blocks::bc4(), "BC4", Grey, blocks::BC4_ROW),
        ("BC4S", blocks::bc4_signed(), "BC4 signed", Grey, blocks::BC4_SIGNED_ROW),
        ("ATI2", blocks::bc5(), "BC5", RedGreen, blocks::BC5_ROW),
        ("BC5U", blocks::bc5(), "BC5", RedGreen, blocks::BC5_ROW),
        ("BC5S", blocks::bc5_signed(), "BC5 signed", RedGreen, blocks::BC5_SIGNED_ROW),
        ("\x71\0\0\0", [blocks::HALF_TEXEL; 16].concat(), "RGBA16F", Rgba, [blocks::HALF_RGBA8; 4]),
    ];
    let fixture = |(name, texels, label, channels, first): (&'static str, Vec<u8>, _, _, [[u8; 4]; 4])| {
        let code = name.as_bytes().try_into().expect("four letters");
        Fixture {
            name,
            bytes: Dds::four_cc(code, 4, 4).file(&texels),
            description: four_by_four(label),
            channels,
            first: first.to_vec(),
        }
    };
    rows.into_iter().map(fixture).collect()
}

fn dxgi_fixtures() -> Vec<Fixture> {
    use Channels::{Alpha, Grey, RedGreen, Rgb, Rgba};
    let whole = |texel: &[u8]| texel.repeat(16);
    let bytes = [10, 20, 30, 40];
    #[rustfmt::skip]
    let rows = [
        (10, whole(&blocks::HALF_TEXEL), "RGBA16F", Rgba, [blocks::HALF_RGBA8; 4]),
        // Red 1023, green 0, blue 512, alpha 2 of 3.
        (24, whole(&0xa000_03ff_u32.to_le_bytes()), "R10G10B10A2", Rgba, [[255, 0, 128, 170]; 4]),
        (27, whole(&bytes), "R8G8B8A8", Rgba, [[10, 20, 30, 40]; 4]),
        (28, whole(&bytes), "R8G8B8A8", Rgba, [[10, 20, 30, 40]; 4]),
        (29, whole(&bytes), "R8G8B8A8", Rgba, [[10, 20, 30, 40]; 4]),
        (49, whole(&[10, 20]), "R8G8", RedGreen, [[10, 20, 0, 255]; 4]),
        (61, whole(&[10]), "L8", Grey, [[10, 10, 10, 255]; 4]),
        (65, whole(&[10]), "A8", Alpha, [[0, 0, 0, 10]; 4]),
        (70, blocks::BC1_OPAQUE.to_vec(), "BC1", Rgb, blocks::BC1_OPAQUE_ROW),
        (71, blocks::BC1_HOLES.to_vec(), "BC1", Rgba, blocks::BC1_HOLES_ROW),
        (72, blocks::BC1_OPAQUE.to_vec(), "BC1", Rgb, blocks::BC1_OPAQUE_ROW),
        (74, blocks::bc2(), "BC2", Rgba, blocks::BC2_ROW),
        (75, blocks::bc2(), "BC2", Rgba, blocks::BC2_ROW),
        (77, blocks::bc3(), "BC3", Rgba, blocks::BC3_ROW),
        (78, blocks::bc3(), "BC3", Rgba, blocks::BC3_ROW),
        (80, blocks::bc4(), "BC4", Grey, blocks::BC4_ROW),
        (81, blocks::bc4_signed(), "BC4 signed", Grey, blocks::BC4_SIGNED_ROW),
        (83, blocks::bc5(), "BC5", RedGreen, blocks::BC5_ROW),
        (84, blocks::bc5_signed(), "BC5 signed", RedGreen, blocks::BC5_SIGNED_ROW),
        (85, whole(&0xf81f_u16.to_le_bytes()), "B5G6R5", Rgb, [[255, 0, 255, 255]; 4]),
        (86, whole(&0x83e0_u16.to_le_bytes()), "B5G5R5A1", Rgba, [[0, 255, 0, 255]; 4]),
        (87, whole(&bytes), "B8G8R8A8", Rgba, [[30, 20, 10, 40]; 4]),
        (88, whole(&bytes), "B8G8R8X8", Rgb, [[30, 20, 10, 255]; 4]),
        (91, whole(&bytes), "B8G8R8A8", Rgba, [[30, 20, 10, 40]; 4]),
        (93, whole(&bytes), "B8G8R8X8", Rgb, [[30, 20, 10, 255]; 4]),
        (95, blocks::bc6h(), "BC6H", Rgb, [[255, 0, 255, 255]; 4]),
        (96, blocks::bc6h_signed(), "BC6H signed", Rgb, [[0, 255, 0, 255]; 4]),
        (98, blocks::bc7(), "BC7", Rgba, blocks::BC7_ROW),
        (99, blocks::bc7(), "BC7", Rgba, blocks::BC7_ROW),
        // Alpha 8, red 4, green 2, blue 1, each of 15.
        (115, whole(&0x8421_u16.to_le_bytes()), "B4G4R4A4", Rgba, [[68, 34, 17, 136]; 4]),
    ];
    let fixture = |(format, texels, label, channels, first): (u32, Vec<u8>, _, _, [[u8; 4]; 4])| Fixture {
        name: label,
        bytes: Dds::dxgi(format, 4, 4).file(&texels),
        description: four_by_four(label),
        channels,
        first: first.to_vec(),
    };
    rows.into_iter().map(fixture).collect()
}

fn masked_fixtures() -> Vec<Fixture> {
    use Channels::{Alpha, Grey, GreyAlpha, RedGreen, Rgb, Rgba};
    const R: u32 = 0xff;
    const G: u32 = 0xff00;
    const B: u32 = 0xff_0000;
    const A: u32 = 0xff00_0000;
    #[rustfmt::skip]
    let rows: [(_, _, _, &[u8], _, _, [u8; 4]); 21] = [
        // The maps of the statics: room for alpha, all of it 0, and no mask.
        (RGB, 32, [B, G, R, 0], &[10, 20, 30, 0], "B8G8R8X8", Rgb, [30, 20, 10, 255]),
        (RGB | ALPHA_PIXELS, 32, [B, G, R, A], &[10, 20, 30, 40], "B8G8R8A8", Rgba, [30, 20, 10, 40]),
        (RGB | ALPHA_PIXELS, 32, [R, G, B, A], &[10, 20, 30, 40], "R8G8B8A8", Rgba, [10, 20, 30, 40]),
        (RGB, 32, [R, G, B, 0], &[10, 20, 30, 0], "R8G8B8X8", Rgb, [10, 20, 30, 255]),
        // An alpha mask without its flag, and the flag without a mask, are no alpha.
        (RGB, 32, [B, G, R, A], &[10, 20, 30, 40], "B8G8R8X8", Rgb, [30, 20, 10, 255]),
        (RGB | ALPHA_PIXELS, 32, [B, G, R, 0], &[10, 20, 30, 40], "B8G8R8X8", Rgb, [30, 20, 10, 255]),
        (RGB, 24, [B, G, R, 0], &[10, 20, 30], "B8G8R8", Rgb, [30, 20, 10, 255]),
        (RGB, 24, [R, G, B, 0], &[10, 20, 30], "R8G8B8", Rgb, [10, 20, 30, 255]),
        // Red 16 of 31, green 32 of 63, blue 1 of 31.
        (RGB, 16, [0xf800, 0x7e0, 0x1f, 0], &[0x01, 0x84], "B5G6R5", Rgb, [132, 130, 8, 255]),
        (RGB | ALPHA_PIXELS, 16, [0x7c00, 0x3e0, 0x1f, 0x8000], &[0x1f, 0x7c], "B5G5R5A1", Rgba, [255, 0, 255, 0]),
        (RGB, 16, [0x7c00, 0x3e0, 0x1f, 0], &[0x1f, 0x7c], "B5G5R5X1", Rgb, [255, 0, 255, 255]),
        (RGB | ALPHA_PIXELS, 16, [0xf00, 0xf0, 0xf, 0xf000], &[0x21, 0x84], "B4G4R4A4", Rgba, [68, 34, 17, 136]),
        // Red 7 of 7, green 1 of 7, blue 2 of 3.
        (RGB, 8, [0xe0, 0x1c, 0x03, 0], &[0b1110_0110], "B2G3R3", Rgb, [255, 36, 170, 255]),
        (RGB, 32, [0x3ff, 0xf_fc00, 0x3ff0_0000, 0], &[0xff, 3, 0, 0x20], "R10G10B10X2", Rgb, [255, 0, 128, 255]),
        (RGB, 32, [0xffff, 0xffff_0000, 0, 0], &[0, 0x80, 0xff, 0xff], "R16G16", RedGreen, [128, 255, 0, 255]),
        (LUMINANCE, 8, [0xff, 0, 0, 0], &[10], "L8", Grey, [10, 10, 10, 255]),
        (LUMINANCE, 16, [0xffff, 0, 0, 0], &[0, 0x80], "L16", Grey, [128, 128, 128, 255]),
        (LUMINANCE | ALPHA_PIXELS, 16, [0xff, 0, 0, 0xff00], &[10, 20], "L8A8", GreyAlpha, [10, 10, 10, 20]),
        (LUMINANCE | ALPHA_PIXELS, 8, [0xf, 0, 0, 0xf0], &[0x21], "L4A4", GreyAlpha, [17, 17, 17, 34]),
        // Masks of green and blue mean nothing beside grey.
        (LUMINANCE, 8, [0xff, 0xff, 0xff, 0], &[10], "L8", Grey, [10, 10, 10, 255]),
        (ALPHA, 8, [0, 0, 0, 0xff], &[10], "A8", Alpha, [0, 0, 0, 10]),
    ];
    let fixture = |(flags, bits, masks, pixel, label, channels, texel): (_, _, _, &[u8], _, _, _)| Fixture {
        name: label,
        bytes: Dds::masked(flags, bits, masks, 4, 4).file(&pixel.repeat(16)),
        description: four_by_four(label),
        channels,
        first: vec![texel; 16],
    };
    rows.into_iter().map(fixture).collect()
}

/// What the panel says of a fixture.
fn four_by_four(label: &str) -> &'static str {
    format!("{label} 4 × 4, 1 mip").leak()
}
