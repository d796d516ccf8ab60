//! Clips: keys in any state become tracks that can be sampled.

use bindpose::format::{AnimationClip, ClipLines, Document, KeyRun, Keyframe, LineMap, parse};
use bindpose::import::m3d;
use bindpose::model::{Clip, LocalJoint, Track};
use glam::{Quat, Vec3};

use crate::documents::{arm, assert_told, key, message_of, model_of, track, turned};

/// The arm with other keys for its middle bone.
fn with_keys(keys: impl Into<Vec<Keyframe>>) -> Document {
    let mut document = arm();
    document.clips[0].bones[1] = track(keys);
    document
}

fn times_and_heights(clip: &Clip, joint: usize) -> Vec<(f32, f32)> {
    let keys = clip.tracks[joint].keys();
    keys.map(|(time_secs, joint)| (time_secs, joint.translation.y))
        .collect()
}

const UP: [f32; 3] = [0.0, 1.0, 0.0];

fn at_height(time_secs: f32, height: f32) -> Keyframe {
    key(time_secs, [0.0, height, 0.0])
}

#[test]
fn unsorted_keys_are_sorted() {
    let document = with_keys([at_height(0.5, 5.0), at_height(0.0, 0.0), at_height(0.25, 2.5)]);
    let (model, _) = model_of(&document);
    assert_eq!(
        times_and_heights(&model.clips[0], 1),
        [(0.0, 0.0), (0.25, 2.5), (0.5, 5.0)]
    );
    let words = "1 bone has keys that are not in the order of time (bone 1 at 0 s); sorted.";
    assert_told(&document, "keys-not-sorted", words);
}

#[test]
fn keys_at_one_time_become_a_jump_from_the_first_to_the_last() {
    let document = with_keys([
        at_height(0.0, 0.0),
        at_height(0.5, 1.0),
        at_height(0.5, 2.0),
        at_height(0.5, 3.0),
        at_height(1.0, 4.0),
    ]);
    let (model, _) = model_of(&document);
    let after = 0.5_f32.next_up();
    assert_eq!(
        times_and_heights(&model.clips[0], 1),
        [(0.0, 0.0), (0.5, 1.0), (after, 3.0), (1.0, 4.0)]
    );
    let words = "2 keys have the time of the key before (first: bone 1 at 0.5 s); the first and the last key of a \
        time are kept as a jump.";
    assert_told(&document, "keys-at-equal-times", words);
}

#[test]
fn zero_and_negative_zero_are_one_time() {
    let (model, codes) = model_of(&with_keys([
        at_height(0.0, 1.0),
        at_height(-0.0, 2.0),
        at_height(1.0, 3.0),
    ]));
    assert_eq!(model.clips[0].tracks[1].key_count(), 3);
    assert_eq!(codes, ["keys-at-equal-times"]);
}

#[test]
fn a_bone_without_keys_rests_and_takes_no_part_in_the_span() {
    let mut document = with_keys([]);
    document.clips[0].bones[0] = track([key(2.0, [0.0; 3]), key(3.0, [0.0; 3])]);
    document.clips[0].bones[2] = track([key(2.5, UP)]);
    let (model, _) = model_of(&document);
    let clip = &model.clips[0];
    assert_eq!((clip.start_secs, clip.end_secs), (2.0, 3.0));
    assert_eq!(clip.tracks[1].key(0), model.skeleton.rest()[1]);
    assert_eq!((clip.key_count, clip.tracks[1].key_count()), (3, 1));
    let words = "1 bone has no keys in this clip (bone 1); at rest as in the bind pose.";
    assert_told(&document, "track-empty", words);
}

#[test]
fn clips_with_fewer_or_more_bones_than_the_skeleton() {
    let mut fewer = arm();
    fewer.clips[0].bones.truncate(1);
    let (model, _) = model_of(&fewer);
    assert_eq!(model.clips[0].tracks.len(), 3);
    assert_eq!(model.clips[0].tracks[2].key(0), model.skeleton.rest()[2]);
    let words = "2 bones have no track in this clip; at rest as in the bind pose.";
    assert_told(&fewer, "clip-bones-missing", words);

    let mut more = arm();
    more.clips[0].bones.push(track([key(9.0, UP)]));
    let (model, _) = model_of(&more);
    assert_eq!((model.clips[0].tracks.len(), model.clips[0].end_secs), (3, 1.0));
    let words = "The clip has 1 track more than the skeleton has bones; left out.";
    assert_told(&more, "clip-bones-extra", words);
}

#[test]
fn rotations_are_made_unit_and_put_on_one_side() {
    let half = turned(key(1.0, UP), 1.0);
    let document = with_keys([
        Keyframe {
            rotation: [0.0; 4],
            ..key(0.0, UP)
        },
        Keyframe {
            rotation: half.rotation.map(|number| number * -3.0),
            ..half
        },
    ]);
    let (model, codes) = model_of(&document);
    let rotations: Vec<Quat> = model.clips[0].tracks[1]
        .keys()
        .map(|(_, joint)| joint.rotation)
        .collect();
    assert_eq!(rotations[0], Quat::IDENTITY);
    assert!(
        rotations[1].abs_diff_eq(Quat::from_rotation_z(1.0), 1e-6),
        "{}",
        rotations[1]
    );
    assert_eq!(codes, ["rotation-not-unit", "rotation-zero", "rotation-side"]);
    for (code, words) in [
        (
            "rotation-not-unit",
            "1 key has a rotation that is not of unit length (bone 1 at 1 s); normalised.",
        ),
        (
            "rotation-zero",
            "1 key has a rotation of length 0 (bone 1 at 0 s); taken as no rotation.",
        ),
    ] {
        assert_eq!(message_of(&document, code), words);
    }
}

