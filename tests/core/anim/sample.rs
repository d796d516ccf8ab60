//! Single tracks: ends, blends, and the search for keys.

use bindpose::anim::{CompiledClip, LocalJoint, LocalPose, sample};
use bindpose::model::{Clip, Track};
use glam::{Quat, Vec3};

fn at_x(x: f32) -> LocalJoint {
    LocalJoint {
        translation: Vec3::new(x, 0.0, 0.0),
        ..LocalJoint::IDENTITY
    }
}

fn clip_of(tracks: &[&[(f32, f32)]]) -> Clip {
    let track =
        |keys: &&[(f32, f32)]| Track::new(keys.iter().map(|&(time_secs, x)| (time_secs, at_x(x)))).expect("increasing");
    Clip::new("clip", tracks.iter().map(track).collect())
}

fn x_at(clip: &Clip, time_secs: f32) -> f32 {
    let mut local = LocalPose::default();
    sample(&CompiledClip::new(clip), time_secs, &mut local);
    local.groups[0].joint(0).translation.x
}

//  time  0    0.5    1        x; the key at 0.5 is shared by both spans
//        2 --- 6 --- 8
#[test]
fn samples_hold_at_the_ends_and_blend_between() {
    let clip = clip_of(&[&[(0.0, 2.0), (0.5, 6.0), (1.0, 8.0)]]);
    for (time_secs, x) in [
        (-1.0, 2.0),
        (0.0, 2.0),
        (0.25, 4.0),
        (0.5, 6.0),
        (0.75, 7.0),
        (1.0, 8.0),
        (9.0, 8.0),
        (0.25, 4.0),
        (f32::NEG_INFINITY, 2.0),
        (f32::INFINITY, 8.0),
        (f32::NAN, 2.0),
    ] {
        assert_eq!(x_at(&clip, time_secs), x, "at {time_secs} s");
    }
}

#[test]
fn one_key_holds_at_every_time() {
    let clip = clip_of(&[&[(3.0, 5.0)]]);
    for time_secs in [-1.0, 3.0, 4.0, f32::NAN] {
        assert_eq!(x_at(&clip, time_secs), 5.0);
    }
}

#[test]
fn the_nearest_and_the_farthest_times_blend() {
    let near = 1.0_f32.next_up();
    let clip = clip_of(&[&[(1.0, 0.0), (near, 1.0), (2.0, 1.0)]]);
    assert_eq!((x_at(&clip, 1.0), x_at(&clip, near)), (0.0, 1.0));
    let clip = clip_of(&[&[(0.0, 0.0), (f32::from_bits(1), 1.0)]]);
    assert_eq!((x_at(&clip, 0.0), x_at(&clip, f32::from_bits(1))), (0.0, 1.0));
    let clip = clip_of(&[&[(-f32::MAX, 0.0), (f32::MAX, 1.0)]]);
    assert_eq!(x_at(&clip, 0.0), 0.5);
}

/// Tracks whose keys lie at the same times, at other times, before and after each other: where one is found must not
/// mislead the search in the next.
#[test]
fn tracks_with_other_times_do_not_mislead_each_other() {
    let tracks: [&[(f32, f32)]; 5] = [
        &[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0), (4.0, 4.0)],
        &[(0.0, 0.0), (0.5, 0.5), (0.75, 0.75), (4.0, 4.0)],
        &[(2.0, 2.0)],
        &[(3.5, 3.5), (4.0, 4.0)],
        &[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0), (4.0, 4.0)],
    ];
    let clip = clip_of(&tracks);
    let mut local = LocalPose::default();
    for step in (0_u8..=80).rev().chain(0..=80) {
        let time_secs = f32::from(step) * 0.05;
        sample(&CompiledClip::new(&clip), time_secs, &mut local);
        for (joint, track) in local.joints().zip(tracks) {
            // Every track says x = time where it has keys.
            let expected = time_secs.clamp(track[0].0, track[track.len() - 1].0);
            assert!(
                (joint.translation.x - expected).abs() < 1e-5,
                "{} at {time_secs} s",
                joint.translation.x
            );
        }
    }
}

#[test]
fn times_in_any_order_give_the_same_to_the_bit() {
    let keys: Vec<(f32, LocalJoint)> = (0_u16..200)
        .map(|key| {
            let x = f32::from(key);
            let joint = LocalJoint {
                rotation: Quat::from_rotation_y(x * 0.3),
                scale: Vec3::splat(1.0 + x * 0.01),
                ..at_x(x)
            };
            (x * 0.01 + (x * 0.7).sin() * 0.003, joint)
        })
        .collect();
    let clip = Clip::new("clip", vec![Track::new(keys).expect("increasing"); 3]);
    let mut times_secs: Vec<f32> = (0_u16..500).map(|step| f32::from(step) * 0.0041).collect();
    let pose = |time_secs: f32| {
        let mut local = LocalPose::default();
        sample(&CompiledClip::new(&clip), time_secs, &mut local);
        local
    };
    let forward: Vec<_> = times_secs
        .iter()
        .map(|&time_secs| (time_secs, pose(time_secs)))
        .collect();
    times_secs.reverse();
    let mut local = LocalPose::default();
    for (time_secs, expected) in forward.iter().rev() {
        sample(&CompiledClip::new(&clip), *time_secs, &mut local);
        assert_eq!(&local, expected);
        assert!(local.joints().all(|joint| (joint.rotation.length() - 1.0).abs() < 1e-6));
    }
}
