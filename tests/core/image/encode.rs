//! Pictures that were written read back as they were.

use bindpose::image::{Image, MapKind, decode, encode_dds, encode_png};

#[test]
fn a_dds_reads_back_with_all_its_levels() -> Result<(), Box<dyn std::error::Error>> {
    let texels = (0..4 * 6 * 3).map(|byte| byte as u8 * 3).collect();
    let image = Image::from_rgba8(6, 3, texels, "test")?.with_mips(MapKind::Data);
    let read = decode(&encode_dds(&image), "map.dds")?;
    assert_eq!((read.level_count(), read.has_alpha()), (3, true));
    for level in 0..3 {
        assert_eq!(read.to_rgba8(0, level), image.to_rgba8(0, level));
    }
    Ok(())
}

#[test]
fn a_png_reads_back_to_its_pixels() -> Result<(), Box<dyn std::error::Error>> {
    let pixels = [255, 0, 0, 255, 0, 255, 0, 128];
    let png = encode_png(&pixels, 2, 1)?;
    let read = image::load_from_memory_with_format(&png, image::ImageFormat::Png)?.into_rgba8();
    assert_eq!(
        (read.dimensions(), read.into_raw().as_slice()),
        ((2, 1), pixels.as_slice())
    );
    Ok(())
}

#[test]
fn a_wrong_size_is_an_error() {
    assert!(encode_png(&[0; 7], 2, 1).is_err());
}
