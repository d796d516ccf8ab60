//! Bones, their scales and their keys.

use bindpose::diagnostic::Subject;
use bindpose::format::{BoneAnimation, Document, Keyframe, LineMap};

use super::{codes_of, only};
use crate::documents::{arm, key, offset, track, turned};

const NONE: [&str; 0] = [];

/// The arm with these tracks.
fn arm_with(bones: [BoneAnimation; 3]) -> Document {
    let mut document = arm();
    document.clips[0].bones = bones.into();
    document
}

/// Where each bone of the arm stands on its parent.
fn place(bone: usize) -> [f32; 3] {
    [0.0, if bone == 0 { 0.0 } else { 1.0 }, 0.0]
}

/// One bone of the arm turns to some angles in degrees, one every `step_secs`.
fn turning(step_secs: f32, degrees: &[f32]) -> Document {
    let keys = (0_u8..).zip(degrees);
    let keys: Vec<Keyframe> = keys
        .map(|(index, degrees)| turned(key(f32::from(index) * step_secs, place(1)), degrees.to_radians()))
        .collect();
    arm_with([track([key(0.0, place(0))]), track(keys), track([key(0.0, place(2))])])
}

#[test]
fn a_bone_is_idle_when_no_bone_below_has_weight() {
    let mut document = arm();
    document.clips.clear();
    // Bone 3 hangs on the last one, and bone 5 on bone 4 on the first one.
    document.bone_parents.extend([2, 0, 4]);
    document.bone_offsets.extend([offset([0.0; 3]); 3]);
    let lines = LineMap {
        bone_parents: (40..46).collect(),
        ..LineMap::default()
    };
    let finding = only(&document, &lines);
    assert_eq!(finding.message, "3 bones move no vertex, nor does a bone below.");
    assert_eq!(finding.subjects, [3, 4, 5].map(Subject::Bone));
    assert_eq!(finding.position.map(|position| position.line), Some(43));
    // With a weight at the end of the chain its bones carry something.
    document.vertices[0].blend_indices[0] = 5;
    assert_eq!(only(&document, &lines).subjects, [Subject::Bone(3)]);
    // A mesh without weights has a finding of its own.
    document
        .vertices
        .iter_mut()
        .for_each(|vertex| vertex.blend_weights = [0.0; 4]);
    assert_eq!(codes_of(&document), ["weights-all-zero"]);
}

/// The first bone scaled, the second turned, at the end of a second.
fn scaled_and_turned(scale: [f32; 3], degrees: f32) -> Document {
    let scaled = Keyframe {
        scale,
        ..key(1.0, place(0))
    };
    let turned = turned(key(1.0, place(1)), degrees.to_radians());
    arm_with([
        track([key(0.0, place(0)), scaled]),
        track([key(0.0, place(1)), turned]),
        track([key(0.0, place(2))]),
    ])
}

#[test]
fn a_bone_is_sheared_by_uneven_scales_above_when_it_is_turned() {
    let finding = only(&scaled_and_turned([1.0, 2.0, 1.0], 30.0), &LineMap::default());
    assert_eq!(
        (finding.code, finding.subject),
        ("scale-shears", Some(Subject::Clip(0)))
    );
    assert_eq!(
        finding.message,
        "At 1 s of \"bend\" bone 1 is sheared: it is turned, and a bone above it is scaled by different factors."
    );
    for (scale, degrees) in [
        ([2.0; 3], 30.0),
        ([-1.0, 1.0, 1.0], 30.0),
        ([1.0, 2.0, 1.0], 0.0),
        ([1.0, 2.0, 1.0], 90.0),
        ([1.0, 1.0, 2.0], 30.0),
        ([1.0, 1.005, 1.0], 45.0),
        ([0.0; 3], 30.0),
    ] {
        assert_eq!(
            codes_of(&scaled_and_turned(scale, degrees)),
            NONE,
            "{scale:?} {degrees}"
        );
    }
}

#[test]
fn equal_keys_are_told_where_they_are_many() {
    let still = |count: u8, bone| {
        (0..count)
            .map(|index| key(f32::from(index), place(bone)))
            .collect::<Vec<_>>()
    };
    let moving = |count: u8| {
        let keys = (0..count).map(|index| turned(key(f32::from(index), place(1)), f32::from(index % 2)));
        keys.collect::<Vec<_>>()
    };
    // Of 2 keys none is said to be too many. 10 keys of 100 are a tenth.
    for (still_keys, moving_keys, codes) in [(2, 3, &NONE[..]), (11, 88, &["keys-all-equal"]), (11, 91, &NONE)] {
        let document = arm_with([
            track(still(still_keys, 0)),
            track(moving(moving_keys)),
            track([key(0.0, place(2))]),
        ]);
        assert_eq!(codes_of(&document), codes, "{still_keys} {moving_keys}");
    }
    let mut document = arm_with([track(still(5, 0)), track(moving(5)), track(still(4, 2))]);
    let finding = only(&document, &LineMap::default());
    assert_eq!(
        finding.message,
        "2 bones keep still in \"bend\", each with equal keys: 7 of its 14 keys could be left out."
    );
    // q and −q are one rotation.
    document.clips[0].bones[0].keyframes[2].rotation = [0.0, 0.0, 0.0, -1.0];
    assert_eq!(codes_of(&document), ["rotation-side", "keys-all-equal"]);
}

#[test]
fn a_loop_jumps_when_it_ends_near_its_beginning_but_not_near_enough() {
    // A full swing there and back. The arm's surface moves by a tenth of its size for each radian.
    let swing = |end: f32| turning(0.5, &[0.0, 60.0, 120.0, 60.0, end]);
    let finding = only(&swing(8.0), &LineMap::default());
    assert_eq!((finding.code, finding.subject), ("loop-jumps", Some(Subject::Clip(0))));
    assert_eq!(
        finding.message,
        "\"bend\" ends near its first pose, but bone 1 jumps by 1.4 % of the model's size where it begins again."
    );
    for (document, why) in [
        (swing(0.0), "it ends as it began"),
        (swing(5.0), "the jump is small"),
        (swing(60.0), "it ends elsewhere"),
        (turning(0.5, &[0.0, 8.0]), "it goes one way"),
        (
            turning(1.0 / 60.0, &[0.0, 60.0, 120.0, 60.0, 8.0]),
            "it moves as fast anyway",
        ),
        (turning(0.5, &[0.0, 120.0, 240.0, 360.0]), "it goes round"),
    ] {
        assert_eq!(codes_of(&document), NONE, "{why}");
    }
}
