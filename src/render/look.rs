//! Colours of the surroundings and the place of the key light.

use glam::Vec3;

use crate::scene::{Theme, linear_from_srgb8};

/// Colours of one theme, sRGB.
pub(super) struct Look {
    /// Backdrop at its lightest.
    pub(super) backdrop_center: [u8; 3],
    /// Backdrop far from there.
    pub(super) backdrop_edge: [u8; 3],
    pub(super) grid_minor: [u8; 3],
    pub(super) grid_minor_opacity: f32,
    pub(super) grid_major: [u8; 3],
    pub(super) grid_major_opacity: f32,
    /// Share of the ground's light that the shadow takes.
    pub(super) shadow_strength: f32,
}

const DARK: Look = Look {
    backdrop_center: [0x33, 0x38, 0x42],
    backdrop_edge: [0x14, 0x16, 0x1A],
    grid_minor: [0x6B, 0x76, 0x8A],
    grid_minor_opacity: 0.24,
    grid_major: [0x7E, 0x8B, 0xA2],
    grid_major_opacity: 0.36,
    shadow_strength: 0.66,
};

const LIGHT: Look = Look {
    backdrop_center: [0xF4, 0xF5, 0xF7],
    backdrop_edge: [0xCF, 0xD4, 0xDC],
    grid_minor: [0x8A, 0x90, 0x9C],
    grid_minor_opacity: 0.5,
    grid_major: [0x5B, 0x63, 0x70],
    grid_major_opacity: 0.7,
    shadow_strength: 0.6,
};

/// The look of a theme.
pub(super) fn look(theme: Theme) -> &'static Look {
    match theme {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    }
}

/// Unit vector towards the key light: high, from the right of one who looks at the front, a little to that side.
pub(super) fn to_key() -> Vec3 {
    Vec3::new(0.62, 0.72, -0.31).normalize()
}

/// An encoded colour, 0…1 a channel.
pub(super) fn encoded(srgb: [u8; 3]) -> [f32; 3] {
    srgb.map(|channel| f32::from(channel) / 255.0)
}

/// A linear colour with opacity.
pub(super) fn linear(srgb: [u8; 3], opacity: f32) -> [f32; 4] {
    let [red, green, blue] = srgb.map(linear_from_srgb8);
    [red, green, blue, opacity]
}
