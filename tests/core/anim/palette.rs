//! Palettes against the textbook: offset · toRoot in f64, for small documents and the real ones.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::format::{Document, Keyframe};
use bindpose::import::m3d;
use bindpose::model::Model;
use glam::{Affine3A, Mat4};

use crate::documents::{REAL_FILES, arm, key, model_of, offset, real_file, reordered, soldier, track};
use crate::textbook::{self, Matrix};

/// What the books' own f32 loses on a model 72 units high.
const TOLERANCE: f64 = 1e-4;

/// What f32 loses through three joints with numbers below 4: about ten steps of the last place.
pub(super) const SMALL_TOLERANCE: f64 = 5e-6;

/// Greatest difference between our palette and the textbook's, over all bones, numbers and times.
pub(super) fn greatest_error(
    document: &Document,
    model: &Model,
    clip: usize,
    times_secs: impl Iterator<Item = f32>,
) -> f64 {
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    let mut greatest = 0.0;
    for time_secs in times_secs {
        buffers.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[clip]), time_secs);
        let expected = textbook::palette(document, clip, f64::from(time_secs));
        for (matrix, &bone) in buffers.palette.0.iter().zip(model.skeleton.file_bones()) {
            greatest = f64::max(greatest, difference(matrix, &expected[bone as usize]));
        }
    }
    greatest
}

fn difference(ours: &Affine3A, theirs: &Matrix) -> f64 {
    // Our columns are the books' rows.
    let ours = Mat4::from(*ours).to_cols_array_2d();
    let pairs = ours.as_flattened().iter().zip(theirs.as_flattened());
    pairs
        .map(|(&ours, &theirs)| (f64::from(ours) - theirs).abs())
        .fold(0.0, |greatest, difference| {
            assert!(!difference.is_nan());
            f64::max(greatest, difference)
        })
}

/// From before the first key to after the last one, and every key time itself.
pub(super) fn times_of(document: &Document, clip: usize, steps: u16) -> Vec<f32> {
    let keys = || {
        document.clips[clip]
            .bones
            .iter()
            .flat_map(|bone| &bone.keyframes)
            .map(|key| key.time_secs)
    };
    let (start, end) = keys().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), time| {
        (a.min(time), b.max(time))
    });
    let (start, end) = (start - 0.25, end + 0.25);
    let even = (0..=steps).map(|step| start + (end - start) * f32::from(step) / f32::from(steps));
    keys().take(200).chain(even).chain([-1e6, 1e6]).collect()
}

#[test]
fn real_files_pose_as_in_the_textbook() {
    for file in REAL_FILES {
        let Some(parsed) = real_file(file) else { continue };
        let (model, _) = m3d::from_parsed(&parsed).expect("sound");
        for clip in 0..model.clips.len() {
            let times_secs = times_of(&parsed.document, clip, 500);
            let error = greatest_error(&parsed.document, &model, clip, times_secs.into_iter());
            assert!(error <= TOLERANCE, "{file}, clip {clip}: {error}");
        }
    }
}

#[test]
fn changed_arms_pose_as_in_the_textbook() {
    type Change = fn(&mut Document);
    let cases: [(&str, Change, &[&str]); 5] = [
        ("the arm poses as in the textbook", |_| {}, &[]),
        ("tracks that begin and end apart hold their ends", apart, &[]),
        ("several roots move on their own", several_roots, &[]),
        ("scale goes before rotation and down to the children", scaled, &[]),
        (
            "the shorter arc is taken from either side",
            other_sides,
            &["rotation-side"],
        ),
    ];
    for (name, change, expected) in cases {
        let mut document = arm();
        change(&mut document);
        let (model, codes) = model_of(&document);
        assert_eq!(codes, expected, "{name}");
        let error = greatest_error(&document, &model, 0, times_of(&document, 0, 300).into_iter());
        assert!(error <= SMALL_TOLERANCE, "{name}: {error}");
    }
    let mut document = arm();
    apart(&mut document);
    let (model, _) = model_of(&document);
    assert_eq!((model.clips[0].start_secs, model.clips[0].end_secs), (-1.0, 3.0));
}

