//! CPU skinning against a plain loop in f64.

use bindpose::anim::{CompiledClip, Palette, PoseBuffers, SkinnedVertices, skin, skin_positions};
use bindpose::import::m3d;
use bindpose::model::Model;
use glam::{Affine3A, DAffine3, DMat3, DVec3, Mat3, Quat, Vec3};

use crate::documents::{arm, model_of, quad, soldier};
use crate::textbook;

fn skinned(model: &Model, palette: &Palette) -> SkinnedVertices {
    let mut out = SkinnedVertices::default();
    skin(&model.mesh, palette, &mut out);
    let mut positions = Vec::new();
    skin_positions(&model.mesh, palette, &mut positions);
    assert_eq!(out.positions, positions, "positions alone are the same positions");
    out
}

/// Greatest distance of a position, and greatest distance of a unit normal or tangent, from the plain way: blended matrix,
/// its inverse transpose, f64.
fn greatest_errors(model: &Model, palette: &Palette) -> (f64, f64) {
    let out = skinned(model, palette);
    let mesh = &model.mesh;
    let (mut position_error, mut direction_error) = (0.0_f64, 0.0_f64);
    for vertex in 0..mesh.vertex_count() {
        let mut linear = DMat3::ZERO;
        let mut translation = DVec3::ZERO;
        let influences = &mesh.influences[vertex];
        for slot in 0..4 {
            let matrix: DAffine3 = palette.0[influences.joints[slot] as usize].as_daffine3();
            linear += matrix.matrix3 * f64::from(influences.weights[slot]);
            translation += matrix.translation * f64::from(influences.weights[slot]);
        }
        let position = linear * mesh.positions[vertex].as_dvec3() + translation;
        let normal = (linear.inverse().transpose() * mesh.normals[vertex].as_dvec3()).normalize();
        let tangent = (linear * mesh.tangents[vertex].truncate().as_dvec3()).normalize();
        position_error = position_error.max(position.distance(out.positions[vertex].as_dvec3()));
        direction_error = direction_error.max(normal.distance(out.normals[vertex].as_dvec3()));
        direction_error = direction_error.max(tangent.distance(out.tangents[vertex].truncate().as_dvec3()));
        assert_eq!(
            out.tangents[vertex].w,
            mesh.tangents[vertex].w * linear.determinant().signum() as f32
        );
    }
    (position_error, direction_error)
}

#[test]
fn the_arm_bends_as_in_the_plain_loop() {
    let (model, _) = model_of(&arm());
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    for step in 0_u8..=20 {
        buffers.evaluate(
            &model.skeleton,
            &CompiledClip::new(&model.clips[0]),
            f32::from(step) / 20.0,
        );
        let (position, direction) = greatest_errors(&model, &buffers.palette);
        assert!(position < 1e-5 && direction < 1e-5, "{position} {direction}");
    }
}

#[test]
fn normals_stay_square_to_the_surface_under_any_scale_and_mirror() {
    let (model, _) = model_of(&arm());
    let lean = Quat::from_rotation_x(0.7) * Quat::from_rotation_z(0.4);
    for scale in [
        Vec3::new(3.0, 0.2, 1.0),
        Vec3::new(1.0, 1.0, -1.0),
        Vec3::new(-2.0, -0.5, -1.0),
        Vec3::splat(1e-4),
        Vec3::splat(1e4),
    ] {
        let matrix = Affine3A::from_mat3(Mat3::from_quat(lean) * Mat3::from_diagonal(scale) * Mat3::from_quat(lean));
        let (position, direction) = greatest_errors(&model, &Palette(vec![matrix; 3]));
        assert!(
            position < 1e-5 * f64::from(scale.abs().max_element()).max(1.0),
            "{scale}: {position}"
        );
        assert!(direction < 1e-4, "{scale}: {direction}");
    }
}

#[test]
fn the_soldier_runs_as_in_the_textbook() {
    let Some(parsed) = soldier() else { return };
    let (model, _) = m3d::from_parsed(&parsed).expect("sound");
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    for time_secs in [-1.0_f32, 0.0, 0.2083, 0.517, 1.2083, 1.24, 1.25, 7.0] {
        buffers.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), time_secs);
        let (position, direction) = greatest_errors(&model, &buffers.palette);
        assert!(
            position < 5e-5 && direction < 1e-4,
            "{time_secs} s: {position} {direction}"
        );

        // And all the way from the file's own numbers.
        let palette = textbook::palette(&parsed.document, 0, f64::from(time_secs));
        let out = skinned(&model, &buffers.palette);
        for (vertex, position) in parsed.document.vertices.iter().zip(&out.positions) {
            let weights = vertex.blend_weights.map(f64::from);
            let expected = textbook::skinned(vertex.position, weights, vertex.blend_indices, &palette);
            let distance = position.as_dvec3().distance(expected.into());
            assert!(distance < 3e-4, "{position} is {distance} from {expected:?}");
        }
    }
}

#[test]
fn the_bind_pose_moves_nothing() {
    let (model, _) = model_of(&arm());
    let out = skinned(&model, &PoseBuffers::for_skeleton(&model.skeleton).palette);
    for (moved, stored) in out.positions.iter().zip(&model.mesh.positions) {
        assert!(moved.abs_diff_eq(*stored, 1e-6));
    }
    for (moved, stored) in out.normals.iter().zip(&model.mesh.normals) {
        assert!(moved.abs_diff_eq(*stored, 1e-6));
    }
}

#[test]
fn static_meshes_and_vertices_without_weights_stay() {
    let (model, _) = model_of(&quad());
    let out = skinned(&model, &Palette::default());
    assert_eq!(
        (&out.positions, &out.normals, &out.tangents),
        (&model.mesh.positions, &model.mesh.normals, &model.mesh.tangents)
    );

    let mut document = arm();
    document.vertices[4].blend_weights = [0.0; 4];
    let (model, _) = model_of(&document);
    let away = Affine3A::from_translation(Vec3::splat(100.0));
    let out = skinned(&model, &Palette(vec![away; 3]));
    assert_eq!(out.positions[4], model.mesh.positions[4]);
    assert_eq!(out.normals[4], model.mesh.normals[4]);
    assert_ne!(out.positions[5], model.mesh.positions[5]);
}

#[test]
fn a_mesh_without_tangents_is_skinned_without_them() {
    let (mut model, _) = model_of(&arm());
    let away = Palette(vec![Affine3A::from_rotation_z(0.5); 3]);
    let with = skinned(&model, &away);
    model.mesh.tangents.clear();
    let without = skinned(&model, &away);
    assert_eq!((&without.positions, &without.normals), (&with.positions, &with.normals));
    assert_eq!(without.tangents, []);
}

#[test]
fn matrices_that_flatten_space_leave_no_nan() {
    let (model, _) = model_of(&arm());
    for matrix in [
        Affine3A::from_scale(Vec3::ZERO),
        Affine3A::from_scale(Vec3::new(1.0, 0.0, 0.0)),
        Affine3A::from_scale(Vec3::splat(1e-30)),
    ] {
        let out = skinned(&model, &Palette(vec![matrix; 3]));
        assert!(out.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-4));
        assert!(
            out.tangents
                .iter()
                .all(|tangent| (tangent.truncate().length() - 1.0).abs() < 1e-4)
        );
    }
}
