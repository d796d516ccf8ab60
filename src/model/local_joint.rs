//! One joint relative to its parent, in parts.

use glam::{Affine3A, DAffine3, DVec3, Quat, Vec3};

/// One joint relative to its parent (`parent_from_joint`): scale, then rotate, then translate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalJoint {
    /// Unit rotation.
    pub rotation: Quat,
    /// Translation in the parent's space.
    pub translation: Vec3,
    /// Scale along the joint's own axes.
    pub scale: Vec3,
}

impl Default for LocalJoint {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl LocalJoint {
    /// The joint coincides with its parent.
    pub const IDENTITY: Self = Self {
        rotation: Quat::IDENTITY,
        translation: Vec3::ZERO,
        scale: Vec3::ONE,
    };

    /// The parts as one matrix.
    #[inline]
    pub fn parent_from_joint(&self) -> Affine3A {
        Affine3A::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }

    /// The parts of a matrix. Shear is dropped. A matrix that flattens space keeps only its translation.
    pub(crate) fn from_matrix(parent_from_joint: &DAffine3) -> Self {
        let translation = parent_from_joint.translation.as_vec3();
        let translation = if translation.is_finite() {
            translation
        } else {
            Vec3::ZERO
        };
        if parent_from_joint.matrix3.determinant() == 0.0 || !parent_from_joint.is_finite() {
            return Self {
                translation,
                ..Self::IDENTITY
            };
        }
        let (scale, rotation, _): (DVec3, _, _) = parent_from_joint.to_scale_rotation_translation();
        let rotation = rotation.normalize().as_quat();
        let local = Self {
            rotation,
            translation,
            scale: scale.as_vec3(),
        };
        if local.is_finite() {
            local
        } else {
            Self {
                translation,
                ..Self::IDENTITY
            }
        }
    }

    /// Whether every part is a number.
    pub fn is_finite(&self) -> bool {
        self.rotation.is_finite() && self.translation.is_finite() && self.scale.is_finite()
    }
}
