//! What is said about files that cannot be read: the words and the codes.

use bindpose::diagnostic::Severity;
use bindpose::image::{Image, decode};

use super::blocks::BC1_OPAQUE;
use super::dds::{ALPHA_PIXELS, CUBE_OF_SIX, Dds, LUMINANCE, RGB};

/// `code: message` of a file that must not be read.
fn error_of(bytes: &[u8], name: &str) -> String {
    let error = decode(bytes, name).expect_err("the file is not sound");
    assert_eq!(error.severity, Severity::Warning);
    format!("{}: {error}", error.code)
}

#[test]
fn files_that_are_no_pictures_are_named() {
    #[rustfmt::skip]
    let cases = [
        (b"".as_slice(), "a.dds", "image-empty: a.dds: the file is empty"),
        (b"hello", "t/a.txt", "image-unrecognized: t/a.txt: this is none of DDS, PNG, JPEG, WebP, TGA, BMP and Radiance"),
        (b"#?RADIANCE\n", "studio.hdr", "image-cut: studio.hdr: the Radiance file ends or is damaged in its header"),
        (
            b"\x76\x2f\x31\x01\x02",
            "studio.dat",
            "image-unrecognized: studio.dat: OpenEXR (.exr) cannot be read; a panorama as Radiance (.hdr) or a cube map as .dds can",
        ),
        (b"ABCD\n", "a.dds", "dds-signature: a.dds: a DDS file begins with \"DDS \", and this one with \"ABCD\""),
        (b"DDS ", "a.dds", "dds-header-cut: a.dds: the DDS header takes 128 bytes, and the file has 4"),
        (b"DD", "a.dds", "dds-header-cut: a.dds: the DDS header takes 128 bytes, and the file has 2"),
    ];
    for (bytes, name, expected) in cases {
        assert_eq!(error_of(bytes, name), expected);
    }
}

#[test]
fn headers_that_cannot_be_are_told_apart() {
    let bc1 = || Dds::four_cc(b"DXT1", 4, 4);
    let dx10 = |fields| Dds {
        dx10: Some(fields),
        ..Dds::dxgi(0, 4, 4)
    };
    #[rustfmt::skip]
    let rows = [
        (Dds::four_cc(b"DXT1", 0, 4),
         "image-size: a.dds: a picture of 0 × 4 cannot be shown; a side may have 1 to 16384 texels"),
        (Dds::four_cc(b"DXT1", 65_535, 65_535),
         "image-size: a.dds: a picture of 65535 × 65535 cannot be shown; a side may have 1 to 16384 texels"),
        (bc1().mips(4), "image-mip-count: a.dds: the header gives 4 mips, and a picture of 4 × 4 has at most 3"),
        (bc1().mips(u32::MAX),
         "image-mip-count: a.dds: the header gives 4294967295 mips, and a picture of 4 × 4 has at most 3"),
        (Dds::four_cc(b"YUY2", 4, 4), "dds-unsupported: a.dds: DDS pixels of the kind YUY2 are not supported"),
        (Dds::four_cc(&[116, 0, 0, 0], 4, 4), "dds-unsupported: a.dds: DDS pixels of the kind 116 are not supported"),
        (Dds::dxgi(2, 4, 4), "dds-unsupported: a.dds: DDS pixels of the DXGI format 2 are not supported"),
        (
            Dds::masked(0, 32, [1; 4], 4, 4),
            "dds-unsupported: a.dds: DDS pixels with the flags 0x0 are not supported; there must be a four-character code, colour, grey or alpha",
        ),
        (
            Dds::masked(0x20, 8, [0; 4], 4, 4),
            "dds-unsupported: a.dds: DDS pixels with the flags 0x20 are not supported; there must be a four-character code, colour, grey or alpha",
        ),
        (Dds::masked(RGB, 12, [0xf, 0, 0, 0], 4, 4),
         "dds-unsupported: a.dds: DDS pixels of 12 bits are not supported; there must be 8, 16, 24 or 32"),
        (Dds::masked(RGB, 16, [0xff, 0xf0f0, 0, 0], 4, 4),
         "dds-mask: a.dds: the mask 0xf0f0 for green does not fit a pixel of 16 bits"),
        (Dds::masked(LUMINANCE | ALPHA_PIXELS, 8, [0xff, 0, 0, 0xff00], 4, 4),
         "dds-mask: a.dds: the mask 0xff00 for alpha does not fit a pixel of 8 bits"),
        (Dds::masked(RGB, 32, [0; 4], 4, 4),
         "dds-mask: a.dds: the mask 0x0 for colour and alpha does not fit a pixel of 32 bits"),
        (Dds { caps2: 0x20_0000, ..bc1() },
         "image-dimension: a.dds: a texture with three dimensions is not supported, only flat ones and cubes are"),
        (dx10([71, 4, 0, 1, 0]),
         "image-dimension: a.dds: a texture with three dimensions is not supported, only flat ones and cubes are"),
        (dx10([71, 2, 0, 1, 0]),
         "image-dimension: a.dds: a texture with one dimension is not supported, only flat ones and cubes are"),
        (dx10([71, 9, 0, 1, 0]), "dds-header-field: a.dds: the DDS header gives its dimension as 9; it must be 3"),
        (dx10([71, 3, 0, 0, 0]), "image-no-slices: a.dds: the array has no slices"),
        (Dds { caps2: 0x0e00, ..bc1() }, "image-cube: a.dds: a cube has 6 faces, and this one 2"),
        (Dds { caps2: CUBE_OF_SIX, ..Dds::four_cc(b"DXT1", 8, 4) },
         "image-cube: a.dds: the faces of a cube must be square, and these are 8 × 4"),
    ];
    for (dds, expected) in rows {
        assert_eq!(error_of(&dds.file(&[0; 1024]), "a.dds"), expected);
    }
}

