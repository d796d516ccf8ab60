//! What check names and fix mends.

use bindpose::anim::CompiledClip;
use bindpose::check;
use bindpose::diagnostic::codes;
use bindpose::edit::Edits;
use bindpose::format::{Document, LineMap};
use bindpose::model::{Channel, Model};
use glam::Vec3;

use super::{apart, edit, figure, seen, size, swaying};
use crate::documents::{arm, key, model_of, quad, track, vertex, with_translation};
use crate::rigs;

const FIX: Edits = Edits {
    in_place: Vec::new(),
    clips: None,
    fix: true,
    range_secs: None,
    close_loop_secs: None,
    reduce: None,
    scale: None,
    up_axis: None,
    handedness: None,
    front: None,
    clip_names: Vec::new(),
    bone_names: Vec::new(),
    keys_for_all: false,
    for_book: false,
};

fn found(model: &Model) -> Vec<&'static str> {
    let findings = check::model(model, &CompiledClip::all(&model.clips), &LineMap::default());
    findings.iter().map(|finding| finding.code).collect()
}

/// A swaying chain with one of everything that can be mended.
fn flawed() -> Document {
    let mut document = swaying(3, 1.0);
    document.materials[0].normal_map = Some("bumps.dds".to_owned());
    document.triangles.insert(1, [0, 0, 1]);
    document.triangles.push([2, 0, 1]);
    document.triangles.push([1, 0, 2]);
    document.subsets[0].face_count = document.triangles.len() as u32;
    document.vertices.insert(0, vertex(9.0, 9.0));
    document.vertices[0].blend_weights = [1.0, 0.0, 0.0, 0.0];
    document
        .triangles
        .as_flattened_mut()
        .iter_mut()
        .for_each(|corner| *corner += 1);
    for vertex in &mut document.vertices[4..7] {
        vertex.tangent[3] *= -1.0;
    }
    for bone in 1..3 {
        let still = (0..31).map(|index| key(index as f32 / 30.0, [0.0, 0.5, 0.0]));
        document.clips[0].bones[bone] = track(still.collect::<Vec<_>>());
    }
    document
}

#[test]
fn what_is_mended_is_told_once_and_found_no_more() {
    let (model, _) = model_of(&flawed());
    let before = found(&model);
    let edited = edit(&model, &FIX);
    let after = found(&edited.model);
    let mended: Vec<_> = edited.changes.iter().map(|change| change.code).collect();
    let expected = [
        &codes::TRIANGLES_WITHOUT_AREA,
        &codes::TRIANGLES_REPEATED,
        &codes::VERTICES_UNUSED,
        &codes::TANGENT_SIGN_AGAINST_UV,
        &codes::KEYS_ALL_EQUAL,
    ];
    assert_eq!(mended, expected.map(|code| code.name));
    for code in expected {
        assert!(before.contains(&code.name), "{} is there before", code.name);
        // The one that winds the other way may be a back, and stays.
        assert_eq!(
            after.contains(&code.name),
            code.name == codes::TRIANGLES_REPEATED.name,
            "{}",
            code.name
        );
    }
    assert_eq!(edit(&edited.model, &FIX).changes, [], "nothing is left to mend");
}

#[test]
fn what_is_seen_stays_where_it_was() {
    let (model, _) = model_of(&flawed());
    let fixed = edit(&model, &FIX).model;
    assert_eq!(fixed.mesh.triangle_count(), 4);
    assert_eq!(fixed.mesh.submeshes[0].triangle_count, 4);
    assert_eq!(fixed.mesh.vertex_count(), model.mesh.vertex_count() - 1);
    for secs in [0.0, 0.3, 1.0] {
        let (old, new) = (seen(&model, 0, secs).positions, seen(&fixed, 0, secs).positions);
        assert!(apart(&old[1..], &new) <= 1e-6 * size(&model));
    }
}

#[test]
fn submeshes_keep_their_own_triangles() {
    let mut document = quad();
    document.materials.push(crate::documents::material("other"));
    document.triangles = vec![[0, 0, 1], [0, 1, 2], [1, 1, 1], [0, 2, 3]];
    document.subsets = vec![crate::documents::subset(0, 2), crate::documents::subset(2, 2)];
    let (model, _) = model_of(&document);
    let fixed = edit(&model, &FIX).model;
    let ranges: Vec<_> = fixed
        .mesh
        .submeshes
        .iter()
        .map(|one| (one.triangle_start, one.triangle_count))
        .collect();
    assert_eq!(ranges, [(0, 1), (1, 1)]);
    assert_eq!(fixed.mesh.indices, [0, 1, 2, 0, 2, 3]);
}

#[test]
fn a_clip_of_still_bones_keeps_its_length() {
    let mut document = arm();
    for bone in &mut document.clips[0].bones {
        *bone = track([key(0.0, [0.0; 3]), key(0.5, [0.0; 3]), key(1.0, [0.0; 3])]);
    }
    let (model, _) = model_of(&document);
    let fixed = edit(&model, &FIX).model;
    assert_eq!((fixed.clips[0].start_secs, fixed.clips[0].end_secs), (0.0, 1.0));
    assert_eq!(fixed.clips[0].key_count, 4);
}

#[test]
fn a_curve_between_equal_keys_is_no_still_bone() {
    let (mut model, _) = model_of(&rigs::rig(1, vec![rigs::even("one", 1, 0.0, 2, 1.0)]));
    let still = model.clips[0].tracks[0].key(0);
    let keys = [0.0, 1.0, 2.0].map(|secs| (secs, still));
    let wave = keys.map(|(secs, joint)| (secs, joint.translation, [Vec3::ONE, Vec3::ONE]));
    let track = bindpose::model::Track::new(keys).expect("keys in order");
    let track = with_translation(&track, Channel::spline(wave));
    model.clips[0] = bindpose::model::Clip::new("one", vec![track]);
    let fixed = edit(&model, &FIX);
    assert_eq!(fixed.model.clips, model.clips);
}

#[test]
fn a_sound_figure_stays_as_it_is() {
    let model = figure();
    let mendable = [
        &codes::TRIANGLES_WITHOUT_AREA,
        &codes::TRIANGLES_REPEATED,
        &codes::VERTICES_UNUSED,
        &codes::TANGENT_SIGN_AGAINST_UV,
        &codes::KEYS_ALL_EQUAL,
    ];
    let findings = found(&model);
    let named = mendable.iter().filter(|code| findings.contains(&code.name)).count();
    assert_eq!(edit(&model, &FIX).changes.len(), named);
}
