//! Four joints side by side.

use glam::{Affine3A, Mat3A, Quat, Vec3, Vec4};

use super::LocalJoint;

/// Four joints relative to their parents ([`LocalJoint`]), one in each lane: a vector holds the same number of all four,
/// so that one instruction works on four joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLanes {
    /// Unit rotations: x, y, z and w of the four.
    pub rotation: [Vec4; 4],
    /// Translations: x, y and z of the four.
    pub translation: [Vec4; 3],
    /// Scales: x, y and z of the four.
    pub scale: [Vec4; 3],
}

impl JointLanes {
    /// Joints in a group.
    pub const COUNT: usize = 4;

    /// All four on their parents.
    pub const IDENTITY: Self = Self {
        rotation: [Vec4::ZERO, Vec4::ZERO, Vec4::ZERO, Vec4::ONE],
        translation: [Vec4::ZERO; 3],
        scale: [Vec4::ONE; 3],
    };

    /// The joint of one lane, below 4.
    pub fn joint(&self, lane: usize) -> LocalJoint {
        LocalJoint {
            rotation: Quat::from_array(self.rotation.map(|lanes| lanes[lane])),
            translation: Vec3::from_array(self.translation.map(|lanes| lanes[lane])),
            scale: Vec3::from_array(self.scale.map(|lanes| lanes[lane])),
        }
    }

    /// Puts a joint into one lane, below 4.
    pub fn set_joint(&mut self, lane: usize, joint: LocalJoint) {
        let set = |lanes: &mut [Vec4], values: &[f32]| {
            for (lanes, &value) in lanes.iter_mut().zip(values) {
                lanes[lane] = value;
            }
        };
        set(&mut self.rotation, &joint.rotation.to_array());
        set(&mut self.translation, &joint.translation.to_array());
        set(&mut self.scale, &joint.scale.to_array());
    }

    /// The parts of each joint as one matrix: [`LocalJoint::parent_from_joint`] of all four.
    #[inline]
    pub fn parent_from_joint(&self) -> MatrixLanes {
        let [x, y, z, w] = self.rotation;
        let (x2, y2, z2) = (x + x, y + y, z + z);
        let (xx, xy, xz) = (x * x2, x * y2, x * z2);
        let (yy, yz, zz) = (y * y2, y * z2, z * z2);
        let (wx, wy, wz) = (w * x2, w * y2, w * z2);
        let [scale_x, scale_y, scale_z] = self.scale;
        let one = Vec4::ONE;
        MatrixLanes {
            x_axis: [one - (yy + zz), xy + wz, xz - wy].map(|lanes| (lanes * scale_x).to_array()),
            y_axis: [xy - wz, one - (xx + zz), yz + wx].map(|lanes| (lanes * scale_y).to_array()),
            z_axis: [xz + wy, yz - wx, one - (xx + yy)].map(|lanes| (lanes * scale_z).to_array()),
            translation: self.translation.map(|lanes| lanes.to_array()),
        }
    }
}

/// Four affine matrices side by side: each column as x, y and z, each of these for the four lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatrixLanes {
    /// First columns.
    pub x_axis: [[f32; 4]; 3],
    /// Second columns.
    pub y_axis: [[f32; 4]; 3],
    /// Third columns.
    pub z_axis: [[f32; 4]; 3],
    /// Fourth columns.
    pub translation: [[f32; 4]; 3],
}

impl MatrixLanes {
    /// `left · m`, where m is the matrix of one lane, below 4. The numbers of m are taken from their lanes as they are
    /// needed, which saves turning the four into matrices of their own.
    #[inline]
    pub fn after(&self, left: &Affine3A, lane: usize) -> Affine3A {
        let Mat3A { x_axis, y_axis, z_axis } = left.matrix3;
        let column = |[x, y, z]: &[[f32; 4]; 3]| x_axis * x[lane] + y_axis * y[lane] + z_axis * z[lane];
        Affine3A {
            matrix3: Mat3A::from_cols(column(&self.x_axis), column(&self.y_axis), column(&self.z_axis)),
            translation: column(&self.translation) + left.translation,
        }
    }
}
