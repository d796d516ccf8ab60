//! PNG, JPEG, WebP, TGA and BMP.

use std::io::Cursor;

use bindpose::image::{Channels, decode};
use image::{ColorType, ImageFormat};

use super::texels;

/// A file of the given kind.
fn encoded(format: ImageFormat, color: ColorType, width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut bytes, pixels, width, height, color, format).expect("it can be written");
    bytes.into_inner()
}

/// An uncompressed TGA of one 32-bit pixel, blue first, with so many bits of alpha.
fn tga_pixel(alpha_bits: u8) -> Vec<u8> {
    let mut bytes = vec![0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 32, alpha_bits];
    bytes.extend([10, 20, 30, 40]);
    bytes
}

const PIXELS: [u8; 12] = [255, 0, 0, 255, 0, 255, 0, 128, 1, 2, 3, 0];

/// Small sound files of every kind but DDS.
pub(super) fn sound_files() -> Vec<(String, Vec<u8>)> {
    let grey: Vec<u8> = (0..=255).collect();
    [
        ("a.png", encoded(ImageFormat::Png, ColorType::Rgba8, 3, 1, &PIXELS)),
        ("a.jpg", encoded(ImageFormat::Jpeg, ColorType::L8, 16, 16, &grey)),
        ("a.webp", encoded(ImageFormat::WebP, ColorType::Rgba8, 3, 1, &PIXELS)),
        ("a.tga", encoded(ImageFormat::Tga, ColorType::Rgba8, 3, 1, &PIXELS)),
        ("a.bmp", encoded(ImageFormat::Bmp, ColorType::Rgba8, 3, 1, &PIXELS)),
    ]
    .map(|(name, bytes)| (name.to_owned(), bytes))
    .to_vec()
}

#[test]
fn files_without_loss_read_back_to_their_pixels() {
    for (format, label) in [
        (ImageFormat::Png, "PNG"),
        (ImageFormat::WebP, "WebP"),
        (ImageFormat::Tga, "TGA"),
        (ImageFormat::Bmp, "BMP"),
    ] {
        // Named as nothing but TGA needs to be.
        let name = if label == "TGA" { "A.TGA" } else { "a.dat" };
        let image = decode(&encoded(format, ColorType::Rgba8, 3, 1, &PIXELS), name).expect("the file is sound");
        assert_eq!(
            (image.channels(), image.data()),
            (Channels::Rgba, PIXELS.as_slice()),
            "{label}"
        );
        assert_eq!(image.description(), format!("{label} 3 × 1, 1 mip"));
        let image = decode(&encoded(format, ColorType::Rgb8, 2, 2, &PIXELS), name).expect("the file is sound");
        assert_eq!(image.channels(), Channels::Rgb, "{label}");
        assert_eq!(
            texels(&image),
            [[255, 0, 0, 255], [255, 0, 255, 255], [0, 128, 1, 255], [2, 3, 0, 255]],
            "{label}"
        );
    }
}

#[test]
fn grey_and_16_bit_pngs_are_read() {
    for (color, pixels, channels, expected) in [
        (ColorType::L8, vec![7], Channels::Grey, [7, 7, 7, 255]),
        (ColorType::La8, vec![7, 9], Channels::GreyAlpha, [7, 7, 7, 9]),
        (
            ColorType::L16,
            0x8080_u16.to_ne_bytes().to_vec(),
            Channels::Grey,
            [128, 128, 128, 255],
        ),
        (
            ColorType::Rgba16,
            [0xffff_u16, 0, 0x8080, 0x0101].map(u16::to_ne_bytes).concat(),
            Channels::Rgba,
            [255, 0, 128, 1],
        ),
    ] {
        let image = decode(&encoded(ImageFormat::Png, color, 1, 1, &pixels), "a.png").expect("the file is sound");
        assert_eq!(
            (image.channels(), texels(&image)),
            (channels, vec![expected]),
            "{color:?}"
        );
    }
}

#[test]
fn a_jpeg_comes_close_to_its_pixels() {
    let bytes = encoded(ImageFormat::Jpeg, ColorType::Rgb8, 16, 16, &[200, 100, 50].repeat(256));
    let image = decode(&bytes, "a.png").expect("what it is shows in its first bytes");
    assert_eq!(
        (image.description(), image.channels()),
        ("JPEG 16 × 16, 1 mip".to_owned(), Channels::Rgb)
    );
    // Two roundings, of the colour's conversion and of the transform.
    for texel in texels(&image) {
        let [r, g, b, a] = texel;
        assert!(
            r.abs_diff(200) <= 2 && g.abs_diff(100) <= 2 && b.abs_diff(50) <= 2 && a == 255,
            "{texel:?}"
        );
    }
}

