//! Curves of one joint.

use bindpose::anim::{CompiledClip, Curve, CurvePoint, CurveSpace, LocalPose, PoseBuffers, sample};
use bindpose::import::m3d;
use bindpose::model::{JointIndex, Model};
use glam::{EulerRot, Quat, Vec3};

use crate::documents::{REAL_FILES, arm, key, model_of, real_file, track, turned};
use crate::rigs::{self, JOINT_COUNTS};

fn points(
    model: &Model,
    clip: usize,
    joint: u32,
    space: CurveSpace,
    span_secs: [f32; 2],
    count: usize,
) -> Vec<CurvePoint> {
    let mut out = vec![CurvePoint::default(); count];
    let clip = &model.clips[clip];
    let curve = Curve::new(&model.skeleton, &CompiledClip::new(clip), JointIndex(joint), space);
    curve.sample(&model.skeleton, &CompiledClip::new(clip), span_secs, &mut out);
    out
}

/// The rotation that three angles stand for: about x first, then y, then z, all fixed axes.
fn from_euler_degrees(degrees: Vec3) -> Quat {
    let [x, y, z] = degrees.to_array().map(f32::to_radians);
    Quat::from_rotation_z(z) * Quat::from_rotation_y(y) * Quat::from_rotation_x(x)
}

#[test]
fn points_are_evenly_spaced_and_are_what_is_sampled() {
    let model = rigs::model(30);
    let span_secs = [0.1, 1.3];
    for joint in [0, 1, 5, 6, 29] {
        let points = points(&model, 0, joint, CurveSpace::Local, span_secs, 7);
        let mut pose = LocalPose::default();
        for (index, point) in points.iter().enumerate() {
            assert!((point.time_secs - (0.1 + 0.2 * index as f32)).abs() < 1e-6);
            sample(&CompiledClip::new(&model.clips[0]), point.time_secs, &mut pose);
            let sampled = pose.joints().nth(joint as usize).expect("a joint");
            assert_eq!((point.translation, point.scale), (sampled.translation, sampled.scale));
            assert!(point.rotation == sampled.rotation || point.rotation == -sampled.rotation);
        }
        assert_eq!((points[0].time_secs, points[6].time_secs), (0.1, 1.3));
    }
    assert_eq!(points(&model, 0, 1, CurveSpace::Local, [0.5, 0.9], 1)[0].time_secs, 0.5);
    assert_eq!(points(&model, 0, 1, CurveSpace::Local, [0.5, 0.9], 0), []);
    let backward = points(&model, 0, 1, CurveSpace::Local, [0.9, 0.5], 2);
    assert_eq!((backward[0].time_secs, backward[1].time_secs), (0.9, 0.5));
    let beyond = points(&model, 0, 99, CurveSpace::Model, [0.5, 0.9], 2);
    assert_eq!(
        (beyond[0].translation, beyond[0].rotation),
        (Vec3::ZERO, Quat::IDENTITY)
    );
}

#[test]
fn in_model_space_a_joint_is_where_its_chain_takes_it() {
    let mut models: Vec<_> = JOINT_COUNTS.map(rigs::model).into();
    models.extend(REAL_FILES.iter().filter_map(|name| {
        let parsed = real_file(name)?;
        Some(m3d::from_parsed(&parsed).expect("sound").0)
    }));
    for model in models.iter().filter(|model| !model.clips.is_empty()) {
        let last = model.skeleton.joint_count() as u32 - 1;
        let bounds = model.bind_bounds();
        // What f32 loses through the joints of a chain.
        let tolerance = 2e-5 * bounds.min.distance(bounds.max).max(5.0);
        let clip = &model.clips[0];
        for joint in [0, last / 3, last / 2, last] {
            let points = points(model, 0, joint, CurveSpace::Model, [clip.start_secs, clip.end_secs], 9);
            let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
            for point in points {
                pose.evaluate(&model.skeleton, &CompiledClip::new(clip), point.time_secs);
                let there = pose.model.0[joint as usize];
                assert!(Vec3::from(there.translation).distance(point.translation) < tolerance);
                let (x, ours) = (there.matrix3.x_axis, point.rotation * Vec3::X * point.scale.x);
                assert!(
                    Vec3::from(x).distance(ours) < 1e-4 * point.scale.x.abs().max(1.0),
                    "{joint}"
                );
            }
        }
    }
}

#[test]
fn angles_stand_for_the_rotation_everywhere() {
    for bones in JOINT_COUNTS {
        let model = rigs::model(bones);
        for joint in [0, bones / 2, bones - 1] {
            for space in [CurveSpace::Local, CurveSpace::Model] {
                for point in points(&model, 0, joint, space, [0.0, 2.0], 200) {
                    let rotation = from_euler_degrees(point.euler_degrees);
                    // Near the poles of y the angles stand for the pole: see the limit in `curve`.
                    assert!(rotation.dot(point.rotation).abs() > 1.0 - 1e-6, "{point:?}");
                }
            }
        }
    }
}

