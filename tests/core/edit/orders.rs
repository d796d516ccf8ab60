//! Edits one after another, in any order.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::edit::Edits;
use bindpose::model::{Front, Handedness, Model, UpAxis};
use glam::Vec3;
use proptest::prelude::*;

use super::{apart, curved, edit, seen, size, spread, swaying};
use crate::documents::model_of;
use crate::rigs;

#[derive(Clone, Copy, Debug)]
enum One {
    Fix,
    Range(f32, f32),
    Close(f32),
    Reduce(f32),
    Scale(f32),
    Up(UpAxis),
    Hand(Handedness),
    Front(Front),
    Rename,
    NameBone,
    ForBook,
}

fn ones() -> impl Strategy<Value = One> {
    prop_oneof![
        Just(One::Fix),
        (0.0_f32..0.4, 0.6_f32..1.0).prop_map(|(from, to)| One::Range(from, to)),
        (0.1_f32..0.9).prop_map(One::Close),
        (-4.0_f32..-2.0).prop_map(|exponent| One::Reduce(10.0_f32.powf(exponent))),
        (0.2_f32..5.0).prop_map(One::Scale),
        prop::sample::select(UpAxis::ALL.to_vec()).prop_map(One::Up),
        prop::sample::select(Handedness::ALL.to_vec()).prop_map(One::Hand),
        prop::sample::select(Front::ALL.to_vec()).prop_map(One::Front),
        Just(One::Rename),
        Just(One::NameBone),
        Just(One::ForBook),
    ]
}

fn model(number: usize) -> Model {
    match number {
        0 => curved(),
        1 => model_of(&rigs::rig(9, vec![rigs::ragged("one", 9)])).0,
        _ => model_of(&swaying(5, 1.5)).0,
    }
}

/// The triangles as the world sees them in the bind pose, in units of the model's size, in an order of their own.
fn triangles(model: &Model) -> Vec<[[i64; 3]; 3]> {
    let world = bindpose::model::world_from_model(model.handedness, model.up_axis, model.front);
    let least = size(model) * 1e-4;
    let corner = |vertex: &u32| {
        let position: Vec3 = world.transform_point3(model.mesh.positions[*vertex as usize]);
        position.to_array().map(|part| (part / least).round() as i64)
    };
    let mut triangles: Vec<_> = model
        .mesh
        .indices
        .as_chunks::<3>()
        .0
        .iter()
        .map(|corners| {
            let mut corners = [0, 1, 2].map(|place| corner(&corners[place]));
            corners.sort_unstable();
            corners
        })
        .collect();
    triangles.sort_unstable();
    triangles
}

fn is_near(a: &[[[i64; 3]; 3]], b: &[[[i64; 3]; 3]]) -> bool {
    // Rounding may come out one step apart.
    a.len() == b.len() && {
        let (a, b) = (a.as_flattened().as_flattened(), b.as_flattened().as_flattened());
        let sums = [a, b].map(|parts| parts.iter().sum::<i64>());
        (sums[0] - sums[1]).unsigned_abs() as usize <= a.len()
    }
}

fn joint_places(model: &Model, secs: f32) -> Vec<Vec3> {
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), secs);
    pose.model.0.iter().map(|joint| joint.translation.into()).collect()
}

fn make(before: &Model, one: One) -> (Edits, Model) {
    let clip = &before.clips[0];
    let edits = Edits::default();
    let at = |part: f32| clip.start_secs + part * clip.duration_secs();
    let edits = match one {
        One::Fix => Edits { fix: true, ..edits },
        One::Range(from, to) => Edits {
            range_secs: Some([at(from), at(to)]),
            ..edits
        },
        One::Close(part) => Edits {
            close_loop_secs: Some(part * clip.duration_secs()),
            ..edits
        },
        One::Reduce(tolerance) => Edits {
            reduce: Some(tolerance),
            ..edits
        },
        One::Scale(factor) => Edits {
            scale: Some(factor),
            ..edits
        },
        One::Up(axis) => Edits {
            up_axis: Some(axis),
            ..edits
        },
        One::Hand(hand) => Edits {
            handedness: Some(hand),
            ..edits
        },
        One::Front(front) => Edits {
            front: Some(front),
            ..edits
        },
        One::Rename => Edits {
            clip_names: vec![(clip.name.clone(), format!("{}x", clip.name))],
            ..edits
        },
        One::NameBone => Edits {
            bone_names: vec![(0, "hips".to_owned())],
            ..edits
        },
        One::ForBook => Edits {
            for_book: true,
            ..edits
        },
    };
    let after = edit(before, &edits).model;
    (edits, after)
}

