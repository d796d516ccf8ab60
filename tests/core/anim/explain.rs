//! A vertex explained comes where skinning brings it.

use bindpose::anim::{CompiledClip, PoseBuffers, RowMatrix, explain_vertex, skin_positions};
use bindpose::format::Document;
use bindpose::import::m3d;
use bindpose::model::Model;

use crate::chains::mirrored;
use crate::documents::{arm, model_of, quad, soldier};
use crate::textbook;

/// Every vertex, at some times: the sum is the skinned position, each step follows from the one before, and all agrees with
/// the textbook from the file's own numbers.
fn check(document: &Document, model: &Model, step: usize, tolerance: f64) {
    let (mut pose, mut positions) = (PoseBuffers::default(), Vec::new());
    for time_secs in [0.0_f32, 0.37, 1.0] {
        pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), time_secs);
        skin_positions(&model.mesh, &pose.palette, &mut positions);
        let expected = textbook::palette(document, 0, f64::from(time_secs));
        for vertex in (0..model.mesh.vertex_count()).step_by(step) {
            let explained = explain_vertex(model, &pose, vertex as u32).expect("there");
            let skinned = positions[vertex];
            let scale = skinned.length().max(explained.bind_position.length());
            assert!(
                explained.position.distance(skinned) <= 1e-5 * scale,
                "{} for {skinned}",
                explained.position
            );

            let named = &document.vertices[vertex];
            let of_file: Vec<_> = (0..4).filter(|&slot| named.blend_weights[slot] > 0.0).collect();
            assert_eq!(explained.influences.len(), of_file.len());
            for (influence, slot) in explained.influences.iter().zip(of_file) {
                assert_eq!(influence.bone, named.blend_indices[slot]);
                assert_eq!(
                    influence.offset.0.as_flattened(),
                    document.bone_offsets[influence.bone as usize]
                );
                let wide = |matrix: &RowMatrix| matrix.0.map(|row| row.map(f64::from));
                let product = textbook::product(&wide(&influence.offset), &wide(&influence.to_root));
                for (ours, theirs) in influence
                    .final_transform
                    .0
                    .as_flattened()
                    .iter()
                    .zip(product.as_flattened())
                {
                    assert!(
                        (f64::from(*ours) - theirs).abs() <= 1e-4 * theirs.abs().max(1.0),
                        "{ours} {theirs}"
                    );
                }
                let alone = textbook::skinned(named.position, [1.0, 0.0, 0.0, 0.0], [influence.bone; 4], &expected);
                assert!(influence.moved.as_dvec3().distance(alone.into()) < tolerance);
                assert!(influence.weighted.distance(influence.moved * influence.weight) == 0.0);
            }
            let sum = textbook::skinned(
                named.position,
                named.blend_weights.map(f64::from),
                named.blend_indices,
                &expected,
            );
            assert!(
                explained.position.as_dvec3().distance(sum.into()) < tolerance,
                "{} {sum:?}",
                explained.position
            );
        }
    }
}

#[test]
fn every_step_agrees_with_the_textbook() {
    for (document, step) in [(arm(), 1), (mirrored(1), 1), (mirrored(300), 7), (mirrored(2_000), 97)] {
        check(&document, &model_of(&document).0, step, 1e-4);
    }
}

#[test]
fn the_soldiers_vertices_come_where_skinning_brings_them() {
    let Some(parsed) = soldier() else { return };
    let (model, _) = m3d::from_parsed(&parsed).expect("sound");
    check(&parsed.document, &model, 41, 3e-4);
}

#[test]
fn the_text_is_the_formula_in_columns() {
    let (model, _) = model_of(&arm());
    let mut pose = PoseBuffers::default();
    pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 1.0);
    let explained = explain_vertex(&model, &pose, 3).expect("there");
    let text = explained.to_text(|joint| (joint.0 == 1).then_some("elbow"));
    let expected = "\
vertex 3: row vectors, matrices row by row as in the file
v' = sum of weight · (v · finalTransform)    finalTransform = offset · toRoot

v                  = [  0.250000  0.500000  0.000000  1 ]

bone 0, weight 0.500000
                  offset                                       toRoot                                    finalTransform
[ 1.000000  0.000000  0.000000  0.000000 ]   [  0.000000  1.000000  0.000000  0.000000 ]   [  0.000000  1.000000  0.000000  0.000000 ]
[ 0.000000  1.000000  0.000000  0.000000 ] · [ -1.000000  0.000000  0.000000  0.000000 ] = [ -1.000000  0.000000  0.000000  0.000000 ]
[ 0.000000  0.000000  1.000000  0.000000 ]   [  0.000000  0.000000  1.000000  0.000000 ]   [  0.000000  0.000000  1.000000  0.000000 ]
[ 0.000000  0.000000  0.000000  1.000000 ]   [  0.000000  0.000000  0.000000  1.000000 ]   [  0.000000  0.000000  0.000000  1.000000 ]
v · finalTransform = [ -0.500000  0.250000  0.000000  1 ]
        · weight   = [ -0.250000  0.125000  0.000000 ]

bone 1 \"elbow\", weight 0.500000
";
    assert!(text.starts_with(expected), "{text}");
    let last = text.lines().last().expect("lines");
    assert_eq!(
        last, "v'                 = [ -0.875000  0.375000  0.000000  1 ]",
        "{text}"
    );
}

#[test]
fn a_vertex_that_nothing_moves_stays_and_one_that_is_not_there_is_none() {
    let mut document = arm();
    document.vertices[4].blend_weights = [0.0; 4];
    for (document, vertex) in [(document, 4), (quad(), 2)] {
        let (model, _) = model_of(&document);
        let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
        if let Some(clip) = model.clips.first() {
            pose.evaluate(&model.skeleton, &CompiledClip::new(clip), 0.5);
        }
        let explained = explain_vertex(&model, &pose, vertex).expect("there");
        assert!(explained.influences.is_empty());
        assert_eq!(explained.position, model.mesh.positions[vertex as usize]);
        assert!(explained.to_text(|_| None).contains("no bone has weight: v'"));
        assert_eq!(explain_vertex(&model, &pose, model.mesh.vertex_count() as u32), None);
    }
}
