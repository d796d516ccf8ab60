//! Joints as rows.

use bindpose::anim::{JointActivity, LocalJoint};
use bindpose::model::{Clip, JointIndex, Track};
use bindpose::ui::for_tests::{FoldedBranch, FoldedBranches, RowKeys, sort_by_motion};

#[test]
fn by_motion_the_liveliest_is_first() {
    let activity = [0.0, 0.25, 1.0, 0.25, 0.0].map(|fraction| JointActivity {
        fraction,
        ..JointActivity::default()
    });
    let mut sorted = vec![JointIndex(9)];
    sort_by_motion(&activity, &mut sorted);
    assert_eq!(sorted, [2, 1, 3, 0, 4].map(JointIndex));
}

const RATE: f32 = 30.0;

/// A clip whose joints have keys at these frames.
fn clip(frames: &[&[u32]]) -> Clip {
    let key = |&frame: &u32| (frame as f32 / RATE, LocalJoint::IDENTITY);
    let tracks = frames
        .iter()
        .map(|frames| Track::new(frames.iter().map(key)).expect("keys in order"));
    Clip::new("clip", tracks.collect())
}

fn moving(fraction: f32) -> JointActivity {
    JointActivity {
        fraction,
        constant: fraction == 0.0,
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
        (frames(&both), both.most_motion, both.constant),
        (vec![1, 5, 7], 0.7, false)
    );
    let one_key = branch(&[3]);
    assert_eq!(
        (frames(&one_key), one_key.most_motion, one_key.constant),
        (vec![9], 0.0, false)
    );
    let nothing = branch(&[]);
    assert!(nothing.times_secs.is_empty() && !nothing.constant && nothing.most_motion == 0.0);
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

#[test]
fn keys_of_a_row_are_those_of_its_joint_and_of_what_is_folded_below() {
    let keys = RowKeys([&[0.0, 1.0], &[0.5, 1.0, 2.0]]);
    assert_eq!([keys.first(), keys.last()], [Some(0.0), Some(2.0)]);
    assert_eq!(
        [keys.after(0.0), keys.after(0.5), keys.after(2.0)],
        [Some(0.5), Some(1.0), None]
    );
    assert_eq!([keys.before(2.0), keys.before(0.0)], [Some(1.0), None]);
    assert_eq!(
        [keys.nearest(0.6), keys.nearest(1.0), keys.nearest(9.0)],
        [Some(0.5), Some(1.0), Some(2.0)]
    );
    assert_eq!(RowKeys([&[], &[]]).nearest(1.0), None);
}
