//! Handedness and up axis of a file, and the matrix that brings it into the world (left-handed, y up).

use glam::{Affine3A, Mat3A, Vec3, Vec3A};

/// Whether x × y = z by the left or by the right hand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Handedness {
    /// As in the books.
    #[default]
    Left,
    /// As the soldier; the books' demo mirrors z to show it.
    Right,
}

/// Which axis of the file points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum UpAxis {
    /// As in the books.
    #[default]
    Y,
    /// As Blender's exporters write.
    Z,
}

/// The matrix from the file's space into the world, which is left-handed with y up. Scale is kept.
///
/// A right-handed y-up file mirrors z, as the books' demo does. A z-up file turns about x first, so that its z becomes y.
pub fn world_from_model(handedness: Handedness, up_axis: UpAxis) -> Affine3A {
    let upright = match (up_axis, handedness) {
        (UpAxis::Y, _) => Mat3A::IDENTITY,
        // x stays, y points away (+z in a left-handed world looking along +z), z points up: a reflection that swaps y and z
        // changes handedness, so each side takes the rotation that keeps its own.
        (UpAxis::Z, _) => Mat3A::from_cols(Vec3A::X, Vec3A::NEG_Z, Vec3A::Y),
    };
    let mirror = match handedness {
        Handedness::Left => Mat3A::IDENTITY,
        Handedness::Right => Mat3A::from_diagonal(Vec3::new(1.0, 1.0, -1.0)),
    };
    Affine3A::from_mat3(glam::Mat3::from(mirror * upright))
}