#[test]
fn a_tga_without_bits_of_alpha_is_opaque() {
    for (alpha_bits, channels, expected) in [
        (0, Channels::Rgb, [30, 20, 10, 255]),
        (8, Channels::Rgba, [30, 20, 10, 40]),
    ] {
        let image = decode(&tga_pixel(alpha_bits), "a.tga").expect("the file is sound");
        assert_eq!((image.channels(), texels(&image)), (channels, vec![expected]));
    }
}

#[test]
fn every_beginning_of_a_picture_is_an_error() {
    for (name, bytes) in sound_files() {
        assert!(decode(&bytes, &name).is_ok(), "{name}");
        // The last chunk of a PNG is empty, and so is the end mark of others: what lacks of it takes nothing away.
        let unused = match name.as_str() {
            "a.png" => 12,
            // Fills it up to an even length.
            "a.webp" => 1,
            _ => 0,
        };
        for len in 0..bytes.len() - unused {
            let error = decode(&bytes[..len], &name).err();
            let error = error.unwrap_or_else(|| panic!("{name} cut to {len} of {} bytes", bytes.len()));
            assert!(error.to_string().starts_with(&format!("{name}: ")), "{error}");
        }
    }
}

#[test]
fn headers_that_promise_too_much_are_refused_before_anything_is_allocated() {
    let png = grey_png_that_claims(16_384);
    let error = decode(&png, "bomb.png").expect_err("nothing packs so tightly");
    assert_eq!(error.code, "image-implausible");
    let expected = format!(
        "bomb.png: the header says 16384 × 16384, which cannot fit into the {} bytes of the file",
        png.len()
    );
    assert_eq!(error.to_string(), expected);

    let mut tga = tga_pixel(8);
    tga[12..16].copy_from_slice(&[0xff; 4]);
    assert_eq!(
        decode(&tga, "bomb.tga").map_err(|error| error.code),
        Err("image-undecodable")
    );
    tga[12..16].copy_from_slice(&[0, 0x40, 0, 0x40]);
    assert_eq!(
        decode(&tga, "bomb.tga").map_err(|error| error.code),
        Err("image-implausible")
    );
}

#[test]
fn a_jpeg_without_its_end_says_so() {
    let jpeg = &sound_files()[1].1;
    let error = decode(&jpeg[..jpeg.len() - 2], "a.jpg").expect_err("the end lacks");
    assert_eq!(
        (error.code, error.to_string().as_str()),
        (
            "image-cut",
            "a.jpg: the JPEG file has no end marker: its last part is missing"
        )
    );
}

#[test]
fn a_picture_counts_as_what_it_becomes_before_it_is_decoded() {
    // Enough bytes for their texels; a grey one of 16 384 takes 256 MiB, and four times as much as RGBA.
    for (side, is_too_large) in [(16_384, true), (8192, false)] {
        let mut png = grey_png_that_claims(side);
        png.extend([0; 1 << 16]);
        let error = decode(&png, "grey.png").expect_err("its texels are missing");
        assert_eq!(error.code, "image-undecodable");
        let about_memory = error.to_string().contains("Memory limit exceeded");
        assert_eq!(about_memory, is_too_large, "{side}: {error}");
    }
}

/// A sound header, and one texel for all of them.
fn grey_png_that_claims(side: u32) -> Vec<u8> {
    let mut png = encoded(ImageFormat::Png, ColorType::L8, 1, 1, &[0]);
    png[16..20].copy_from_slice(&side.to_be_bytes());
    png[20..24].copy_from_slice(&side.to_be_bytes());
    let mut crc = Crc::default();
    crc.update(&png[12..29]);
    png[29..33].copy_from_slice(&crc.value().to_be_bytes());
    png
}

/// The check sum of PNG chunks.
struct Crc(u32);

impl Default for Crc {
    fn default() -> Self {
        Self(u32::MAX)
    }
}

impl Crc {
    fn update(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 ^= u32::from(byte);
            for _ in 0..8 {
                let carry = self.0 & 1;
                self.0 = (self.0 >> 1) ^ (carry * 0xedb8_8320);
            }
        }
    }

    fn value(&self) -> u32 {
        !self.0
    }
}