#[test]
fn keys_that_are_not_finite_are_left_out() {
    let document = with_keys([
        key(0.0, UP),
        key(f32::NAN, UP),
        key(0.5, [f32::INFINITY, 0.0, 0.0]),
        key(2e9, UP),
        key(1.0, UP),
    ]);
    let (model, _) = model_of(&document);
    assert_eq!(model.clips[0].tracks[1].times_secs(), [0.0, 1.0]);
    let words = "3 keys have a number that is not finite or a time beyond 10⁹ s (first: bone 1); left out.";
    assert_told(&document, "keys-not-finite", words);
}

#[test]
fn findings_point_at_the_bone_and_its_line() {
    let mut document = with_keys([at_height(1.0, 0.0), at_height(0.0, 0.0)]);
    document.clips.push(AnimationClip {
        name: "bend".to_owned(),
        bones: Vec::new(),
    });
    let lines = LineMap {
        clips: vec![
            ClipLines {
                clip: 70,
                bones: vec![71, 75, 79],
                // The second key of bone 1 stands apart.
                key_runs: vec![
                    KeyRun {
                        bone: 0,
                        key: 0,
                        line: 73,
                    },
                    KeyRun {
                        bone: 1,
                        key: 0,
                        line: 76,
                    },
                    KeyRun {
                        bone: 1,
                        key: 1,
                        line: 78,
                    },
                ],
            },
            ClipLines {
                clip: 90,
                ..ClipLines::default()
            },
        ],
        ..LineMap::default()
    };
    let (model, findings) = m3d::from_document(&document, &lines).expect("mended");
    let told: Vec<(&str, Option<u32>)> = findings
        .iter()
        .map(|finding| (finding.code, finding.position.map(|at| at.line)))
        .collect();
    assert_eq!(
        told,
        [
            ("duplicate-clip-name", Some(90)),
            ("keys-not-sorted", Some(78)),
            ("clip-bones-missing", Some(90)),
        ]
    );
    assert_eq!(
        message_of(&document, "duplicate-clip-name"),
        "Another clip has the same name; this one is shown as \"bend (2)\"."
    );
    assert_eq!(model.clips[1].name, "bend (2)");
}

fn at_times(times_secs: &[f32]) -> Track {
    Track::new(times_secs.iter().map(|&time_secs| (time_secs, LocalJoint::IDENTITY))).expect("increasing")
}

#[test]
fn span_and_key_rate_of_tracks() {
    let sixty: Vec<f32> = (0..76).map(|key| (key as f32 / 60.0 * 1e7).floor() / 1e7).collect();
    let cases: [(&[&[f32]], f32, f32, f32); 7] = [
        (&[], 0.0, 0.0, 30.0),
        (&[&[1.5]], 1.5, 1.5, 30.0),
        (&[&[0.0, 0.5], &[-1.0, 2.0]], -1.0, 2.0, 2.0),
        // A gap does not count, nor does a jump, nor tracks with fewer keys.
        (&[&[0.0, 0.1, 0.2, 5.0, 5.1], &[0.0, 5.0]], 0.0, 5.1, 10.0),
        (&[&[0.0, 0.04, 0.08, 0.080_000_01, 0.12]], 0.0, 0.12, 25.0),
        (&[&sixty, &[0.0, 1.0]], 0.0, 1.25, 60.0),
        (&[&[0.0, 1.0 / 29.97, 2.0 / 29.97]], 0.0, 2.0 / 29.97, 29.97),
    ];
    for (tracks, start_secs, end_secs, rate) in cases {
        let clip = Clip::new("clip", tracks.iter().map(|times_secs| at_times(times_secs)).collect());
        assert_eq!((clip.start_secs, clip.end_secs), (start_secs, end_secs));
        assert!(
            (clip.keys_per_sec - rate).abs() <= 1e-3,
            "{} is not {rate}",
            clip.keys_per_sec
        );
    }
}

#[test]
fn frames_count_from_0_and_both_ends_are_frames() {
    let mut clip = Clip::new("run", vec![at_times(&[0.0, 1.25])]);
    clip.keys_per_sec = 60.0;
    assert_eq!((clip.last_frame(), clip.frame_count()), (75, 76));
    for (time_secs, frame) in [
        (0.517, 31),
        (0.0, 0),
        (1.25, 75),
        (-3.0, 0),
        (9.0, 75),
        (f32::NAN, 0),
        (f32::INFINITY, 75),
        (0.0083, 0),
        (0.0084, 1),
    ] {
        assert_eq!(clip.frame_at(time_secs), frame, "{time_secs} s");
    }
    for frame in 0..=75 {
        assert_eq!(clip.frame_at(clip.time_of_frame(frame)), frame);
    }
    assert_eq!(
        (
            clip.time_of_frame(0),
            clip.time_of_frame(75),
            clip.time_of_frame(u32::MAX)
        ),
        (0.0, 1.25, 1.25)
    );
}

