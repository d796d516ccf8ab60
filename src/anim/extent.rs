//! The space that a clip needs: a box around all that it reaches, and the few points by which it is framed.

use std::ops::Range;

use glam::{Affine3A, Vec3, Vec3A};

use super::buffers::PoseBuffers;
use super::compile::CompiledClip;
use super::pose::Palette;
use super::skin::{skin_position, skin_positions};
use crate::model::{Aabb, Influences, Mesh, Model};

/// The most vertices that are skinned for one box: tens of milliseconds of work.
const VERTEX_BUDGET: usize = 8_000_000;

/// Lines along which the farthest points are kept, both ways. With 32 the hull of a round thing is short by about 3 %.
const AXES: usize = 32;
/// Times of a clip that are looked at, evenly spread.
const TIMES: usize = 12;
/// Vertices looked at per time; of a larger mesh every n-th.
const MOST_VERTICES: usize = 20_000;

/// Vertices of a group: so many that its box costs less than they do, so few that its box is small.
const GROUP: usize = 32;
/// By how much of its numbers' size the box of a group may be off: rounding, and weights that sum to nearly 1.
const GROUP_ERROR: f32 = 1e-5;

/// Box of the skinned vertices over a clip, in model space. A static model keeps its bind bounds.
///
/// Exact at the key times: a vertex is left out only where the box of its group shows that it lies inside. Between two keys a turning part
/// may reach a little further, by less than `r (1 − cos(θ / 2))` for a point at distance `r` that turns by `θ` between them. Two limits
/// bound the work: above 1 000 key times the span is sampled evenly, and above 8 million vertices in all only the boxes of large groups are
/// moved, so that the result is too large rather than too small.
pub fn animated_bounds(model: &Model, clip: &CompiledClip) -> Aabb {
    let mesh = &model.mesh;
    if mesh.influences.is_empty() {
        return model.bind_bounds();
    }
    let times_secs = clip.probe_times_secs();
    let exact = mesh.vertex_count().saturating_mul(times_secs.len()) <= VERTEX_BUDGET;
    let groups = VertexGroups::new(mesh, if exact { GROUP } else { usize::MAX });
    let mut buffers = PoseBuffers::for_skeleton(&model.skeleton);
    let mut bounds = Aabb::EMPTY;
    for time_secs in times_secs {
        buffers.evaluate(&model.skeleton, clip, time_secs);
        for group in &groups.groups {
            let moved = group.moved(&buffers.palette);
            if !exact {
                bounds = bounds.union(moved);
            } else if !group.is_within(&moved, &bounds) {
                for &vertex in &groups.vertices[group.vertices.clone()] {
                    bounds = bounds.include(skinned(mesh, &buffers.palette, vertex));
                }
            }
        }
    }
    bounds
}

fn skinned(mesh: &Mesh, palette: &Palette, vertex: u32) -> Vec3 {
    let vertex = vertex as usize;
    skin_position(palette, &mesh.influences[vertex], mesh.positions[vertex])
}

/// The vertices of a mesh, a few together that the same joint moves most. Those without weights, which stay in bind space, are together.
struct VertexGroups {
    /// Their numbers, group by group.
    vertices: Vec<u32>,
    groups: Vec<VertexGroup>,
}

struct VertexGroup {
    /// Where its vertices are.
    vertices: Range<usize>,
    /// All joints that move one of them.
    joints: Vec<u32>,
    bind_bounds: Aabb,
    /// By how much the sum of a vertex' weights differs from 1 at most.
    weight_error: f32,
}

impl VertexGroups {
    /// Groups of at most so many vertices.
    fn new(mesh: &Mesh, most: usize) -> Self {
        let leading: Vec<[u32; 2]> = mesh.influences.iter().map(leading_joints).collect();
        let joints_of = |vertex: u32| leading[vertex as usize];
        let mut vertices: Vec<u32> = (0..leading.len() as u32).collect();
        // In the order of the file, where neighbours are mostly neighbours in space; and few keys are sorted fast.
        vertices.sort_by_key(|&vertex| joints_of(vertex));
        let mut groups = Vec::new();
        let mut start = 0;
        for of_joint in vertices.chunk_by(|&a, &b| joints_of(a)[0] == joints_of(b)[0]) {
            for few in of_joint.chunks(most) {
                let end = start + few.len();
                groups.push(VertexGroup::new(mesh, &vertices, start..end));
                start = end;
            }
        }
        Self { vertices, groups }
    }
}

/// The joints with the greatest and the second greatest weight, of which there may be none.
fn leading_joints(Influences { joints, weights }: &Influences) -> [u32; 2] {
    let mut leading = [(0.0, u32::MAX); 2];
    for (&joint, &weight) in joints.iter().zip(weights) {
        if weight > leading[0].0 {
            leading = [(weight, joint), leading[0]];
        } else if weight > leading[1].0 {
            leading[1] = (weight, joint);
        }
    }
    leading.map(|(_, joint)| joint)
}

impl VertexGroup {
    fn new(mesh: &Mesh, vertices: &[u32], range: Range<usize>) -> Self {
        let mut group = Self {
            vertices: range.clone(),
            joints: Vec::new(),
            bind_bounds: Aabb::EMPTY,
            weight_error: 0.0,
        };
        for &vertex in &vertices[range] {
            let Influences { joints, weights } = mesh.influences[vertex as usize];
            group.bind_bounds = group.bind_bounds.include(mesh.positions[vertex as usize]);
            if weights != [0.0; 4] {
                group.weight_error = group.weight_error.max((weights.iter().sum::<f32>() - 1.0).abs());
            }
            let moving = joints.into_iter().zip(weights).filter(|&(_, weight)| weight != 0.0);
            group.joints.extend(moving.map(|(joint, _)| joint));
        }
        group.joints.sort_unstable();
        group.joints.dedup();
        group
    }

    /// Box around the boxes to which its joints bring it. A skinned vertex is a mean of where its joints take it, so it lies in there.
    fn moved(&self, palette: &Palette) -> Aabb {
        if self.joints.is_empty() {
            return self.bind_bounds;
        }
        let (center, half) = (self.bind_bounds.center(), self.bind_bounds.size() * 0.5);
        self.joints.iter().fold(Aabb::EMPTY, |bounds, &joint| {
            let model_from_bind = palette.0.get(joint as usize).unwrap_or(&Affine3A::IDENTITY);
            let center = model_from_bind.transform_point3(center);
            let half = Vec3::from(model_from_bind.matrix3.abs() * Vec3A::from(half));
            bounds.union(Aabb {
                min: center - half,
                max: center + half,
            })
        })
    }

    /// Whether all of its vertices lie in a box, by where they are moved.
    fn is_within(&self, moved: &Aabb, bounds: &Aabb) -> bool {
        let size = moved.min.abs().max(moved.max.abs()).max_element();
        let error = GROUP_ERROR * size;
        self.weight_error <= GROUP_ERROR
            && (moved.min - error).cmpge(bounds.min).all()
            && (moved.max + error).cmple(bounds.max).all()
    }
}

/// Box of the vertices of a model without a clip, in model space.
pub fn bounds_at_rest(model: &Model) -> Aabb {
    if model.skeleton.rests_in_bind_pose() {
        return model.bind_bounds();
    }
    let buffers = PoseBuffers::for_skeleton(&model.skeleton);
    let mut positions = Vec::new();
    skin_positions(&model.mesh, &buffers.palette, &mut positions);
    Aabb::from_points(positions)
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
