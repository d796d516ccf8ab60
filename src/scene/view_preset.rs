//! Named directions to look from.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Straight up and down are left out by a hair, so that "right" stays defined while dragging.
pub(super) const MAX_PITCH_RADIANS: f32 = FRAC_PI_2 - 1e-3;

/// A named direction to look from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ViewPreset {
    /// A little to the side and from above: how a model is shown first.
    ThreeQuarter,
    /// The model's front.
    Front,
    /// The model's back.
    Back,
    /// The model's right side.
    Right,
    /// The model's left side.
    Left,
    /// From above.
    Top,
    /// From below.
    Bottom,
    /// Equal angles to all three axes.
    Isometric,
}

impl ViewPreset {
    /// All presets, in the order of menus.
    pub const ALL: [Self; 8] = [
        Self::ThreeQuarter,
        Self::Front,
        Self::Back,
        Self::Right,
        Self::Left,
        Self::Top,
        Self::Bottom,
        Self::Isometric,
    ];

    /// Name for menus.
    pub fn label(self) -> &'static str {
        match self {
            Self::ThreeQuarter => "Three-quarter",
            Self::Front => "Front",
            Self::Back => "Back",
            Self::Right => "Right",
            Self::Left => "Left",
            Self::Top => "Top",
            Self::Bottom => "Bottom",
            Self::Isometric => "Isometric",
        }
    }

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
