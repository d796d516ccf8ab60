//! What can be seen of a skin: one number a vertex.
//!
//! Made on the CPU and drawn from one more vertex buffer, so that tests and panels read the numbers that are seen.

use std::collections::{HashMap, HashSet};

use glam::Vec3;

use crate::model::{Influences, JointIndex, Mesh};
use crate::modes::modes;

modes! {
    /// Which number of a vertex is shown.
    pub enum SkinView {
        /// The weight of one joint, 0…1.
        Weight = "weight", "Weight of a bone";
        /// How many joints move it, 0…4.
        InfluenceCount = "influences", "Number of bones";
        /// The joint with the greatest weight.
        DominantJoint = "dominant", "Strongest bone";
        /// How much the edges around it are stretched against the bind pose: 1 is unchanged.
        Stretch = "stretch", "Stretch";
    }
}

/// What each vertex is moved by: nothing in a static mesh.
fn influences(mesh: &Mesh) -> impl Iterator<Item = Influences> + '_ {
    let known = mesh.influences.iter().copied();
    known
        .chain(std::iter::repeat(Influences::default()))
        .take(mesh.vertex_count())
}

/// The weight of a joint at each vertex, 0…1. A joint that a vertex names twice has the sum.
pub fn joint_weights(mesh: &Mesh, joint: JointIndex, weights: &mut Vec<f32>) {
    weights.clear();
    weights.extend(influences(mesh).map(|influences| {
        let slots = influences.joints.into_iter().zip(influences.weights);
        slots
            .filter(|&(named, _)| named == joint.0)
            .map(|(_, weight)| weight)
            .sum::<f32>()
    }));
}

/// How many joints move each vertex, 0…4.
pub fn influence_counts(mesh: &Mesh, counts: &mut Vec<u8>) {
    counts.clear();
    counts.extend(
        influences(mesh).map(|influences| influences.weights.iter().filter(|&&weight| weight > 0.0).count() as u8),
    );
}

/// The joint with the greatest weight at each vertex, the first of equals; none without weight.
pub fn dominant_joints(mesh: &Mesh, joints: &mut Vec<Option<JointIndex>>) {
    joints.clear();
    joints.extend(influences(mesh).map(|influences| dominant_joint(&influences)));
}

/// The joint with the greatest weight, the first of equals; none without weight.
pub fn dominant_joint(influences: &Influences) -> Option<JointIndex> {
    let slots = influences.joints.into_iter().zip(influences.weights);
    let greatest = slots.reduce(|most, slot| if slot.1 > most.1 { slot } else { most });
    greatest
        .filter(|&(_, weight)| weight > 0.0)
        .map(|(joint, _)| JointIndex(joint))
}

/// Edges of a mesh with their lengths in the bind pose, found once.
///
/// Vertices at one place with the same influences count as one: a file may split them for texture or normal, but their stretch
/// is the same.
#[derive(Clone, Debug, Default)]
pub struct Stretch {
    /// Of each vertex: the first one that is the same.
    same: Vec<u32>,
    edges: Vec<Edge>,
    /// Of each vertex: 1 / the number of its edges; 0 without.
    per_edge_count: Vec<f32>,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    ends: [u32; 2],
    per_bind_length: f32,
}

impl Stretch {
    /// The edges of a mesh. Those of no length are left out.
    pub fn new(mesh: &Mesh) -> Self {
        let mut first = HashMap::with_capacity(mesh.vertex_count());
        let vertices = mesh.positions.iter().zip(influences(mesh));
        let same: Vec<u32> = (0u32..)
            .zip(vertices)
            .map(|(vertex, (position, Influences { joints, weights }))| {
                let key = (position.to_array().map(f32::to_bits), joints, weights.map(f32::to_bits));
                *first.entry(key).or_insert(vertex)
            })
            .collect();
        let mut seen = HashSet::with_capacity(mesh.indices.len());
        let mut edges = Vec::new();
        let mut counts = vec![0_u32; same.len()];
        for &[a, b, c] in mesh.indices.as_chunks::<3>().0 {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (from, to) = (same[from as usize], same[to as usize]);
                let ends = [from.min(to), from.max(to)];
                let [low, high] = ends.map(|end| end as usize);
                let per_bind_length = mesh.positions[low].distance(mesh.positions[high]).recip();
                if !per_bind_length.is_finite() || !seen.insert(ends) {
                    continue;
                }
                edges.push(Edge { ends, per_bind_length });
                counts[low] += 1;
                counts[high] += 1;
            }
        }
        let per_edge_count = counts
            .into_iter()
            .map(|count| if count == 0 { 0.0 } else { 1.0 / count as f32 })
            .collect();
        Self {
            same,
            edges,
            per_edge_count,
        }
    }

    /// For each vertex the mean over its edges of length / length in the bind pose; 1 without edges. `positions` are the
    /// posed vertices of the mesh, in its order.
    pub fn ratios(&self, positions: &[Vec3], ratios: &mut Vec<f32>) {
        ratios.clear();
        ratios.resize(self.same.len(), 0.0);
        if positions.len() < self.same.len() {
            ratios.fill(1.0);
            return;
        }
        for Edge { ends, per_bind_length } in &self.edges {
            let [from, to] = ends.map(|end| end as usize);
            let ratio = positions[from].distance(positions[to]) * per_bind_length;
            ratios[from] += ratio;
            ratios[to] += ratio;
        }
        // The first of equals comes before them, so its mean is there when they ask for it.
        for (vertex, &same) in self.same.iter().enumerate() {
            ratios[vertex] = match same as usize {
                same if same != vertex => ratios[same],
                _ if self.per_edge_count[vertex] == 0.0 => 1.0,
                _ => ratios[vertex] * self.per_edge_count[vertex],
            };
        }
    }
}
