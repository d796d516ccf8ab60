//! In which order submeshes are blended over what is behind them: the farthest first.
//!
//! What is blended is drawn after the background and writes no depth, so two panes of one submesh both show. Its parts with alpha 1 are
//! drawn among the opaque ones, with depth, so hair and leaves hide what is behind them in any order. Of what is double-sided the backs
//! come first.

use std::ops::Range;

use glam::{Affine3A, Vec3, Vec4};

use super::triangles::DrawRange;
use crate::model::Mesh;
use crate::scene::RenderFrame;

/// The mean of a submesh's corners in any pose. Blending with weights is linear, so that a sum for each joint is enough.
pub struct Center {
    /// Sums over the corners that no joint moves: positions, and w for their count. All sums are divided by the count of all corners.
    still: Vec4,
    /// Joints with the same sums, each corner times its weight.
    of_joints: Vec<(u32, Vec4)>,
}

impl Center {
    /// Of each range.
    pub fn of(mesh: &Mesh, ranges: &[DrawRange], joint_count: usize) -> Vec<Self> {
        let mut sums = vec![Vec4::ZERO; joint_count];
        let of_range = |range: &DrawRange| {
            let corners = &mesh.indices[range.indices.start as usize..range.indices.end as usize];
            let part = 1.0 / corners.len().max(1) as f32;
            let mut still = Vec4::ZERO;
            for &corner in corners {
                let position = mesh.positions[corner as usize].extend(1.0) * part;
                let influences = mesh.influences.get(corner as usize).copied().unwrap_or_default();
                if influences.weights == [0.0; 4] {
                    still += position;
                }
                for (joint, weight) in influences.joints.into_iter().zip(influences.weights) {
                    if let Some(sum) = sums.get_mut(joint as usize) {
                        *sum += position * weight;
                    }
                }
            }
            let moved = (0..).zip(&mut sums).filter(|(_, sum)| **sum != Vec4::ZERO);
            Self {
                still,
                of_joints: moved.map(|(joint, sum)| (joint, std::mem::take(sum))).collect(),
            }
        };
        ranges.iter().map(of_range).collect()
    }

    /// In model space, posed by a palette; in bind space when it is empty.
    pub fn posed(&self, palette: &[Affine3A]) -> Vec3 {
        let moved = self.of_joints.iter().map(|(joint, sum)| {
            let model_from_bind = palette.get(*joint as usize).unwrap_or(&Affine3A::IDENTITY);
            model_from_bind.matrix3 * sum.truncate() + Vec3::from(model_from_bind.translation) * sum.w
        });
        self.still.truncate() + moved.sum::<Vec3>()
    }
}

/// Instances that follow each other in the stream, the range that is drawn of them, and whether its fronts are or its backs.
pub(super) type Run = (Range<u32>, usize, bool);

/// More instances than this are blended in the order of the stream, so that a range of all of them is one draw.
const MOST_SORTED: usize = 64;

/// Instances in sight and ranges, the farthest first, by where their centres lie along the view. Equally far ones are in the order of
/// the file. Of many instances the first says in which order the ranges come. `sides` says what is drawn of a range, one after the other,
/// true for its fronts; nothing of one that is not blended. Without `own`, the frame's own instance is left out.
pub(super) fn farthest_first(
    frame: &RenderFrame<'_>,
    centers: &[Center],
    sides: impl Fn(usize) -> &'static [bool],
    own: bool,
) -> Vec<Run> {
    let ranges: Vec<usize> = (0..centers.len()).filter(|&range| !sides(range).is_empty()).collect();
    if ranges.is_empty() {
        return Vec::new();
    }
    let joints = frame.palette.0.len();
    let crowd = frame.crowd.instances.iter().take(frame.crowd.in_sight).map(|instance| {
        let start = instance.palette as usize * joints;
        let palette = frame.crowd.palettes.get(start..start + joints);
        (instance.world_from_model, palette.unwrap_or_default())
    });
    let instances = std::iter::once((frame.world_from_model, &frame.palette.0[..])).chain(crowd);
    let forward = frame.camera.forward();
    let instances: Vec<_> = (0..).zip(instances).skip(usize::from(!own)).collect();
    let together = if instances.len() > MOST_SORTED {
        instances.len()
    } else {
        1
    };
    let mut order = Vec::new();
    for &(instance, (world_from_model, palette)) in instances.iter().step_by(together) {
        order.extend(ranges.iter().map(|&range| {
            let center = world_from_model.transform_point3(centers[range].posed(palette));
            (center.dot(forward), (instance, range))
        }));
    }
    order.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let mut runs: Vec<Run> = Vec::new();
    for (_, (instance, range)) in order {
        let instances = instance..instance + together as u32;
        for &is_front in sides(range) {
            match runs.last_mut() {
                Some((run, of, side)) if (*of, *side, run.end) == (range, is_front, instance) => {
                    run.end = instances.end;
                }
                _ => runs.push((instances.clone(), range, is_front)),
            }
        }
    }
    runs
}
