//! Clips of another skeleton whose bones lie otherwise: each bone turns from its rest as the other's does.

use bindpose::edit::retarget;
use bindpose::model::{Channel, Clip, JointIndex, LocalJoint, Skeleton, Track};
use glam::{Affine3A, EulerRot, Mat4, Quat, Vec3};

/// Hips, spine, arm, forearm and hand, one on the other, with the rotation and the place of each at rest on its parent.
fn arm(prefix: &str, rest: [(Quat, Vec3); 5]) -> Skeleton {
    let rest = rest.map(|(rotation, translation)| LocalJoint {
        rotation,
        translation,
        ..LocalJoint::IDENTITY
    });
    let bind = placed(&rest).map(|placed| Affine3A::from_mat4(placed.inverse()));
    let parents = (0..5).map(|joint: u32| joint.checked_sub(1).map(JointIndex));
    let names = ["Hips", "Spine", "Arm", "ForeArm", "Hand"].map(|name| format!("{prefix}{name}"));
    Skeleton::new(parents.collect(), bind.to_vec(), (0..5).collect())
        .expect("it is sound")
        .with_rest(&rest)
        .with_names(names.to_vec())
}

/// Each joint relative to the model.
fn placed(local: &[LocalJoint]) -> [Mat4; 5] {
    let mut above = Mat4::IDENTITY;
    std::array::from_fn(|joint| {
        let LocalJoint {
            rotation,
            translation,
            scale,
        } = local[joint];
        above *= Mat4::from_scale_rotation_translation(scale, rotation, translation);
        above
    })
}

fn at(clip: &Clip, secs: f32) -> [Mat4; 5] {
    placed(&clip.tracks.iter().map(|track| track.at(secs)).collect::<Vec<_>>())
}

#[test]
fn a_motion_is_kept_relative_to_a_rest_pose_whose_arm_hangs() {
    let still = Quat::IDENTITY;
    let along = |length: f32| Vec3::X * length;
    let theirs = arm(
        "mixamorig:",
        [
            (still, Vec3::Y),
            (still, Vec3::Y * 0.5),
            (still, along(0.25)),
            (still, along(0.5)),
            (still, along(0.5)),
        ],
    );
    // Twice as large; the arm hangs down, and the frames of spine and forearm lie otherwise on their bones too.
    let [spine, fore] = [Quat::from_rotation_y(1.0), Quat::from_rotation_x(2.0)];
    let hanging = Quat::from_rotation_z(-std::f32::consts::FRAC_PI_2);
    let ours = arm(
        "",
        [
            (still, Vec3::Y * 2.0),
            (spine, Vec3::Y),
            (spine.inverse(), spine.inverse() * along(0.5)),
            (hanging * fore, hanging * along(1.0)),
            (fore.inverse(), fore.inverse() * along(1.0)),
        ],
    );
    let their_rest = placed(theirs.rest());
    let our_rest = placed(ours.rest());
    let down = our_rest[4].transform_point3(Vec3::ZERO) - our_rest[3].transform_point3(Vec3::ZERO);
    assert!(down.abs_diff_eq(-Vec3::Y, 1e-5), "{down}");
    let keys = |joint: usize, turns: [[f32; 3]; 3], steps: [Vec3; 3]| {
        let secs = |key: usize| key as f32 * 0.5;
        let rest = theirs.rest()[joint];
        let rotations = turns.map(|[x, y, z]| Quat::from_euler(EulerRot::XYZ, x, y, z) * rest.rotation);
        let places = steps.map(|step| rest.translation + step);
        Track::of_channels(
            Channel::straight((0..3).map(|key| (secs(key), places[key]))).expect("keys"),
            Channel::straight((0..3).map(|key| (secs(key), rotations[key]))).expect("keys"),
            Channel::at_rest(rest.scale),
        )
    };
    let stays = [Vec3::ZERO; 3];
    let walks = [Vec3::ZERO, Vec3::new(1.0, 0.25, -0.5), Vec3::new(2.0, 0.0, 1.0)];
    let clip = Clip::new(
        "wave",
        vec![
            keys(0, [[0.0; 3], [0.0, 0.5, 0.0], [0.0, 1.0, 0.25]], walks),
            keys(1, [[0.25, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, -0.5, 0.0]], stays),
            keys(2, [[0.0, 0.0, 1.5], [0.5, 0.75, 0.0], [0.0, 0.25, -1.25]], stays),
            keys(3, [[0.0, 1.25, 0.0], [0.0; 3], [1.0, 0.0, 0.5]], stays),
            keys(4, [[0.5, 0.0, 0.0], [0.0, 0.0, -0.5], [0.25; 3]], stays),
        ],
    );
    let retargeted = retarget(&ours, &theirs, std::slice::from_ref(&clip))
        .expect("its numbers are sound")
        .expect("the names are known");
    assert!(retargeted.is_relative);
    let none: [String; 0] = [];
    assert_eq!(
        (&*retargeted.without_place, &*retargeted.at_rest),
        (&none[..], &none[..])
    );
    let mut farthest = 0f32;
    for secs in [0.0, 0.25, 0.5, 0.8, 1.0] {
        let [moved, found] = [&clip, &retargeted.clips[0]].map(|clip| at(clip, secs));
        // The hips go as far as theirs, in our size. Each bone is the one at rest, turned in the model as theirs is.
        let hips = moved[0].transform_point3(Vec3::ZERO) - their_rest[0].transform_point3(Vec3::ZERO);
        let mut wanted = our_rest[0].transform_point3(Vec3::ZERO) + hips * 2.0;
        for joint in 0..5 {
            let place = found[joint].transform_point3(Vec3::ZERO);
            assert!(
                place.abs_diff_eq(wanted, 1e-4),
                "joint {joint}, {secs} s: {place} {wanted}"
            );
            let turned = (moved[joint] * their_rest[joint].inverse())
                .to_scale_rotation_translation()
                .1;
            let at_rest = our_rest[joint].transform_point3(Vec3::ZERO);
            farthest = farthest.max((place - at_rest - hips * 2.0).length());
            if let Some(next) = our_rest.get(joint + 1) {
                wanted += turned * (next.transform_point3(Vec3::ZERO) - at_rest);
            }
        }
    }
    assert!(farthest > 1.0, "it moves: {farthest}");
}

#[test]
fn bones_that_only_one_skeleton_has_are_told_even_those_that_no_clip_moves() {
    let rest = [(Quat::IDENTITY, Vec3::Y); 5];
    let theirs = arm("mixamorig:", rest);
    let names = ["Hips", "Spine", "Arm", "ForeArm", "Fist"].map(str::to_owned);
    let ours = arm("", rest).with_names(names.to_vec());
    let mut tracks: Vec<Track> = theirs.rest().iter().map(|&rest| Track::at_rest(rest)).collect();
    tracks[0] = Track::of_channels(
        Channel::straight([(0.0, Vec3::Y), (1.0, Vec3::X)]).expect("keys"),
        Channel::at_rest(Quat::IDENTITY),
        Channel::at_rest(Vec3::ONE),
    );
    let retargeted = retarget(&ours, &theirs, &[Clip::new("walk", tracks)])
        .expect("its numbers are sound")
        .expect("the only bone that moves has a name that is known");
    assert!(!retargeted.is_relative, "they lie alike");
    assert_eq!(retargeted.without_place, ["mixamorig:Hand"]);
    assert_eq!(retargeted.at_rest, ["Fist"]);
}
