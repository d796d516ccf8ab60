//! Where a loop begins again.

use bindpose::anim::{CompiledClip, LoopGap, PoseBuffers, VISIBLE_FRACTION, loop_gap};
use bindpose::import::m3d;
use bindpose::model::{JointIndex, Model};

use crate::documents::{REAL_FILES, arm, figure, key, model_of, offset, real_file, track, turned};
use crate::rigs::{self, JOINT_COUNTS};

/// The arm, two units high, with these last keys.
fn arm_that_ends(translation: [[f32; 3]; 3], angle_radians: [f32; 3]) -> Model {
    let mut document = arm();
    for (bone, keys) in document.clips[0].bones.iter_mut().enumerate() {
        let rest = [0.0, if bone == 0 { 0.0 } else { 1.0 }, 0.0];
        let end = std::array::from_fn(|axis| rest[axis] + translation[bone][axis]);
        *keys = track([
            key(0.0, rest),
            turned(key(0.5, [9.0, 9.0, 9.0]), 3.0),
            turned(key(1.0, end), angle_radians[bone]),
        ]);
    }
    model_of(&document).0
}

fn gap_of(model: &Model, size: f32) -> LoopGap {
    whole_gap(model, 0, size)
}

fn whole_gap(model: &Model, clip: usize, size: f32) -> LoopGap {
    let clip = &model.clips[clip];
    loop_gap(
        &model.skeleton,
        &CompiledClip::new(clip),
        [clip.start_secs, clip.end_secs],
        size,
    )
}

#[test]
fn a_clip_that_ends_as_it_began_has_no_loop_gap() {
    let gap = gap_of(&arm_that_ends([[0.0; 3]; 3], [0.0; 3]), 2.0);
    assert_eq!((gap.visible, gap.worst, gap.joints.len()), (false, None, 3));
    assert!(
        gap.joints
            .iter()
            .all(|joint| joint.visibility == 0.0 && joint.travel == 0.0)
    );
}

#[test]
fn the_jump_is_told_of_the_joint_that_has_the_keys_for_it() {
    let model = arm_that_ends([[0.0; 3], [0.3, 0.0, 0.4], [0.0; 3]], [0.0; 3]);
    let gap = gap_of(&model, 2.0);
    assert_eq!((gap.visible, gap.worst), (true, Some(JointIndex(1))));
    let [below, there, above] = &gap.joints[..] else {
        panic!("three joints")
    };
    assert_eq!((below.translation, below.travel, below.visibility), (0.0, 0.0, 0.0));
    assert!((there.translation - 0.5).abs() < 1e-6 && (there.travel - 0.5).abs() < 1e-6);
    assert!((above.travel - 0.5).abs() < 1e-6, "its child jumps with it");
    assert_eq!(
        (above.translation, above.visibility),
        (0.0, 0.0),
        "but by no keys of its own"
    );
    assert!((there.visibility - 0.5 / (2.0 * VISIBLE_FRACTION)).abs() < 1e-3);
}

#[test]
fn what_is_two_pixels_of_a_thousand_is_seen() {
    // By a way of its own: 1/500 of the size. By a turn: 1.15°, at a tenth of the size from the joint.
    let limit_radians = VISIBLE_FRACTION / 0.1;
    for (shift, angle_radians, visible) in [
        (2.0 * VISIBLE_FRACTION * 0.95, 0.0, false),
        (2.0 * VISIBLE_FRACTION * 1.05, 0.0, true),
        (0.0, limit_radians * 0.95, false),
        (0.0, limit_radians * 1.05, true),
    ] {
        let still = [0.0; 3];
        // Nothing hangs on the last joint that would be carried farther.
        let model = arm_that_ends([still, still, [shift, 0.0, 0.0]], [0.0, 0.0, angle_radians]);
        let gap = gap_of(&model, 2.0);
        assert_eq!(gap.visible, visible, "{shift} {angle_radians}: {gap:?}");
        assert_eq!(gap.worst, Some(JointIndex(2)));
        assert!((gap.joints[2].rotation_degrees - angle_radians.to_degrees()).abs() < 1e-3);
    }
    // A turn too small by itself that carries what is far away.
    let gap = gap_of(&arm_that_ends([[0.0; 3]; 3], [limit_radians * 0.5, 0.0, 0.0]), 2.0);
    assert!(gap.visible && gap.joints[2].visibility == 0.0 && gap.joints[0].visibility < 1.0);
}

