//! A transform in parts that a person can read.

use glam::{Affine3A, DMat3, DQuat, DVec3, EulerRot, Quat, Vec3};

use super::table::{aligned, number};
use crate::model::LocalJoint;

/// Axes whose cosine is above this are not square to each other. The rounding of long chains in f32 stays below.
const SHEAR_FROM: f64 = 1e-4;

/// Position, rotation, scale, and what these cannot say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransformParts {
    /// Where the origin goes.
    pub position: Vec3,
    /// Unit rotation, w not negative.
    pub rotation: Quat,
    /// The same rotation as three turns in degrees: about x, then y, then z of the outer space's fixed axes. In row vectors
    /// Rx · Ry · Rz; "XYZ" in Blender. y is −90…90.
    pub euler_xyz_degrees: Vec3,
    /// Length of each axis. A matrix that mirrors has a negative x, since it does not tell which axis was meant.
    pub scale: Vec3,
    /// Cosines of the angles between the axes x and y, x and z, y and z: 0 where they are square to each other.
    pub shear: Vec3,
}

impl TransformParts {
    /// The parts of a joint as it stands: signs of its scale are kept.
    pub fn of_joint(joint: &LocalJoint) -> Self {
        Self::of(joint.translation, joint.rotation.as_dquat(), joint.scale, Vec3::ZERO)
    }

    /// The parts of a matrix. The rotation has its x axis along the matrix's x, its y axis in the plane of x and y: exact where
    /// the axes are square to each other, otherwise [`TransformParts::shear`] says how much they are not (after Thomas,
    /// "Decomposing a Matrix into Simple Transformations", Graphics Gems II). An axis of no length is taken where the others
    /// leave room.
    pub fn of_matrix(matrix: &Affine3A) -> Self {
        let DMat3 { x_axis, y_axis, z_axis } = matrix.as_daffine3().matrix3;
        let axes = [x_axis, y_axis, z_axis];
        let side = if x_axis.cross(y_axis).dot(z_axis) < 0.0 {
            -1.0
        } else {
            1.0
        };
        let lengths = axes.map(DVec3::length);
        let [x, y, z] = [side * x_axis, y_axis, z_axis].map(DVec3::normalize_or_zero);
        let rotation = DQuat::from_mat3(&square_axes(x, y, z));
        let shear = DVec3::new(x.dot(y), x.dot(z), y.dot(z));
        let shear = if shear.abs().max_element() > SHEAR_FROM {
            shear
        } else {
            DVec3::ZERO
        };
        let scale = DVec3::new(side * lengths[0], lengths[1], lengths[2]);
        Self::of(matrix.translation.into(), rotation, scale.as_vec3(), shear.as_vec3())
    }

    fn of(position: Vec3, rotation: DQuat, scale: Vec3, shear: Vec3) -> Self {
        // Near the poles the angles are sensitive to the rounding of an f32 quaternion.
        let rotation = rotation.normalize();
        let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
        let (x, y, z) = rotation.to_euler(EulerRot::XYZEx);
        Self {
            position,
            rotation: rotation.as_quat(),
            euler_xyz_degrees: DVec3::new(x, y, z).map(f64::to_degrees).as_vec3(),
            scale,
            shear,
        }
    }

    /// Whether the axes are not square to each other, so that position, rotation and scale alone are another transform.
    pub fn is_sheared(&self) -> bool {
        self.shear != Vec3::ZERO
    }

    /// Whether it turns left hands into right ones.
    pub fn is_mirrored(&self) -> bool {
        self.scale.to_array().into_iter().filter(|scale| *scale < 0.0).count() % 2 == 1
    }

    /// One line for each part, for the clipboard.
    pub fn to_text(&self) -> String {
        let mut rows = vec![
            self.row("position", self.position),
            self.row("rotation (Euler XYZ, degrees)", self.euler_xyz_degrees),
            self.row("scale", self.scale),
        ];
        if self.is_sheared() {
            rows.push(self.row("shear (cosines xy, xz, yz)", self.shear));
        }
        let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        let numbers: Vec<_> = rows.iter().map(|(_, numbers)| numbers.clone()).collect();
        let mut text = String::new();
        for ((name, _), line) in rows.iter().zip(aligned(&numbers)) {
            text.push_str(&format!("{name:width$}  {line}\n"));
        }
        let quaternion = self.rotation.to_array().map(number).join("  ");
        text.push_str(&format!("{:width$}  {quaternion}\n", "quaternion (x y z w)"));
        if self.is_mirrored() {
            text.push_str("mirrored\n");
        }
        text
    }

    fn row(&self, name: &'static str, vector: Vec3) -> (&'static str, [String; 3]) {
        (name, vector.to_array().map(number))
    }
}

/// The nearest square axes that keep the direction of x and the plane of x and y, of which some may be zero.
fn square_axes(x: DVec3, y: DVec3, z: DVec3) -> DMat3 {
    let x = if x == DVec3::ZERO { y.cross(z) } else { x };
    let x = x.try_normalize().unwrap_or_else(|| match (y, z) {
        (DVec3::ZERO, DVec3::ZERO) => DVec3::X,
        (DVec3::ZERO, along) | (along, _) => along.any_orthonormal_vector(),
    });
    let in_plane = y - x * x.dot(y);
    let beside = |along: DVec3| along.try_normalize().filter(|_| along.length() > 1e-9);
    let y = beside(in_plane)
        .or_else(|| beside(z.cross(x)))
        .unwrap_or_else(|| x.any_orthonormal_vector());
    DMat3::from_cols(x, y, x.cross(y))
}