#[test]
fn wrong_sizes_of_the_header_are_errors() {
    let file = Dds::four_cc(b"DXT1", 4, 4).file(&BC1_OPAQUE);
    for (at, expected) in [
        (
            4,
            "dds-header-field: a.dds: the DDS header gives its size as 7; it must be 124",
        ),
        (
            76,
            "dds-header-field: a.dds: the DDS header gives the size of its pixel format as 7; it must be 32",
        ),
    ] {
        let mut file = file.clone();
        file[at] = 7;
        assert_eq!(error_of(&file, "a.dds"), expected);
    }
}

#[test]
fn files_that_end_early_say_how_much_lacks_and_where() {
    let cube = Dds {
        caps2: CUBE_OF_SIX,
        ..Dds::four_cc(b"DXT1", 8, 8).mips(4)
    };
    let array = |slices| Dds {
        dx10: Some([71, 3, 0, slices, 0]),
        ..Dds::dxgi(71, 8, 8).mips(2)
    };
    #[rustfmt::skip]
    let cases = [
        (Dds::four_cc(b"DXT1", 8, 8), 31, "the file ends 1 bytes early, in mip 0 (8 × 8) of the picture at byte 128"),
        (Dds::four_cc(b"DXT1", 8, 8).mips(2), 32,
         "the file ends 8 bytes early, in mip 1 (4 × 4) of the picture at byte 160"),
        // 32 + 8 + 8 + 8 bytes a face.
        (cube, 56 * 2 + 45, "the file ends 179 bytes early, in mip 2 (2 × 2) of face +y at byte 280"),
        (array(3), 40 + 8, "the file ends 72 bytes early, in mip 0 (8 × 8) of slice 1 at byte 188"),
        (array(u32::MAX), 100, "the file ends 171798691700 bytes early, in mip 0 (8 × 8) of slice 2 at byte 228"),
        // What the header claims is never allocated.
        (Dds::dxgi(98, 16_384, 16_384), 5,
         "the file ends 268435451 bytes early, in mip 0 (16384 × 16384) of the picture at byte 148"),
    ];
    for (dds, len, expected) in cases {
        assert_eq!(
            error_of(&dds.file(&vec![0; len]), "a.dds"),
            format!("image-cut: a.dds: {expected}")
        );
    }
}

#[test]
fn texels_by_code_must_fill_their_size() {
    let error = Image::from_rgba8(2, 2, vec![0; 15], "made").expect_err("a byte lacks");
    assert_eq!(error.to_string(), "15 bytes of texels are not the 16 of 2 × 2");
    assert_eq!(error.code, "image-data-length");
    assert_eq!(
        Image::from_rgba8(0, 2, Vec::new(), "made").map_err(|error| error.code),
        Err("image-size")
    );
    let image = Image::from_rgba8(2, 2, vec![7; 16], "made").expect("four texels");
    assert_eq!(image.description(), "made 2 × 2, 1 mip");
}
