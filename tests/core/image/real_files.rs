//! The maps of real models, where they are at hand.

use std::path::Path;

use bindpose::image::{Channels, Image, MapKind, decode};

use super::texels;
use crate::shared::shared;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/textures");

/// Whether the files are there.
fn at_hand() -> bool {
    shared("textures").is_some()
}

fn read(path: &str) -> Image {
    let bytes = std::fs::read(Path::new(FOLDER).join(path)).expect("the file can be read");
    decode(&bytes, path).unwrap_or_else(|error| panic!("{error}"))
}

/// Every real map and what it is.
const REAL_MAPS: [(&str, &str, Channels); 29] = {
    use Channels::{RedGreen, Rgb, Rgba};
    [
        ("column/column_d.dds", "BC7 256 × 256, 9 mips", Rgba),
        ("column/column_n.dds", "BC7 256 × 256, 9 mips", Rgba),
        (
            "cube/Atrium_diffuseIBL_BC6H_128_8mips.dds",
            "BC6H 128 × 128 cube, 8 mips",
            Rgb,
        ),
        ("cube/LobbyCube_DXT1_256_nomips.dds", "BC1 256 × 256 cube, 1 mip", Rgb),
        (
            "cube/skybox02_BGRX_256_nomips.dds",
            "B8G8R8X8 256 × 256 cube, 1 mip",
            Rgb,
        ),
        ("misc/WireFence.dds", "BC3 512 × 512, 10 mips", Rgba),
        ("misc/default_nmap.dds", "B8G8R8A8 1 × 1, 1 mip", Rgba),
        ("misc/grass.dds", "BC3 512 × 512, 10 mips", Rgba),
        ("misc/tree01S.dds", "BC2 208 × 256, 1 mip", Rgba),
        ("misc/treearray.dds", "BC3 512 × 512, first of 3 slices, 10 mips", Rgba),
        ("misc/white1x1.dds", "B8G8R8A8 1 × 1, 1 mip", Rgba),
        ("soldier/head_norm.dds", "BC5 1024 × 1024, 11 mips", RedGreen),
        ("soldier/jacket_norm.dds", "BC5 1024 × 1024, 11 mips", RedGreen),
        ("soldier/pants_norm.dds", "BC5 1024 × 1024, 11 mips", RedGreen),
        ("soldier/upbody_norm.dds", "BC5 1024 × 1024, 11 mips", RedGreen),
        ("statics/rock01_diffuse.dds", "B8G8R8X8 512 × 512, 1 mip", Rgb),
        ("statics/rock01_normal.dds", "B8G8R8X8 512 × 512, 1 mip", Rgb),
        ("statics/templeBase01_diffuse.dds", "B8G8R8X8 512 × 512, 1 mip", Rgb),
        ("statics/templeBase01_normal.dds", "B8G8R8X8 512 × 512, 1 mip", Rgb),
        ("statics/templeBase02_diffuse.dds", "B8G8R8X8 512 × 512, 1 mip", Rgb),
        ("statics/templeBase02_normal.dds", "B8G8R8X8 512 × 512, 1 mip", Rgb),
        ("statics/templeBase03_diffuse.dds", "B8G8R8X8 512 × 512, 1 mip", Rgb),
        ("statics/templeBase03_normal.dds", "B8G8R8A8 512 × 512, 10 mips", Rgba),
        ("statics/templeStairs_diffuse.dds", "B8G8R8X8 512 × 512, 1 mip", Rgb),
        ("statics/templeStairs_normal.dds", "B8G8R8X8 512 × 512, 1 mip", Rgb),
        ("statics/tree01-bark_diffuse.dds", "BC1 512 × 512, 10 mips", Rgb),
        ("statics/tree01-bark_normal.dds", "B8G8R8A8 512 × 512, 10 mips", Rgba),
        ("statics/tree01-leaves_diffuse.dds", "B8G8R8A8 512 × 512, 10 mips", Rgba),
        ("statics/tree01-leaves_normal.dds", "B8G8R8A8 512 × 512, 10 mips", Rgba),
    ]
};

#[test]
fn every_real_map_is_read() {
    if !at_hand() {
        return;
    }
    for (path, description, channels) in REAL_MAPS {
        let image = read(path);
        assert_eq!(
            (image.description().as_str(), image.channels()),
            (description, channels),
            "{path}"
        );
        for face in 0..image.face_count() {
            for level in 0..image.level_count() {
                assert!(image.to_rgba8(face, level).is_some(), "{path}");
            }
        }
        if path.contains("statics") && channels == Channels::Rgb {
            assert!(texels(&image).iter().all(|texel| texel[3] == 255), "{path} is opaque");
        }
    }
}

