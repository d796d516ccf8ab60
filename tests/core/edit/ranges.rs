//! Parts of clips.

use bindpose::anim::CompiledClip;
use bindpose::edit::Edits;
use bindpose::model::{Channel, Clip, LocalJoint, Model, Track, Way};
use glam::{Quat, Vec3};
use proptest::prelude::*;

use super::{apart, curved, edit, seen_in, size, spread, try_edit};
use crate::documents::{model_of, with_rotation, with_translation};
use crate::rigs;

fn range(from: f32, to: f32) -> Edits {
    Edits {
        range_secs: Some([from, to]),
        ..Edits::default()
    }
}

/// Models of one clip each.
fn model(number: usize) -> Model {
    let document = match number {
        0 => return curved(),
        1 => rigs::rig(12, vec![rigs::ragged("one", 12)]),
        _ => rigs::rig(4, vec![rigs::even("one", 4, 3.0, 9, 4.0)]),
    };
    model_of(&document).0
}

proptest! {
    #![proptest_config(crate::properties::cases(64))]

    #[test]
    fn a_part_has_the_same_poses_at_all_its_times(number in 0_usize..3, from in 0.0_f32..1.0, to in 0.0_f32..1.0) {
        let model = model(number);
        let whole = &model.clips[0];
        let [from, to] = [from.min(to), from.max(to)].map(|part| whole.start_secs + part * whole.duration_secs());
        prop_assume!(to - from > 0.01);
        let cut = edit(&model, &range(from, to)).model;
        let part = &cut.clips[0];
        // A whole is no cut, and keeps its times.
        let shift_secs = from - part.start_secs;
        if (from, to) != (whole.start_secs, whole.end_secs) {
            prop_assert_eq!((part.start_secs, part.end_secs), (0.0, to - from));
        }
        let times: Vec<f32> = spread(part).chain(super::key_times(part)).collect();
        let [whole_compiled, part_compiled] = [whole, part].map(CompiledClip::new);
        // Both clips are made of arcs; where a curve is cut, of other ones.
        let most = 5e-5 * size(&model);
        for secs in times {
            let new = seen_in(&cut, Some(&part_compiled), secs).positions;
            let off = |late_secs: f32| {
                let old = seen_in(&model, Some(&whole_compiled), secs + shift_secs + late_secs);
                apart(&old.positions, &new)
            };
            // A shifted key of a STEP curve may stand one rounding apart from the shifted time.
            let off = [0.0, 1e-6, -1e-6].map(off);
            prop_assert!(off.iter().any(|off| *off <= most), "{off:?} at {secs} s of {from} s … {to} s");
        }
    }
}

#[test]
fn the_cuts_are_keys_and_curves_stay_curves() {
    let model = curved();
    let cut = edit(&model, &range(0.5, 1.25)).model;
    for (new, old) in cut.clips[0].tracks.iter().zip(&model.clips[0].tracks) {
        for secs in [0.5, 1.25] {
            let key = new.times_secs().iter().position(|&key_secs| key_secs == secs - 0.5);
            let key = key.expect("a cut is a key");
            assert!(new.key(key).rotation.abs_diff_eq(old.at(secs).rotation, 1e-6));
            assert_eq!(new.key(key).translation, old.at(secs).translation);
            assert_eq!(new.key(key).scale, old.at(secs).scale);
        }
        assert_eq!((new.holds(), new.bends()), (old.holds(), old.bends()));
        for step in 0..=100 {
            let secs = 0.5 + 0.0075 * step as f32;
            let (new, old) = (new.at(secs - 0.5), old.at(secs));
            assert!(new.translation.abs_diff_eq(old.translation, 1e-6), "at {secs} s");
            assert!(new.scale.abs_diff_eq(old.scale, 1e-6), "at {secs} s");
            assert!(new.rotation.angle_between(old.rotation) < 1e-3, "at {secs} s");
        }
    }
}

