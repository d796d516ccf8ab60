//! Vertices in groups, each with a box that a palette moves: most of a mesh can be passed over without moving its vertices.

use std::ops::Range;

use glam::{Affine3A, Vec3, Vec3A};
use rustc_hash::FxHashMap;

use super::pose::Palette;
use crate::model::{Aabb, Influences, Mesh};
use crate::slices::Slices;

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
    pub async fn new(mesh: &Mesh, slices: &Slices) -> Self {
        Self::of_at_most(mesh, GROUP, slices).await
    }

    /// One group for each joint that moves some vertices most.
    pub(super) async fn by_joint(mesh: &Mesh, slices: &Slices) -> Self {
        Self::of_at_most(mesh, usize::MAX, slices).await
    }

    async fn of_at_most(mesh: &Mesh, most: usize, slices: &Slices) -> Self {
        let leading: Vec<[u32; 2]> = if mesh.influences.is_empty() {
            vec![[u32::MAX; 2]; mesh.vertex_count()]
        } else {
            mesh.influences.iter().map(leading_joints).collect()
        };
        let joints_of = |vertex: u32| leading[vertex as usize];
        // In the order of the file, where neighbours are mostly neighbours in space.
        slices.pause().await;
        let vertices = sorted_by_joints(&leading);
        let mut groups = Vec::new();
        let mut start = 0;
        for of_joint in vertices.chunk_by(|&a, &b| joints_of(a)[0] == joints_of(b)[0]) {
            let add = |few: &[u32]| {
                let end = start + few.len();
                groups.push(VertexGroup {
                    vertices: start..end,
                    swept: MovedBox::of(mesh, few, joints_of(few[0])[0]),
                });
                start = end;
            };
            slices.for_each(of_joint.chunks(most), add).await;
        }
        Self { vertices, groups }
    }

    /// Each group: its vertices, and where they can be.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&[u32], &MovedBox)> {
        let groups = self.groups.iter();
        groups.map(|group| (&self.vertices[group.vertices.clone()], &group.swept))
    }
}

/// The vertices by their leading joints, of which many have the same; those that have the same in their order.
fn sorted_by_joints(leading: &[[u32; 2]]) -> Vec<u32> {
    let mut numbers = FxHashMap::default();
    let mut kinds: Vec<([u32; 2], u32)> = Vec::new();
    let kind_of: Vec<u32> = leading
        .iter()
        .map(|joints| {
            let kind = *numbers.entry(*joints).or_insert_with(|| {
                kinds.push((*joints, 0));
                kinds.len() - 1
            });
            kinds[kind].1 += 1;
            kind as u32
        })
        .collect();
    // Where the vertices of each kind begin.
    let mut order: Vec<u32> = (0..kinds.len() as u32).collect();
    order.sort_unstable_by_key(|&kind| kinds[kind as usize].0);
    let mut start = 0;
    for kind in order {
        let count = &mut kinds[kind as usize].1;
        start += std::mem::replace(count, start);
    }
    let mut sorted = vec![0; leading.len()];
    for (vertex, kind) in (0u32..).zip(kind_of) {
        let place = &mut kinds[kind as usize].1;
        sorted[*place as usize] = vertex;
        *place += 1;
    }
    sorted
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
    /// The bind box.
    center: Vec3A,
    half: Vec3A,
    /// All joints that move one of them, and the greatest weight of each. The first has the most weight on each of them.
    joints: Vec<(u32, f32)>,
    /// The greatest weight that all joints but the first have together.
    others: f32,
    /// Some of them stay in bind space.
    some_stay: bool,
    /// By how much of its numbers' size it is grown: for rounding, and by as much as a sum of weights differs from 1.
    error: f32,
}

impl MovedBox {
    /// Of vertices with one leading joint.
    fn of(mesh: &Mesh, vertices: &[u32], leading: u32) -> Self {
        let mut bounds = Aabb::EMPTY;
        let mut moved = Self {
            center: Vec3A::ZERO,
            half: Vec3A::ZERO,
            joints: Vec::new(),
            others: 0.0,
            some_stay: mesh.influences.is_empty(),
            error: GROUP_ERROR,
        };
        if leading != u32::MAX {
            moved.joints.push((leading, 0.0));
        }
        for &vertex in vertices {
            bounds = bounds.include(mesh.positions[vertex as usize]);
            if let Some(influences) = mesh.influences.get(vertex as usize) {
                moved.add(influences);
            }
        }
        (moved.center, moved.half) = (bounds.center().into(), (bounds.size() * 0.5).into());
        moved
    }

