//! The space that a clip needs.

use glam::Vec3;

use super::{Palette, PoseBuffers, skin_positions};
use crate::model::{Aabb, Clip, Mesh, Model};

/// Vertices skinned at most for one box: tens of milliseconds of work.
const VERTEX_BUDGET: usize = 8_000_000;

/// Box of the skinned vertices over a clip, in model space. A static model keeps its bind bounds.
///
/// Exact at the key times: every vertex is skinned there. Between two keys a turning part may reach a little further, by
/// less than `r (1 − cos(θ / 2))` for a point at distance `r` that turns by `θ` between them. Two limits bound the work:
/// above 1 000 key times the span is sampled evenly, and above 8 million vertices in all the joints carry boxes of their
/// vertices instead, so that the result is too large rather than too small.
pub fn animated_bounds(model: &Model, clip: &Clip) -> Aabb {
    let mesh = &model.mesh;
    if mesh.influences.is_empty() {
        return model.bind_bounds();
    }
    let times_secs = clip.looked_at_secs();
    let exact = mesh.vertex_count().saturating_mul(times_secs.len()) <= VERTEX_BUDGET;
    let carried = if exact { None } else { Some(CarriedBoxes::new(model)) };
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    let mut positions = Vec::with_capacity(if exact { mesh.vertex_count() } else { 0 });
    times_secs.into_iter().fold(Aabb::EMPTY, |bounds, time_secs| {
        buffers.evaluate(&model.skeleton, clip, time_secs);
        bounds.union(match &carried {
            Some(carried) => carried.moved(&buffers.palette),
            None => skinned_bounds(mesh, &buffers.palette, &mut positions),
        })
    })
}

fn skinned_bounds(mesh: &Mesh, palette: &Palette, positions: &mut Vec<Vec3>) -> Aabb {
    skin_positions(mesh, palette, positions);
    Aabb::from_points(positions.iter().copied())
}

/// For each joint the box of all vertices that it moves, in bind space. A skinned vertex is a mean of where its joints
/// take it, so it cannot leave the box around the moved boxes.
struct CarriedBoxes {
    of_joints: Vec<Aabb>,
    of_unmoved: Aabb,
}

impl CarriedBoxes {
    fn new(model: &Model) -> Self {
        let mut of_joints = vec![Aabb::EMPTY; model.skeleton.joint_count()];
        let mut of_unmoved = Aabb::EMPTY;
        for (influences, &position) in model.mesh.influences.iter().zip(&model.mesh.positions) {
            if influences.weights == [0.0; 4] {
                of_unmoved = of_unmoved.include(position);
            }
            for (&joint, &weight) in influences.joints.iter().zip(&influences.weights) {
                if weight > 0.0 {
                    let carried = &mut of_joints[joint as usize];
                    *carried = carried.include(position);
                }
            }
        }
        Self { of_joints, of_unmoved }
    }

    fn moved(&self, palette: &Palette) -> Aabb {
        let moved = self.of_joints.iter().zip(&palette.0);
        moved.fold(self.of_unmoved, |bounds, (carried, &model_from_bind)| {
            bounds.union(carried.transformed(model_from_bind))
        })
    }
}
