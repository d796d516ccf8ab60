//! What folded rows show of the joints folded away in their branches. Merged once for each, when it is first seen.

use std::collections::{BTreeMap, BTreeSet};

use crate::anim::{JointActivity, key_times, merged_key_times_of};
use crate::model::{Clip, JointIndex};

/// What is folded away below one joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FoldedBranch {
    /// Times at which any joint of it has a key, in order.
    pub(super) times_secs: Vec<f32>,
    /// Whether nothing of it moves.
    pub(super) constant: bool,
    /// The share of motion of the joint that moves most of it.
    pub(super) most_share: f32,
}

impl FoldedBranch {
    /// Of the joints below one.
    fn new(clip: &Clip, below: &[JointIndex], activity: &[JointActivity]) -> Self {
        let activity = || below.iter().filter_map(|joint| activity.get(joint.index()));
        Self {
            times_secs: merged_key_times_of(clip, below),
            // A key alone says no less than one that others differ from.
            constant: activity().all(|joint| joint.constant)
                && below.iter().any(|&joint| key_times(clip, joint).len() > 1),
            most_share: activity().map(|joint| joint.share).fold(0.0, f32::max),
        }
    }
}

/// The branches folded away below rows that were seen. Of joints shown as rows none is in the branch of another, so they
/// hold no more keys than the clip.
#[derive(Debug, Default)]
pub(super) struct FoldedBranches {
    of: Option<(u64, usize)>,
    branches: BTreeMap<JointIndex, FoldedBranch>,
}

impl FoldedBranches {
    /// Forgets branches of another clip; `of` tells clips apart.
    pub(super) fn keep_of(&mut self, of: (u64, usize)) {
        if self.of != Some(of) {
            self.of = Some(of);
            self.branches.clear();
        }
    }

    /// What is folded away below a joint, once it was merged.
    pub(super) fn get(&self, joint: JointIndex) -> Option<&FoldedBranch> {
        self.branches.get(&joint)
    }

    /// Merges what is below a joint, when that is not there. `folded` are all joints whose rows are folded.
    pub(super) fn merge(
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

#[cfg(test)]
mod tests {
    use glam::{Quat, Vec3};

    use super::*;
    use crate::anim::LocalJoint;
    use crate::model::Track;

    const RATE: f32 = 30.0;

    /// A clip whose joints have keys at these frames.
    fn clip(frames: &[&[u32]]) -> Clip {
        let key = |&frame: &u32| {
            let joint = LocalJoint {
                rotation: Quat::IDENTITY,
                translation: Vec3::ZERO,
                scale: Vec3::ONE,
            };
            (frame as f32 / RATE, joint)
        };
        let tracks = frames
            .iter()
            .map(|frames| Track::new(frames.iter().map(key)).expect("keys in order"));
        Clip::new("clip", tracks.collect())
    }

    fn moving(share: f32) -> JointActivity {
        JointActivity {
            share,
            constant: share == 0.0,
            ..JointActivity::default()
        }
    }

    #[test]
    fn a_branch_has_the_keys_of_its_joints_and_the_share_of_the_liveliest() {
        let clip = clip(&[&[0, 30], &[1, 5], &[5, 7], &[9]]);
        let activity = [1.0, 0.2, 0.7, 0.0].map(moving);
        let branch = |below: &[u32]| {
            let below: Vec<_> = below.iter().copied().map(JointIndex).collect();
            FoldedBranch::new(&clip, &below, &activity)
        };
        let frames = |branch: &FoldedBranch| {
            let frames = branch.times_secs.iter().map(|secs| (secs * RATE).round() as u32);
            frames.collect::<Vec<_>>()
        };
        let both = branch(&[1, 2]);
        assert_eq!(
            (frames(&both), both.most_share, both.constant),
            (vec![1, 5, 7], 0.7, false)
        );
        let one_key = branch(&[3]);
        assert_eq!(
            (frames(&one_key), one_key.most_share, one_key.constant),
            (vec![9], 0.0, false)
        );
        let nothing = branch(&[]);
        assert!(nothing.times_secs.is_empty() && !nothing.constant && nothing.most_share == 0.0);
        let still = FoldedBranch::new(&clip, &[JointIndex(1)], &[0.0; 4].map(moving));
        assert!(still.constant);
    }

    #[test]
    fn branches_are_merged_once_and_forgotten_when_they_unfold_or_the_clip_changes() {
        let clip = clip(&[&[0], &[1], &[2]]);
        let [root, above] = [0, 1].map(JointIndex);
        let mut branches = FoldedBranches::default();
        branches.keep_of((1, 0));
        branches.merge(above, &clip, &[JointIndex(2)], &[], [above].into_iter());
        let at = branches.get(above).map(|branch| branch.times_secs.as_ptr());
        branches.merge(above, &clip, &[JointIndex(2)], &[], [above].into_iter());
        branches.keep_of((1, 0));
        assert_eq!(branches.get(above).map(|branch| branch.times_secs.as_ptr()), at, "kept");
        branches.merge(root, &clip, &[above, JointIndex(2)], &[], [root].into_iter());
        assert!(branches.get(above).is_none() && branches.get(root).is_some());
        branches.keep_of((1, 1));
        assert!(branches.get(root).is_none());
    }
}