#[test]
fn lengths_are_those_of_the_model_where_a_parent_scales() {
    let mut document = arm();
    // The offset of an exporter's centimetres: the parent is a hundredth of the model.
    document.bone_offsets[0] = offset([0.0; 3]).map(|number| number * 100.0);
    document.bone_offsets[0][15] = 1.0;
    document.clips[0].bones[0] = track([bindpose::format::Keyframe {
        scale: [0.01; 3],
        ..key(0.0, [0.0; 3])
    }]);
    document.clips[0].bones[1] = track([key(0.0, [0.0, 100.0, 0.0]), key(1.0, [30.0, 100.0, 0.0])]);
    document.clips[0].bones[2] = track([key(0.0, [0.0, 1.0, 0.0])]);
    let (model, _) = model_of(&document);
    let gap = gap_of(&model, 2.0);
    assert!((gap.joints[1].translation - 0.3).abs() < 1e-6, "{gap:?}");
    assert!((gap.joints[1].travel - 0.3).abs() < 1e-6, "{gap:?}");
}

#[test]
fn signs_of_quaternions_and_scales_are_taken_for_what_they_are() {
    let mut document = arm();
    // Round in steps so small that neighbours stay on one side: the last quaternion is the first one's negative.
    let around = [0.0, 2.0, 4.0, std::f32::consts::TAU];
    let keys = around.map(|angle_radians| turned(key(angle_radians, [0.0; 3]), angle_radians));
    document.clips[0].bones[0] = track(keys);
    document.clips[0].bones[1] = track([
        key(0.0, [0.0, 1.0, 0.0]),
        bindpose::format::Keyframe {
            scale: [1.0, 0.5, 1.0],
            ..key(1.0, [0.0, 1.0, 0.0])
        },
    ]);
    document.clips[0].bones[2] = track([key(0.0, [0.0, 1.0, 0.0])]);
    let (model, _) = model_of(&document);
    assert!(model.clips[0].tracks[0].key(3).rotation.w < -0.99);
    let gap = gap_of(&model, 2.0);
    assert!(gap.joints[0].rotation_degrees < 1e-3, "a whole turn is none");
    assert_eq!((gap.joints[1].scale, gap.worst), (0.5, Some(JointIndex(1))));
    assert_eq!(
        gap.by_travel()[1],
        JointIndex(1),
        "after the first, whose turn is rounded"
    );
}

#[test]
fn every_size_of_skeleton_has_its_loop_gap() {
    for bones in JOINT_COUNTS {
        let model = rigs::model(bones);
        let [ragged, single, even] = [0, 1, 2].map(|clip| whole_gap(&model, clip, 5.0));
        assert_eq!(ragged.joints.len(), bones as usize);
        assert!(ragged.visible && ragged.worst.is_some());
        assert!(!single.visible && single.worst.is_none(), "one key has no gap");
        // The first bone wanders two units; the others come back.
        assert_eq!(even.worst, Some(JointIndex(0)));
        assert!((even.joints[0].translation - 2.0).abs() < 1e-6);
        assert!(even.joints.iter().skip(1).all(|joint| joint.rotation_degrees < 1e-3));
        assert!(even.joints.iter().all(|joint| (joint.travel - 2.0).abs() < 1e-3));
    }
}

