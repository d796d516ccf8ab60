//! Vertices in groups, each with a box that a palette moves: most of a mesh can be passed over without moving its vertices.

use std::ops::Range;

use glam::{Affine3A, Vec3, Vec3A};

use super::pose::Palette;
use crate::model::{Aabb, Influences, Mesh};

/// Vertices of a group: so many that its box costs less than they do, so few that its box is small.
const GROUP: usize = 32;
/// By how much of its numbers' size a moved box is grown for rounding.
const GROUP_ERROR: f32 = 1e-5;

/// The vertices of a mesh, a few together that the same joint moves most. Those without weights, which stay in bind space, are together.
#[derive(Clone, Debug, Default)]
pub struct VertexGroups {
    /// Their numbers, group by group.
    vertices: Vec<u32>,
    groups: Vec<VertexGroup>,
}

/// Some vertices of a mesh and where they are in the list of [`VertexGroups`].
#[derive(Clone, Debug)]
struct VertexGroup {
    vertices: Range<usize>,
    swept: MovedBox,
}

impl VertexGroups {
    /// Groups of a few vertices.
    pub fn new(mesh: &Mesh) -> Self {
        Self::of_at_most(mesh, GROUP)
    }

    /// One group for each joint that moves some vertices most.
    pub(super) fn by_joint(mesh: &Mesh) -> Self {
        Self::of_at_most(mesh, usize::MAX)
    }

    fn of_at_most(mesh: &Mesh, most: usize) -> Self {
        let leading: Vec<[u32; 2]> = if mesh.influences.is_empty() {
            vec![[u32::MAX; 2]; mesh.vertex_count()]
        } else {
            mesh.influences.iter().map(leading_joints).collect()
        };
        let joints_of = |vertex: u32| leading[vertex as usize];
        let mut vertices: Vec<u32> = (0..leading.len() as u32).collect();
        // In the order of the file, where neighbours are mostly neighbours in space; and few keys are sorted fast.
        vertices.sort_by_key(|&vertex| joints_of(vertex));
        let mut groups = Vec::new();
        let mut start = 0;
        for of_joint in vertices.chunk_by(|&a, &b| joints_of(a)[0] == joints_of(b)[0]) {
            for few in of_joint.chunks(most) {
                let end = start + few.len();
                groups.push(VertexGroup {
                    vertices: start..end,
                    swept: MovedBox::of(mesh, few),
                });
                start = end;
            }
        }
        Self { vertices, groups }
    }

    /// Each group: its vertices, and where they can be.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&[u32], &MovedBox)> {
        let groups = self.groups.iter();
        groups.map(|group| (&self.vertices[group.vertices.clone()], &group.swept))
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

/// The bind box of some vertices, and what moves them: enough to say where they can be in a pose.
#[derive(Clone, Debug)]
pub(super) struct MovedBox {
    bind_bounds: Aabb,
    /// All joints that move one of them.
    joints: Vec<u32>,
    /// Some of them stay in bind space.
    some_stay: bool,
    /// By how much of its numbers' size it is grown: for rounding, and by as much as a sum of weights differs from 1.
    error: f32,
}

impl MovedBox {
    fn of(mesh: &Mesh, vertices: &[u32]) -> Self {
        let mut moved = Self {
            bind_bounds: Aabb::EMPTY,
            joints: Vec::new(),
            some_stay: mesh.influences.is_empty(),
            error: GROUP_ERROR,
        };
        for &vertex in vertices {
            moved.bind_bounds = moved.bind_bounds.include(mesh.positions[vertex as usize]);
            let Some(Influences { joints, weights }) = mesh.influences.get(vertex as usize) else {
                continue;
            };
            if *weights == [0.0; 4] {
                moved.some_stay = true;
                continue;
            }
            // A mean with a negative weight may lie anywhere.
            let is_mean = weights.iter().all(|&weight| weight >= 0.0);
            let error = if is_mean {
                (weights.iter().sum::<f32>() - 1.0).abs()
            } else {
                f32::INFINITY
            };
            moved.error = moved.error.max(GROUP_ERROR + error);
            for (&joint, &weight) in joints.iter().zip(weights) {
                if weight != 0.0 && !moved.joints.contains(&joint) {
                    moved.joints.push(joint);
                }
            }
        }
        moved
    }

    /// A box that holds the vertices in a pose; they may not reach its sides. A skinned vertex is a mean of where its joints take it, so it
    /// lies in the box around these places. NaN or infinite where nothing can be said.
    pub(super) fn in_pose(&self, palette: &Palette) -> Aabb {
        let (center, half) = (self.bind_bounds.center(), self.bind_bounds.size() * 0.5);
        let (center, half) = (Vec3A::from(center), Vec3A::from(half));
        let (mut min, mut max) = if self.some_stay {
            (center - half, center + half)
        } else {
            (Vec3A::INFINITY, Vec3A::NEG_INFINITY)
        };
        for &joint in &self.joints {
            let model_from_bind = palette.0.get(joint as usize).unwrap_or(&Affine3A::IDENTITY);
            let center = model_from_bind.transform_point3a(center);
            let half = model_from_bind.matrix3.abs() * half;
            (min, max) = (min.min(center - half), max.max(center + half));
        }
        let error = Vec3A::splat(self.error * min.abs().max(max.abs()).max_element());
        Aabb {
            min: Vec3::from(min - error),
            max: Vec3::from(max + error),
        }
    }
}
