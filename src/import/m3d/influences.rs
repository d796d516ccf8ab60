//! From the file's blend weights and bone numbers to influences.

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Fault, Subject, codes};
use crate::format::{Document, LineMap, Vertex, VertexField};
use crate::import::weights::{Mended, SUM_TOLERANCE};
use crate::model::{Influences, Skeleton};

/// Highest bone number that the books' loaders keep: they store it in a byte.
const BOOK_BONE_INDEX: u32 = 255;

/// One entry per vertex; none for a model without joints.
pub(super) fn influences_from_document(
    document: &Document,
    lines: &LineMap,
    skeleton: &Skeleton,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Influences>, Fault> {
    if skeleton.joint_count() == 0 {
        return Ok(Vec::new());
    }
    let (mut mended, mut high_bone) = (Mended::default(), Tally::default());
    let influences = (0u32..)
        .zip(&document.vertices)
        .map(|(index, vertex)| {
            let weights = normalized(index, vertex.blend_weights, &mut mended);
            joined(index, vertex, weights, skeleton, &mut high_bone).map_err(|fault| {
                let lines = lines.vertex_lines(VertexField::BlendIndices);
                fault.on_line(lines.get(index as usize).copied()).into()
            })
        })
        .collect::<Result<_, Fault>>()?;
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
    let usable = stored.map(|weight| {
        if weight.is_finite() && weight > 0.0 {
            weight
        } else {
            0.0
        }
    });
    if usable != stored {
        mended.invalid.add(index);
    }
    // In f64: four great weights must not overflow to infinity and divide to zero.
    let sum: f64 = usable.iter().map(|&weight| f64::from(weight)).sum();
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

/// Weights with the joints of their bones. A slot without weight names joint 0, whatever the file has there.
fn joined(
    index: u32,
    vertex: &Vertex,
    weights: [f32; 4],
    skeleton: &Skeleton,
    high_bone: &mut Tally,
) -> Result<Influences, Fault> {
    let mut joints = [0; 4];
    for ((joint, &bone), &weight) in joints.iter_mut().zip(&vertex.blend_indices).zip(&weights) {
        if weight == 0.0 {
            continue;
        }
        let Some(named) = skeleton.joint_of_bone().get(bone as usize) else {
            let bone_count = skeleton.joint_count();
            let message = format!("Vertex {index} gives weight to bone {bone}, but there are {bone_count} bones.");
            let fault = codes::INFLUENCE_OUT_OF_RANGE
                .says(message)
                .about(Subject::Vertex(index));
            let fault = fault.expected(format!("a bone below {bone_count}"));
            return Err(fault.found(bone.to_string()).into());
        };
        if bone > BOOK_BONE_INDEX {
            high_bone.add(index);
        }
        *joint = named.0;
    }
    Ok(Influences { joints, weights })
}