#[test]
fn the_figure_loops_without_a_loop_gap_that_is_seen() {
    let (model, _) = model_of(&figure().document);
    let bounds = model.bind_bounds();
    assert!(model.clips.len() > 1);
    for (index, clip) in model.clips.iter().enumerate() {
        let gap = whole_gap(&model, index, bounds.min.distance(bounds.max));
        assert!(
            !gap.visible,
            "{}: {:?}",
            clip.name,
            gap.worst.map(|joint| gap.joints[joint.index()])
        );
    }
}

#[test]
fn gaps_of_real_files_are_those_of_their_poses() {
    for name in REAL_FILES {
        let Some(parsed) = real_file(name) else { continue };
        let (model, _) = m3d::from_parsed(&parsed).expect("sound");
        let bounds = model.bind_bounds();
        for (index, clip) in model.clips.iter().enumerate() {
            let gap = whole_gap(&model, index, bounds.min.distance(bounds.max));
            let places = |time_secs| {
                let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
                pose.evaluate(&model.skeleton, &CompiledClip::new(clip), time_secs);
                pose.model.0
            };
            for ((joint, first), last) in gap
                .joints
                .iter()
                .zip(places(clip.start_secs))
                .zip(places(clip.end_secs))
            {
                assert_eq!(joint.travel, last.translation.distance(first.translation), "{name}");
                assert!(joint.visibility.is_finite() && (0.0..=180.001).contains(&joint.rotation_degrees));
            }
        }
    }
}

#[test]
fn a_range_has_the_loop_gap_between_its_own_ends() {
    let model = rigs::model(12);
    let clip = &model.clips[2];
    let span_secs = [3.3, 4.1];
    let gap = loop_gap(&model.skeleton, &CompiledClip::new(clip), span_secs, 5.0);
    let [first, last] = span_secs.map(|time_secs| {
        let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
        pose.evaluate(&model.skeleton, &CompiledClip::new(clip), time_secs);
        pose
    });
    for (joint, found) in gap.joints.iter().enumerate() {
        let [a, b] = [&first, &last].map(|pose| pose.model.0[joint].translation);
        assert_eq!(found.travel, a.distance(b));
        let [a, b] = [&first, &last].map(|pose| pose.local.joints().nth(joint).expect("a joint").rotation.as_dquat());
        let turned = 2.0 * a.dot(b).abs().min(1.0).acos().to_degrees();
        // The oracle's cosine loses what is below a thousandth of a degree.
        assert!(
            (f64::from(found.rotation_degrees) - turned).abs() < 0.05,
            "{joint}: {found:?} {turned}"
        );
    }
    assert!(gap.visible && gap.joints[0].travel > 0.5);
    let nothing = bindpose::anim::loop_gap(&model.skeleton, &CompiledClip::new(clip), [3.3, 3.3], 5.0);
    assert!(!nothing.visible && nothing.worst.is_none());
}

#[test]
fn the_farthest_travelled_joint_is_first_and_of_equal_ones_the_one_that_turns_more() {
    let model = arm_that_ends([[0.0; 3], [0.3, 0.0, 0.0], [0.0, 0.2, 0.0]], [0.0, 0.0, 0.5]);
    let joints = |order: [u32; 3]| order.map(JointIndex);
    assert_eq!(gap_of(&model, 2.0).by_travel(), joints([2, 1, 0]));
    let model = arm_that_ends([[0.0; 3], [0.3, 0.0, 0.0], [0.0; 3]], [0.0, 0.0, 0.5]);
    assert_eq!(gap_of(&model, 2.0).by_travel(), joints([2, 1, 0]), "the last one turns");
    let model = arm_that_ends([[0.0; 3]; 3], [0.0; 3]);
    assert_eq!(gap_of(&model, 2.0).by_travel(), joints([0, 1, 2]));
    assert_eq!(gap_of(&model, 2.0).visible_travel, 2.0 * VISIBLE_FRACTION);
}
