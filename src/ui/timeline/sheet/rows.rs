//! The joints as rows: as a tree whose branches fold, or sorted by motion. A folded row shows the keys of its whole branch. They are
//! merged once, when the row is first in view.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::anim::{JointActivity, key_times, merged_key_times_of};
use crate::model::{Clip, JointIndex};
use crate::session::{JointRow, OpenModel, Session};

/// One row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::ui::timeline) struct BoneRow {
    pub(in crate::ui::timeline) joint: JointIndex,
    /// Distance from the root. 0 without a tree.
    pub(in crate::ui::timeline) depth: u32,
    /// Joints below it in the tree, folded or not. 0 without a tree.
    pub(in crate::ui::timeline) below: usize,
    pub(in crate::ui::timeline) folded: bool,
}

/// A row in view, and what is folded below it.
#[derive(Clone, Copy, Debug)]
pub(in crate::ui::timeline) struct SeenRow<'a> {
    pub(in crate::ui::timeline) row: &'a BoneRow,
    pub(in crate::ui::timeline) folded: Option<&'a FoldedBranch>,
}

/// Rows of the open clip, in buffers that are reused.
#[derive(Debug, Default)]
pub(in crate::ui::timeline) struct Rows {
    /// Sorted by motion, the most first, instead of as a tree.
    pub(in crate::ui::timeline) by_motion: bool,
    sorted_of: Option<(u64, usize)>,
    sorted: Vec<JointIndex>,
    tree: Vec<JointRow>,
    rows: Vec<BoneRow>,
    branches: FoldedBranches,
}

impl Rows {
    /// Lists the rows of a clip again, if something changed.
    pub(in crate::ui::timeline) fn update(&mut self, session: &Session, open: &OpenModel, clip: usize) {
        self.branches.keep_of((session.clips_revision(), clip));
        self.rows.clear();
        if self.by_motion {
            let of = Some((session.clips_revision(), clip));
            if self.sorted_of != of {
                self.sorted_of = of;
                sort_by_motion(open.activity(clip).unwrap_or_default(), &mut self.sorted);
            }
            self.rows.extend(self.sorted.iter().map(|&joint| BoneRow {
                joint,
                depth: 0,
                below: 0,
                folded: false,
            }));
        } else {
            session.joint_rows("", &mut self.tree);
            let tree = session.joints().tree();
            self.rows.extend(self.tree.iter().map(|row| BoneRow {
                joint: row.joint,
                depth: row.depth,
                below: tree.branch(row.joint).len().saturating_sub(1),
                folded: row.folded,
            }));
        }
    }

    pub(in crate::ui::timeline) fn all(&self) -> &[BoneRow] {
        &self.rows
    }

    /// Merges what is folded below rows in view.
    pub(in crate::ui::timeline) fn merge_folded(
        &mut self,
        seen: Range<usize>,
        session: &Session,
        open: &OpenModel,
        clip_index: usize,
    ) {
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

    /// What is folded below a row in view.
    pub(in crate::ui::timeline) fn folded_below(&self, row: &BoneRow) -> Option<&FoldedBranch> {
        self.branches.get(row.joint).filter(|_| row.folded)
    }

    /// The rows in view, once what is below them was merged.
    pub(in crate::ui::timeline) fn seen(&self, seen: Range<usize>) -> impl Iterator<Item = SeenRow<'_>> {
        let rows = self.rows.get(seen).unwrap_or_default();
        rows.iter().map(|row| SeenRow {
            row,
            folded: self.folded_below(row),
        })
    }

    /// The joints of a row: its own, and those folded below it.
    pub(in crate::ui::timeline) fn joints_of<'a>(
        &'a self,
        session: &'a Session,
        index: usize,
    ) -> Option<&'a [JointIndex]> {
        let row = self.rows.get(index)?;
        Some(if row.folded {
            session.joints().tree().branch(row.joint)
        } else {
            std::slice::from_ref(&row.joint)
        })
    }
}