    fn add(&mut self, Influences { joints, weights }: &Influences) {
        if *weights == [0.0; 4] {
            self.some_stay = true;
            return;
        }
        // A mean with a negative weight may lie anywhere.
        let is_mean = weights.iter().all(|&weight| weight >= 0.0);
        let error = if is_mean {
            (weights.iter().sum::<f32>() - 1.0).abs()
        } else {
            f32::INFINITY
        };
        self.error = self.error.max(GROUP_ERROR + error);
        let mut others = 0.0;
        for (&joint, &weight) in joints.iter().zip(weights) {
            if weight == 0.0 {
                continue;
            }
            let known = self.joints.iter().position(|&(known, _)| known == joint);
            let place = known.unwrap_or(self.joints.len());
            if known.is_none() {
                self.joints.push((joint, 0.0));
            }
            // A joint may stand in two slots.
            let of_joint = joints.iter().zip(weights).filter(|&(&other, _)| other == joint);
            let most = &mut self.joints[place].1;
            *most = most.max(of_joint.map(|(_, weight)| weight).sum());
            others += if place == 0 { 0.0 } else { weight };
        }
        self.others = self.others.max(others);
    }

    /// A box that holds the vertices in a pose; they may not reach its sides. A skinned vertex is a mean of where its joints take it, so it
    /// lies in the box around these places. NaN or infinite where nothing can be said.
    pub(super) fn in_pose(&self, palette: &Palette) -> Aabb {
        let (mut min, mut max) = self.staying();
        for &(joint, _) in &self.joints {
            let (center, half) = self.taken_by(matrix(palette, joint));
            (min, max) = (min.min(center - half), max.max(center + half));
        }
        self.grown(min, max, min, max)
    }

    /// The same, and mostly smaller: what moves a vertex but a little cannot take it far from where its first joint has it.
    pub(super) fn narrow_in_pose(&self, palette: &Palette) -> Aabb {
        let Some((&(first, _), others)) = self.joints.split_first().filter(|(_, others)| !others.is_empty()) else {
            return self.in_pose(palette);
        };
        let first = matrix(palette, first);
        let (first_center, first_half) = self.taken_by(first);
        let (min, max) = self.staying();
        let (mut min, mut max) = (min.min(first_center - first_half), max.max(first_center + first_half));
        // How far from there each other joint takes them at most; and all these together, each by its weight.
        let (mut least, mut greatest) = (Vec3A::ZERO, Vec3A::ZERO);
        let (mut least_sum, mut greatest_sum) = (Vec3A::ZERO, Vec3A::ZERO);
        for &(joint, weight) in others {
            let joint = matrix(palette, joint);
            let (center, half) = self.taken_by(joint);
            (min, max) = (min.min(center - half), max.max(center + half));
            let (way, half) = (center - first_center, (joint.matrix3 - first.matrix3).abs() * self.half);
            // In this order a number that is none stays in the sums.
            let (back, forth) = (Vec3A::ZERO.min(way - half), Vec3A::ZERO.max(way + half));
            (least, greatest) = (least.min(back), greatest.max(forth));
            least_sum += back * weight;
            greatest_sum += forth * weight;
        }
        let back = (least * self.others).max(least_sum);
        let forth = (greatest * self.others).min(greatest_sum);
        if self.some_stay {
            return self.grown(min, max, min, max);
        }
        let narrow_min = min.max(first_center - first_half + back);
        let narrow_max = max.min(first_center + first_half + forth);
        self.grown(narrow_min, narrow_max, min, max)
    }

    /// The box of those that stay in bind space.
    fn staying(&self) -> (Vec3A, Vec3A) {
        if self.some_stay {
            (self.center - self.half, self.center + self.half)
        } else {
            (Vec3A::INFINITY, Vec3A::NEG_INFINITY)
        }
    }

    /// Middle and half the size of the box in which a matrix has them.
    #[inline]
    fn taken_by(&self, model_from_bind: &Affine3A) -> (Vec3A, Vec3A) {
        let center = model_from_bind.transform_point3a(self.center);
        (center, model_from_bind.matrix3.abs() * self.half)
    }

    /// A box with room for errors of numbers as large as those of another one.
    fn grown(&self, min: Vec3A, max: Vec3A, least: Vec3A, greatest: Vec3A) -> Aabb {
        let error = Vec3A::ONE * (self.error * least.abs().max(greatest.abs()).max_element());
        Aabb {
            min: Vec3::from(min - error),
            max: Vec3::from(max + error),
        }
    }
}

#[inline]
fn matrix(palette: &Palette, joint: u32) -> &Affine3A {
    palette.0.get(joint as usize).unwrap_or(&Affine3A::IDENTITY)
}
