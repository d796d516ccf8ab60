//! Named directions to look from.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use crate::modes::modes;

/// Straight up and down are left out by a hair, so that "right" stays defined while dragging.
pub(super) const MAX_PITCH_RADIANS: f32 = FRAC_PI_2 - 1e-3;

modes! {
    /// A named direction to look from.
    pub enum ViewPreset {
        /// A little to the side and from above: how a model is shown first.
        ThreeQuarter = "three-quarter", "Three-quarter";
        /// The model's front.
        Front = "front", "Front";
        /// The model's back.
        Back = "back", "Back";
        /// The model's right side.
        Right = "right", "Right";
        /// The model's left side.
        Left = "left", "Left";
        /// From above.
        Top = "top", "Top";
        /// From below.
        Bottom = "bottom", "Bottom";
        /// Equal angles to all three axes.
        Isometric = "isometric", "Isometric";
    }
}

impl ViewPreset {
    /// Yaw and pitch of [`Camera`](super::Camera), radians. The front of a model faces −z.
    pub fn yaw_pitch_radians(self) -> (f32, f32) {
        match self {
            Self::ThreeQuarter => (-0.62, 0.2),
            Self::Front => (0.0, 0.0),
            Self::Back => (PI, 0.0),
            Self::Right => (FRAC_PI_2, 0.0),
            Self::Left => (-FRAC_PI_2, 0.0),
            Self::Top => (0.0, MAX_PITCH_RADIANS),
            Self::Bottom => (0.0, -MAX_PITCH_RADIANS),
            // atan(1/√2): the lift at which the three axes look equally long.
            Self::Isometric => (-FRAC_PI_4, 0.615_479_7),
        }
    }
}
