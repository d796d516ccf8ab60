//! The photo studio: walls, panels of light, a window, floor.
//!
//! The viewer stands at −z and looks along +z; x is to the right, y up. Radiances are linear and in units where 1 shows
//! as white. Panels are small and bright, so that what shines has something to mirror, and walls are dim, so that the mean over
//! all directions stays near 0.37: with the lamp a base colour that faces it shows about as it is.

use glam::Vec3;

use super::cube::smoothstep;

/// Which studio: each theme of the page has one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Room {
    /// Dark walls.
    #[default]
    Dark,
    /// Bright walls, for a model before a bright page: what it mirrors all round is bright too.
    Bright,
}

/// The lights of a room that are not in its environment: what a white surface shows that faces one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoomLights {
    /// The lamp: a warm disc that casts the shadow.
    pub key: Vec3,
    /// Cool, without a shape, from behind.
    pub rim: Vec3,
}

impl Room {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Dark, Self::Bright];

    /// Its lamp and its rim light.
    pub fn lights(self) -> RoomLights {
        let (key, rim) = match self {
            Self::Dark => (0.60, 0.60),
            Self::Bright => (0.50, 0.35),
        };
        RoomLights {
            key: Vec3::new(1.00, 0.975, 0.93) * key,
            rim: Vec3::new(0.50, 0.66, 0.95) * rim,
        }
    }
}

/// Radiances of walls and panels.
struct Radiances {
    ceiling: Vec3,
    wall: Vec3,
    floor: Vec3,
    soft_box: Vec3,
    cloth: Vec3,
    left_strip: Vec3,
    right_strip: Vec3,
    window: Vec3,
}

const DARK: Radiances = Radiances {
    ceiling: Vec3::new(0.235, 0.242, 0.256),
    wall: Vec3::new(0.176, 0.180, 0.188),
    // A little warm.
    floor: Vec3::new(0.138, 0.130, 0.121),
    soft_box: Vec3::new(5.0, 4.9, 4.75),
    cloth: Vec3::new(0.60, 0.63, 0.67),
    left_strip: Vec3::new(6.0, 7.0, 8.0),
    right_strip: Vec3::new(4.5, 5.2, 6.0),
    window: Vec3::splat(10.0),
};

const BRIGHT: Radiances = Radiances {
    ceiling: Vec3::new(0.70, 0.71, 0.73),
    wall: Vec3::new(0.30, 0.305, 0.315),
    floor: Vec3::new(0.30, 0.29, 0.275),
    soft_box: Vec3::new(3.5, 3.43, 3.32),
    cloth: Vec3::new(0.60, 0.63, 0.67),
    left_strip: Vec3::new(4.2, 4.9, 5.6),
    right_strip: Vec3::new(3.15, 3.65, 4.2),
    window: Vec3::splat(7.0),
};

/// A rectangle of light, bright in its middle.
struct Panel {
    /// Unit vectors towards its middle, to its right and upwards, as seen from the middle of the set.
    towards: Vec3,
    right: Vec3,
    up: Vec3,
    /// Half its width and height, as tangents of the angles from its middle.
    half_size: [f32; 2],
    /// How far the edge fades, in the same unit.
    softness: f32,
    /// Half the width of the bars that cross it, in the same unit.
    bar: f32,
    /// In the middle.
    radiance: Vec3,
}

/// A room, ready to be looked at.
pub(super) struct Set {
    radiances: Radiances,
    panels: [Panel; 5],
}

impl Set {
    /// For cubes whose texels are so wide, radians: no edge is sharper than that, so that a coarse cube has as much light as a fine one.
    pub(super) fn new(room: Room, texel_radians: f32) -> Self {
        let radiances = match room {
            Room::Dark => DARK,
            Room::Bright => BRIGHT,
        };
        let panel = |towards: Vec3, half_size, softness: f32, bar, radiance| {
            let towards = towards.normalize();
            let right = Vec3::Y.cross(towards).normalize();
            Panel {
                towards,
                right,
                up: towards.cross(right),
                half_size,
                softness: softness.max(0.75 * texel_radians),
                bar,
                radiance,
            }
        };
        let panels = [
            // The soft box overhead in front, a little towards the lamp.
            panel(
                Vec3::new(0.34, 0.80, -0.52),
                [0.30, 0.20],
                0.03,
                0.0,
                radiances.soft_box,
            ),
            // The fill: a wall of cloth opposite to the lamp.
            panel(Vec3::new(-0.90, 0.12, -0.42), [0.62, 0.80], 0.42, 0.0, radiances.cloth),
            // Cool strips behind on both sides draw a line along the silhouette.
            panel(
                Vec3::new(-0.80, 0.30, 0.52),
                [0.035, 0.85],
                0.02,
                0.0,
                radiances.left_strip,
            ),
            panel(
                Vec3::new(0.84, 0.22, 0.50),
                [0.035, 0.75],
                0.02,
                0.0,
                radiances.right_strip,
            ),
            // A window with four panes, beside the viewer: what a visor and an eye show.
            panel(
                Vec3::new(0.50, 0.35, -0.79),
                [0.07, 0.10],
                0.012,
                0.009,
                radiances.window,
            ),
        ];
        Self { radiances, panels }
    }

    /// Radiance from a direction of unit length.
    pub(super) fn radiance(&self, direction: Vec3) -> Vec3 {
        let Radiances {
            ceiling, wall, floor, ..
        } = self.radiances;
        let y = direction.y;
        let above = wall.lerp(ceiling, smoothstep(0.05, 0.9, y));
        // The floor is lit from above: it darkens towards the walls, and where they meet is a line, which metal shows. It is so soft that a
        // coarse cube has it too.
        let ground = (floor * 0.45).lerp(floor, smoothstep(-0.05, -0.6, y));
        let room = ground.lerp(above, smoothstep(-0.12, 0.02, y));
        self.panels
            .iter()
            .fold(room, |behind, panel| panel.over(behind, direction))
    }
}

impl Panel {
    /// Radiance from a direction, with the panel in front of `behind`.
    fn over(&self, behind: Vec3, direction: Vec3) -> Vec3 {
        let facing = direction.dot(self.towards);
        if facing <= 0.0 {
            return behind;
        }
        let [width, height] = self.half_size;
        let x = direction.dot(self.right) / facing;
        let y = direction.dot(self.up) / facing;
        // Distance from the edge, negative inside; corners are round.
        let radius = self.softness.min(width).min(height);
        let (over_x, over_y) = (x.abs() - width + radius, y.abs() - height + radius);
        let outside = over_x.max(0.0).hypot(over_y.max(0.0));
        let mut distance = outside + over_x.max(over_y).min(0.0) - radius;
        if self.bar > 0.0 {
            distance = distance.max(self.bar - x.abs()).max(self.bar - y.abs());
        }
        let coverage = 1.0 - smoothstep(-self.softness, self.softness, distance);
        let from_middle = (x / width).powi(2) + (y / height).powi(2);
        let lamp = self.radiance * (0.62 + 0.38 * (-from_middle).exp());
        behind.lerp(lamp, coverage)
    }
}