/// What an edit leaves as it was.
fn assert_kept(before: &Model, one: One, after: &Model) {
    let [old, new] = [before, after].map(|model| &model.clips[0]);
    let length = if let One::Range(from, to) = one { to - from } else { 1.0 };
    let lengths = [old.duration_secs() * length, new.duration_secs()];
    assert!((lengths[0] - lengths[1]).abs() < 1e-5, "{one:?}: {lengths:?}");
    if !matches!(one, One::Fix) {
        assert!(is_near(&triangles(before), &triangles(after)), "{one:?}");
    }
    if !matches!(one, One::Rename | One::ForBook) {
        assert_eq!(old.name, new.name, "{one:?}");
    }
    let scale = size(after) / size(before);
    let shift_secs = if matches!(one, One::ForBook) {
        old.start_secs
    } else {
        0.0
    };
    for secs in spread(old) {
        let new_secs = secs - shift_secs;
        let off = match one {
            // The poses in its part are held outside of it.
            One::Range(..) if secs < new.start_secs || secs > new.end_secs => continue,
            One::Close(part) if secs > old.end_secs - part * old.duration_secs() => continue,
            One::Fix => apart(&joint_places(before, secs), &joint_places(after, secs)),
            One::Reduce(_) => continue,
            _ => {
                let mut seen_before = seen(before, 0, secs).positions;
                seen_before.iter_mut().for_each(|position| *position *= scale);
                apart(&seen_before, &seen(after, 0, new_secs).positions) / scale
            }
        };
        assert!(off <= 1e-4 * size(before), "{one:?} at {secs} s: {off}");
    }
    if let One::Reduce(tolerance) = one {
        for secs in super::key_times(old) {
            let off = apart(&joint_places(before, secs), &joint_places(after, secs));
            assert!(off <= tolerance * size(before), "{one:?} at {secs} s: {off}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn edits_in_any_order_keep_what_they_must(number in 0_usize..3, order in prop::collection::vec(ones(), 1..8)) {
        let mut model = model(number);
        for one in order {
            let (_, after) = make(&model, one);
            assert_kept(&model, one, &after);
            model = after;
        }
    }
}

#[test]
fn one_call_makes_them_in_the_one_order() {
    let model = curved();
    let all = Edits {
        fix: true,
        range_secs: Some([0.2, 1.8]),
        close_loop_secs: Some(0.5),
        reduce: Some(1e-3),
        scale: Some(2.0),
        up_axis: Some(UpAxis::Z),
        handedness: Some(Handedness::Right),
        clip_names: vec![("sway".to_owned(), "Wind".to_owned())],
        ..Edits::default()
    };
    let at_once = edit(&model, &all);
    let steps = [
        Edits {
            fix: true,
            ..Edits::default()
        },
        Edits {
            range_secs: all.range_secs,
            ..Edits::default()
        },
        Edits {
            close_loop_secs: all.close_loop_secs,
            ..Edits::default()
        },
        Edits {
            reduce: all.reduce,
            ..Edits::default()
        },
        Edits {
            up_axis: all.up_axis,
            handedness: all.handedness,
            ..Edits::default()
        },
        Edits {
            scale: all.scale,
            ..Edits::default()
        },
        Edits {
            clip_names: all.clip_names.clone(),
            ..Edits::default()
        },
    ];
    let (mut one_by_one, mut changes) = (model, Vec::new());
    for step in steps {
        let edited = edit(&one_by_one, &step);
        one_by_one = edited.model;
        changes.extend(edited.changes);
    }
    assert_eq!(at_once.model.clips, one_by_one.clips);
    assert_eq!(at_once.model.mesh.positions, one_by_one.mesh.positions);
    assert_eq!(at_once.changes, changes);
}
