//! Keys that are left out.

use bindpose::anim::{CompiledClip, PoseBuffers};
use bindpose::edit::{Edits, apply_in};
use bindpose::model::{Channel, Clip, Influences, JointNames, LocalJoint, Model, Track, Way};
use bindpose::slices::{Sliced, Slices};
use glam::{Quat, Vec3, Vec3A};
use proptest::prelude::*;

use super::{curved, edit, figure, key_times, size, swaying, try_edit};
use crate::documents::{model_of, with_rotation, with_translation};
use crate::rigs;

fn reduce(tolerance: f32) -> Edits {
    Edits {
        reduce: Some(tolerance),
        ..Edits::default()
    }
}

/// Where each joint is, and where the places of its children at rest are when they hang on it stiffly.
fn places(model: &Model, clip: &CompiledClip, secs: f32, pose: &mut PoseBuffers) -> Vec<Vec3A> {
    pose.evaluate(&model.skeleton, clip, secs);
    let joints = pose.model.0.iter().map(|joint| joint.translation);
    let children = model
        .skeleton
        .parents()
        .iter()
        .enumerate()
        .filter_map(|(child, parent)| {
            let tip = model.skeleton.rest()[child].translation;
            Some(pose.model.0[parent.as_ref()?.index()].transform_point3a(tip.into()))
        });
    joints.chain(children).collect()
}

/// How far joints and tips are off at most, at every key of the old clip and between them.
fn greatest_error(model: &Model, old: &Clip, new: &Clip) -> f32 {
    let (old_lanes, new_lanes) = (CompiledClip::new(old), CompiledClip::new(new));
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    let keys = key_times(old);
    let between = keys
        .windows(2)
        .flat_map(|pair| [0.2, 0.37, 0.71].map(|part| pair[0] + part * (pair[1] - pair[0])));
    let times: Vec<f32> = keys.iter().copied().chain(between).collect();
    let errors = times.into_iter().map(|secs| {
        let before = places(model, &old_lanes, secs, &mut pose);
        let after = places(model, &new_lanes, secs, &mut pose);
        before
            .iter()
            .zip(&after)
            .map(|(a, b)| a.distance(*b))
            .fold(0.0, f32::max)
    });
    errors.fold(0.0, f32::max)
}

fn check(model: &Model, tolerance: f32) -> usize {
    let edited = edit(model, &reduce(tolerance));
    let mut left_out = 0;
    for (old, new) in model.clips.iter().zip(&edited.model.clips) {
        let off = greatest_error(model, old, new);
        assert!(
            off <= tolerance * size(model),
            "{}: {off} of {}",
            old.name,
            tolerance * size(model)
        );
        assert_eq!((old.start_secs, old.end_secs), (new.start_secs, new.end_secs));
        for (old, new) in old.tracks.iter().zip(&new.tracks) {
            let is_old = |secs: &f32| old.times_secs().contains(secs);
            assert!(new.times_secs().iter().all(is_old), "no key is new");
        }
        left_out += old.key_count - new.key_count;
    }
    left_out
}

#[test]
fn joints_and_tips_stay_within_the_tolerance_at_every_old_key() {
    let sway = model_of(&swaying(24, 4.0)).0;
    for model in [figure(), sway, rigs::model(30), curved()] {
        let mut before = 0;
        for tolerance in [1e-5, 1e-4, 1e-3, 1e-2, 0.1] {
            let left_out = check(&model, tolerance);
            assert!(left_out >= before, "a wider tolerance leaves out no fewer keys");
            before = left_out;
        }
    }
}

#[test]
fn a_dense_clip_keeps_a_part_of_its_keys() {
    let (model, _) = model_of(&swaying(12, 4.0));
    let keys = model.clips[0].key_count;
    let left_out = check(&model, 1e-2);
    assert!(left_out * 5 > keys, "{left_out} of {keys} keys are left out");
}

