//! From the file's blend weights and bone numbers to influences.

use glam::Vec4;

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Diagnostic, Fault, Subject, codes};
use crate::format::{Document, LineMap, Vertex, VertexField};
use crate::import::weights::{Mended, SUM_TOLERANCE};
use crate::model::{Influences, Skeleton};
use crate::slices::Slices;

/// Highest bone number that the books' loaders keep: they store it in a byte.
const BOOK_BONE_INDEX: u32 = 255;

/// One entry per vertex; none for a model without joints.
pub(super) async fn influences_from_document(
    document: &Document,
    lines: &LineMap,
    skeleton: &Skeleton,
    diagnostics: &mut Diagnostics,
    slices: &Slices,
) -> Result<Vec<Influences>, Fault> {
    if skeleton.joint_count() == 0 {
        return Ok(Vec::new());
    }
    let (mut mended, mut high_bone) = (Mended::default(), Tally::default());
    let mut influences = Vec::with_capacity(document.vertices.len());
    let mut faulty = None;
    let take = |(index, vertex): (u32, &Vertex)| {
        let weights = normalized(index, vertex.blend_weights, &mut mended);
        let joints = joints_of(vertex, &weights, skeleton).unwrap_or_else(|| {
            faulty.get_or_insert_with(|| (index, out_of_range(index, vertex, &weights, skeleton)));
            [0; 4]
        });
        let weighted = vertex.blend_indices.into_iter().zip(weights);
        for _ in weighted.filter(|&(bone, weight)| bone > BOOK_BONE_INDEX && weight != 0.0) {
            high_bone.add(index);
        }
        influences.push(Influences { joints, weights });
    };
    slices.for_each((0..).zip(&document.vertices), take).await;
    if let Some((index, fault)) = faulty {
        let lines = lines.vertex_lines(VertexField::BlendIndices);
        return Err(fault.on_line(lines.get(index as usize).copied()).into());
    }
    let place = |field, tally: &Tally| Place::of_rows(tally, Subject::Vertex, &lines.vertex_lines(field));
    mended.tell(diagnostics, |tally| place(VertexField::BlendWeights, tally));
    if high_bone.count > 0 {
        let message = format!(
            "{} a bone above {BOOK_BONE_INDEX}, which the books' loaders cannot hold.",
            counted(high_bone.count, "influence names", "influences name")
        );
        let place = place(VertexField::BlendIndices, &high_bone);
        diagnostics.add(&codes::BONE_INDEX_ABOVE_BYTE, place, message);
    }
    Ok(influences)
}

/// Weights that sum to 1, or four zeros.
fn normalized(index: u32, stored: [f32; 4], mended: &mut Mended) -> [f32; 4] {
    let stored = Vec4::from_array(stored);
    let is_usable = stored.cmpgt(Vec4::ZERO) & stored.cmplt(Vec4::INFINITY);
    let usable = Vec4::select(is_usable, stored, Vec4::ZERO);
    if usable.cmpne(stored).any() {
        mended.invalid.add(index);
    }
    let usable = usable.to_array();
    // In f64: four great weights must not overflow to infinity and divide to zero.
    let wide = |slot: usize| f64::from(usable[slot]);
    let sum = wide(0) + wide(1) + wide(2) + wide(3);
    if sum <= 0.0 {
        mended.unweighted.add(index);
        return [0.0; 4];
    }
    if (sum - 1.0).abs() > SUM_TOLERANCE {
        mended.off_sum.add(index);
    }
    // A sum that is as near to 1 as numbers are stays, so that a second time changes nothing.
    if (sum - 1.0).abs() <= f64::from(f32::EPSILON) {
        return usable;
    }
    usable.map(|weight| (f64::from(weight) / sum) as f32)
}

/// The joints of a vertex's bones; none when one of them is not there. A slot without weight names joint 0, whatever the file has there.
#[inline]
fn joints_of(vertex: &Vertex, weights: &[f32; 4], skeleton: &Skeleton) -> Option<[u32; 4]> {
    let mut joints = [0; 4];
    for ((joint, &bone), &weight) in joints.iter_mut().zip(&vertex.blend_indices).zip(weights) {
        if weight != 0.0 {
            *joint = skeleton.joint_of_bone().get(bone as usize)?.0;
        }
    }
    Some(joints)
}

/// The error of a vertex that gives weight to a bone that is not there.
#[cold]
fn out_of_range(index: u32, vertex: &Vertex, weights: &[f32; 4], skeleton: &Skeleton) -> Diagnostic {
    let bone_count = skeleton.joint_count();
    let mut weighted = vertex.blend_indices.iter().zip(weights);
    let missing = weighted.find(|&(&bone, &weight)| weight != 0.0 && bone as usize >= bone_count);
    let bone = missing.map_or(0, |(&bone, _)| bone);
    let message = format!("Vertex {index} gives weight to bone {bone}, but there are {bone_count} bones.");
    let fault = codes::INFLUENCE_OUT_OF_RANGE
        .says(message)
        .about(Subject::Vertex(index));
    let fault = fault.expected(format!("a bone below {bone_count}"));
    fault.found(bone.to_string())
}