fn apart(document: &mut Document) {
    let bones = &mut document.clips[0].bones;
    bones[0].keyframes.iter_mut().for_each(|key| key.time_secs += 2.0);
    for key in &mut bones[1].keyframes {
        key.time_secs = key.time_secs * 0.5 - 1.0;
    }
    bones[2] = track([key(0.5, [0.0, 1.0, 0.0])]);
}

fn several_roots(document: &mut Document) {
    document.bone_parents = vec![-1, 0, -1];
    document.clips[0].bones[2] = track([key(0.0, [0.0, 2.0, 0.0]), key(1.0, [5.0, 2.0, 0.0])]);
}

fn scaled(document: &mut Document) {
    document.clips[0].bones[0].keyframes[1].scale = [2.0, 0.5, -1.0];
    document.clips[0].bones[1].keyframes[0].scale = [1.0, 3.0, 1.0];
}

fn other_sides(document: &mut Document) {
    for bone in &mut document.clips[0].bones {
        let last = &mut bone.keyframes[1];
        last.rotation = last.rotation.map(|number| -number);
    }
}

#[test]
fn any_order_of_bones_poses_the_same() {
    let (sorted, _) = model_of(&arm());
    let mut expected = PoseBuffers::for_skeleton(&sorted.skeleton);
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let document = reordered(&arm(), &order);
        let (model, _) = model_of(&document);
        let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
        for time_secs in [-0.5, 0.0, 0.3, 0.75, 1.0, 2.0] {
            buffers.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), time_secs);
            expected.evaluate(&sorted.skeleton, &CompiledClip::new(&sorted.clips[0]), time_secs);
            // The joints stand in one order again, so the palettes are equal to the bit.
            assert_eq!(buffers.palette.0, expected.palette.0, "{order:?} at {time_secs} s");
        }
        assert!(greatest_error(&document, &model, 0, times_of(&document, 0, 50).into_iter()) <= SMALL_TOLERANCE);
    }
}

#[test]
fn a_thousand_bones_pose_as_in_the_textbook() {
    let count = 1_000_u16;
    let mut document = arm();
    document.bone_parents = (0..i32::from(count))
        .map(|bone| bone / 2 - i32::from(bone == 0))
        .collect();
    // Bone 1's half is bone 0, as is bone 0's own, which is the root.
    document.bone_parents[0] = -1;
    document.bone_offsets = (0..count)
        .map(|bone| offset([f32::from(bone) * 0.01, 0.0, 0.0]))
        .collect();
    document.clips[0].bones = (0..count)
        .map(|bone| {
            let swing = f32::from(bone % 7) * 0.2;
            let turn = |time_secs, angle| crate::documents::turned(key(time_secs, [0.1, 0.2, 0.0]), angle);
            track([turn(0.0, -swing), turn(0.3, swing), turn(0.7, 0.0)])
        })
        .collect();
    let (model, _) = model_of(&document);
    assert_eq!(model.skeleton.joint_count(), 1_000);
    let error = greatest_error(&document, &model, 0, [0.0, 0.11, 0.42, 0.69, 5.0].into_iter());
    assert!(error <= 1e-5, "{error}");
}