/// The joints of a branch without its root.
fn below(session: &Session, joint: JointIndex) -> &[JointIndex] {
    session.joints().tree().branch(joint).get(1..).unwrap_or_default()
}

/// Sorts by motion, the most first. Equal ones keep the skeleton's order.
pub fn sort_by_motion(activity: &[JointActivity], sorted: &mut Vec<JointIndex>) {
    sorted.clear();
    sorted.extend((0..activity.len() as u32).map(JointIndex));
    sorted.sort_by(|a, b| activity[b.index()].fraction.total_cmp(&activity[a.index()].fraction));
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct FoldedBranch {
    /// Times of the keys of all its joints, in order.
    pub times_secs: Vec<f32>,
    pub constant: bool,
    /// The most that a joint of it moves, as a fraction of the most of all joints.
    pub most_motion: f32,
}

impl FoldedBranch {
    pub fn new(clip: &Clip, below: &[JointIndex], activity: &[JointActivity]) -> Self {
        let activity = || below.iter().filter_map(|joint| activity.get(joint.index()));
        Self {
            times_secs: merged_key_times_of(clip, below),
            // A joint with a single key does not count as constant.
            constant: activity().all(|joint| joint.constant)
                && below.iter().any(|&joint| key_times(clip, joint).len() > 1),
            most_motion: activity().map(|joint| joint.fraction).fold(0.0, f32::max),
        }
    }
}

/// The folded branches of rows that were in view. No two of them overlap, so together they hold no more keys than the clip.
#[derive(Debug, Default)]
pub struct FoldedBranches {
    of: Option<(u64, usize)>,
    branches: BTreeMap<JointIndex, FoldedBranch>,
}

impl FoldedBranches {
    /// Forgets branches of another clip; `of` tells clips apart.
    pub fn keep_of(&mut self, of: (u64, usize)) {
        if self.of != Some(of) {
            self.of = Some(of);
            self.branches.clear();
        }
    }

    /// What is folded below a joint, if it was merged.
    pub fn get(&self, joint: JointIndex) -> Option<&FoldedBranch> {
        self.branches.get(&joint)
    }

    /// Merges what is below a joint, if that is missing. `folded`: all joints whose rows are folded.
    pub fn merge(
        &mut self,
        joint: JointIndex,
        clip: &Clip,
        below: &[JointIndex],
        activity: &[JointActivity],
        folded: impl Iterator<Item = JointIndex>,
    ) {
        if !self.branches.contains_key(&joint) {
            let folded: BTreeSet<JointIndex> = folded.collect();
            self.branches.retain(|joint, _| folded.contains(joint));
            self.branches.insert(joint, FoldedBranch::new(clip, below, activity));
        }
    }
}

/// Key times of a row: the joint's own, and those folded below it.
#[derive(Clone, Copy, Debug)]
pub struct RowKeys<'a>(pub [&'a [f32]; 2]);

impl RowKeys<'_> {
    pub fn before(&self, secs: f32) -> Option<f32> {
        let before = self
            .0
            .map(|times| times[..times.partition_point(|&key| key < secs)].last().copied());
        before.into_iter().flatten().max_by(f32::total_cmp)
    }

    pub fn after(&self, secs: f32) -> Option<f32> {
        let after = self
            .0
            .map(|times| times.get(times.partition_point(|&key| key <= secs)).copied());
        after.into_iter().flatten().min_by(f32::total_cmp)
    }

    pub fn first(&self) -> Option<f32> {
        self.after(f32::NEG_INFINITY)
    }

    pub fn last(&self) -> Option<f32> {
        self.before(f32::INFINITY)
    }

    pub fn nearest(&self, secs: f32) -> Option<f32> {
        let around = [self.before(secs), self.after(secs.next_down())];
        let away = |key: &f32| (key - secs).abs();
        around.into_iter().flatten().min_by(|a, b| away(a).total_cmp(&away(b)))
    }
}
