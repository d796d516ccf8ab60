//! The joints as rows: as a tree whose branches fold, or by how much they move.

use std::collections::BTreeSet;

use crate::anim::JointActivity;
use crate::model::{JointIndex, Skeleton};

/// One row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Row {
    pub(super) joint: JointIndex,
    /// Distance from the root; 0 in a list without a tree.
    pub(super) depth: u32,
    /// Joints below it in the tree, folded away or not; 0 in a list without a tree.
    pub(super) below: u32,
    pub(super) folded: bool,
}

/// Branches that are folded, and whether there is a tree at all.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Arrangement {
    pub(super) folded: BTreeSet<JointIndex>,
    pub(super) by_motion: bool,
}

/// Rows of one clip, put together when something about them changed.
#[derive(Debug, Default)]
pub(super) struct Rows {
    of: Option<(u64, usize, Arrangement)>,
    rows: Vec<Row>,
}

impl Rows {
    /// The rows in order. `model_revision` and `clip` say what the other values belong to.
    pub(super) fn update(
        &mut self,
        (model_revision, clip): (u64, usize),
        skeleton: &Skeleton,
        activity: &[JointActivity],
        arrangement: &Arrangement,
    ) -> &[Row] {
        let is_same = |of: &(u64, usize, Arrangement)| (of.0, of.1) == (model_revision, clip) && of.2 == *arrangement;
        if !self.of.as_ref().is_some_and(is_same) {
            self.rows = if arrangement.by_motion {
                by_motion(skeleton, activity)
            } else {
                as_tree(skeleton, &arrangement.folded)
            };
            self.of = Some((model_revision, clip, arrangement.clone()));
        }
        &self.rows
    }
}

/// Depth first, without what is folded away.
fn as_tree(skeleton: &Skeleton, folded: &BTreeSet<JointIndex>) -> Vec<Row> {
    let parents = skeleton.parents();
    let mut below = vec![0_u32; parents.len()];
    let mut children = vec![Vec::new(); parents.len()];
    // Parents come first: backwards each joint's branch is counted before it is added to its parent's.
    for (index, parent) in parents.iter().enumerate().rev() {
        if let Some(parent) = parent {
            below[parent.index()] += below[index] + 1;
            children[parent.index()].push(JointIndex(index as u32));
        }
    }
    let roots = parents.iter().enumerate().rev().filter(|(_, parent)| parent.is_none());
    let mut ahead: Vec<(JointIndex, u32)> = roots.map(|(index, _)| (JointIndex(index as u32), 0)).collect();
    let mut rows = Vec::with_capacity(parents.len());
    while let Some((joint, depth)) = ahead.pop() {
        let folded = folded.contains(&joint);
        rows.push(Row {
            joint,
            depth,
            below: below[joint.index()],
            folded,
        });
        if !folded {
            // The last first, as the lists and the stack both are.
            ahead.extend(children[joint.index()].iter().map(|&child| (child, depth + 1)));
        }
    }
    rows
}

/// What moves most first; of equal ones in the skeleton's order.
fn by_motion(skeleton: &Skeleton, activity: &[JointActivity]) -> Vec<Row> {
    let share = |joint: JointIndex| activity.get(joint.index()).map_or(0.0, |activity| activity.share);
    let mut joints: Vec<JointIndex> = (0..skeleton.joint_count() as u32).map(JointIndex).collect();
    joints.sort_by(|&a, &b| share(b).total_cmp(&share(a)));
    let row = |joint| Row {
        joint,
        depth: 0,
        below: 0,
        folded: false,
    };
    joints.into_iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Affine3A;

    /// 0 ─ 1 ─ 2, 0 ─ 3, and 4 by itself.
    fn skeleton() -> Skeleton {
        let parents = [None, Some(0), Some(1), Some(0), None].map(|parent| parent.map(JointIndex));
        Skeleton::new(parents.into(), vec![Affine3A::IDENTITY; 5], (0..5).collect()).expect("a skeleton")
    }

    fn shown(rows: &[Row]) -> Vec<(u32, u32, u32)> {
        rows.iter().map(|row| (row.joint.0, row.depth, row.below)).collect()
    }

    #[test]
    fn branches_stand_together_and_fold() {
        let skeleton = skeleton();
        let all = as_tree(&skeleton, &BTreeSet::new());
        assert_eq!(shown(&all), [(0, 0, 3), (1, 1, 1), (2, 2, 0), (3, 1, 0), (4, 0, 0)]);
        let folded = as_tree(&skeleton, &BTreeSet::from([JointIndex(1)]));
        assert_eq!(shown(&folded), [(0, 0, 3), (1, 1, 1), (3, 1, 0), (4, 0, 0)]);
        assert!(folded[1].folded && !folded[0].folded);
    }

    #[test]
    fn by_motion_the_liveliest_is_first() {
        let activity = [0.0, 0.25, 1.0, 0.25, 0.0].map(|share| JointActivity {
            share,
            ..JointActivity::default()
        });
        let rows = by_motion(&skeleton(), &activity);
        assert_eq!(rows.iter().map(|row| row.joint.0).collect::<Vec<_>>(), [2, 1, 3, 0, 4]);
    }
}
