//! How far apart two poses of one joint are, in lengths that can be compared.

use glam::Vec3A;

use crate::model::{JointIndex, LocalJoint, Skeleton};

/// How far the part of a surface that follows one joint reaches from it, as a share of the model's size: a forearm, a head
/// or a foot is about a tenth of a figure. By it turns and scales become lengths.
const REACH_SHARE: f32 = 0.1;

/// The way from one pose of a joint to another, relative to its parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct JointChange {
    /// Distance of the joint's place in model units.
    pub(super) translation: f32,
    /// Angle of the turn, 0…π.
    pub(super) rotation_radians: f32,
    /// Greatest change along an axis, as a share of the greater scale.
    pub(super) scale: f32,
}

impl JointChange {
    /// From one pose of a joint to another. Lengths are brought into model space by where the bind pose has the parent, whose
    /// scale is often that of an exporter's units.
    pub(super) fn between(skeleton: &Skeleton, joint: JointIndex, from: &LocalJoint, to: &LocalJoint) -> Self {
        let way: Vec3A = (to.translation - from.translation).into();
        let parent = skeleton.parents().get(joint.index()).copied().flatten();
        let way = parent.map_or(way, |parent| {
            skeleton.bind_model_from_joint()[parent.index()].matrix3 * way
        });
        let scale = |axis: usize| {
            let (from, to) = (from.scale[axis], to.scale[axis]);
            let greater = from.abs().max(to.abs());
            if greater > 0.0 {
                (to - from).abs() / greater
            } else {
                0.0
            }
        };
        let (from, to) = (from.rotation.as_dquat(), to.rotation.as_dquat());
        // q and −q are the same rotation. Four times the quarter angle by its tangent: exact for small angles, where the
        // cosine tells nothing.
        let to = if from.dot(to) < 0.0 { -to } else { to };
        let rotation_radians = 4.0 * (to - from).length().atan2((to + from).length());
        Self {
            translation: way.length(),
            rotation_radians: rotation_radians as f32,
            scale: scale(0).max(scale(1)).max(scale(2)),
        }
    }

    /// How far the surface that follows the joint moves, in model units, for a model of a size in those units.
    pub(super) fn surface_way(&self, size: f32) -> f32 {
        self.translation + (self.rotation_radians + self.scale) * REACH_SHARE * size
    }
}
