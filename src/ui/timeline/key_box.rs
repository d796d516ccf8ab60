//! Keys in a box that was drawn over them.

use std::collections::BTreeSet;

use crate::model::JointIndex;
use crate::session::Session;

/// A stretch of time and the joints whose keys in it are chosen.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct KeyBox {
    /// Where the pointer took hold: a time, and a row with its part.
    pub(super) from: (f32, f32),
    /// Start and end, in order.
    pub(super) span_secs: [f32; 2],
    /// The joints of the rows that it covers.
    pub(super) joints: BTreeSet<JointIndex>,
}

impl KeyBox {
    /// Nothing yet, from a time and a row with its part on.
    pub(super) fn at(from: (f32, f32)) -> Self {
        Self {
            from,
            span_secs: [from.0; 2],
            joints: BTreeSet::new(),
        }
    }

    /// Takes the box to another corner.
    pub(super) fn stretch<'a>(
        &mut self,
        (time_secs, row): (f32, f32),
        joints_of: impl Fn(usize) -> Option<&'a [JointIndex]>,
    ) {
        let (from_secs, from_row) = self.from;
        self.span_secs = [from_secs.min(time_secs), from_secs.max(time_secs)];
        let [first, last] = [from_row.min(row), from_row.max(row)].map(|row| row.max(0.0) as usize);
        self.joints = (first..=last).map_while(joints_of).flatten().copied().collect();
    }

    /// Those of a joint's key times that are in it.
    pub(super) fn part_of(&self, joint: JointIndex, times_secs: &[f32]) -> std::ops::Range<usize> {
        if !self.joints.contains(&joint) {
            return 0..0;
        }
        self.span_of(times_secs)
    }

    /// Those of key times of several joints that are in it, as far as it has any of those joints.
    pub(super) fn part_of_any(
        &self,
        is_among: impl Fn(JointIndex) -> bool,
        times_secs: &[f32],
    ) -> std::ops::Range<usize> {
        if !self.joints.iter().any(|&joint| is_among(joint)) {
            return 0..0;
        }
        self.span_of(times_secs)
    }

    fn span_of(&self, times_secs: &[f32]) -> std::ops::Range<usize> {
        let [start_secs, end_secs] = self.span_secs;
        let first = times_secs.partition_point(|&secs| secs < start_secs);
        let end = times_secs.partition_point(|&secs| secs <= end_secs);
        first..end.max(first)
    }

    /// How many keys are in it.
    pub(super) fn count(&self, session: &Session) -> usize {
        let in_box = |&joint: &JointIndex| self.part_of(joint, session.key_times(Some(joint))).len();
        self.joints.iter().map(in_box).sum()
    }
}
