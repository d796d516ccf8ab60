//! Damaged and invented files: an error or a picture, never a panic.

use bindpose::image::{MapKind, check, decode};
use proptest::prelude::*;

use super::dds::{CUBE_OF_SIX, Dds, every_layout};
use super::raster;

/// Small sound files of every kind.
fn sound_files() -> Vec<(String, Vec<u8>)> {
    let cube = Dds {
        caps2: CUBE_OF_SIX,
        ..Dds::four_cc(b"DXT5", 4, 4).mips(3)
    };
    let array = Dds {
        dx10: Some([98, 3, 0, 3, 0]),
        ..Dds::dxgi(98, 8, 4).mips(2)
    };
    let mut files: Vec<_> = every_layout()
        .into_iter()
        .map(|fixture| (format!("{}.dds", fixture.name), fixture.bytes))
        .collect();
    files.push(("cube.dds".to_owned(), cube.file(&[0x55; 6 * 3 * 16])));
    files.push(("array.dds".to_owned(), array.file(&[0x40; 3 * (32 + 16)])));
    files
}

#[test]
fn every_beginning_of_a_dds_file_is_an_error() {
    for (name, bytes) in sound_files() {
        assert!(decode(&bytes, &name).is_ok(), "{name}");
        for len in 0..bytes.len() {
            assert!(decode(&bytes[..len], &name).is_err(), "{name} cut to {len} bytes");
        }
    }
}

#[test]
fn a_check_finds_what_decoding_would_but_for_damage_inside_of_what_is_packed() {
    for (name, bytes) in sound_files().into_iter().chain(raster::sound_files()) {
        assert_eq!(check(&bytes, &name), Ok(()), "{name}");
        for len in 0..bytes.len() {
            let (checked, decoded) = (check(&bytes[..len], &name), decode(&bytes[..len], &name).map(drop));
            if checked.is_err() || name.ends_with(".dds") {
                assert_eq!(checked, decoded, "{name} cut to {len} bytes");
            }
        }
        assert!(check(&bytes[..16], &name).is_err(), "{name}");
    }
    assert!(check(b"", "a.png").is_err() && check(b"words", "a.png").is_err());
}

/// Decodes and, where that succeeds, uses every level in every way.
fn exercise(bytes: &[u8], name: &str) {
    let Ok(image) = decode(bytes, name) else { return };
    for face in 0..image.face_count() {
        for level in 0..image.level_count() {
            let (width, height) = image.level_size(level);
            let texel_count = width as usize * height as usize;
            assert_eq!(
                image.to_rgba8(face, level).map(|texels| texels.len()),
                Some(texel_count * 4)
            );
            assert_eq!(
                image.to_rgba32f(face, level).map(|texels| texels.len()),
                Some(texel_count * 4)
            );
        }
    }
    for map_kind in [MapKind::Diffuse, MapKind::Normal] {
        let mipped = image.clone().with_mips(map_kind);
        assert!(mipped.level_count() >= image.level_count());
    }
}

/// Words that headers are made of, and any others.
fn word() -> impl Strategy<Value = u32> {
    prop_oneof![
        0..8_u32,
        prop::sample::select(vec![
            0x40, 0x41, 0x2_0000, 0x2_0001, 4, 2, 0xff, 0xff00, 0xf800, 0xfe00, 8, 16, 24, 32
        ]),
        any::<u32>(),
    ]
}

fn four_cc() -> impl Strategy<Value = [u8; 4]> {
    let known = [
        b"DXT1", b"DXT2", b"DXT3", b"DXT4", b"DXT5", b"ATI1", b"ATI2", b"BC4S", b"BC5S", b"DX10", b"q\0\0\0",
    ];
    prop_oneof![prop::sample::select(known.map(|code| *code).to_vec()), any::<[u8; 4]>()]
}

proptest! {
    #![proptest_config(crate::properties::cases(2000))]

    #[test]
    fn invented_headers_never_panic(
        size in prop::array::uniform2(word()),
        mips_bits_caps in prop::array::uniform3(word()),
        flags in word(),
        code in four_cc(),
        masks in prop::array::uniform4(word()),
        dx10 in (0..120_u32, word(), word(), word(), word()),
        texels in prop::collection::vec(any::<u8>(), 0..2000),
    ) {
        let [mip_count, bits, caps2] = mips_bits_caps;
        let dds = Dds {
            mip_count,
            flags,
            bits,
            masks,
            caps2,
            dx10: (code == *b"DX10").then_some([dx10.0, dx10.1, dx10.2, dx10.3, dx10.4]),
            ..Dds::four_cc(&code, size[0], size[1])
        };
        exercise(&dds.file(&texels), "invented.dds");
    }

    #[test]
    fn sound_headers_with_any_texels_decode(
        format in prop::sample::select(vec![10_u32, 28, 61, 71, 74, 77, 80, 81, 83, 84, 85, 95, 96, 98]),
        width in 1..20_u32,
        height in 1..20_u32,
        texels in prop::collection::vec(any::<u8>(), 20 * 20 * 8),
    ) {
        let file = Dds::dxgi(format, width, height).file(&texels);
        prop_assert!(decode(&file, "any.dds").is_ok());
        exercise(&file, "any.dds");
    }

    #[test]
    fn changed_bytes_never_panic(
        which in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let files: Vec<_> = sound_files().into_iter().chain(raster::sound_files()).collect();
        let (name, mut bytes) = which.get(&files).clone();
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if let Some(len) = cut {
            bytes.truncate(len.index(bytes.len()));
        }
        exercise(&bytes, &name);
    }

    #[test]
    fn any_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400), tga in any::<bool>()) {
        exercise(&bytes, if tga { "any.tga" } else { "any.dds" });
    }
}