#[test]
fn every_real_map_is_in_the_table() {
    if !at_hand() {
        return;
    }
    let entries = |folder: &Path| -> Vec<_> {
        let entries = std::fs::read_dir(folder).expect("the folder can be read");
        entries
            .map(|entry| entry.expect("the folder can be read").path())
            .collect()
    };
    let mut paths: Vec<_> = entries(Path::new(FOLDER))
        .iter()
        .filter(|folder| !folder.ends_with("malformed"))
        .flat_map(|folder| entries(folder))
        .filter_map(|path| Some(path.strip_prefix(FOLDER).ok()?.to_string_lossy().replace('\\', "/")))
        .collect();
    paths.sort();
    assert_eq!(paths, REAL_MAPS.map(|(path, ..)| path));
}

#[test]
fn real_normal_maps_hold_directions() {
    if !at_hand() {
        return;
    }
    for name in ["head", "jacket", "pants", "upbody"] {
        let texels = texels(&read(&format!("soldier/{name}_norm.dds")));
        let unit = |value: u8| f64::from(value) / 127.5 - 1.0;
        // Few stick out of the unit circle, and by no more than the coarse steps of a block allow; on average they are
        // flat.
        let long = texels
            .iter()
            .filter(|[r, g, ..]| unit(*r).hypot(unit(*g)) > 1.02)
            .count();
        assert!(long * 1000 < texels.len(), "{name}: {long} directions are too long");
        for channel in 0..2 {
            let mean = texels.iter().map(|texel| unit(texel[channel])).sum::<f64>() / texels.len() as f64;
            assert!(mean.abs() < 0.1, "{name}: mean {mean}");
        }
    }
}

#[test]
fn mips_of_real_maps_keep_their_mean_light() {
    if !at_hand() {
        return;
    }
    let linear = |value: u8| {
        let value = f64::from(value) / 255.0;
        if value <= 0.040_45 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    };
    let image = read("statics/rock01_diffuse.dds").with_mips(MapKind::Diffuse);
    assert_eq!(image.description(), "B8G8R8X8 512 × 512, 10 mips made here");
    let last = super::level_texels(&image, 0, 9);
    let texels = texels(&image);
    for channel in 0..3 {
        let mean = texels.iter().map(|texel| linear(texel[channel])).sum::<f64>() / texels.len() as f64;
        // Rounded once, by less than half a step of sRGB on either side.
        let steps = [last[0][channel].saturating_sub(1), last[0][channel].saturating_add(1)].map(linear);
        assert!(steps[0] < mean && mean < steps[1], "{mean} is not within {steps:?}");
    }
}

#[test]
fn malformed_real_files_are_named_with_their_reason() {
    if !at_hand() {
        return;
    }
    #[rustfmt::skip]
    let cases = [
        ("invalid-006b3057-841d-4c47-8af3-c352fd511b8d",
         "dds-header-cut: the DDS header takes 148 bytes, and the file has 128"),
        (
            "invalid-3f308164-3aa4-4095-8fec-f48fa90ff471",
            "dds-unsupported: DDS pixels with the flags 0x0 are not supported; there must be a four-character code, colour, grey or alpha",
        ),
        ("invalid-4d9b027e-ab8b-4412-ae66-a49fe7e7120e",
         "image-dimension: a texture with three dimensions is not supported, only flat ones and cubes are"),
        ("invalid-676e6dcc-38ae-42b6-bda7-da30d1ccdc4b", "image-cube: a cube has 6 faces, and this one 0"),
        ("invalid-7bf16981-845f-4095-af74-bbb1244cd105",
         "dds-signature: a DDS file begins with \"DDS \", and this one with \"ABCD\""),
        ("invalid-adc8f63c-279f-4f25-9641-3324b3838a12",
         "dds-header-field: the DDS header gives the size of its pixel format as 24; it must be 32"),
        ("invalid-dc141355-6459-4a70-b8f0-e3fcefbb2e39",
         "image-dimension: a texture with one dimension is not supported, only flat ones and cubes are"),
        (
            "unsupported-daab5194-837d-4578-932d-423a7338f4c4",
            "dds-unsupported: DDS pixels with the flags 0x0 are not supported; there must be a four-character code, colour, grey or alpha",
        ),
    ];
    for (file, expected) in cases {
        let name = format!("malformed/{file}.dds");
        let bytes = std::fs::read(Path::new(FOLDER).join(&name)).expect("the file can be read");
        let error = decode(&bytes, &name).expect_err("the file is malformed");
        let message = error.message.strip_prefix(&format!("{name}: ")).expect("the name");
        assert_eq!(format!("{}: {message}", error.code), expected, "{name}");
    }
}
