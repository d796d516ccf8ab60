//! Blends of two poses against f64, joint by joint.

use bindpose::anim::{CompiledClip, LocalJoint, LocalPose, blend, sample};
use glam::{DQuat, Quat, Vec3};
use proptest::prelude::*;

use crate::rigs::{self, JOINT_COUNTS};

fn pose(joints: &[LocalJoint]) -> LocalPose {
    let mut pose = LocalPose::default();
    pose.set_joints(joints);
    pose
}

fn blended(from: &LocalPose, to: &LocalPose, share: f32) -> Vec<LocalJoint> {
    let mut out = LocalPose::default();
    blend(from, to, share, &mut out);
    out.joints().collect()
}

/// The turn from one rotation to the other about its own axis, by a share of its angle: no weights of sines.
fn oracle(from: &LocalJoint, to: &LocalJoint, share: f64) -> (DQuat, [f64; 3], [f64; 3]) {
    let (start, end) = (from.rotation.as_dquat().normalize(), to.rotation.as_dquat().normalize());
    let mut turn = end * start.conjugate();
    if turn.w < 0.0 {
        turn = -turn;
    }
    let (axis, angle) = turn.to_axis_angle();
    let rotation = DQuat::from_axis_angle(axis, angle * share) * start;
    let line = |from: Vec3, to: Vec3| {
        let (from, to) = (from.as_dvec3(), to.as_dvec3());
        (from + (to - from) * share).to_array()
    };
    (
        rotation,
        line(from.translation, to.translation),
        line(from.scale, to.scale),
    )
}

/// f32 keeps seven digits; all numbers here are of the order of 1.
const TOLERANCE: f64 = 2e-6;

fn difference(out: &LocalJoint, (rotation, translation, scale): (DQuat, [f64; 3], [f64; 3])) -> f64 {
    let ours = out.rotation.as_dquat();
    let turned = (ours - rotation).length().min((ours + rotation).length());
    let away = |ours: Vec3, theirs: [f64; 3]| (ours.as_dvec3() - glam::DVec3::from_array(theirs)).length();
    turned
        .max(away(out.translation, translation))
        .max(away(out.scale, scale))
}

#[test]
fn the_poses_of_two_clips_blend_as_in_the_oracle() {
    for bones in JOINT_COUNTS {
        let model = rigs::model(bones);
        let (mut from, mut to) = (LocalPose::default(), LocalPose::default());
        sample(&CompiledClip::new(&model.clips[0]), 0.6, &mut from);
        sample(&CompiledClip::new(&model.clips[2]), 3.4, &mut to);
        for share in [0.0_f32, 0.1, 0.5, 0.9, 1.0] {
            let out = blended(&from, &to, share);
            assert_eq!(out.len(), bones as usize);
            for ((from, to), out) in from.joints().zip(to.joints()).zip(&out) {
                // Half a turn has two short ways.
                if from.rotation.dot(to.rotation).abs() > 1e-3 {
                    let off = difference(out, oracle(&from, &to, f64::from(share)));
                    assert!(off < TOLERANCE, "{from:?} {to:?} {share}: {off}");
                }
            }
        }
    }
}

#[test]
fn the_signs_of_quaternions_do_not_matter() {
    let at = |rotation| LocalJoint {
        rotation,
        ..LocalJoint::IDENTITY
    };
    let quarter = Quat::from_rotation_y(1.5);
    for (from, to) in [
        (Quat::IDENTITY, quarter),
        (-Quat::IDENTITY, quarter),
        (Quat::IDENTITY, -quarter),
    ] {
        let out = blended(&pose(&[at(from)]), &pose(&[at(to)]), 0.5)[0].rotation;
        assert!(
            out.dot(Quat::from_rotation_y(0.75)).abs() > 1.0 - 1e-6,
            "{from} {to}: {out}"
        );
    }
}

#[test]
fn the_ends_are_the_poses_and_shares_beyond_them_too() {
    let joints = |x: f32| {
        [LocalJoint {
            rotation: Quat::from_rotation_x(x),
            translation: Vec3::new(x, 1.0, 0.3),
            scale: Vec3::splat(1.0 + x),
        }; 5]
    };
    let (from, to) = (pose(&joints(0.3)), pose(&joints(1.7)));
    for share in [0.0, -1.0, f32::NEG_INFINITY, f32::NAN] {
        assert_eq!(blended(&from, &to, share), joints(0.3), "{share}");
    }
    for share in [1.0, 2.0, f32::INFINITY] {
        assert_eq!(blended(&from, &to, share), joints(1.7), "{share}");
    }
    assert_eq!(blended(&from, &from, 0.37).len(), 5);
    assert!(
        blended(&from, &pose(&joints(1.0)[..2]), 0.5).len() == 2,
        "what one lacks is left out"
    );
    assert!(blended(&pose(&[]), &to, 0.5).is_empty());
}

fn joints() -> impl Strategy<Value = LocalJoint> {
    let triple = || (-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0).prop_map(Vec3::from);
    let rotation = prop::array::uniform4(-1.0f32..1.0)
        .prop_filter("a direction", |q| q.iter().map(|x| x * x).sum::<f32>() > 0.01)
        .prop_map(|q| Quat::from_array(q).normalize());
    (rotation, triple(), triple()).prop_map(|(rotation, translation, scale)| LocalJoint {
        rotation,
        translation,
        scale,
    })
}

proptest! {
    #![proptest_config(crate::properties::cases(256))]

    #[test]
    fn any_two_joints_blend_as_in_the_oracle(from in joints(), to in joints(), share in 0.0f32..=1.0) {
        let out = blended(&pose(&[from]), &pose(&[to]), share)[0];
        prop_assert!((out.rotation.length() - 1.0).abs() < 1e-5, "{}", out.rotation.length());
        prop_assume!(from.rotation.dot(to.rotation).abs() > 1e-3);
        let off = difference(&out, oracle(&from, &to, f64::from(share)));
        prop_assert!(off < TOLERANCE, "{}", off);
    }
}