#[test]
fn a_jump_of_a_curve_stays_one_where_rounding_would_close_it() {
    let mut model = curved();
    let times_secs = [-100.0, 0.1, 0.1_f32.next_up(), 1.0];
    assert_eq!(
        times_secs[1] + 50.0,
        times_secs[2] + 50.0,
        "the cut would bring them together"
    );
    let turned = |secs: f32| Quat::from_rotation_x(secs * 0.01);
    let joint = |secs: f32| LocalJoint {
        translation: Vec3::splat(secs),
        rotation: turned(secs),
        ..LocalJoint::IDENTITY
    };
    let keys = times_secs.map(|secs| (secs, joint(secs)));
    let held = Channel::held(times_secs.map(|secs| (secs, Vec3::splat(secs))));
    // A channel may have some of the track's times.
    let still = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    let bent = times_secs[2..].iter().map(|&secs| (secs, turned(secs), [still; 2]));
    let track = with_translation(&Track::new(keys).expect("sound keys"), held);
    let track = with_rotation(&track, Channel::spline(bent));
    let tracks = vec![track; model.skeleton.joint_count()];
    model.clips = vec![Clip::new("jumps", tracks)];
    let cut = edit(&model, &range(-50.0, 1.0)).model;
    let track = &cut.clips[0].tracks[0];
    let jump_secs = 0.1_f32 + 50.0;
    let expected = [0.0, jump_secs, jump_secs.next_up(), 51.0];
    assert_eq!(track.times_secs(), expected);
    let (held, bent) = (track.translation(), track.rotation());
    assert!(
        *held.way() == Way::Held && matches!(bent.way(), Way::Spline(_)),
        "they stay as they are"
    );
    assert_eq!(held.times_secs(), expected);
    assert_eq!(held.value_at(jump_secs), Vec3::splat(times_secs[1]));
    assert_eq!(held.value_at(jump_secs.next_up()), Vec3::splat(times_secs[2]));
    assert_eq!(bent.times_secs(), [0.0, jump_secs, 51.0], "it has no jump itself");
}

#[test]
fn a_curve_that_begins_after_the_cut_keeps_still_until_then() {
    let model = curved();
    let cut = edit(&model, &range(0.1, 1.75)).model;
    for secs in [0.1, 0.15, 0.24, 1.51, 1.6, 1.75] {
        for (new, old) in cut.clips[0].tracks.iter().zip(&model.clips[0].tracks) {
            assert!(
                new.at(secs - 0.1)
                    .translation
                    .abs_diff_eq(old.at(secs).translation, 1e-6),
                "at {secs} s"
            );
        }
    }
}

#[test]
fn a_still_clip_keeps_the_length_of_its_part() {
    let (mut model, _) = model_of(&rigs::rig(3, vec![rigs::even("one", 3, 0.0, 5, 4.0)]));
    let key = model.clips[0].tracks[0].key(0);
    let still = Track::new([(0.0, key), (1.0, key)]).expect("two keys");
    model.clips[0] = Clip::new(
        "one",
        vec![Track::at_rest(key), still, Track::new([(0.5, key)]).expect("a key")],
    );
    let cut = edit(&model, &range(0.25, 0.75)).model;
    assert_eq!((cut.clips[0].start_secs, cut.clips[0].end_secs), (0.0, 0.5));
    assert!(!cut.clips[0].tracks[0].has_keys());
}

#[test]
fn the_whole_is_no_change() {
    let model = curved();
    let clip = &model.clips[0];
    let edited = edit(&model, &range(clip.start_secs, clip.end_secs));
    assert_eq!(edited.changes, []);
    assert_eq!(edited.model.clips, model.clips);
}

#[test]
fn ranges_that_make_no_sense_are_refused() {
    for (from, to) in [(0.5, 0.5), (1.0, 0.5), (-0.1, 1.0), (0.0, 2.1), (f32::NAN, 1.0)] {
        let refused = try_edit(&curved(), &range(from, to)).expect_err("no range");
        assert!(
            refused.to_string().ends_with("which goes from 0 s to 2 s."),
            "{refused}"
        );
    }
    let refused = try_edit(&rigs::model(3), &range(0.5, 0.6)).expect_err("three clips");
    assert_eq!(
        refused.to_string(),
        "A range is of one clip, and there are 3; choose one."
    );
}
