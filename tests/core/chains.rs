//! Models made by rule, of any number of bones: a root with a left and a right chain, mirrored across x = 0.

use bindpose::format::{AnimationClip, Document, Vertex};
use bindpose::model::Model;

use crate::documents::{key, material, model_of, offset, subset, track, turned, vertex};

/// Bones of one length hang from the root alternately left and right, and each branches off again at every tenth. Every bone
/// has a triangle of its own, shared with its parent. The clip `wave` of a second turns each a little.
pub(crate) fn mirrored(bone_count: usize) -> Document {
    let places: Vec<[f32; 3]> = (0..bone_count).map(place).collect();
    let parents: Vec<i32> = (0..bone_count as i32).map(parent).collect();
    let moved = |bone: usize| {
        let parent = usize::try_from(parents[bone]).map_or([0.0; 3], |parent| places[parent]);
        let from_parent = std::array::from_fn(|axis| places[bone][axis] - parent[axis]);
        let angle = 0.02 + 0.01 * (bone % 5) as f32;
        track([
            key(0.0, from_parent),
            key(0.5, from_parent),
            turned(key(1.0, from_parent), angle),
        ])
    };
    let corners = |bone: usize| {
        let parent = parents[bone].max(0) as u32;
        [[0.0, 0.0], [0.0, 0.1], [0.1, 0.0]].map(|[x, y]| Vertex {
            position: [places[bone][0] + x, places[bone][1] + y, places[bone][2]],
            blend_weights: [0.75, 0.25, 0.0, 0.0],
            blend_indices: [bone as u32, parent, 0, 0],
            ..vertex(0.0, 0.0)
        })
    };
    Document {
        materials: vec![material("skin")],
        subsets: vec![subset(0, bone_count as u32)],
        vertices: (0..bone_count).flat_map(corners).collect(),
        triangles: (0..bone_count as u32)
            .map(|bone| [bone * 3, bone * 3 + 1, bone * 3 + 2])
            .collect(),
        bone_offsets: places.iter().map(|&place| offset(place)).collect(),
        bone_parents: parents.clone(),
        clips: vec![AnimationClip {
            name: "wave".to_owned(),
            bones: (0..bone_count).map(moved).collect(),
        }],
        ..Document::default()
    }
}

/// Bone 0 is the root; odd bones are left (+x), even ones right.
fn parent(bone: i32) -> i32 {
    match bone {
        0 => -1,
        1 | 2 => 0,
        // Every tenth pair hangs from an older one.
        _ if (bone - 1) / 2 % 10 == 0 => (bone - 1) % 2 + 1,
        _ => bone - 2,
    }
}

fn place(bone: usize) -> [f32; 3] {
    if bone == 0 {
        return [0.0; 3];
    }
    let (pair, side) = ((bone - 1) / 2, if bone % 2 == 1 { 1.0 } else { -1.0 });
    [
        side * (0.5 + (pair % 10) as f32 * 0.3),
        (pair / 10) as f32 * 0.2,
        0.05 * (pair % 3) as f32,
    ]
}

pub(crate) fn mirrored_model(bone_count: usize) -> Model {
    model_of(&mirrored(bone_count)).0
}
