//! Uniforms of a frame.

use bindpose::anim::Palette;
use bindpose::render::for_tests::{Lamps, instance_size, light_uniform};
use bindpose::scene::{
    Aabb, Camera, Crowd, CrowdInstance, FrameOptions, Ghosts, Ground, Light, Projection, RenderFrame,
};
use glam::{Affine3A, Vec3};

/// The height of the book's own figure.
const BOOK_HEIGHT: f32 = 3.6;

/// One, two and eight figures 2 × 4 × 1 in a row, 3 apart, in boxes that hold them.
#[test]
fn lengths_of_the_light_are_the_same_in_a_crowd() {
    let instances: Vec<_> = (1..8)
        .map(|step| CrowdInstance {
            world_from_model: Affine3A::from_translation(Vec3::X * 3.0 * step as f32),
            palette: 0,
        })
        .collect();
    let palette = Palette::default();
    let frame = |count: usize| RenderFrame {
        camera: Camera {
            target: Vec3::ZERO,
            distance: 10.0,
            yaw_radians: 0.0,
            pitch_radians: 0.0,
            projection: Projection::Orthographic,
        },
        world_from_model: Affine3A::IDENTITY,
        world_bounds: Aabb {
            min: Vec3::new(-1.0, 0.0, -0.5),
            max: Vec3::new(1.0 + 3.0 * count as f32, 4.0, 0.5),
        },
        ground: Ground { height: 0.0, cell: 1.0 },
        mesh: None,
        palette: &palette,
        crowd: Crowd {
            instances: &instances[..count],
            in_sight: 0,
            palettes: &[],
        },
        hidden_submeshes: &[],
        highlighted_submesh: None,
        vertex_colors: None,
        ghosts: Ghosts::default(),
        seen_through: None,
        sample: None,
        options: FrameOptions::default(),
    };
    for count in [0, 1, 7] {
        let frame = frame(count);
        assert_eq!(instance_size(&frame), Vec3::new(2.0, 4.0, 1.0), "{count} beside it");
        let light = light_uniform(&frame, Light::Studio, Lamps::Studio, 2048);
        assert_eq!(light.book_unit, 4.0 / BOOK_HEIGHT);
    }
}