#[test]
fn the_bind_pose_gives_identity_matrices() {
    let (model, _) = model_of(&arm());
    let buffers = PoseBuffers::for_skeleton(&model.skeleton);
    assert_eq!(buffers.palette.0, [Affine3A::IDENTITY; 3]);

    // Reached through the stages, from the joints at rest, it is the same pose.
    let rest = |document: &Document, tolerance: f32| {
        let mut document = document.clone();
        for clip in &mut document.clips {
            clip.bones.iter_mut().for_each(|bone| bone.keyframes.clear());
        }
        let (model, _) = model_of(&document);
        let mut buffers = PoseBuffers::default();
        buffers.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 0.4);
        for matrix in &buffers.palette.0 {
            assert!(matrix.abs_diff_eq(Affine3A::IDENTITY, tolerance), "{matrix:?}");
        }
        let bind = PoseBuffers::for_skeleton(&model.skeleton);
        for (ours, bind) in buffers.model.0.iter().zip(&bind.model.0) {
            assert!(ours.abs_diff_eq(*bind, tolerance), "{ours:?} {bind:?}");
        }
    };
    rest(&arm(), 1e-6);
    if let Some(parsed) = real_file("d3d12/soldier") {
        rest(&parsed.document, 1e-4);
    }
}

#[test]
fn the_soldier_s_root_begins_where_it_was_skinned() {
    let Some(parsed) = soldier() else { return };
    let (model, _) = m3d::from_parsed(&parsed).expect("sound");
    let mut buffers = PoseBuffers::default();
    buffers.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 0.0);
    assert!(
        buffers.palette.0[0].abs_diff_eq(Affine3A::IDENTITY, 5e-5),
        "{:?}",
        buffers.palette.0[0]
    );
}

#[test]
fn buffers_are_filled_anew_and_not_grown() {
    let (model, _) = model_of(&arm());
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    let places = |buffers: &PoseBuffers| {
        (
            buffers.local.groups.as_ptr(),
            buffers.model.0.as_ptr(),
            buffers.palette.0.as_ptr(),
        )
    };
    let before = places(&buffers);
    for frame in 0_u8..100 {
        buffers.evaluate(
            &model.skeleton,
            &CompiledClip::new(&model.clips[0]),
            f32::from(frame) * 0.02,
        );
    }
    assert_eq!(places(&buffers), before);
    assert_eq!(buffers.palette.0.len(), 3);
    // A smaller model after a greater one leaves nothing behind.
    let mut small = arm();
    small.bone_offsets.truncate(1);
    small.bone_parents.truncate(1);
    small.clips[0].bones.truncate(1);
    small
        .vertices
        .iter_mut()
        .for_each(|vertex| vertex.blend_weights = [1.0, 0.0, 0.0, 0.0]);
    small
        .vertices
        .iter_mut()
        .for_each(|vertex| vertex.blend_indices = [0; 4]);
    let (small, _) = model_of(&small);
    buffers.evaluate(&small.skeleton, &CompiledClip::new(&small.clips[0]), 0.5);
    assert_eq!(
        (
            buffers.local.joint_count(),
            buffers.model.0.len(),
            buffers.palette.0.len()
        ),
        (1, 1, 1)
    );
}

#[test]
fn a_static_model_has_an_empty_palette() {
    let (model, _) = model_of(&crate::documents::quad());
    let buffers = PoseBuffers::for_skeleton(&model.skeleton);
    assert!(buffers.palette.0.is_empty() && buffers.local.groups.is_empty());
}

/// Keys a millisecond apart with nearly equal rotations, and keys almost a half turn apart: both ends of what the arc's
/// polynomial has to do.
#[test]
fn tiny_and_wide_arcs_turn_at_even_speed() {
    for angle in [0.0, 1e-7, 1e-4, 0.1, 1.0, 2.0, 3.0, 3.13] {
        let mut document = arm();
        for bone in &mut document.clips[0].bones[1..] {
            bone.keyframes.truncate(1);
        }
        let first: Keyframe = key(0.0, [0.0; 3]);
        document.clips[0].bones[0] = track([first, crate::documents::turned(key(1.0, [0.0; 3]), angle)]);
        let (model, _) = model_of(&document);
        let mut buffers = PoseBuffers::default();
        for step in 0_u8..=100 {
            let part = f32::from(step) / 100.0;
            buffers.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), part);
            let expected = Affine3A::from_rotation_z(angle * part);
            assert!(buffers.model.0[0].abs_diff_eq(expected, 1e-6), "{angle} at {part}");
        }
    }
}
