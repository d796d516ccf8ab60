//! From the animated pose to the bind pose.

use bindpose::anim::{CompiledClip, PoseBuffers, blend_to_bind, sample};
use bindpose::import::m3d;
use bindpose::model::Model;
use glam::Affine3A;

use crate::chains::mirrored_model;
use crate::documents::{arm, model_of, soldier};

fn greatest_difference(a: &[Affine3A], b: &[Affine3A]) -> f32 {
    assert_eq!(a.len(), b.len());
    let numbers = |matrices: &[Affine3A]| {
        matrices
            .iter()
            .flat_map(|matrix| matrix.to_cols_array())
            .collect::<Vec<_>>()
    };
    let pairs = numbers(a).into_iter().zip(numbers(b));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// Both ends are exact, and close to an end the pose is close to it.
fn check_ends(model: &Model, tolerance: f32) {
    let (skeleton, clip) = (&model.skeleton, &model.clips[0]);
    let (time_secs, clip) = ((clip.start_secs + clip.end_secs) * 0.5, &CompiledClip::new(clip));
    let (mut animated, mut bind, mut pose) = (PoseBuffers::default(), PoseBuffers::default(), PoseBuffers::default());
    animated.evaluate(skeleton, clip, time_secs);
    bind.set_bind_pose(skeleton);
    for share in [0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
        pose.evaluate(skeleton, clip, time_secs);
        pose.bring_toward_bind(skeleton, share);
        assert!(pose.palette.0 == animated.palette.0, "{share}");
    }
    for share in [1.0, 2.0, f32::INFINITY] {
        pose.evaluate(skeleton, clip, time_secs);
        pose.bring_toward_bind(skeleton, share);
        assert!(pose.palette.0 == bind.palette.0, "{share}");
        assert!(pose.local == bind.local, "{share}");
    }
    pose.evaluate(skeleton, clip, time_secs);
    pose.bring_toward_bind(skeleton, 1.0 - 1e-6);
    let off = greatest_difference(&pose.palette.0, &bind.palette.0);
    assert!(off < tolerance, "{off} from the bind pose");
    pose.evaluate(skeleton, clip, time_secs);
    pose.bring_toward_bind(skeleton, 1e-6);
    let off = greatest_difference(&pose.palette.0, &animated.palette.0);
    assert!(off < tolerance, "{off} from the animated pose");
}

#[test]
fn both_ends_are_the_poses_themselves() {
    check_ends(&model_of(&arm()).0, 1e-4);
    for count in [1, 300, 2_000] {
        check_ends(&mirrored_model(count), 1e-3);
    }
}

#[test]
fn half_way_each_turn_is_half_a_turn() {
    let (model, _) = model_of(&arm());
    let mut pose = PoseBuffers::default();
    pose.evaluate(&model.skeleton, &CompiledClip::new(&model.clips[0]), 1.0);
    pose.bring_toward_bind(&model.skeleton, 0.5);
    for joint in pose.local.joints() {
        let (axis, angle) = joint.rotation.to_axis_angle();
        assert!(
            (angle - std::f32::consts::FRAC_PI_4).abs() < 1e-5 && axis.z > 0.999,
            "{axis} {angle}"
        );
    }
}

#[test]
fn a_joint_without_skin_rests_where_its_offset_says_and_its_children_come_home() {
    // The middle bone moves no vertex, and its exporter wrote the identity for it.
    let mut document = arm();
    document.bone_offsets[1] = crate::documents::offset([0.0; 3]);
    for vertex in &mut document.vertices {
        vertex.blend_indices = vertex.blend_indices.map(|bone| if bone == 1 { 2 } else { bone });
    }
    let (model, _) = model_of(&document);
    let mut pose = PoseBuffers::default();
    sample(&CompiledClip::new(&model.clips[0]), 0.7, &mut pose.local);
    blend_to_bind(&model.skeleton, 1.0, &mut pose.local);
    bindpose::anim::local_to_model(&model.skeleton, &pose.local, &mut pose.model);
    let heights: Vec<_> = pose.model.0.iter().map(|joint| joint.translation.y).collect();
    assert_eq!(heights, [0.0, 0.0, 2.0]);
    bindpose::anim::palette(&model.skeleton, &pose.model, &mut pose.palette);
    assert!(
        pose.palette
            .0
            .iter()
            .all(|matrix| matrix.abs_diff_eq(Affine3A::IDENTITY, 1e-6))
    );
}

#[test]
fn the_soldier_comes_to_its_bind_pose_without_a_jump() {
    let Some(parsed) = soldier() else { return };
    let (model, _) = m3d::from_parsed(&parsed).expect("sound");
    check_ends(&model, 2e-3);
}
