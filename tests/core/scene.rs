//! Tests of `scene`: cameras, bones and colours as plain data.

mod appearance;
mod bones;
mod camera;
mod flight;
mod framing;
mod ground;
mod ray;
mod shots;
mod sight;
mod skin_colors;
mod tint;

use bindpose::scene::Aabb;
use glam::Vec3;

fn unit_box() -> Aabb {
    Aabb {
        min: Vec3::splat(-1.0),
        max: Vec3::splat(1.0),
    }
}
