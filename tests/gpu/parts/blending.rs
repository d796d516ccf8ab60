//! The middle of what is blended.

use bindpose::anim::{Palette, skin_positions};
use bindpose::model::{Influences, Mesh};
use bindpose::render::for_tests::{Center, DrawRange};
use glam::{Affine3A, Quat, Vec3};

#[test]
fn a_centre_is_the_mean_of_the_posed_corners() {
    let influences = |joints: [u32; 4], weights: [f32; 4]| Influences { joints, weights };
    let mesh = Mesh {
        positions: vec![Vec3::X, Vec3::new(2.0, 3.0, -1.0), Vec3::Z, Vec3::new(-4.0, 0.5, 2.0)],
        influences: vec![
            influences([0, 1, 0, 0], [0.25, 0.75, 0.0, 0.0]),
            influences([1, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]),
            influences([0; 4], [0.0; 4]),
            influences([0, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]),
        ],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    let ranges = [0..3, 0..6].map(|indices| DrawRange {
        submesh: 0,
        indices,
        vertices: 0..4,
        material: 0,
    });
    let palette = Palette(vec![
        Affine3A::from_rotation_translation(Quat::from_rotation_y(0.7), Vec3::new(1.0, -2.0, 0.5)),
        Affine3A::from_scale_rotation_translation(Vec3::splat(1.5), Quat::from_rotation_x(-1.2), Vec3::Y),
    ]);
    let mut posed = Vec::new();
    skin_positions(&mesh, &palette, &mut posed);
    for (range, center) in ranges.iter().zip(Center::of(&mesh, &ranges, 2)) {
        let corners = &mesh.indices[range.indices.start as usize..range.indices.end as usize];
        let mean = |positions: &[Vec3]| {
            corners.iter().map(|&corner| positions[corner as usize]).sum::<Vec3>() / corners.len() as f32
        };
        assert!(center.posed(&palette.0).distance(mean(&posed)) < 1e-5);
        assert!(center.posed(&[]).distance(mean(&mesh.positions)) < 1e-5);
    }
}
