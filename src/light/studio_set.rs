//! The photo studio: walls, panels of light, a window, floor.
//!
//! The viewer stands at −z and looks along +z; x is to the right, y up. Radiances are linear and in units where 1 shows
//! as white. In the dark room panels are small and bright, so that what shines has something to mirror, and walls are dim, so that the mean over
//! all directions is about 0.35: with the lamp a base colour that faces it shows about as it is. The bright room has bright
//! walls and nearly as strong a lamp; its mean is 0.54. In both the side that faces the lamp is between two and a half and three times as bright
//! as the one in shadow.

use glam::{Mat3, Vec3};

use super::cube::smoothstep;

/// Which studio: each theme of the page has one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Room {
    /// Dark walls.
    #[default]
    Dark,
    /// Bright walls, for a model before a bright page: what it mirrors along its edge is bright too.
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
            Self::Bright => (0.58, 0.35),
        };
        RoomLights {
            key: Vec3::new(1.00, 0.975, 0.93) * key,
            rim: Vec3::new(0.50, 0.66, 0.95) * rim,
        }
    }
}

/// What is behind the panels.
struct Walls {
    ceiling: Vec3,
    wall: Vec3,
    floor: Vec3,
    /// What the side behind the viewer has of that: where it is dark, what is round and smooth is dark in its middle, bright towards its edge
    /// and shows the panels, as things are photographed before white.
    behind_viewer: f32,
}

const DARK: Walls = Walls {
    ceiling: Vec3::new(0.235, 0.242, 0.256),
    wall: Vec3::new(0.176, 0.180, 0.188),
    // A little warm.
    floor: Vec3::new(0.138, 0.130, 0.121),
    behind_viewer: 1.0,
};

const BRIGHT: Walls = Walls {
    ceiling: Vec3::new(0.552, 0.56, 0.571),
    wall: Vec3::new(0.449, 0.456, 0.467),
    floor: Vec3::new(0.721, 0.70, 0.662),
    behind_viewer: 0.24,
};

/// A rectangle of light, bright in its middle, upright.
#[derive(Clone, Copy)]
struct Panel {
    /// Towards its middle, as seen from the middle of the set; of any length.
    towards: Vec3,
    /// Half its width and height, as tangents of the angles from its middle.
    half_size: [f32; 2],
    /// How far the edge fades, in the same unit.
    softness: f32,
    /// Half the width of the bars that cross it, in the same unit.
    bar: f32,
    /// In the middle.
    radiance: Vec3,
}

/// In front: a soft box overhead, a little towards the lamp; opposite to the lamp the fill, a wall of cloth; a window with four panes, beside the
/// viewer: what a visor and an eye show.
const DARK_PANELS: [Panel; 3] = [
    Panel {
        towards: Vec3::new(0.34, 0.80, -0.52),
        half_size: [0.30, 0.20],
        softness: 0.03,
        bar: 0.0,
        radiance: Vec3::new(5.0, 4.9, 4.75),
    },
    Panel {
        towards: Vec3::new(-0.90, 0.12, -0.42),
        half_size: [0.62, 0.80],
        softness: 0.42,
        bar: 0.0,
        radiance: Vec3::new(0.60, 0.63, 0.67),
    },
    Panel {
        towards: Vec3::new(0.50, 0.35, -0.79),
        half_size: [0.07, 0.10],
        softness: 0.012,
        bar: 0.009,
        radiance: Vec3::splat(10.0),
    },
];

