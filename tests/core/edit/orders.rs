//! Edits one after another, in any order.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::check;
use bindpose::diagnostic::Severity;
use bindpose::edit::Edits;
use bindpose::export::{MapImages, glb, m3d};
use bindpose::format::{Dialect, LineMap};
use bindpose::import::import;
use bindpose::model::{Front, Handedness, JointNames, Model, UpAxis};
use glam::Vec3;
use proptest::prelude::*;

use super::{apart, curved, edit, seen, seen_in, size, spread, swaying};
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
    let mut edits = Edits::default();
    let at = |part: f32| clip.start_secs + part * clip.duration_secs();
    match one {
        One::Fix => edits.fix = true,
        One::Range(from, to) => edits.range_secs = Some([at(from), at(to)]),
        One::Close(part) => edits.close_loop_secs = Some(part * clip.duration_secs()),
        One::Reduce(tolerance) => edits.reduce = Some(tolerance),
        One::Scale(factor) => edits.scale = Some(factor),
        One::Up(axis) => edits.up_axis = Some(axis),
        One::Hand(hand) => edits.handedness = Some(hand),
        One::Front(front) => edits.front = Some(front),
        One::Rename => edits.clip_names = vec![(clip.name.clone(), format!("{}x", clip.name))],
        One::NameBone => edits.bone_names = vec![(0, "hips".to_owned())],
        One::ForBook => edits.for_book = true,
    }
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
    let shift_secs = match one {
        One::ForBook => old.start_secs,
        One::Range(from, _) if new.duration_secs() < old.duration_secs() => old.start_secs + from * old.duration_secs(),
        _ => 0.0,
    };
    let [old_compiled, new_compiled] = [old, new].map(CompiledClip::new);
    let seen_before = |secs| seen_in(before, Some(&old_compiled), secs).positions;
    let seen_after = |secs| seen_in(after, Some(&new_compiled), secs).positions;
    for secs in spread(old) {
        let new_secs = secs - shift_secs;
        let off = match one {
            // The poses in its part are held outside of it.
            One::Range(..) if new_secs < new.start_secs || new_secs > new.end_secs => continue,
            One::Close(part) if secs > old.end_secs - part * old.duration_secs() => continue,
            One::Fix => apart(&joint_places(before, secs), &joint_places(after, secs)),
            One::Reduce(_) => continue,
            _ => {
                let mut seen_before = seen_before(secs);
                seen_before.iter_mut().for_each(|position| *position *= scale);
                // A shifted key of a STEP curve may stand one rounding apart from the shifted time.
                let off = |late_secs| apart(&seen_before, &seen_after(new_secs + late_secs)) / scale;
                [0.0, 1e-6, -1e-6].map(off).into_iter().fold(f32::INFINITY, f32::min)
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
    #![proptest_config(crate::properties::cases(48))]
    #[test]
    fn edits_in_any_order_keep_what_they_must(number in 0_usize..3, order in prop::collection::vec(ones(), 1..8)) {
        let mut model = model(number);
        for one in order {
            let (_, after) = make(&model, one);
            assert_kept(&model, one, &after);
            assert_sound(&after);
            model = after;
        }
        assert_read_back(&model);
    }

    #[test]
    fn edits_of_one_call_leave_a_model_that_is_written_and_read(number in 0_usize..3, edits in all_at_once()) {
        let before = model(number);
        let clip = &before.clips[0];
        let length_secs = clip.duration_secs();
        let edits = Edits {
            range_secs: edits.range_secs.map(|range| range.map(|part| clip.start_secs + part * length_secs)),
            // Of what the cut leaves.
            close_loop_secs: edits.close_loop_secs.map(|part| part * 0.2 * length_secs),
            clip_names: edits.clip_names.iter().map(|(_, name)| (clip.name.clone(), name.clone())).collect(),
            clips: edits.clips.as_ref().map(|_| vec![clip.name.clone()]),
            ..edits
        };
        let after = edit(&before, &edits).model;
        assert_sound(&after);
        let lengths = [after.clips[0].duration_secs(), edits.range_secs.map_or(length_secs, |[from, to]| to - from)];
        assert!((lengths[0] - lengths[1]).abs() < 1e-5, "{lengths:?}");
        assert_read_back(&after);
    }
}

/// The options of a call, some of them; times as parts of a clip.
fn all_at_once() -> impl Strategy<Value = Edits> {
    let of_clips = (
        any::<bool>(),
        any::<bool>(),
        of((0.0_f32..0.4, 0.6_f32..1.0)),
        of(0.1_f32..0.9),
        of(-4.0_f32..-2.0),
    );
    let of_space = (
        of(0.2_f32..5.0),
        of(prop::sample::select(UpAxis::ALL.to_vec())),
        of(prop::sample::select(Handedness::ALL.to_vec())),
        any::<bool>(),
        any::<bool>(),
    );
    (of_clips, of_space).prop_map(
        |((choose, fix, range, close, reduce), (scale, up_axis, handedness, rename, for_book))| Edits {
            clips: choose.then(Vec::new),
            fix,
            range_secs: range.map(|(from, to)| [from, to]),
            close_loop_secs: close,
            reduce: reduce.map(|exponent| 10.0_f32.powf(exponent)),
            scale,
            up_axis,
            handedness,
            clip_names: if rename {
                vec![(String::new(), "renamed".to_owned())]
            } else {
                Vec::new()
            },
            bone_names: if rename {
                vec![(0, "hips".to_owned())]
            } else {
                Vec::new()
            },
            for_book,
            ..Edits::default()
        },
    )
}

fn of<T: std::fmt::Debug>(value: impl Strategy<Value = T>) -> impl Strategy<Value = Option<T>> {
    prop::option::of(value)
}

/// That a model is whole: weights sum to 1, clips end where their last keys are, and nothing in it is an error.
fn assert_sound(model: &Model) {
    for influences in &model.mesh.influences {
        let sum: f32 = influences.weights.iter().sum();
        assert!((sum - 1.0).abs() < 1e-6 || sum == 0.0, "{influences:?}");
    }
    for clip in &model.clips {
        let times = super::key_times(clip);
        assert_eq!(
            (times.first(), times.last()),
            (Some(&clip.start_secs), Some(&clip.end_secs))
        );
    }
    let findings = check::model(model, &CompiledClip::all(&model.clips), &LineMap::default());
    let worst = findings.iter().find(|finding| finding.severity == Severity::Error);
    assert!(worst.is_none(), "{worst:?}");
}

/// That what is written of a model is read again, in both forms, with as many vertices, triangles and joints, and posed alike.
fn assert_read_back(model: &Model) {
    let names = JointNames::default();
    let of_glb = glb(model, &names, &MapImages::new()).expect("it can be written").bytes;
    let of_m3d = m3d(model, &names, Dialect::D3d12).expect("it can be written").bytes;
    for (form, bytes) in [("glb", of_glb), ("m3d", of_m3d)] {
        let imported = import(&bytes).unwrap_or_else(|refused| panic!("{form}: {}", refused.error.message));
        let worst = imported
            .diagnostics
            .iter()
            .find(|finding| finding.severity == Severity::Error);
        assert!(worst.is_none(), "{form}: {worst:?}");
        let again = imported.model;
        assert_eq!(
            (again.mesh.vertex_count(), again.mesh.triangle_count()),
            (model.mesh.vertex_count(), model.mesh.triangle_count()),
            "{form}"
        );
        assert_eq!(again.clips.len(), model.clips.len(), "{form}");
        let lengths = |model: &Model, secs: f32| -> Vec<f32> {
            let positions = seen(model, 0, secs).positions;
            positions.windows(2).map(|pair| pair[0].distance(pair[1])).collect()
        };
        // Spaces differ, lengths do not. glTF has no time before 0.
        let clip = &model.clips[0];
        for secs in [
            clip.start_secs,
            clip.start_secs + 0.4 * clip.duration_secs(),
            clip.end_secs,
        ] {
            let shift_secs = clip.start_secs - again.clips[0].start_secs;
            for (old, new) in lengths(model, secs).iter().zip(lengths(&again, secs - shift_secs)) {
                assert!(
                    (old - new).abs() <= 1e-4 * size(model),
                    "{form} at {secs} s: {old} became {new}"
                );
            }
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
    #[rustfmt::skip]
    let steps = [
        Edits { fix: true, ..Edits::default() },
        Edits { range_secs: all.range_secs, ..Edits::default() },
        Edits { close_loop_secs: all.close_loop_secs, ..Edits::default() },
        Edits { reduce: all.reduce, ..Edits::default() },
        Edits { up_axis: all.up_axis, handedness: all.handedness, ..Edits::default() },
        Edits { scale: all.scale, ..Edits::default() },
        Edits { clip_names: all.clip_names.clone(), ..Edits::default() },
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

#[test]
fn a_jump_stays_a_jump_when_its_clip_begins_sooner() {
    for order in [
        vec![One::Close(0.1), One::Range(0.067_054_08, 0.6)],
        vec![One::Close(0.1), One::Range(0.134_784_79, 0.941_020_1), One::ForBook],
    ] {
        let mut model = model(0);
        for one in order {
            let (_, after) = make(&model, one);
            assert_kept(&model, one, &after);
            assert_sound(&after);
            model = after;
        }
        assert_read_back(&model);
    }
}
