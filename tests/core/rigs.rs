//! Models of as many joints as a test wants, with clips whose keys lie as they like.

use bindpose::format::{AnimationClip, BoneAnimation, Document, Keyframe};
use bindpose::model::Model;
use glam::{EulerRot, Quat};

use crate::documents::{key, model_of, offset, quad, track, vertex};

/// The joints of the models that tests run over: one, more than a uniform block holds, more than a texture's row.
pub(crate) const JOINT_COUNTS: [u32; 3] = [1, 300, 2_000];

/// A quad that hangs on the first of `bones` bones. Every tenth bone hangs on the first, the others on the one before, each
/// half a unit above its parent.
pub(crate) fn rig(bones: u32, clips: Vec<AnimationClip>) -> Document {
    let parent = |bone: u32| match bone {
        0 => -1,
        bone if bone.is_multiple_of(10) => 0,
        bone => bone as i32 - 1,
    };
    let mut heights = Vec::new();
    for bone in 0..bones {
        let below = usize::try_from(parent(bone)).map_or(-0.5, |parent| heights[parent]);
        heights.push(below + 0.5_f32);
    }
    let mut document = quad();
    for vertex in &mut document.vertices {
        vertex.blend_weights = [1.0, 0.0, 0.0, 0.0];
    }
    document.vertices.push(vertex(0.0, 0.0));
    document.bone_offsets = heights.iter().map(|&height| offset([0.0, height, 0.0])).collect();
    document.bone_parents = (0..bones).map(parent).collect();
    document.clips = clips;
    document
}

/// [`rig`] with all three kinds of clips, as a model.
pub(crate) fn model(bones: u32) -> Model {
    let clips = vec![
        ragged("ragged", bones),
        single("single", bones),
        even("even", bones, 3.0, 9, 4.0),
    ];
    model_of(&rig(bones, clips)).0
}

/// Keys of every bone at even steps: the first bone wanders along x by one a second, the others turn about z and come back.
pub(crate) fn even(name: &str, bones: u32, start_secs: f32, keys: u32, keys_per_sec: f32) -> AnimationClip {
    let keys_of = |bone: u32| {
        let one = |index: u32| {
            let time_secs = start_secs + index as f32 / keys_per_sec;
            if bone == 0 {
                return key(time_secs, [index as f32 / keys_per_sec, 0.0, 0.0]);
            }
            let phase = index as f32 / (keys - 1).max(1) as f32;
            posed(
                time_secs,
                0.5,
                Quat::from_rotation_z((phase * std::f32::consts::TAU).sin() * 0.7),
            )
        };
        track((0..keys).map(one).collect::<Vec<_>>())
    };
    clip(name, bones, keys_of)
}

/// Keys at times of each bone's own, from 0.25 s at the earliest; every fourth bone has one key, every seventh none.
pub(crate) fn ragged(name: &str, bones: u32) -> AnimationClip {
    let keys_of = |bone: u32| {
        let count = match bone {
            bone if bone % 7 == 6 => 0,
            bone if bone % 4 == 3 => 1,
            bone => 2 + bone * 5 % 11,
        };
        let mut time_secs = 0.25 + (bone % 5) as f32 * 0.1;
        let one = |index: u32| {
            time_secs += 0.03 + ((index * 7 + bone) % 9) as f32 * 0.02;
            let (a, b) = (index as f32 * 1.3 + bone as f32, index as f32 * 0.7);
            let lift = if bone == 0 { 0.0 } else { 0.5 };
            posed(
                time_secs,
                lift,
                Quat::from_euler(EulerRot::XYZ, a.sin() * 2.0, b.sin(), (a + b).cos() * 2.0),
            )
        };
        track((0..count).map(one).collect::<Vec<_>>())
    };
    clip(name, bones, keys_of)
}

/// One key a bone, at 1.5 s.
pub(crate) fn single(name: &str, bones: u32) -> AnimationClip {
    clip(name, bones, |bone| {
        track([posed(
            1.5,
            if bone == 0 { 0.0 } else { 0.5 },
            Quat::from_rotation_x(bone as f32 * 0.1),
        )])
    })
}

fn clip(name: &str, bones: u32, keys_of: impl FnMut(u32) -> BoneAnimation) -> AnimationClip {
    AnimationClip {
        name: name.to_owned(),
        bones: (0..bones).map(keys_of).collect(),
    }
}

fn posed(time_secs: f32, height: f32, rotation: Quat) -> Keyframe {
    Keyframe {
        rotation: rotation.to_array(),
        ..key(time_secs, [0.0, height, 0.0])
    }
}
