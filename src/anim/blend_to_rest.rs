//! Between the animated pose and the bind pose.

use super::LocalPose;
use crate::model::{JointLanes, LocalJoint, Skeleton};

/// Brings each joint of a local pose `share` of the way to [`Skeleton::rest`]: translation and scale in a straight line,
/// rotation along the shorter arc at even speed. 0 and below leaves the pose as it is, as NaN does;
/// 1 and above is rest.
///
/// Rest comes from the inverse bind matrices alone, so a joint that moves no vertex rests where its matrix puts it like any
/// other. Exporters that write the identity for such a joint put it at the model's origin: no vertex goes with it, and its
/// children still come to their own places, since their rest is relative to that same origin.
pub fn blend_to_rest(skeleton: &Skeleton, share: f32, local: &mut LocalPose) {
    if share.is_nan() || share <= 0.0 {
        return;
    }
    let share = share.min(1.0);
    let joint_count = local.joint_count();
    let mut rest = skeleton.rest()[..joint_count.min(skeleton.joint_count())].chunks(JointLanes::COUNT);
    for group in &mut local.groups {
        for (lane, rest) in rest.next().unwrap_or_default().iter().enumerate() {
            group.set_joint(lane, blend(&group.joint(lane), rest, share));
        }
    }
}

fn blend(from: &LocalJoint, to: &LocalJoint, share: f32) -> LocalJoint {
    if share == 1.0 {
        return *to;
    }
    LocalJoint {
        rotation: from.rotation.slerp(to.rotation, share).normalize(),
        translation: from.translation * (1.0 - share) + to.translation * share,
        scale: from.scale * (1.0 - share) + to.scale * share,
    }
}
