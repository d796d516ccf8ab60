//! Which joints are each other's mirror image.

use std::collections::{HashMap, HashSet};

use glam::{Affine3A, Vec3};

use super::{Aabb, JointIndex, JointTree, Skeleton};
use crate::sorting;

/// How far apart the ways of two partners from their parents may end, one of them mirrored: this fraction of the longest side of
/// the box of all joints, and this fraction of the way. Bind poses of real figures lean a little, so that a hand is far from
/// where the other's image is; from its own elbow it is not.
const TOLERANCE: (f32, f32) = (0.01, 0.15);

/// So many pairs of siblings are compared each with each: a figure's joint has a few dozen children.
const MOST_COMPARED: usize = 256 * 256;

/// Where more would have to be compared, partners come first that fall into one cell of a grid of ways and branches. Sides of
/// the cells as parts of the absolute tolerance, the finest first. None is a multiple of another: a border that parts two
/// partners in one grid runs elsewhere in the next.
const CELLS: [f32; 4] = [0.01, 0.041, 0.17, 0.55];

/// Two joints that are each other's image across the plane x = 0 of the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MirrorPair {
    /// The one whose branch is on the side of +x: the left of a figure that faces −z.
    pub left: JointIndex,
    /// The other.
    pub right: JointIndex,
}

/// Pairs of joints whose parents are a pair too, or one joint of the middle, and whose ways from there in the bind pose mirror
/// each other across x = 0 of the world: to 1 % of the skeleton's longest side and 15 % of the way. For roots the way is from
/// the origin, so a model that stands beside that plane has no pairs. Among many hundreds of siblings only those are sure to be
/// found that mirror each other to about 1 ‰ of that side. In the skeleton's order of the left joints.
pub fn mirror_pairs(skeleton: &Skeleton, tree: &JointTree, world_from_model: Affine3A) -> Vec<MirrorPair> {
    let places: Vec<Vec3> = skeleton
        .bind_model_from_joint()
        .iter()
        .map(|model_from_joint| world_from_model.transform_point3(model_from_joint.translation.into()))
        .collect();
    let middles = branch_middles(skeleton, tree, &places);
    let search = Search {
        tolerance: Aabb::from_points(places.iter().copied()).size().max_element() * TOLERANCE.0,
        from_parent: (places.iter().zip(skeleton.parents()))
            .map(|(&place, parent)| place - parent.map_or(Vec3::ZERO, |parent| places[parent.index()]))
            .collect(),
        to_middle: (middles.iter().zip(&places))
            .map(|(&middle, &place)| middle - place)
            .collect(),
    };
    let roots = (0u32..).map(JointIndex).zip(skeleton.parents());
    let roots: Vec<_> = roots
        .filter(|(_, parent)| parent.is_none())
        .map(|(root, _)| root)
        .collect();
    let mut open = search.match_up(&roots, &roots);
    let mut pairs = Vec::new();
    while let Some((a, b)) = open.pop() {
        let children = |joint| tree.children(joint).collect::<Vec<_>>();
        open.extend(search.match_up(&children(a), &children(b)));
        if a != b {
            let (left, right) = if middles[a.index()].x >= middles[b.index()].x {
                (a, b)
            } else {
                (b, a)
            };
            pairs.push(MirrorPair { left, right });
        }
    }
    sorting::sort_by_key(&mut pairs, |pair| pair.left);
    pairs
}

/// Mean place of all joints of each branch.
fn branch_middles(skeleton: &Skeleton, tree: &JointTree, places: &[Vec3]) -> Vec<Vec3> {
    let mut sums = places.to_vec();
    for (joint, parent) in skeleton.parents().iter().enumerate().rev() {
        if let Some(parent) = parent {
            let sum = sums[joint];
            sums[parent.index()] += sum;
        }
    }
    let joints = (0u32..).map(JointIndex);
    sums.into_iter()
        .zip(joints)
        .map(|(sum, joint)| sum / tree.branch(joint).len() as f32)
        .collect()
}

