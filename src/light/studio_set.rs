//! The photo studio: walls, panels of light, floor.
//!
//! The viewer stands at −z and looks along +z; x is to the right, y up. Radiances are linear and in units where 1 shows
//! as white. The mean over all directions is near 0.4, so that with the key light a base colour shows about as it is.

use glam::Vec3;

use super::cube::smoothstep;

/// The ceiling: pale.
const CEILING: Vec3 = Vec3::new(0.335, 0.345, 0.365);
/// The walls: dim.
const WALL: Vec3 = Vec3::new(0.23, 0.235, 0.245);
/// The floor: darker, and a little warm.
const FLOOR: Vec3 = Vec3::new(0.185, 0.175, 0.163);

/// A rectangle of light, bright in its middle and soft at its edges.
struct Panel {
    /// Towards its middle, any length.
    towards: Vec3,
    /// Half its width and height, as tangents of the angles from its middle.
    half_size: (f32, f32),
    /// How far the edge fades, in the same unit.
    softness: f32,
    /// In the middle.
    radiance: Vec3,
}

/// Every panel of the set.
const PANELS: [Panel; 4] = [
    // The large soft box overhead in front, a little towards the key.
    Panel {
        towards: Vec3::new(0.34, 0.80, -0.52),
        half_size: (0.72, 0.48),
        softness: 0.17,
        radiance: Vec3::new(1.95, 1.91, 1.85),
    },
    // The fill: a wall of cloth opposite to the key.
    Panel {
        towards: Vec3::new(-0.90, 0.12, -0.42),
        half_size: (0.62, 0.80),
        softness: 0.42,
        radiance: Vec3::new(0.68, 0.71, 0.76),
    },
    // Cool strips behind on both sides draw a line along the silhouette.
    Panel {
        towards: Vec3::new(-0.80, 0.30, 0.52),
        half_size: (0.15, 0.85),
        softness: 0.11,
        radiance: Vec3::new(1.45, 1.72, 2.15),
    },
    Panel {
        towards: Vec3::new(0.84, 0.22, 0.50),
        half_size: (0.12, 0.75),
        softness: 0.10,
        radiance: Vec3::new(1.05, 1.22, 1.50),
    },
];

/// Radiance from a direction of unit length.
pub(super) fn radiance(direction: Vec3) -> Vec3 {
    let above = WALL.lerp(CEILING, smoothstep(0.0, 0.9, direction.y));
    let room = FLOOR.lerp(above, smoothstep(-0.45, 0.12, direction.y));
    PANELS.iter().fold(room, |behind, panel| panel.over(behind, direction))
}

impl Panel {
    /// Radiance from a direction, with the panel in front of `behind`.
    fn over(&self, behind: Vec3, direction: Vec3) -> Vec3 {
        let towards = self.towards.normalize();
        let facing = direction.dot(towards);
        if facing <= 0.0 {
            return behind;
        }
        // Sides as seen from the middle of the set, upright.
        let right = Vec3::Y.cross(towards).normalize();
        let up = towards.cross(right);
        let (width, height) = self.half_size;
        let x = direction.dot(right) / facing;
        let y = direction.dot(up) / facing;
        // Distance from the edge, negative inside; corners are round.
        let radius = self.softness.min(width).min(height);
        let (over_x, over_y) = (x.abs() - width + radius, y.abs() - height + radius);
        let outside = over_x.max(0.0).hypot(over_y.max(0.0));
        let distance = outside + over_x.max(over_y).min(0.0) - radius;
        let coverage = 1.0 - smoothstep(-self.softness, self.softness, distance);
        let from_middle = (x / width).powi(2) + (y / height).powi(2);
        let lamp = self.radiance * (0.62 + 0.38 * (-from_middle).exp());
        behind.lerp(lamp, coverage)
    }
}