/// The same three. The fill is a second soft box, whose clear edge metal mirrors; the window is larger.
const BRIGHT_PANELS: [Panel; 3] = [
    Panel {
        towards: Vec3::new(0.30, 0.86, -0.42),
        half_size: [0.28, 0.21],
        softness: 0.05,
        bar: 0.0,
        radiance: Vec3::new(2.70, 2.66, 2.58),
    },
    Panel {
        towards: Vec3::new(-0.74, 0.42, -0.50),
        half_size: [0.11, 0.36],
        softness: 0.05,
        bar: 0.0,
        radiance: Vec3::new(2.26, 2.30, 2.36),
    },
    Panel {
        towards: Vec3::new(0.58, 0.30, -0.76),
        half_size: [0.13, 0.19],
        softness: 0.02,
        bar: 0.011,
        radiance: Vec3::splat(7.2),
    },
];

/// Behind the model, on both sides: cool strips draw a line along the silhouette. As bright as in the dark room.
const STRIPS: [Panel; 2] = [
    Panel {
        towards: Vec3::new(-0.80, 0.30, 0.52),
        half_size: [0.035, 0.85],
        softness: 0.02,
        bar: 0.0,
        radiance: Vec3::new(6.0, 7.0, 8.0),
    },
    Panel {
        towards: Vec3::new(0.84, 0.22, 0.50),
        half_size: [0.035, 0.75],
        softness: 0.02,
        bar: 0.0,
        radiance: Vec3::new(4.5, 5.2, 6.0),
    },
];
/// How bright the strips are in the bright room, as a fraction of that.
const BRIGHT_STRIPS: f32 = 0.7;

/// A room, ready to be looked at.
pub(super) struct Set {
    walls: Walls,
    /// Each with unit vectors to its right, upwards and towards it.
    panels: Vec<(Panel, Mat3)>,
}

impl Set {
    /// For cubes whose texels are so wide, radians: no edge is sharper than that, so that a coarse cube has as much light as a fine one.
    pub(super) fn new(room: Room, texel_radians: f32) -> Self {
        let (walls, panels, strips) = match room {
            Room::Dark => (DARK, DARK_PANELS, 1.0),
            Room::Bright => (BRIGHT, BRIGHT_PANELS, BRIGHT_STRIPS),
        };
        let behind = STRIPS.map(|strip| Panel {
            radiance: strip.radiance * strips,
            ..strip
        });
        let panels = panels.into_iter().chain(behind).map(|panel| {
            let softness = panel.softness.max(0.75 * texel_radians);
            (Panel { softness, ..panel }, panel.axes())
        });
        Self {
            walls,
            panels: panels.collect(),
        }
    }

    /// Radiance from a direction of unit length.
    pub(super) fn radiance(&self, direction: Vec3) -> Vec3 {
        let Walls {
            ceiling,
            wall,
            floor,
            behind_viewer,
        } = self.walls;
        let y = direction.y;
        let above = wall.lerp(ceiling, smoothstep(0.05, 0.9, y));
        // The floor is lit from above: it darkens towards the walls, and where they meet is a line, which metal shows. It is so soft that a
        // coarse cube has it too.
        let ground = (floor * 0.45).lerp(floor, smoothstep(-0.05, -0.6, y));
        let room = ground.lerp(above, smoothstep(-0.12, 0.02, y));
        let room = room * (behind_viewer + (1.0 - behind_viewer) * smoothstep(-0.85, 0.25, direction.z));
        self.panels
            .iter()
            .fold(room, |behind, (panel, axes)| panel.over(behind, axes, direction))
    }
}

impl Panel {
    /// Unit vectors to its right, upwards and towards it.
    fn axes(&self) -> Mat3 {
        let towards = self.towards.normalize();
        let right = Vec3::Y.cross(towards).normalize();
        Mat3::from_cols(right, towards.cross(right), towards)
    }

    /// Radiance from a direction, with the panel in front of `behind`.
    fn over(&self, behind: Vec3, axes: &Mat3, direction: Vec3) -> Vec3 {
        let facing = direction.dot(axes.z_axis);
        if facing <= 0.0 {
            return behind;
        }
        let [width, height] = self.half_size;
        let x = direction.dot(axes.x_axis) / facing;
        let y = direction.dot(axes.y_axis) / facing;
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
