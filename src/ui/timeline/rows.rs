//! The joints as rows: as a tree whose branches fold, or by how much they move.

use std::ops::Range;

use super::folded::{FoldedBranch, FoldedBranches};
use crate::anim::JointActivity;
use crate::model::JointIndex;
use crate::session::{JointRow, OpenModel, Session};

/// One row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Row {
    pub(super) joint: JointIndex,
    /// Distance from the root; 0 in a list without a tree.
    pub(super) depth: u32,
    /// Joints below it in the tree, folded away or not; 0 in a list without a tree.
    pub(super) below: usize,
    pub(super) folded: bool,
}

/// A row that is seen, and what is folded away below it.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenRow<'a> {
    pub(super) row: &'a Row,
    pub(super) folded: Option<&'a FoldedBranch>,
}

/// Rows of the clip on show, in buffers that are kept.
#[derive(Debug, Default)]
pub(super) struct Rows {
    /// The liveliest first, instead of the tree.
    pub(super) by_motion: bool,
    sorted_of: Option<(u64, usize)>,
    sorted: Vec<JointIndex>,
    tree: Vec<JointRow>,
    rows: Vec<Row>,
    branches: FoldedBranches,
}

impl Rows {
    /// Orders the rows of a clip anew.
    pub(super) fn update(&mut self, session: &Session, open: &OpenModel, clip: usize) {
        self.branches.keep_of((session.clips_revision(), clip));
        self.rows.clear();
        if self.by_motion {
            let of = Some((session.clips_revision(), clip));
            if self.sorted_of != of {
                self.sorted_of = of;
                sort_by_motion(open.activity(clip).unwrap_or_default(), &mut self.sorted);
            }
            self.rows.extend(self.sorted.iter().map(|&joint| Row {
                joint,
                depth: 0,
                below: 0,
                folded: false,
            }));
        } else {
            session.joint_rows("", &mut self.tree);
            let tree = session.joints().tree();
            self.rows.extend(self.tree.iter().map(|row| Row {
                joint: row.joint,
                depth: row.depth,
                below: tree.branch(row.joint).len().saturating_sub(1),
                folded: row.folded,
            }));
        }
    }

    /// The rows in order.
    pub(super) fn all(&self) -> &[Row] {
        &self.rows
    }

    /// Merges what is folded away below the rows that are seen.
    pub(super) fn merge_folded(&mut self, seen: Range<usize>, session: &Session, open: &OpenModel, clip_index: usize) {
        let Some(clip) = open.model.clips.get(clip_index) else {
            return;
        };
        let activity = open.activity(clip_index).unwrap_or_default();
        for row in self.rows.get(seen).unwrap_or_default() {
            if row.folded {
                let below = below(session, row.joint);
                let folded = self.rows.iter().filter(|row| row.folded).map(|row| row.joint);
                self.branches.merge(row.joint, clip, below, activity, folded);
            }
        }
    }

    /// What is folded away below a row that is seen.
    pub(super) fn folded_below(&self, row: &Row) -> Option<&FoldedBranch> {
        self.branches.get(row.joint).filter(|_| row.folded)
    }

    /// The rows that are seen, once what is below them was merged.
    pub(super) fn seen(&self, seen: Range<usize>) -> impl Iterator<Item = SeenRow<'_>> {
        let rows = self.rows.get(seen).unwrap_or_default();
        rows.iter().map(|row| SeenRow {
            row,
            folded: self.folded_below(row),
        })
    }

    /// The joints that a row stands for: its own, and those folded away below it.
    pub(super) fn joints_of<'a>(&'a self, session: &'a Session, index: usize) -> Option<&'a [JointIndex]> {
        let row = self.rows.get(index)?;
        Some(if row.folded {
            session.joints().tree().branch(row.joint)
        } else {
            std::slice::from_ref(&row.joint)
        })
    }
}

/// The joints of a branch but for its topmost.
fn below(session: &Session, joint: JointIndex) -> &[JointIndex] {
    session.joints().tree().branch(joint).get(1..).unwrap_or_default()
}

/// What moves most first; of equal ones in the skeleton's order.
fn sort_by_motion(activity: &[JointActivity], sorted: &mut Vec<JointIndex>) {
    sorted.clear();
    sorted.extend((0..activity.len() as u32).map(JointIndex));
    sorted.sort_by(|a, b| activity[b.index()].share.total_cmp(&activity[a.index()].share));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_motion_the_liveliest_is_first() {
        let activity = [0.0, 0.25, 1.0, 0.25, 0.0].map(|share| JointActivity {
            share,
            ..JointActivity::default()
        });
        let mut sorted = vec![JointIndex(9)];
        sort_by_motion(&activity, &mut sorted);
        assert_eq!(sorted, [2, 1, 3, 0, 4].map(JointIndex));
    }
}
