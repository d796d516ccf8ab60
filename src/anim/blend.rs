//! Blends two poses, or a pose and the bind pose.

use super::lanes::{ArcLanes, JointLanes};
use super::pose::LocalPose;
use crate::model::Skeleton;

/// Each joint between two poses of one skeleton, relative to its parent: translation and scale in a straight line, rotation
/// along the shorter arc at even speed, whatever the signs of the quaternions. `weight` is that of `to`, clamped to 0…1; at
/// its ends `out` is one of the poses. NaN is 0. Joints that one pose lacks are left out.
pub fn blend(from: &LocalPose, to: &LocalPose, weight: f32, out: &mut LocalPose) {
    out.resize(from.joint_count().min(to.joint_count()));
    for (out, (from, to)) in out.groups.iter_mut().zip(from.groups.iter().zip(&to.groups)) {
        *out = between(from, to, weight);
    }
}

/// Brings each joint of a local pose toward [`Skeleton::bind`], as [`blend`] does with the `weight` of the bind pose: 0 leaves
/// the pose as it is, 1 is the bind pose.
///
/// It comes from the inverse bind matrices alone, so a joint that moves no vertex goes where its matrix puts it like any
/// other. Exporters that write the identity for such a joint put it at the model's origin: no vertex goes with it, and its
/// children still come to their own places, since they are relative to that same origin.
pub fn blend_to_bind(skeleton: &Skeleton, weight: f32, local: &mut LocalPose) {
    let joint_count = local.joint_count().min(skeleton.joint_count());
    let bind = skeleton.bind()[..joint_count].chunks(JointLanes::COUNT);
    for (group, bind) in local.groups.iter_mut().zip(bind) {
        *group = between(group, &JointLanes::from_joints(bind), weight);
    }
}

fn between(from: &JointLanes, to: &JointLanes, weight: f32) -> JointLanes {
    if weight >= 1.0 {
        *to
    } else if weight > 0.0 {
        let mut to = *to;
        let arc = ArcLanes::to_same_side(from, &mut to);
        from.toward(&to, &arc, weight)
    } else {
        *from
    }
}
