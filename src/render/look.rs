//! Colours of the surroundings and the places of the lights.

use glam::{Quat, Vec3};

use crate::scene::{Camera, Theme, linear_from_srgb8};

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
    /// Share of the ground's light that the nearness of the model takes.
    pub(super) contact_strength: f32,
    /// Edges of triangles, with opacity.
    pub(super) wire: [u8; 3],
    pub(super) wire_opacity: f32,
    /// A part that stands out.
    pub(super) accent: [u8; 3],
}

const DARK: Look = Look {
    backdrop_center: [0x33, 0x38, 0x42],
    backdrop_edge: [0x14, 0x16, 0x1A],
    grid_minor: [0x6B, 0x76, 0x8A],
    grid_minor_opacity: 0.24,
    grid_major: [0x7E, 0x8B, 0xA2],
    grid_major_opacity: 0.36,
    shadow_strength: 0.60,
    contact_strength: 0.85,
    wire: [0xE7, 0xEA, 0xF0],
    wire_opacity: 0.28,
    accent: [0x5A, 0xA9, 0xFF],
};

const LIGHT: Look = Look {
    backdrop_center: [0xF4, 0xF5, 0xF7],
    backdrop_edge: [0xCF, 0xD4, 0xDC],
    grid_minor: [0x8A, 0x90, 0x9C],
    grid_minor_opacity: 0.5,
    grid_major: [0x5B, 0x63, 0x70],
    grid_major_opacity: 0.7,
    shadow_strength: 0.5,
    contact_strength: 0.7,
    wire: [0x1B, 0x20, 0x29],
    wire_opacity: 0.4,
    accent: [0x17, 0x69, 0xD2],
};

/// The look of a theme.
pub(super) fn look(theme: Theme) -> &'static Look {
    match theme {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    }
}

/// Where the studio's lights stand. They keep their place beside the viewer, as if the model stood on a turntable: whichever
/// side is looked at is lit well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StudioLights {
    /// Unit vector towards the key: high over the viewer's right shoulder.
    pub(super) to_key: Vec3,
    /// Unit vector towards the rim: behind the model, from the left.
    pub(super) to_rim: Vec3,
}

impl StudioLights {
    /// The studio as a whole may be turned about y, with all that stands in it.
    pub(super) fn beside(camera: &Camera, turn_radians: f32) -> Self {
        let turn = Quat::from_rotation_y(turn_radians);
        let right = camera.right();
        let ahead = right.cross(Vec3::Y);
        let towards = |x: f32, y: f32, z: f32| turn * (right * x + Vec3::Y * y + ahead * z).normalize();
        Self {
            to_key: towards(0.64, 0.74, -0.34),
            to_rim: towards(-0.72, 0.36, 0.58),
        }
    }
}

/// The directions in which the three lights of the books' demo shine, before they turn.
const BOOK_DIRECTIONS: [Vec3; 3] = [
    Vec3::new(0.57735, -0.57735, 0.57735),
    Vec3::new(-0.57735, -0.57735, 0.57735),
    Vec3::new(0.0, -0.707, -0.707),
];

/// Unit vectors towards the three lights of the books' demo, turned about y.
pub(super) fn to_book_lights(turn_radians: f32) -> [Vec3; 3] {
    let turn = Quat::from_rotation_y(turn_radians);
    BOOK_DIRECTIONS.map(|direction| turn * -direction.normalize())
}

/// An encoded opaque colour, 0…1 a channel.
pub(super) fn encoded([red, green, blue]: [u8; 3]) -> [f32; 4] {
    [red, green, blue, 255].map(|channel| f32::from(channel) / 255.0)
}

/// A linear colour with opacity.
pub(super) fn linear(srgb: [u8; 3], opacity: f32) -> [f32; 4] {
    let [red, green, blue] = srgb.map(linear_from_srgb8);
    [red, green, blue, opacity]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Projection;

    /// As the demo's `XMMatrixRotationY` does it: z goes towards x.
    #[test]
    fn the_books_lights_turn_about_y() {
        let (quarter, s) = (std::f32::consts::FRAC_PI_2, std::f32::consts::FRAC_1_SQRT_2);
        let expected = [
            [(-0.57735, 0.57735, -0.57735), (0.57735, 0.57735, -0.57735), (0.0, s, s)],
            [(-0.57735, 0.57735, 0.57735), (-0.57735, 0.57735, -0.57735), (s, s, 0.0)],
            [(0.57735, 0.57735, 0.57735), (-0.57735, 0.57735, 0.57735), (0.0, s, -s)],
        ];
        for (turns, expected) in (0..).zip(expected) {
            let found = to_book_lights(quarter * turns as f32);
            for (found, (x, y, z)) in found.into_iter().zip(expected) {
                assert!(
                    found.abs_diff_eq(Vec3::new(x, y, z), 1e-4),
                    "{found} after {turns} quarters"
                );
            }
        }
    }

    #[test]
    fn the_key_is_above_to_the_right_and_before_the_model_from_every_side() {
        for yaw_radians in [0.0, 1.0, 2.5, -3.0] {
            let camera = Camera {
                target: Vec3::ZERO,
                distance: 1.0,
                yaw_radians,
                pitch_radians: 0.3,
                projection: Projection::Orthographic,
            };
            let StudioLights { to_key, to_rim } = StudioLights::beside(&camera, 0.0);
            assert!(to_key.y > 0.5 && to_key.dot(camera.right()) > 0.4 && to_key.dot(camera.forward()) < -0.3);
            assert!(to_rim.dot(camera.right()) < -0.4 && to_rim.dot(camera.forward()) > 0.3);
        }
    }
}
