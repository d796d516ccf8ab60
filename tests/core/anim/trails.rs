//! Trails against posing at each frame; times of ghosts.

use bindpose::anim::{CompiledClip, GhostPlan, PoseBuffers, Trails, ghost_times, palettes_at};
use bindpose::model::{Clip, JointIndex, LocalJoint, Track};

use crate::chains::mirrored_model;
use crate::documents::{arm, model_of};

#[test]
fn a_trail_has_the_joints_place_at_every_frame() {
    for model in [model_of(&arm()).0, mirrored_model(300)] {
        let clip = &model.clips[0];
        let joints = [JointIndex(2), JointIndex(0)];
        let (mut trails, mut pose) = (Trails::default(), PoseBuffers::default());
        let compiled = CompiledClip::new(clip);
        trails.follow(clip, &joints, &mut pose, |time_secs, pose| {
            pose.evaluate(&model.skeleton, &compiled, time_secs);
        });
        assert_eq!(trails.point_count(), clip.frame_count() as usize);
        assert_eq!(trails.polylines().len(), joints.len());
        for (points, joint) in trails.polylines().zip(joints) {
            for (frame, &point) in (0..).zip(points) {
                pose.evaluate(&model.skeleton, &compiled, clip.time_of_frame(frame));
                assert_eq!(point, pose.model.0[joint.index()].translation.into(), "frame {frame}");
            }
        }
    }
}

#[test]
fn a_clip_of_a_million_frames_has_a_trail_of_two_thousand_points() {
    let key = |time_secs: f32| {
        (
            time_secs,
            LocalJoint {
                translation: glam::Vec3::X * time_secs,
                ..LocalJoint::IDENTITY
            },
        )
    };
    let dense = (0..1_000_000).map(|frame| key(frame as f32 * 0.01));
    let (mut model, _) = model_of(&arm());
    let still = Track::new([key(0.0)]).expect("one key");
    model.clips = vec![Clip::new(
        "long",
        vec![Track::new(dense).expect("in order"), still.clone(), still],
    )];
    let (mut trails, mut pose) = (Trails::default(), PoseBuffers::default());
    let (clip, compiled) = (&model.clips[0], CompiledClip::new(&model.clips[0]));
    let mut pose_at = |time_secs: f32, pose: &mut PoseBuffers| pose.evaluate(&model.skeleton, &compiled, time_secs);
    trails.follow(clip, &[JointIndex(0), JointIndex(9)], &mut pose, &mut pose_at);
    assert_eq!(trails.point_count(), 2_000);
    let lines: Vec<_> = trails.polylines().collect();
    assert!(lines[0].is_sorted_by(|a, b| a.x < b.x), "it goes one way");
    assert!((lines[0][1_999].x - 9_999.99).abs() < 0.01);
    assert!(lines[1].iter().all(|&point| point == glam::Vec3::ZERO), "no such joint");
    trails.follow(clip, &[], &mut pose, pose_at);
    assert_eq!(trails.polylines().count(), 0);
}

#[test]
fn ghosts_stand_in_order_on_both_sides_and_inside_the_clip() {
    let model = crate::chains::mirrored_model(3);
    let clip = &model.clips[0];
    assert_eq!((clip.start_secs, clip.end_secs, clip.keys_per_sec), (0.0, 1.0, 2.0));
    let mut times = Vec::new();
    let plan = |before, after, step_frames| GhostPlan {
        before,
        after,
        step_frames,
    };
    ghost_times(clip, 0.5, plan(1, 1, 1), &mut times);
    assert_eq!(times, [0.0, 1.0]);
    ghost_times(clip, 0.75, plan(3, 2, 1), &mut times);
    assert_eq!(times, [0.25], "what lies outside is left out");
    ghost_times(clip, 0.25, plan(u32::MAX, u32::MAX, 0), &mut times);
    assert_eq!(times, [0.75], "a step is a frame at least");
    ghost_times(clip, f32::NAN, plan(3, 3, 1), &mut times);
    assert!(times.is_empty());
}

#[test]
fn each_ghost_has_the_palette_of_its_time() {
    let model = mirrored_model(300);
    let (clip, times) = (&model.clips[0], [0.1, 0.9]);
    let (mut pose, mut palettes) = (PoseBuffers::default(), vec![bindpose::anim::Palette::default(); 2]);
    palettes_at(&times, &mut pose, &mut palettes, |time_secs, pose| {
        pose.evaluate(&model.skeleton, &CompiledClip::new(clip), time_secs);
    });
    for (palette, time_secs) in palettes.iter().zip(times) {
        pose.evaluate(&model.skeleton, &CompiledClip::new(clip), time_secs);
        assert_eq!(palette.0, pose.palette.0);
    }
}
