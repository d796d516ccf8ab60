//! Tests of `image`, and of how its files are found.

mod blocks;
mod damage;
mod dds;
mod directions;
mod encode;
mod errors;
mod finding;
mod half;
mod layouts;
mod mips;
mod radiance;
mod raster;
mod real_files;
mod shapes;

use bindpose::image::Image;

/// The largest level of the first face, texel by texel.
fn texels(image: &Image) -> Vec<[u8; 4]> {
    level_texels(image, 0, 0)
}

fn level_texels(image: &Image, face: u32, level: u32) -> Vec<[u8; 4]> {
    let texels = image.to_rgba8(face, level).expect("the level is there");
    texels.as_chunks::<4>().0.to_vec()
}
