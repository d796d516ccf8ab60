//! Where a node is relative to its parent, by the many parts that FBX has for it.
//!
//! Autodesk's "Computing transformation matrices": `T · Roff · Rp · Rpre · R · Rpost⁻¹ · Rp⁻¹ · Soff · Sp · S · Sp⁻¹`, with translation T, offset and pivot of the
//! rotation, pre-rotation, rotation, post-rotation, offset and pivot of the scaling, and scaling. Angles are in degrees. What hangs on a node, but not its
//! children, has the geometric transform besides.

use glam::{DAffine3, DQuat, DVec3};

use super::objects::Object;

/// In which order a node turns about its axes. Of `XYZ` it turns about x first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum RotationOrder {
    #[default]
    Xyz,
    Xzy,
    Yzx,
    Yxz,
    Zxy,
    Zyx,
}

impl RotationOrder {
    /// By the number that files have for it; that of spherical rotations, 6, is turned as the first.
    fn from_number(number: i64) -> Self {
        match number {
            1 => Self::Xzy,
            2 => Self::Yzx,
            3 => Self::Yxz,
            4 => Self::Zxy,
            5 => Self::Zyx,
            _ => Self::Xyz,
        }
    }

    /// The rotation by these angles in degrees about x, y and z.
    pub(super) fn rotation(self, degrees: DVec3) -> DQuat {
        let angles = degrees.map(f64::to_radians);
        let [x, y, z] = [
            DQuat::from_rotation_x(angles.x),
            DQuat::from_rotation_y(angles.y),
            DQuat::from_rotation_z(angles.z),
        ];
        match self {
            Self::Xyz => z * y * x,
            Self::Xzy => y * z * x,
            Self::Yzx => x * z * y,
            Self::Yxz => z * x * y,
            Self::Zxy => y * x * z,
            Self::Zyx => x * y * z,
        }
    }
}

/// Which scale of its parent a node has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Inherit {
    /// The parent's scale acts between rotation and scale of the node: `R · S_parent · S`.
    ScaleAfterRotation,
    /// That of any other scene: `S_parent · R · S`.
    #[default]
    Whole,
    /// The parent's own scale does not act on the node.
    NoScale,
}

/// The parts of a node's transform that no clip moves, and those that one may.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transform {
    pub(super) translation: DVec3,
    /// Degrees.
    pub(super) rotation: DVec3,
    pub(super) scale: DVec3,
    order: RotationOrder,
    pub(super) inherit: Inherit,
    pre: DQuat,
    post_inverse: DQuat,
    rotation_offset: DVec3,
    rotation_pivot: DVec3,
    scaling_offset: DVec3,
    scaling_pivot: DVec3,
    /// Of what hangs on the node.
    pub(super) node_from_geometry: DAffine3,
}

impl Transform {
    pub(super) fn of(object: &Object<'_, '_>) -> Self {
        let vector = |name: &str, default| object.vector(name).filter(|vector| vector.is_finite()).unwrap_or(default);
        let offset = |name: &str| vector(name, DVec3::ZERO);
        let turned = |name: &str| RotationOrder::Xyz.rotation(offset(name));
        let order = object.integer("RotationOrder").map_or_else(RotationOrder::default, RotationOrder::from_number);
        Self {
            translation: offset("Lcl Translation"),
            rotation: offset("Lcl Rotation"),
            scale: vector("Lcl Scaling", DVec3::ONE),
            order,
            inherit: match object.integer("InheritType") {
                Some(0) => Inherit::ScaleAfterRotation,
                Some(2) => Inherit::NoScale,
                _ => Inherit::Whole,
            },
            pre: turned("PreRotation"),
            post_inverse: turned("PostRotation").inverse(),
            rotation_offset: offset("RotationOffset"),
            rotation_pivot: offset("RotationPivot"),
            scaling_offset: offset("ScalingOffset"),
            scaling_pivot: offset("ScalingPivot"),
            node_from_geometry: DAffine3::from_scale_rotation_translation(
                vector("GeometricScaling", DVec3::ONE),
                turned("GeometricRotation"),
                offset("GeometricTranslation"),
            ),
        }
    }

    /// The rotation by these angles in degrees, with what is turned before and after.
    pub(super) fn whole_rotation(&self, degrees: DVec3) -> DQuat {
        self.pre * self.order.rotation(degrees) * self.post_inverse
    }

    /// Relative to the parent, with these parts in place of the node's own.
    pub(super) fn parent_from_node(&self, translation: DVec3, degrees: DVec3, scale: DVec3) -> DAffine3 {
        let rotation = self.whole_rotation(degrees);
        // Both pivots move what lies beyond them: `x` below is `Sp + S · (v − Sp) + Soff` at v = 0, and what is turned is `x − Rp`.
        let scaled = self.scaling_offset + self.scaling_pivot - scale * self.scaling_pivot;
        let origin = translation + self.rotation_offset + self.rotation_pivot + rotation * (scaled - self.rotation_pivot);
        DAffine3::from_scale_rotation_translation(scale, rotation, origin)
    }
}
