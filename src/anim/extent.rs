//! The space that a clip needs: a box around all that it reaches, and the few points by which it is framed.

use glam::Vec3;

use super::buffers::PoseBuffers;
use super::compile::CompiledClip;
use super::pose::Palette;
use super::skin::skin_positions;
use crate::model::{Aabb, Mesh, Model};

/// The most vertices that are skinned for one box: tens of milliseconds of work.
const VERTEX_BUDGET: usize = 8_000_000;

/// Lines along which the farthest points are kept, both ways. With 32 the hull of a round thing is short by about 3 %.
const AXES: usize = 32;
/// Times of a clip that are looked at, evenly spread.
const TIMES: usize = 12;
/// Vertices looked at per time; of a larger mesh every n-th.
const MOST_VERTICES: usize = 20_000;

/// Box of the skinned vertices over a clip, in model space. A static model keeps its bind bounds.
///
/// Exact at the key times: every vertex is skinned there. Between two keys a turning part may reach a little further, by
/// less than `r (1 − cos(θ / 2))` for a point at distance `r` that turns by `θ` between them. Two limits bound the work:
/// above 1 000 key times the span is sampled evenly, and above 8 million vertices in all the joints carry boxes of their
/// vertices instead, so that the result is too large rather than too small.
pub fn animated_bounds(model: &Model, clip: &CompiledClip) -> Aabb {
    let mesh = &model.mesh;
    if mesh.influences.is_empty() {
        return model.bind_bounds();
    }
    let times_secs = clip.probe_times_secs();
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

/// Box of the vertices of a model without a clip, in model space.
pub fn bounds_at_rest(model: &Model) -> Aabb {
    if model.skeleton.rests_in_bind_pose() {
        return model.bind_bounds();
    }
    let buffers = PoseBuffers::for_skeleton(&model.skeleton);
    skinned_bounds(&model.mesh, &buffers.palette, &mut Vec::new())
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

/// Points of the mesh, in model space, that lie farthest in many directions over a clip, or at rest without one.
/// Their hull is nearly that of all the model reaches, and they are at most `2 · 32` a time.
pub fn extreme_points(model: &Model, clip: Option<&CompiledClip>) -> Vec<Vec3> {
    let mesh = &model.mesh;
    let stride = mesh.vertex_count().div_ceil(MOST_VERTICES).max(1);
    let axes = axes();
    let mut points = Vec::new();
    let mut positions = Vec::new();
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    let Some(clip) = clip.filter(|_| !mesh.influences.is_empty()) else {
        let at_rest = if model.skeleton.rests_in_bind_pose() {
            &mesh.positions
        } else {
            skin_positions(mesh, &buffers.palette, &mut positions);
            &positions
        };
        keep_extremes(&axes, at_rest.iter().step_by(stride), &mut points);
        return points;
    };
    let duration_secs = clip.end_secs() - clip.start_secs();
    for i in 0..TIMES {
        let part = i as f32 / (TIMES - 1) as f32;
        buffers.evaluate(&model.skeleton, clip, clip.start_secs() + part * duration_secs);
        skin_positions(mesh, &buffers.palette, &mut positions);
        keep_extremes(&axes, positions.iter().step_by(stride), &mut points);
        if duration_secs <= 0.0 {
            break;
        }
    }
    points
}

/// Directions spread evenly over half a sphere (a Fibonacci lattice).
fn axes() -> [Vec3; AXES] {
    let golden_angle = std::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
    std::array::from_fn(|i| {
        let y = 1.0 - (i as f32 + 0.5) / AXES as f32;
        let (sin, cos) = (golden_angle * i as f32).sin_cos();
        let radius = (1.0 - y * y).sqrt();
        Vec3::new(radius * cos, y, radius * sin)
    })
}

fn keep_extremes<'a>(axes: &[Vec3], points: impl Iterator<Item = &'a Vec3>, kept: &mut Vec<Vec3>) {
    let mut extremes: Vec<[(f32, Option<Vec3>); 2]> = vec![[(f32::NEG_INFINITY, None); 2]; axes.len()];
    for &point in points {
        for (axis, [far, near]) in axes.iter().zip(&mut extremes) {
            let along = axis.dot(point);
            if along > far.0 {
                *far = (along, Some(point));
            }
            if -along > near.0 {
                *near = (-along, Some(point));
            }
        }
    }
    kept.extend(extremes.iter().flatten().filter_map(|(_, point)| *point));
}
