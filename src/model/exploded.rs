//! Finds clips whose keys do not belong to the offsets: the mesh flies apart.

use glam::{Affine3A, Vec3};

use super::notes::{Notes, Place};
use super::{Clip, Mesh, Skeleton};
use crate::diagnostic::{Subject, codes};
use crate::format::LineMap;

/// Triangles looked at for a clip, spread over the mesh: enough for a fraction.
const LOOKED_AT: usize = 4_000;

/// Triangles looked at for all clips together, so that thousands of clips do not look at the mesh thousands of times.
const LOOKED_AT_IN_ALL: usize = 100 * LOOKED_AT;

/// Triangles looked at for a clip however many there are.
const LEAST_LOOKED_AT: usize = 50;

/// An edge this many times longer than the usual edge of the pose is torn.
const TORN: f32 = 4.0;

/// Share of torn edges from which the mesh has flown apart. A run of the books' soldier tears none.
const TORN_SHARE: f64 = 0.05;

/// Compares edge lengths at the first key of each clip with the bind pose. Keys in model space, or offsets of another
/// skeleton, tear the edges between parts that follow different joints; a clip that only scales tears none.
pub(super) fn note_exploded(mesh: &Mesh, skeleton: &Skeleton, clips: &[Clip], lines: &LineMap, notes: &mut Notes) {
    if mesh.influences.is_empty() {
        return;
    }
    let looked_at = (LOOKED_AT_IN_ALL / clips.len().max(1)).clamp(LEAST_LOOKED_AT, LOOKED_AT);
    for (index, clip) in (0u32..).zip(clips) {
        let share = torn_share(mesh, looked_at, &first_key_palette(skeleton, clip));
        if share > TORN_SHARE {
            notes.add(
                &codes::EXPLODED,
                Place::on(Subject::Clip(index), lines.clips.get(index as usize).map(|lines| lines.clip)),
                format!(
                    "{:.0} % of the edges are torn at the first key of \"{}\": its keys do not belong to the bone offsets \
                     (perhaps they are relative to the model, not to the parent).",
                    share * 100.0,
                    clip.name
                ),
            );
        }
    }
}

/// `model_from_bind` of each joint at the first key of its track.
fn first_key_palette(skeleton: &Skeleton, clip: &Clip) -> Vec<Affine3A> {
    let mut model_from_joint: Vec<Affine3A> = Vec::with_capacity(skeleton.joint_count());
    for (track, parent) in clip.tracks.iter().zip(skeleton.parents()) {
        let parent_from_joint = track.key(0).parent_from_joint();
        model_from_joint.push(match parent {
            Some(parent) => model_from_joint[parent.index()] * parent_from_joint,
            None => parent_from_joint,
        });
    }
    let joints = model_from_joint.iter().zip(skeleton.joint_from_bind());
    joints
        .map(|(&model_from_joint, &joint_from_bind)| model_from_joint * joint_from_bind)
        .collect()
}

/// Share of edges that are far longer, beside the bind pose, than the middle one.
fn torn_share(mesh: &Mesh, looked_at: usize, palette: &[Affine3A]) -> f64 {
    let posed = |vertex: u32| -> Vec3 {
        let (position, influences) = (mesh.positions[vertex as usize], &mesh.influences[vertex as usize]);
        let pairs = influences.joints.iter().zip(&influences.weights);
        pairs
            .map(|(&joint, &weight)| palette[joint as usize].transform_point3(position) * weight)
            .sum()
    };
    let stride = (mesh.triangle_count() / looked_at).max(1);
    let mut ratios = Vec::with_capacity(looked_at * 3);
    for corners in mesh.indices.chunks_exact(3).step_by(stride) {
        for [a, b] in [[0, 1], [1, 2], [2, 0]].map(|edge| edge.map(|corner: usize| corners[corner])) {
            let weighted = |vertex: u32| mesh.influences[vertex as usize].weights != [0.0; 4];
            let bind_length = mesh.positions[a as usize].distance(mesh.positions[b as usize]);
            let ratio = posed(a).distance(posed(b)) / bind_length;
            if bind_length > 0.0 && ratio.is_finite() && weighted(a) && weighted(b) {
                ratios.push(ratio);
            }
        }
    }
    if ratios.is_empty() {
        return 0.0;
    }
    let middle = ratios.len() / 2;
    let (_, &mut usual, _) = ratios.select_nth_unstable_by(middle, f32::total_cmp);
    let torn = ratios
        .iter()
        .filter(|&&ratio| ratio > TORN * usual.max(f32::MIN_POSITIVE))
        .count();
    torn as f64 / ratios.len() as f64
}
