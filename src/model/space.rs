//! Handedness and up axis of a file, and the matrix that brings it into the world (left-handed, y up).

use glam::{Affine3A, Mat3A, Vec3, Vec3A};

use crate::modes::modes;

modes! {
    /// Whether x × y = z by the left or by the right hand.
    #[derive(Default)]
    pub enum Handedness {
        /// As in the books.
        #[default]
        Left = "left", "Left-handed";
        /// As the soldier; the books' demo mirrors z to show it.
        Right = "right", "Right-handed";
    }
}

modes! {
    /// Which axis of the file points up.
    #[derive(Default)]
    pub enum UpAxis {
        /// As in the books.
        #[default]
        Y = "y", "Y up";
        /// As Blender's exporters write.
        Z = "z", "Z up";
    }
}

modes! {
    /// Which way characters of the file face, along the axis that is neither up nor sideways: z with y up, y with z up.
    #[derive(Default)]
    pub enum Front {
        /// As in the books and in Blender.
        #[default]
        Negative = "negative", "Negative";
        /// As in glTF.
        Positive = "positive", "Positive";
    }
}

/// The matrix from the file's space into the world, which is left-handed with y up. Scale is kept.
///
/// A model that faces −z (y up) or −y (z up), as characters do in the books and in Blender, faces −z in the world, towards
/// the default camera. So a right-handed y-up file mirrors x, which is what the books' demo comes to (it mirrors z and
/// turns by π about y), and a right-handed z-up file swaps y and z. A file whose characters face the other way is turned by π about
/// the world's y.
pub fn world_from_model(handedness: Handedness, up_axis: UpAxis, front: Front) -> Affine3A {
    let upright = match up_axis {
        UpAxis::Y => Mat3A::IDENTITY,
        // A reflection: it changes handedness by itself.
        UpAxis::Z => Mat3A::from_cols(Vec3A::X, Vec3A::Z, Vec3A::Y),
    };
    let mirrors = (handedness == Handedness::Right) != (up_axis == UpAxis::Z);
    let mirror = Mat3A::from_diagonal(Vec3::new(if mirrors { -1.0 } else { 1.0 }, 1.0, 1.0));
    let turn = match front {
        Front::Negative => Mat3A::IDENTITY,
        Front::Positive => Mat3A::from_diagonal(Vec3::new(-1.0, 1.0, -1.0)),
    };
    Affine3A::from_mat3(glam::Mat3::from(turn * mirror * upright))
}