struct Search {
    /// Way of each joint from its parent, or from the origin.
    from_parent: Vec<Vec3>,
    /// From each joint to the mean place of its branch.
    to_middle: Vec<Vec3>,
    /// World units.
    tolerance: f32,
}

impl Search {
    /// The best partners among the children of two joints, or of one joint of the middle, whose children may be their own
    /// partners. Each joint once.
    fn match_up(&self, of_a: &[JointIndex], of_b: &[JointIndex]) -> Vec<(JointIndex, JointIndex)> {
        let is_middle = of_a == of_b;
        let (mut of_a, mut of_b) = (of_a.to_vec(), of_b.to_vec());
        let are_many = |of_a: &[JointIndex], of_b: &[JointIndex]| of_a.len() * of_b.len() > MOST_COMPARED;
        let mut pairs = Vec::new();
        for cell in CELLS {
            if are_many(&of_a, &of_b) {
                self.match_in_cells(&mut of_a, &mut of_b, cell * self.tolerance, &mut pairs);
            }
        }
        if are_many(&of_a, &of_b) {
            let most = MOST_COMPARED.isqrt();
            of_a.truncate(most);
            of_b.truncate(most);
        }
        self.match_closest(&of_a, &of_b, is_middle, &mut pairs);
        pairs
    }

    /// Matches joints with the images of others in the same cell of a grid, and takes them out of the lists.
    fn match_in_cells(
        &self,
        of_a: &mut Vec<JointIndex>,
        of_b: &mut Vec<JointIndex>,
        cell: f32,
        pairs: &mut Vec<(JointIndex, JointIndex)>,
    ) {
        let cell_of = |joint: JointIndex, seen: fn(Vec3) -> Vec3| {
            [self.from_parent[joint.index()], self.to_middle[joint.index()]]
                .map(|way| (seen(way) / cell).round().as_ivec3())
        };
        // The last of each is the first joint.
        let mut cells: HashMap<_, Vec<JointIndex>> = HashMap::new();
        for &b in of_b.iter().rev() {
            cells.entry(cell_of(b, |way| way)).or_default().push(b);
        }
        let mut taken = HashSet::new();
        for &a in of_a.iter() {
            if taken.contains(&a) {
                continue;
            }
            let Some(waiting) = cells.get_mut(&cell_of(a, mirrored)) else {
                continue;
            };
            while let Some(b) = waiting.pop() {
                if !taken.contains(&b) {
                    taken.extend([a, b]);
                    pairs.push((a, b));
                    break;
                }
            }
        }
        of_a.retain(|joint| !taken.contains(joint));
        of_b.retain(|joint| !taken.contains(joint));
    }

    /// Matches the closest first, by comparing each with each.
    fn match_closest(
        &self,
        of_a: &[JointIndex],
        of_b: &[JointIndex],
        is_middle: bool,
        pairs: &mut Vec<(JointIndex, JointIndex)>,
    ) {
        let mut candidates: Vec<(f32, JointIndex, JointIndex)> = Vec::new();
        for &a in of_a {
            for &b in of_b.iter().filter(|&&b| !is_middle || a <= b) {
                let ways = [a, b].map(|joint| self.from_parent[joint.index()]);
                let length = ways[0].length().max(ways[1].length());
                let off = mirrored(ways[0]).distance(ways[1]);
                if off <= self.tolerance + length * TOLERANCE.1 {
                    // Joints at one place are told apart by where their branches go.
                    let branches_off = mirrored(self.to_middle[a.index()]).distance(self.to_middle[b.index()]);
                    candidates.push((off + branches_off, a, b));
                }
            }
        }
        sorting::sort_by(&mut candidates, |x, y| {
            x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2)))
        });
        let mut taken = HashSet::new();
        candidates.retain(|(_, a, b)| {
            let free = !taken.contains(a) && !taken.contains(b);
            if free {
                taken.extend([*a, *b]);
            }
            free
        });
        pairs.extend(candidates.into_iter().map(|(_, a, b)| (a, b)));
    }
}

fn mirrored(place: Vec3) -> Vec3 {
    Vec3::new(-place.x, place.y, place.z)
}
