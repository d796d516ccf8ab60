//! Joints side by side, and poses of fewer joints than the skeleton has.

use bindpose::anim::{CompiledClip, JointLanes, LocalJoint, LocalPose, ModelPose, local_to_model};
use bindpose::model::{Clip, Track};
use glam::{Affine3A, Quat, Vec3};

use crate::documents::{arm, model_of};

/// Joints that differ in every part; the third mirrors.
fn joints() -> [LocalJoint; 5] {
    [0.0_f32, 1.0, 2.0, 3.0, 4.0].map(|number| LocalJoint {
        rotation: Quat::from_euler(glam::EulerRot::XYZ, number, 0.5 - number * 0.3, number * 1.7),
        translation: Vec3::new(number, number * -2.0, 0.25),
        scale: Vec3::new(1.0 + number, 0.5, if number == 2.0 { -1.0 } else { 2.0 }),
    })
}

#[test]
fn joints_go_into_lanes_and_come_out() {
    let mut local = LocalPose::default();
    local.set_joints(&joints());
    assert_eq!((local.joint_count(), local.groups.len()), (5, 2));
    assert!(local.joints().eq(joints()));
    local.resize(3);
    assert!(local.joints().eq(joints()[..3].iter().copied()));
}

#[test]
fn lanes_make_the_matrices_of_their_joints() {
    let mut lanes = JointLanes::IDENTITY;
    for (lane, &joint) in joints()[1..].iter().enumerate() {
        lanes.set_joint(lane, joint);
    }
    let left = Affine3A::from_scale_rotation_translation(Vec3::splat(0.5), Quat::from_rotation_y(1.0), Vec3::X);
    for (lane, joint) in joints()[1..].iter().enumerate() {
        assert_eq!(lanes.joint(lane), *joint);
        let (ours, expected) = (
            lanes.parent_from_joint().after(&left, lane),
            left * joint.parent_from_joint(),
        );
        assert!(ours.abs_diff_eq(expected, 1e-5), "lane {lane}: {ours:?} {expected:?}");
    }
}

#[test]
fn joints_that_a_pose_lacks_are_at_rest() {
    let (model, _) = model_of(&arm());
    let turned = LocalJoint {
        rotation: Quat::from_rotation_z(1.0),
        ..LocalJoint::IDENTITY
    };
    let mut out = ModelPose::default();
    for posed in 0..=3 {
        let mut local = LocalPose::default();
        local.set_joints(&[turned; 3][..posed]);
        local_to_model(&model.skeleton, &local, &mut out);
        let mut expected = Affine3A::IDENTITY;
        for (joint, rest) in model.skeleton.rest().iter().enumerate() {
            expected *= if joint < posed { turned } else { *rest }.parent_from_joint();
            assert!(
                out.0[joint].abs_diff_eq(expected, 1e-6),
                "joint {joint} of {posed} posed"
            );
        }
    }
}

/// Five tracks with no time in common: each group stands on one time line, which must not change what a track says.
#[test]
fn tracks_of_a_group_do_not_change_each_other() {
    let tracks: Vec<Track> = (0_u8..5)
        .map(|number| {
            let keys = (0_u8..=number).map(|key| {
                let time_secs = f32::from(key) * 0.37 + f32::from(number) * 0.11;
                let joint = joints()[usize::from(key)];
                (
                    time_secs,
                    LocalJoint {
                        scale: joint.scale.abs(),
                        ..joint
                    },
                )
            });
            Track::new(keys).expect("increasing")
        })
        .collect();
    let together = Clip::new("together", tracks.clone());
    let (mut all, mut alone) = (LocalPose::default(), LocalPose::default());
    for step in 0_u8..=250 {
        let time_secs = f32::from(step) * 0.01 - 0.2;
        bindpose::anim::sample(&CompiledClip::new(&together), time_secs, &mut all);
        for (joint, track) in all.joints().zip(&tracks) {
            bindpose::anim::sample(
                &CompiledClip::new(&Clip::new("alone", vec![track.clone()])),
                time_secs,
                &mut alone,
            );
            let expected = alone.groups[0].joint(0).parent_from_joint();
            assert!(
                joint.parent_from_joint().abs_diff_eq(expected, 2e-6),
                "at {time_secs} s: {joint:?}"
            );
        }
    }
}