#[test]
fn the_error_that_is_told_is_the_one_that_is_there() {
    let (model, _) = model_of(&swaying(12, 4.0));
    let edited = edit(&model, &reduce(1e-3));
    let [change] = &edited.changes[..] else {
        panic!("one change: {:?}", edited.changes)
    };
    let told = change
        .message
        .split("by more than ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next());
    let told: f32 = told
        .and_then(|told| told.parse().ok())
        .expect("the message has the error");
    let is = greatest_error(&model, &model.clips[0], &edited.model.clips[0]) / size(&model);
    // The edit looks at more tips than this test does.
    assert!(is <= told * 1.01 && told <= 1e-3, "{is} is told as {told}");
    assert_eq!(change.code, "keys-reduced");
}

#[test]
fn two_keys_of_a_straight_way_are_enough() {
    let (model, _) = model_of(&rigs::rig(1, vec![rigs::even("way", 1, 0.0, 400, 30.0)]));
    let edited = edit(&model, &reduce(1e-4));
    assert_eq!(edited.model.clips[0].tracks[0].times_secs().len(), 2);
}

#[test]
fn steps_and_splines_lose_keys_that_say_little_and_stay_such() {
    const KEYS: u16 = 200;
    let secs = |key: u16| f32::from(key) * 0.02;
    let mut model = model_of(&swaying(3, 2.0)).0;
    let held = (0..KEYS).map(|key| {
        (
            secs(key),
            Vec3::splat(0.3 * f32::from(key / 50) + 1e-6 * f32::from(key % 2)),
        )
    });
    let turned = (0..KEYS).map(|key| {
        let half = 0.4 * (3.0 * secs(key)).sin();
        let slope = Quat::from_xyzw(half.cos(), 0.0, 0.0, -half.sin()) * (1.2 * (3.0 * secs(key)).cos());
        (secs(key), Quat::from_rotation_x(2.0 * half), [slope; 2])
    });
    let still = (0..KEYS).map(|key| (secs(key), Vec3::ONE, [Vec3::ZERO; 2]));
    let track = Track::of_channels(
        Channel::held(held).expect("sound keys"),
        Channel::spline(turned).expect("sound keys"),
        Channel::spline(still).expect("sound keys"),
    );
    let tracks = model.clips[0].tracks.iter().map(|_| track.clone()).collect();
    model.clips = vec![Clip::new("curves", tracks)];
    let mut before = 0;
    for tolerance in [1e-4, 1e-3, 1e-2] {
        let left_out = check(&model, tolerance);
        assert!(left_out >= before && left_out > 0, "{left_out} after {before}");
        before = left_out;
    }
    let reduced = edit(&model, &reduce(1e-3)).model;
    for track in &reduced.clips[0].tracks {
        assert_eq!(track.translation().times_secs(), [0, 50, 100, 150, 199].map(secs));
        assert_eq!(*track.translation().way(), Way::Held);
        let of_spline = track.rotation().times_secs().len();
        assert!((4..40).contains(&of_spline), "{of_spline}");
        assert_eq!(track.scale().times_secs(), [0, 199].map(secs));
        assert!(matches!(
            (track.rotation().way(), track.scale().way()),
            (Way::Spline(_), Way::Spline(_))
        ));
    }
}

#[test]
fn channels_of_different_times_lose_their_own_keys() {
    let mut model = model_of(&swaying(2, 2.0)).0;
    let secs = |key: u16| f32::from(key) * 0.02;
    let moved = Channel::straight((0..100).map(|key| (secs(key), Vec3::X * f32::from(key % 2))));
    let turned = (0..99).map(|key| (secs(key), Quat::from_rotation_x(0.01 * f32::from(key))));
    let track = with_rotation(&with_translation(&Track::default(), moved), Channel::straight(turned));
    model.clips = vec![Clip::new("channels", vec![track.clone(), track])];
    let edited = edit(&model, &reduce(1e-3));
    for track in &edited.model.clips[0].tracks {
        assert_eq!(track.translation().times_secs().len(), 100);
        assert_eq!(track.rotation().times_secs(), [0, 98].map(secs));
    }
    let told = "\"channels\" has 204 keys in its channels instead of 398; ";
    assert!(edited.changes[0].message.starts_with(told), "{:?}", edited.changes);
}

#[test]
fn a_tolerance_that_is_none_or_leaves_nothing_is_refused() {
    for tolerance in [0.0, -1.0, f32::NAN, f32::INFINITY, 0.11, 2.0] {
        let refused = try_edit(&curved(), &reduce(tolerance)).expect_err("no tolerance");
        let sentence = format!("The tolerance of reduced keys cannot be {tolerance}: ");
        assert!(refused.to_string().starts_with(&sentence), "{refused}");
    }
    let refused = try_edit(&curved(), &reduce(2.0)).expect_err("more than the model");
    assert_eq!(
        refused.to_string(),
        "The tolerance of reduced keys cannot be 2: it is a part of the model's size, above 0 and at most 0.1."
    );
    assert!(try_edit(&curved(), &reduce(0.1)).is_ok());
}

/// Tracks are sampled in groups. What is left out of one moves the numbers of another by their rounding, which no share of its own helps.
#[test]
fn a_joint_that_is_far_away_does_not_keep_the_others_at_it() {
    let document = rigs::rig(11, vec![rigs::even("way", 11, 0.0, 40, 30.0)]);
    let (mut model, _) = model_of(&document);
    let rest = model.skeleton.rest()[10];
    let far = LocalJoint {
        translation: Vec3::splat(1e30),
        ..rest
    };
    let last_secs = model.clips[0].end_secs;
    let mut tracks = model.clips[0].tracks.clone();
    tracks[10] = Track::new([(0.0, rest), (last_secs, far)]).expect("sound keys");
    model.clips = vec![Clip::new("way", tracks)];
    let clips = model.clips.clone();
    let mut work = Sliced::new(&Slices::new(|| true), async move |slices| {
        apply_in(model, &JointNames::default(), &reduce(1e-2), &slices).await
    });
    let edited = (0..10_000).find_map(|_| work.advance()).expect("it ends");
    assert_eq!(edited.expect("sound edits").model.clips, clips, "it keeps its keys");
}

/// A joint that turns one way while it moves the other: what hangs from it against its axes is off by both.
#[test]
fn what_hangs_against_the_axes_stays_within_the_tolerance() {
    let document = rigs::rig(1, vec![rigs::even("way", 1, 0.0, 3, 1.0)]);
    let (mut model, _) = model_of(&document);
    let tip = 10.0;
    model
        .mesh
        .positions
        .iter_mut()
        .for_each(|position| *position = Vec3::ZERO);
    let count = model.mesh.positions.len();
    model.mesh.positions[count - 1] = Vec3::new(-tip, 0.0, 0.0);
    model.mesh.influences.iter_mut().for_each(|influences| {
        *influences = Influences {
            joints: [0; 4],
            weights: [1.0, 0.0, 0.0, 0.0],
        };
    });
    let bounds = model
        .mesh
        .positions
        .iter()
        .map(|position| position.length())
        .fold(0.0, f32::max);
    assert_eq!(bounds, tip);
    let rest = model.skeleton.rest()[0];
    for angle in [0.002_f32, 0.004, 0.006, 0.008] {
        let middle = LocalJoint {
            rotation: Quat::from_rotation_z(angle) * rest.rotation,
            translation: rest.translation + Vec3::new(0.0, -angle * tip, 0.0),
            ..rest
        };
        let track = Track::new([(0.0, rest), (1.0, middle), (2.0, rest)]).expect("sound keys");
        model.clips = vec![Clip::new("way", vec![track])];
        let edited = edit(&model, &reduce(0.011));
        let pose = |clip: &Clip| {
            let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
            pose.evaluate(&model.skeleton, &CompiledClip::new(clip), 1.0);
            pose.palette.0[0].transform_point3(model.mesh.positions[count - 1])
        };
        let off = pose(&model.clips[0]).distance(pose(&edited.model.clips[0]));
        assert!(
            off <= 0.011 * size(&model),
            "{angle}: {off} of {}",
            0.011 * size(&model)
        );
    }
}

proptest! {
    #![proptest_config(crate::properties::cases(24))]
    #[test]
    fn random_rigs_stay_within_their_tolerance(bones in 1_u32..40, exponent in -5.0_f32..-1.0) {
        let (model, _) = model_of(&rigs::rig(bones, vec![rigs::ragged("ragged", bones), rigs::even("even", bones, 1.0, 90, 30.0)]));
        check(&model, 10.0_f32.powf(exponent));
    }
}
