//! The clips. Each is a function from phase to pose, sampled at 30 keys a second.

mod curve;
mod gait;
mod pose;
mod standing;

use bindpose::format::{AnimationClip, BoneAnimation, Keyframe};
use glam::DQuat;

use crate::document::{round, rounded};
use crate::rig::{JOINT_COUNT, Rig};
use pose::{LocalKey, Pose};

/// All clips, the one to greet with first.
pub(crate) fn clips(rig: &Rig) -> Vec<AnimationClip> {
    vec![
        clip(rig, "Idle", standing::IDLE_KEY_SPANS, |phase| {
            standing::idle(rig, phase)
        }),
        clip(rig, "Walk", gait::WALK.key_spans, |phase| gait::WALK.pose(rig, phase)),
        clip(rig, "Run", gait::RUN.key_spans, |phase| gait::RUN.pose(rig, phase)),
        clip(rig, "Wave", standing::WAVE_KEY_SPANS, |phase| {
            standing::wave(rig, phase)
        }),
    ]
}

/// Keys a second of every clip.
const KEYS_PER_SEC: f64 = 30.0;

/// A clip of `key_spans` thirtieths of a second through the poses of phases 0…1. The last key is the first pose again. A
/// joint that keeps still has keys at both ends only.
pub(crate) fn clip(rig: &Rig, name: &str, key_spans: usize, pose: impl Fn(f64) -> Pose) -> AnimationClip {
    let mut tracks = vec![Vec::new(); JOINT_COUNT];
    for key in 0..=key_spans {
        let phase = (key % key_spans) as f64 / key_spans as f64;
        let time_secs = round(key as f64 / KEYS_PER_SEC, 6);
        for (track, local) in tracks.iter_mut().zip(pose(phase).local_keys(rig)) {
            let previous = track.last().map(|keyframe: &Keyframe| keyframe.rotation);
            track.push(keyframe(time_secs, local, previous));
        }
    }
    let bones = tracks
        .into_iter()
        .map(|keyframes| BoneAnimation {
            keyframes: without_still_keys(keyframes),
        })
        .collect();
    AnimationClip {
        name: name.into(),
        bones,
    }
}

fn keyframe(time_secs: f32, local: LocalKey, previous: Option<[f32; 4]>) -> Keyframe {
    // Of q and -q the one that is nearer to the key before, and at first the one with w > 0.
    let before = previous.map_or(DQuat::IDENTITY, |q| DQuat::from_array(q.map(f64::from)));
    let rotation = if before.dot(local.rotation) < 0.0 {
        -local.rotation
    } else {
        local.rotation
    };
    Keyframe {
        time_secs,
        translation: rounded(local.translation, 5),
        scale: [1.0; 3],
        rotation: rotation.to_array().map(|value| round(value, 6)),
    }
}

fn without_still_keys(mut keyframes: Vec<Keyframe>) -> Vec<Keyframe> {
    let still = keyframes.iter().all(|keyframe| {
        Keyframe {
            time_secs: keyframes[0].time_secs,
            ..*keyframe
        } == keyframes[0]
    });
    if still {
        keyframes.drain(1..keyframes.len() - 1);
    }
    keyframes
}
