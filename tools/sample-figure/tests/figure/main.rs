//! Tests of the figure and its maps, and helpers that pose it the obvious way.

mod file;
mod maps;
mod motion;
mod rig;
mod skin;
mod texcoords;

use std::collections::BTreeMap;
use std::sync::LazyLock;

use bindpose::format::{AnimationClip, Document};
use glam::{DMat4, DQuat, DVec3};

static FIGURE: LazyLock<Document> = LazyLock::new(sample_figure::figure);

/// Positions are written to 5 decimals, 0.01 mm.
const WRITTEN_METRES: f64 = 1e-5;

/// Index of the left thigh in the file; shin, foot and toe follow.
const LEFT_THIGH: usize = 19;
/// Likewise of the right thigh.
const RIGHT_THIGH: usize = 35;

fn is_below(joint: usize, ancestor: usize) -> bool {
    joint == ancestor || FIGURE.bone_parents[joint] >= 0 && is_below(FIGURE.bone_parents[joint] as usize, ancestor)
}

fn vector(numbers: [f32; 3]) -> DVec3 {
    DVec3::from_array(numbers.map(f64::from))
}

fn quat(numbers: [f32; 4]) -> DQuat {
    DQuat::from_array(numbers.map(f64::from))
}

fn position(corner: u32) -> DVec3 {
    vector(FIGURE.vertices[corner as usize].position)
}

/// Distinct positions, and which of them each vertex has.
fn welded(figure: &Document) -> (Vec<DVec3>, Vec<usize>) {
    let mut known = BTreeMap::new();
    let mut points = Vec::new();
    let vertex_of = figure.vertices.iter().map(|vertex| {
        *known.entry(vertex.position.map(f32::to_bits)).or_insert_with(|| {
            points.push(vector(vertex.position));
            points.len() - 1
        })
    });
    let vertex_of = vertex_of.collect();
    (points, vertex_of)
}

fn offset(joint: usize) -> DMat4 {
    DMat4::from_cols_array(&FIGURE.bone_offsets[joint].map(f64::from))
}

fn end_secs(clip: &AnimationClip) -> f32 {
    clip.bones
        .iter()
        .flat_map(|bone| bone.keyframes.last())
        .map(|key| key.time_secs)
        .fold(0.0, f32::max)
}

fn frames(clip: &AnimationClip) -> usize {
    (end_secs(clip) * 30.0).round() as usize
}

/// Translation and rotation of a joint at a frame; a still joint has keys at the ends only.
fn key(clip: &AnimationClip, joint: usize, frame: usize) -> (DVec3, DQuat) {
    let keys = &clip.bones[joint].keyframes;
    let key = keys[if keys.len() == 2 { 0 } else { frame }];
    (vector(key.translation), quat(key.rotation).normalize())
}

/// The textbook's way: parents times children.
fn model_from_joint(clip: &AnimationClip, frame: usize) -> Vec<DMat4> {
    let mut model = Vec::<DMat4>::new();
    for (joint, &parent) in FIGURE.bone_parents.iter().enumerate() {
        let (translation, rotation) = key(clip, joint, frame);
        let local = DMat4::from_rotation_translation(rotation, translation);
        model.push(if parent < 0 {
            local
        } else {
            model[parent as usize] * local
        });
    }
    model
}

fn palette(clip: &AnimationClip, frame: usize) -> Vec<DMat4> {
    model_from_joint(clip, frame)
        .into_iter()
        .enumerate()
        .map(|(joint, model)| model * offset(joint))
        .collect()
}

fn skinned(vertex: &bindpose::format::Vertex, palette: &[DMat4]) -> DVec3 {
    let point = vector(vertex.position);
    let influences = vertex.blend_weights.into_iter().zip(vertex.blend_indices);
    influences
        .map(|(weight, joint)| palette[joint as usize].transform_point3(point) * f64::from(weight))
        .sum()
}