/// Two and a half turns about z in steps that the eye can follow.
#[test]
fn angles_go_on_beyond_a_whole_turn() {
    let mut document = arm();
    let keys = (0..=20).map(|index| {
        turned(
            key(index as f32 * 0.1, [0.0; 3]),
            index as f32 * std::f32::consts::FRAC_PI_4,
        )
    });
    document.clips[0].bones[0] = track(keys.collect::<Vec<_>>());
    let (model, _) = model_of(&document);
    let points = points(&model, 0, 0, CurveSpace::Local, [0.0, 2.0], 101);
    for (index, point) in points.iter().enumerate() {
        let expected = Vec3::new(0.0, 0.0, 9.0 * index as f32);
        assert!(
            point.euler_degrees.distance(expected) < 2e-2,
            "{index}: {}",
            point.euler_degrees
        );
    }
    assert!(
        points
            .windows(2)
            .all(|pair| pair[0].rotation.dot(pair[1].rotation) > 0.9)
    );
}

/// Through the pole of y, where the principal angles jump by 180°, the curves go straight on.
#[test]
fn angles_go_straight_through_the_poles() {
    for (x, direction) in [(0.0_f32, 1.0_f32), (0.4, 1.0), (-1.1, -1.0)] {
        let mut document = arm();
        let keys = (0..=18).map(|index| {
            let y = direction * index as f32 * 10.0_f32.to_radians();
            let rotation = Quat::from_euler(EulerRot::ZYX, 0.25, y, x);
            bindpose::format::Keyframe {
                rotation: rotation.to_array(),
                ..key(index as f32, [0.0; 3])
            }
        });
        document.clips[0].bones[0] = track(keys.collect::<Vec<_>>());
        let (model, _) = model_of(&document);
        let points = points(&model, 0, 0, CurveSpace::Local, [0.0, 18.0], 19);
        for (index, point) in points.iter().enumerate() {
            let expected = Vec3::new(x.to_degrees(), direction * 10.0 * index as f32, 0.25_f32.to_degrees());
            // At the pole itself f32 leaves a hundredth of a degree.
            assert!(
                point.euler_degrees.distance(expected) < 0.1,
                "{index}: {} {expected}",
                point.euler_degrees
            );
        }
    }
}

/// What is said of a time is the same to the bit whatever stretch is looked at, with whatever steps.
#[test]
fn looking_at_another_stretch_changes_no_value() {
    let mut document = arm();
    // More than two turns about an axis askew, so that quaternions change sides and each angle goes beyond 180°.
    for (bone, keys) in document.clips[0].bones.iter_mut().enumerate() {
        let axis = Vec3::new(0.3 + bone as f32, 0.2, 1.0).normalize();
        let turned = (0..=20).map(|index| {
            let rotation = Quat::from_axis_angle(axis, index as f32 * 0.75).to_array();
            bindpose::format::Keyframe {
                rotation,
                ..key(index as f32 * 0.5, [0.0; 3])
            }
        });
        *keys = track(turned.collect::<Vec<_>>());
    }
    let (model, _) = model_of(&document);
    let clip = &model.clips[0];
    for (joint, space) in [(0, CurveSpace::Local), (2, CurveSpace::Local), (2, CurveSpace::Model)] {
        let curve = Curve::new(&model.skeleton, &CompiledClip::new(clip), JointIndex(joint), space);
        let whole = points(&model, 0, joint, space, [0.0, 10.0], 641);
        for (start_secs, end_secs, count) in [(0.0, 5.0, 321), (3.75, 6.25, 161), (6.25, 10.0, 61), (8.75, 8.75, 1)] {
            for point in points(&model, 0, joint, space, [start_secs, end_secs], count) {
                let place = (point.time_secs * 64.0) as usize;
                assert_eq!(point, whole[place], "{joint} {space:?} from {start_secs}");
                assert_eq!(
                    point,
                    curve.at(&model.skeleton, &CompiledClip::new(clip), point.time_secs)
                );
            }
        }
        // And it is one line: no step is a jump. The arm's tip turns by 2.25 in half a second at most.
        let most = 2.25 / 32.0 * 1.5;
        for pair in whole.windows(2) {
            assert!(pair[0].rotation.dot(pair[1].rotation) > 0.0);
            let step = (pair[1].euler_degrees - pair[0].euler_degrees).abs().max_element();
            // Angles go faster than the joint as y comes near a pole.
            let cosine = pair[0].euler_degrees.y.to_radians().cos().abs().max(0.05);
            assert!(step.to_radians() < most / cosine, "{joint} {space:?}: {pair:?}");
        }
    }
}

#[test]
fn a_chain_that_turns_half_a_turn_a_joint_is_followed_from_key_to_key() {
    let mut document = arm();
    for keys in &mut document.clips[0].bones {
        *keys = track([0, 1, 2].map(|index| turned(key(index as f32, [0.0; 3]), index as f32 * 2.5)));
    }
    let (model, _) = model_of(&document);
    let ends = points(&model, 0, 2, CurveSpace::Model, [0.0, 2.0], 3);
    for (point, expected) in ends.iter().zip([0.0_f32, 7.5, 15.0]) {
        let z = point.euler_degrees.z;
        assert!((z - expected.to_degrees()).abs() < 0.05, "{z}");
    }
}
