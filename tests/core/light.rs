//! Tests of `light`.

mod book;
mod environment;
mod furnace;
mod images;
mod prefilter;
mod shaders;
mod sky_lamp;
mod studio;
mod tone_map;

use glam::Vec3;

/// The direction over the horizontal, `turn_radians` from +z towards +x and `height_radians` up.
fn direction(turn_radians: f32, height_radians: f32) -> Vec3 {
    let flat = height_radians.cos();
    Vec3::new(
        flat * turn_radians.sin(),
        height_radians.sin(),
        flat * turn_radians.cos(),
    )
}

/// Directions spread evenly over the sphere, by the golden angle.
fn all_directions(count: usize) -> impl Iterator<Item = Vec3> {
    (0..count).map(move |index| {
        let y = 1.0 - (2 * index + 1) as f32 / count as f32;
        direction(index as f32 * 2.399_963_2, y.asin())
    })
}

/// The largest difference of two colours in a channel.
fn difference(a: Vec3, b: Vec3) -> f32 {
    (a - b).abs().max_element()
}
