//! The skeleton as a tree of rows: depth first, children in the skeleton's order.

use super::{JointIndex, Mesh, Skeleton};

/// Order, depth and branches of a skeleton's joints, computed once.
///
/// Depth first, the joints of a branch stand next to each other, so a folded branch is stepped over in one step.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct JointTree {
    /// Joints, depth first.
    order: Vec<JointIndex>,
    /// Of each joint: its place in `order`.
    places: Vec<u32>,
    /// Of each joint: its distance from its root.
    depths: Vec<u32>,
    /// Of each joint: the number of joints of its branch, itself among them.
    branch_sizes: Vec<u32>,
}

/// How many vertices joints move.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VertexCounts {
    /// Of each joint: vertices to which it gives weight.
    pub own: Vec<u32>,
    /// Of each joint: vertices to which some joint of its branch gives weight, each counted once.
    pub of_branch: Vec<u32>,
}

impl JointTree {
    /// The tree of a skeleton.
    pub fn new(skeleton: &Skeleton) -> Self {
        let parents = skeleton.parents();
        let joint_count = parents.len();
        let mut branch_sizes = vec![1; joint_count];
        let mut depths = vec![0; joint_count];
        for (joint, parent) in parents.iter().enumerate().rev() {
            if let Some(parent) = parent {
                branch_sizes[parent.index()] += branch_sizes[joint];
            }
        }
        // Parents come first, so each joint finds its parent's place known, and where that parent's next branch begins.
        let mut places = vec![0; joint_count];
        let mut next_in_branch = vec![0; joint_count];
        let mut next_root = 0;
        for (joint, parent) in parents.iter().enumerate() {
            let next = match parent {
                Some(parent) => {
                    depths[joint] = depths[parent.index()] + 1;
                    &mut next_in_branch[parent.index()]
                }
                None => &mut next_root,
            };
            places[joint] = *next;
            *next += branch_sizes[joint];
            next_in_branch[joint] = places[joint] + 1;
        }
        let mut order = vec![JointIndex(0); joint_count];
        for (joint, &place) in (0u32..).zip(&places) {
            order[place as usize] = JointIndex(joint);
        }
        Self {
            order,
            places,
            depths,
            branch_sizes,
        }
    }

    /// All joints, depth first.
    pub fn order(&self) -> &[JointIndex] {
        &self.order
    }

    /// Distance of a joint from its root: 0 for a root.
    pub fn depth(&self, joint: JointIndex) -> u32 {
        self.depths.get(joint.index()).copied().unwrap_or_default()
    }

    /// A joint and all below it, depth first. None for a joint that is not there.
    pub fn branch(&self, joint: JointIndex) -> &[JointIndex] {
        let Some((&place, &size)) = self.places.get(joint.index()).zip(self.branch_sizes.get(joint.index())) else {
            return &[];
        };
        &self.order[place as usize..(place + size) as usize]
    }

    /// The joints that hang from a joint itself, in the skeleton's order.
    pub fn children(&self, joint: JointIndex) -> impl Iterator<Item = JointIndex> + '_ {
        let mut below = self.branch(joint).get(1..).unwrap_or_default();
        std::iter::from_fn(move || {
            let &child = below.first()?;
            below = &below[self.branch(child).len()..];
            Some(child)
        })
    }

    /// Whether a joint is another one or hangs from it at any distance.
    pub fn is_in_branch(&self, joint: JointIndex, of: JointIndex) -> bool {
        let place = self.places.get(joint.index()).zip(self.places.get(of.index()));
        place.is_some_and(|(&joint, &start)| (start..start + self.branch_sizes[of.index()]).contains(&joint))
    }

    /// How many vertices of a mesh of this skeleton each joint moves.
    pub fn vertex_counts(&self, skeleton: &Skeleton, mesh: &Mesh) -> VertexCounts {
        let parents = skeleton.parents();
        let mut own = vec![0_u32; self.order.len()];
        // What a vertex adds to the branch of a joint but not to those of its children: summed upwards it comes to one in
        // every branch that holds one of the vertex's joints.
        let mut added = vec![0_i64; self.order.len()];
        for influences in &mesh.influences {
            let mut places = [u32::MAX; 4];
            let weighted = influences.joints.iter().zip(&influences.weights);
            for (place, (&joint, _)) in places.iter_mut().zip(weighted.filter(|(_, weight)| **weight > 0.0)) {
                *place = self.places[joint as usize];
            }
            // A joint that is named twice is one joint.
            places.sort_unstable();
            let mut before = None;
            for place in places.into_iter().filter(|&place| place != u32::MAX) {
                let joint = self.order[place as usize];
                if before == Some(joint) {
                    continue;
                }
                own[joint.index()] += 1;
                added[joint.index()] += 1;
                // Neighbours in this order meet first where the joint would be counted a second time.
                let met = before.and_then(|before| self.first_common(parents, before, joint));
                if let Some(common) = met {
                    added[common.index()] -= 1;
                }
                before = Some(joint);
            }
        }
        for (joint, parent) in parents.iter().enumerate().rev() {
            if let Some(parent) = parent {
                added[parent.index()] += added[joint];
            }
        }
        let of_branch = added.into_iter().map(|count| count.max(0) as u32).collect();
        VertexCounts { own, of_branch }
    }

    /// The lowest joint in whose branch both are.
    fn first_common(
        &self,
        parents: &[Option<JointIndex>],
        mut from: JointIndex,
        other: JointIndex,
    ) -> Option<JointIndex> {
        while !self.is_in_branch(other, from) {
            from = parents[from.index()]?;
        }
        Some(from)
    }
}
