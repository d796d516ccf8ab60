//! From a model's space into glTF's: right-handed, y up, facing +z.

use glam::{Affine3A, Mat3A, Quat, Vec3, Vec4};

use crate::model::{LocalJoint, Model, world_from_model};

/// Brings what a model has into glTF's space. Axes are exchanged and change their sign, so nothing is rounded.
pub(super) struct Space {
    gltf_from_model: Mat3A,
    /// −1 where it mirrors, else 1.
    sign: f32,
}

impl Space {
    pub(super) fn of(model: &Model) -> Self {
        let world_from_model = world_from_model(model.handedness, model.up_axis, model.front).matrix3;
        // In the left-handed world characters face −z.
        let gltf_from_model = Mat3A::from_diagonal(Vec3::new(1.0, 1.0, -1.0)) * world_from_model;
        Self {
            gltf_from_model,
            sign: gltf_from_model.determinant(),
        }
    }

    /// Whether the model's space is glTF's.
    pub(super) fn is_same(&self) -> bool {
        self.gltf_from_model == Mat3A::IDENTITY
    }

    /// A place or a direction. Adding 0 makes no −0 of a 0.
    pub(super) fn vector(&self, of_model: Vec3) -> Vec3 {
        self.gltf_from_model * of_model + Vec3::ZERO
    }

    /// A tangent. Where space is mirrored the cross product of normal and tangent points the other way, and so does its sign.
    pub(super) fn tangent(&self, of_model: Vec4) -> Vec4 {
        self.vector(of_model.truncate()).extend(of_model.w * self.sign)
    }

    /// A rotation, or the slope of one: a mirror turns it the other way round.
    pub(super) fn rotation(&self, of_model: Quat) -> Quat {
        Quat::from_vec4((self.vector(of_model.xyz()) * self.sign).extend(of_model.w) + Vec4::ZERO)
    }

    pub(super) fn scale(&self, of_model: Vec3) -> Vec3 {
        let axes = self.gltf_from_model;
        Mat3A::from_cols(axes.x_axis.abs(), axes.y_axis.abs(), axes.z_axis.abs()) * of_model
    }

    pub(super) fn joint(&self, of_model: &LocalJoint) -> LocalJoint {
        LocalJoint {
            rotation: self.rotation(of_model.rotation),
            translation: self.vector(of_model.translation),
            scale: self.scale(of_model.scale),
        }
    }

    pub(super) fn matrix(&self, of_model: &Affine3A) -> Affine3A {
        Affine3A {
            matrix3: self.gltf_from_model * of_model.matrix3 * self.gltf_from_model.transpose(),
            translation: self.gltf_from_model * of_model.translation,
        }
    }
}