#[test]
fn steps_reach_whole_frames_inside_the_clip() {
    let mut clip = Clip::new("run", vec![at_times(&[1.0, 2.0])]);
    clip.keys_per_sec = 10.0;
    for (time_secs, frames, expected_secs) in [
        (1.0, 1, 1.1),
        (1.3, -1, 1.2),
        (1.349, 1, 1.4),
        (1.349, -1, 1.3),
        (1.349, -2, 1.2),
        // What f32 makes of a frame's time is that frame.
        (1.300_001, -1, 1.2),
        (1.299_999, 1, 1.4),
        (1.9, 10, 2.0),
        (1.1, -10, 1.0),
        (1.0, i32::MIN, 1.0),
        (1.0, i32::MAX, 2.0),
        (0.0, 1, 1.1),
    ] {
        let stepped_secs = clip.step_frames(time_secs, frames);
        assert!(
            (stepped_secs - expected_secs).abs() < 1e-6,
            "{time_secs} s by {frames} became {stepped_secs} s"
        );
    }
    // A length of 10.4 frames: the last step holds the rest, and the end can be left again.
    clip.end_secs = 2.04;
    assert_eq!(clip.step_frames(1.9, 1), 2.04);
    assert!((clip.step_frames(2.04, -1) - 1.9).abs() < 1e-6);
}

#[test]
fn frames_of_a_clip_without_length() {
    let clip = Clip::new("still", vec![at_times(&[3.0])]);
    assert_eq!((clip.last_frame(), clip.frame_count(), clip.frame_at(5.0)), (0, 1, 0));
    assert_eq!(
        (clip.time_of_frame(0), clip.time_of_frame(4), clip.step_frames(3.0, 1)),
        (3.0, 3.0, 3.0)
    );
}

#[test]
fn keys_in_model_space_are_told() {
    let mut document = arm();
    for (height, bone) in (0u8..).zip(&mut document.clips[0].bones) {
        // Where the bone is in the model, 10 apart so that it cannot pass for a stretch.
        let place = [f32::from(height) * 10.0, f32::from(height), 0.0];
        bone.keyframes.iter_mut().for_each(|key| key.translation = place);
    }
    let words = "44 % of the edges are torn at the first key of \"bend\": its keys do not belong to the bone offsets \
        (perhaps they are relative to the model, not to the parent).";
    assert_told(&document, "exploded", words);
}

#[test]
fn a_clip_that_scales_the_whole_is_not_torn() {
    let mut document = arm();
    document.clips[0].bones[0]
        .keyframes
        .iter_mut()
        .for_each(|key| key.scale = [100.0; 3]);
    assert_eq!(model_of(&document).1, Vec::<&str>::new());
    assert_eq!(model_of(&arm()).0.clips[0].tracks[1].key(0).translation, Vec3::Y);
}

/// As in the fixture: keys at NaN, −∞ and ∞ between two sound ones.
#[test]
fn keys_at_times_that_are_no_numbers_are_left_out() {
    let parsed =
        parse(include_bytes!("../../fixtures/good/key_times_not_finite.m3d")).expect("the fixture can be read");
    let (model, findings) = m3d::from_parsed(&parsed).expect("the fixture makes a model");
    assert_eq!(model.clips[0].tracks[1].times_secs(), [0.0, 0.5]);
    let [finding] = findings.as_slice() else {
        panic!("{findings:?}")
    };
    assert_eq!(
        (finding.code, finding.message.as_str()),
        (
            "keys-not-finite",
            "3 keys have a number that is not finite or a time beyond 10⁹ s (first: bone 1); left out."
        )
    );
}

#[test]
fn a_clip_without_a_name_is_noted_and_shown_with_its_number() {
    let mut document = arm();
    document.clips[0].name.clear();
    let (model, codes) = model_of(&document);
    assert_eq!(
        (model.clips[0].name.as_str(), codes.as_slice()),
        ("clip 0", &["clip-unnamed"][..])
    );
}

#[test]
fn a_quaternion_with_turned_signs_is_told_but_not_a_turn_of_more_than_half_a_circle() {
    let quarter = turned(at_height(1.0, 0.0), std::f32::consts::FRAC_PI_2);
    let other_side = Keyframe {
        rotation: quarter.rotation.map(|part| -part),
        ..quarter
    };
    let (model, codes) = model_of(&with_keys([at_height(0.0, 0.0), other_side]));
    assert_eq!(codes, ["rotation-side"]);
    assert!(model.clips[0].tracks[1].key(1).rotation.w > 0.0);
    let wide = turned(at_height(1.0, 0.0), 200_f32.to_radians());
    assert_eq!(model_of(&with_keys([at_height(0.0, 0.0), wide])).1, [""; 0]);
}
