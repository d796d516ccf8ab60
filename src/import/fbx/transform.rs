//! Where a node is relative to its parent, by the many parts that FBX has for it.
//!
//! Autodesk's "Computing transformation matrices": `T · Roff · Rp · Rpre · R · Rpost⁻¹ · Rp⁻¹ · Soff · Sp · S · Sp⁻¹`, with translation T, offset and pivot of the
//! rotation, pre-rotation, rotation, post-rotation, offset and pivot of the scaling, and scaling. Angles are in degrees. What hangs on a node, but not its
//! children, has the geometric transform besides.

use glam::{DAffine3, DQuat, DVec3, EulerRot};

use super::objects::Object;
use crate::model::LocalJoint;

/// In which order a node turns about its axes, by the number that files have for it: the first axis first, and what [`EulerRot`] calls that, which names the
/// last one first. Spherical rotations, 6, are turned as XYZ is.
const ORDERS: [([usize; 3], EulerRot); 7] = [
    ([0, 1, 2], EulerRot::ZYX),
    ([0, 2, 1], EulerRot::YZX),
    ([1, 2, 0], EulerRot::XZY),
    ([1, 0, 2], EulerRot::ZXY),
    ([2, 0, 1], EulerRot::YXZ),
    ([2, 1, 0], EulerRot::XYZ),
    ([0, 1, 2], EulerRot::ZYX),
];

/// A row of [`ORDERS`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RotationOrder(usize);

impl RotationOrder {
    fn from_number(number: i64) -> Self {
        let row = usize::try_from(number).ok().filter(|&row| row < ORDERS.len());
        Self(row.unwrap_or_default())
    }

    /// The rotation by these angles in degrees about x, y and z.
    pub(super) fn rotation(self, degrees: DVec3) -> DQuat {
        let about = |axis: usize| DQuat::from_axis_angle(DVec3::AXES[axis], degrees[axis].to_radians());
        let [first, second, third] = ORDERS[self.0].0.map(about);
        third * second * first
    }

    /// The angles in degrees about x, y and z of a rotation.
    pub(super) fn degrees(self, rotation: DQuat) -> DVec3 {
        let ([first, second, third], order) = ORDERS[self.0];
        let angles = rotation.to_euler(order);
        let mut degrees = DVec3::ZERO;
        (degrees[third], degrees[second], degrees[first]) = angles;
        degrees.map(f64::to_degrees)
    }
}

/// Which scale of its parent a node has: Autodesk's `FbxTransform::EInheritType`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Inherit {
    /// `RrSs`: the parent's scale acts between rotation and scale of the node.
    ScaleAfterRotation,
    /// `RSrs`: the parent's whole matrix acts, as in other formats.
    #[default]
    Whole,
    /// `Rrs`: the parent's own scale does not act on the node.
    NoScale,
}

/// What clips move of a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts {
    pub(super) translation: DVec3,
    /// Degrees, in the node's order.
    pub(super) rotation: DVec3,
    pub(super) scale: DVec3,
}

/// Where a node is relative to its parent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    pub(super) translation: DVec3,
    pub(super) rotation: DQuat,
    pub(super) scale: DVec3,
}

impl Local {
    pub(super) fn matrix(self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }

    pub(super) fn joint(self) -> LocalJoint {
        let joint = LocalJoint {
            rotation: self.rotation.normalize().as_quat(),
            translation: self.translation.as_vec3(),
            scale: self.scale.as_vec3(),
        };
        if joint.is_finite() {
            joint
        } else {
            LocalJoint::from_matrix(&self.matrix())
        }
    }
}

/// The parts of a node's transform that no clip moves, and those that one may.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transform {
    pub(super) translation: DVec3,
    /// Degrees.
    pub(super) rotation: DVec3,
    pub(super) scale: DVec3,
    pub(super) order: RotationOrder,
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
    /// `unit_metres` are those of the file's unit.
    pub(super) fn of(object: &Object<'_, '_>, unit_metres: f64) -> Self {
        let vector = |name: &str, default| {
            object
                .vector(name)
                .filter(|vector| vector.is_finite())
                .unwrap_or(default)
        };
        let angles = |name: &str| vector(name, DVec3::ZERO);
        let offset = |name: &str| vector(name, DVec3::ZERO) * unit_metres;
        // With `RotationActive` 0, or for limits alone, rotation order, pre- and post-rotation are not used. 6.1 has no such property.
        let has_space = object.integer("RotationActive") != Some(0)
            && object.integer("RotationSpaceForLimitOnly").unwrap_or(0) == 0;
        let turned = |name: &str| match has_space {
            true => RotationOrder::default().rotation(angles(name)),
            false => DQuat::IDENTITY,
        };
        let order = object.integer("RotationOrder").filter(|_| has_space);
        let order = order.map_or_else(RotationOrder::default, RotationOrder::from_number);
        Self {
            translation: offset("Lcl Translation"),
            rotation: angles("Lcl Rotation"),
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
                RotationOrder::default().rotation(angles("GeometricRotation")),
                offset("GeometricTranslation"),
            ),
        }
    }

    /// The parts of the node where no clip moves it.
    pub(super) fn parts(&self) -> Parts {
        Parts {
            translation: self.translation,
            rotation: self.rotation,
            scale: self.scale,
        }
    }

    /// Whether its place depends on how it turns and scales.
    pub(super) fn has_pivots(&self) -> bool {
        [self.rotation_pivot, self.scaling_pivot, self.scaling_offset]
            .iter()
            .any(|pivot| *pivot != DVec3::ZERO)
    }

    /// Relative to the parent, with these parts in place of the node's own.
    pub(super) fn local(&self, parts: Parts) -> Local {
        let Parts {
            translation,
            rotation,
            scale,
        } = parts;
        let rotation = self.pre * self.order.rotation(rotation) * self.post_inverse;
        // `scaled` is where the scaling pivot leaves the origin; the rotation turns `scaled − Rp` about the rotation pivot.
        let scaled = self.scaling_offset + self.scaling_pivot - scale * self.scaling_pivot;
        let origin =
            translation + self.rotation_offset + self.rotation_pivot + rotation * (scaled - self.rotation_pivot);
        Local {
            translation: origin,
            rotation,
            scale,
        }
    }
}

/// Whether a scale is the same along all axes.
pub(super) fn is_even(scale: DVec3) -> bool {
    let near = |other: f64| (other - scale.x).abs() <= 1e-6 * scale.x.abs();
    near(scale.y) && near(scale.z)
}
