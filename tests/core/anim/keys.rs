//! Key times: rows of marks, and steps from key to key.

use bindpose::anim::{key_times, merged_key_times, merged_key_times_of, next_key, previous_key};
use bindpose::import::m3d;
use bindpose::model::JointIndex;

use crate::documents::{REAL_FILES, arm, key, model_of, real_file, track};
use crate::rigs::{self, JOINT_COUNTS};

#[test]
fn a_joint_has_its_own_keys_and_none_that_the_file_lacks() {
    let mut document = arm();
    document.clips[0].bones[1] = track([key(0.5, [0.0; 3])]);
    document.clips[0].bones[2] = track([]);
    let (model, _) = model_of(&document);
    let clip = &model.clips[0];
    assert_eq!(key_times(clip, JointIndex(0)), [0.0, 1.0]);
    assert_eq!(key_times(clip, JointIndex(1)), [0.5]);
    assert!(key_times(clip, JointIndex(2)).is_empty() && key_times(clip, JointIndex(3)).is_empty());
    assert!(clip.tracks[1].has_keys() && !clip.tracks[2].has_keys());
    assert_eq!(merged_key_times(clip), [0.0, 0.5, 1.0]);
}

#[test]
fn times_that_nobody_tells_apart_count_once() {
    let mut document = arm();
    let times: [&[f32]; 3] = [&[0.0, 0.1, 0.2], &[0.000_001, 0.099_999, 0.200_001], &[0.05, 0.106]];
    for (bone, times) in document.clips[0].bones.iter_mut().zip(times) {
        *bone = track(times.iter().map(|&secs| key(secs, [0.0; 3])).collect::<Vec<_>>());
    }
    let (model, _) = model_of(&document);
    // A twentieth of a frame is 5 ms here.
    let clip = &model.clips[0];
    assert_eq!(merged_key_times(clip), [0.0, 0.05, 0.099_999, 0.106, 0.2]);
    let of = |joints: &[u32]| {
        let joints: Vec<_> = joints.iter().copied().map(JointIndex).collect();
        merged_key_times_of(clip, &joints)
    };
    assert_eq!(of(&[2, 1]), [0.000_001, 0.05, 0.099_999, 0.106, 0.200_001]);
    assert_eq!(of(&[0, 1, 2]), merged_key_times(clip));
    assert_eq!((of(&[]), of(&[9])), (vec![], vec![]), "nobody has no keys");
}

#[test]
fn steps_go_to_the_next_key_and_end_at_the_ends() {
    let model = rigs::model(1);
    let clip = &model.clips[2];
    let times = key_times(clip, JointIndex(0));
    assert_eq!((times.len(), times[0], times[8]), (9, 3.0, 5.0));
    for (time_secs, next, previous) in [
        (0.0, Some(3.0), None),
        (3.0, Some(3.25), None),
        (3.1, Some(3.25), Some(3.0)),
        // A rounding away from a key is on it.
        (3.250_001, Some(3.5), Some(3.0)),
        (3.249_999, Some(3.5), Some(3.0)),
        (5.0, None, Some(4.75)),
        (9.0, None, Some(5.0)),
        (f32::NAN, Some(3.0), None),
    ] {
        assert_eq!(next_key(clip, times, time_secs), next, "{time_secs}");
        assert_eq!(previous_key(clip, times, time_secs), previous, "{time_secs}");
    }
    assert_eq!((next_key(clip, &[], 1.0), previous_key(clip, &[], 1.0)), (None, None));
}

/// Every frame on which a key stands is that key to the bit, and every key is reached by steps.
#[test]
fn frames_are_keys_and_steps_reach_them_all() {
    let mut models: Vec<_> = JOINT_COUNTS.map(rigs::model).into();
    models.extend(REAL_FILES.iter().filter_map(|name| {
        let parsed = real_file(name)?;
        Some(m3d::from_parsed(&parsed).expect("sound").0)
    }));
    for clip in models.iter().flat_map(|model| &model.clips) {
        let densest = clip
            .tracks
            .iter()
            .max_by_key(|track| track.key_count())
            .expect("a track");
        let rate = f64::from(clip.keys_per_sec);
        for frame in 1..clip.last_frame() {
            let ideal_secs = f64::from(clip.start_secs) + f64::from(frame) / rate;
            let near = |&secs: &f32| (f64::from(secs) - ideal_secs).abs() * rate < 0.005;
            if let Some(&key_secs) = densest.times_secs().iter().find(|secs| near(secs)) {
                assert_eq!(
                    clip.time_of_frame(frame).to_bits(),
                    key_secs.to_bits(),
                    "{} {frame}",
                    clip.name
                );
                assert_eq!(clip.time_at_place(f64::from(frame)).to_bits(), key_secs.to_bits());
            }
        }
        let all = merged_key_times(clip);
        let mut reached = vec![clip.start_secs];
        while let Some(secs) = next_key(clip, &all, reached[reached.len() - 1]) {
            reached.push(secs);
        }
        assert_eq!(reached, all, "{}", clip.name);
        let mut back = vec![clip.end_secs.max(all[all.len() - 1])];
        while let Some(secs) = previous_key(clip, &all, back[back.len() - 1]) {
            back.push(secs);
        }
        assert_eq!(back.len(), all.len(), "{}", clip.name);
    }
}

#[test]
fn places_between_frames_are_times_between_them() {
    let model = rigs::model(1);
    let clip = &model.clips[2];
    for (place, time_secs) in [
        (0.0, 3.0),
        (2.5, 3.625),
        (8.0, 5.0),
        (7.75, 4.9375),
        (-1.0, 3.0),
        (99.0, 5.0),
        (f64::NAN, 3.0),
        (f64::INFINITY, 5.0),
    ] {
        assert_eq!(clip.time_at_place(place), time_secs, "{place}");
    }
    assert_eq!(
        (clip.place_of(3.625), clip.place_of(f32::NAN), clip.place_of(9.0)),
        (2.5, 0.0, 8.0)
    );
}
