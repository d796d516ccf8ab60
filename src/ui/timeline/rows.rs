//! The joints as rows: as a tree whose branches fold, or by how much they move.

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

/// Rows of the clip on show, in buffers that are kept.
#[derive(Debug, Default)]
pub(super) struct Rows {
    /// The liveliest first, instead of the tree.
    pub(super) by_motion: bool,
    sorted_of: Option<(u64, usize)>,
    sorted: Vec<JointIndex>,
    tree: Vec<JointRow>,
    rows: Vec<Row>,
}

impl Rows {
    /// The rows in order.
    pub(super) fn update(&mut self, session: &Session, open: &OpenModel, clip: usize) -> &[Row] {
        self.rows.clear();
        if self.by_motion {
            let of = Some((session.model_revision(), clip));
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
        &self.rows
    }
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
