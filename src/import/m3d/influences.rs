//! From the file's blend weights and bone numbers to influences.

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Subject, codes};
use crate::format::{Document, LineMap, Vertex, VertexField};
use crate::import::{ImportError, ImportErrorKind};
use crate::model::{Influences, Skeleton};

/// A sum of weights that is off by more than this was not meant to be rounded.
const SUM_TOLERANCE: f32 = 1e-3;

/// Highest bone number that the books' loaders keep: they store it in a byte.
const BOOK_BONE_INDEX: u32 = 255;

/// What is mended or worth knowing, counted over the vertices.
#[derive(Default)]
struct Mended {
    off_sum: Tally,
    unweighted: Tally,
    invalid: Tally,
    high_bone: Tally,
}

/// One entry per vertex; none for a model without joints.
pub(super) fn influences_from_document(
    document: &Document,
    lines: &LineMap,
    skeleton: &Skeleton,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Influences>, ImportError> {
    if skeleton.joint_count() == 0 {
        return Ok(Vec::new());
    }
    let mut mended = Mended::default();
    let influences = (0u32..)
        .zip(&document.vertices)
        .map(|(index, vertex)| {
            let weights = normalized(index, vertex.blend_weights, &mut mended);
            joined(index, vertex, weights, skeleton, &mut mended).map_err(|kind| {
                let lines = lines.vertex_lines(VertexField::BlendIndices);
                kind.on_line(lines.get(index as usize).copied())
            })
        })
        .collect::<Result<_, _>>()?;
    mended.note(lines, diagnostics);
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
    if (sum - 1.0).abs() > f64::from(SUM_TOLERANCE) {
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
    mended: &mut Mended,
) -> Result<Influences, ImportErrorKind> {
    let mut joints = [0; 4];
    for ((joint, &bone), &weight) in joints.iter_mut().zip(&vertex.blend_indices).zip(&weights) {
        if weight == 0.0 {
            continue;
        }
        let Some(named) = skeleton.joint_of_bone().get(bone as usize) else {
            return Err(ImportErrorKind::InfluenceOutOfRange {
                vertex: index,
                bone,
                bone_count: skeleton.joint_count() as u32,
            });
        };
        if bone > BOOK_BONE_INDEX {
            mended.high_bone.add(index);
        }
        *joint = named.0;
    }
    Ok(Influences { joints, weights })
}

impl Mended {
    fn note(&self, lines: &LineMap, diagnostics: &mut Diagnostics) {
        let place_in = |field, tally: &Tally| Place::of_rows(tally, Subject::Vertex, &lines.vertex_lines(field));
        let place = |tally: &Tally| place_in(VertexField::BlendWeights, tally);
        let vertices = |tally: &Tally| counted(tally.count, "vertex has", "vertices have");
        if self.invalid.count > 0 {
            diagnostics.add(
                &codes::WEIGHTS_INVALID,
                place(&self.invalid),
                format!(
                    "{} a blend weight that is negative or not finite; taken as 0.",
                    vertices(&self.invalid)
                ),
            );
        }
        if self.off_sum.count > 0 {
            diagnostics.add(
                &codes::WEIGHTS_NOT_NORMALIZED,
                place(&self.off_sum),
                format!(
                    "{} blend weights whose sum is off from 1 by more than {SUM_TOLERANCE}; normalised.",
                    vertices(&self.off_sum)
                ),
            );
        }
        if self.unweighted.count > 0 {
            diagnostics.add(
                &codes::WEIGHTS_ALL_ZERO,
                place(&self.unweighted),
                format!("{} no blend weight; not moved by any bone.", vertices(&self.unweighted)),
            );
        }
        if self.high_bone.count > 0 {
            diagnostics.add(
                &codes::BONE_INDEX_ABOVE_BYTE,
                place_in(VertexField::BlendIndices, &self.high_bone),
                format!(
                    "{} a bone above {BOOK_BONE_INDEX}, which the books' loaders cannot hold.",
                    counted(self.high_bone.count, "influence names", "influences name")
                ),
            );
        }
    }
}
