//! Models with many joints for the tests of the timeline.

use bindpose::format::{AnimationClip, BoneAnimation, Document, Keyframe};
use bindpose::session::File;
use glam::{Quat, Vec3};

use crate::models::{self, KEYS_PER_SEC};

/// A tree of joints, three to a parent, that all swing, the later the more; every seventh stands still. One clip of so many
/// keys a joint, and a second one of a key each.
pub(crate) fn rig(joints: usize, keys: usize) -> File {
    models::file("rig.m3d", &document(joints, keys))
}

/// A chain of joints that swing, with keys at these frames each.
pub(crate) fn chain(frames: &[&[usize]]) -> File {
    let joints = frames.len();
    let mut document = document(joints, 1);
    document.bone_parents = (-1..joints as i32 - 1).collect();
    document.clips.truncate(1);
    for (bone, (track, frames)) in document.clips[0].bones.iter_mut().zip(frames).enumerate() {
        track.keyframes = frames
            .iter()
            .map(|&frame| keyframe(bone + 1, joints + 1, frame))
            .collect();
    }
    models::file("chain.m3d", &document)
}

fn document(joints: usize, keys: usize) -> Document {
    let mut document = models::skinned(&[("Swing", 0.0, 2)]);
    document.bone_parents = (0..joints as i32)
        .map(|bone| if bone == 0 { -1 } else { (bone - 1) / 3 })
        .collect();
    document.bone_offsets = vec![document.bone_offsets[0]; joints];
    for vertex in &mut document.vertices {
        vertex.blend_weights = [1.0, 0.0, 0.0, 0.0];
        vertex.blend_indices = [0; 4];
    }
    let track = |bone: usize, keys: usize| BoneAnimation {
        keyframes: (0..keys).map(|key| keyframe(bone, joints, key)).collect(),
    };
    document.clips = [("Swing", keys), ("Short", 1)]
        .map(|(name, keys)| AnimationClip {
            name: name.to_owned(),
            bones: (0..joints).map(|bone| track(bone, keys)).collect(),
        })
        .into();
    document
}

fn keyframe(bone: usize, joints: usize, key: usize) -> Keyframe {
    let size = if bone.is_multiple_of(7) {
        0.0
    } else {
        bone as f32 / joints as f32
    };
    let swing = (key as f32 * 0.15).sin() * size;
    Keyframe {
        time_secs: key as f32 / KEYS_PER_SEC,
        translation: (Vec3::Y * 0.1).to_array(),
        scale: [1.0; 3],
        rotation: Quat::from_rotation_x(swing).to_array(),
    }
}

/// A joint that doubles its size until the last of two keys.
pub(crate) fn growing() -> File {
    let mut document = document(1, 2);
    document.clips.truncate(1);
    for (key, scale) in document.clips[0].bones[0].keyframes.iter_mut().zip([1.0, 2.0]) {
        key.scale = [scale; 3];
    }
    models::file("growing.m3d", &document)
}
