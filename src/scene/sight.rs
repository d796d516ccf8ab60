//! What of the world a picture shows, and how large.

use glam::{Vec2, Vec3};

use super::{Camera, Projection};

/// The room that a picture shows, without its near and far end.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    eye: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// Half the picture's width and height, world units: at the eye, and what is added in a unit of depth.
    half_at_eye: Vec2,
    half_per_depth: Vec2,
    /// How far a sphere reaches along the picture toward a slanting side, in radii.
    reach: Vec2,
}

impl Sight {
    /// The room that a camera shows in a picture of `aspect` = width / height.
    pub fn of(camera: &Camera, aspect: f32) -> Self {
        let half_height = camera.height_in_view() * 0.5;
        let half = Vec2::new(half_height * aspect, half_height);
        let (half_at_eye, half_per_depth) = match camera.projection {
            Projection::Perspective { .. } => (Vec2::ZERO, half / camera.distance),
            Projection::Orthographic => (half, Vec2::ZERO),
        };
        Self {
            eye: camera.eye(),
            right: camera.right(),
            up: camera.up(),
            forward: camera.forward(),
            half_at_eye,
            half_per_depth,
            reach: half_per_depth.map(|slope| slope.hypot(1.0)),
        }
    }

    /// Whether some of a sphere may be in the picture. Close to a corner it may say yes where the answer is no.
    pub fn shows(&self, center: Vec3, radius: f32) -> bool {
        let from_eye = center - self.eye;
        let depth = from_eye.dot(self.forward);
        let aside = Vec2::new(from_eye.dot(self.right), from_eye.dot(self.up)).abs();
        let is_behind = depth < -radius && self.half_per_depth != Vec2::ZERO;
        !is_behind
            && aside
                .cmple(self.half_at_eye + self.half_per_depth * depth + self.reach * radius)
                .all()
    }

    /// The height of a sphere as a fraction of the picture's; infinite at the eye.
    pub fn height_of(&self, center: Vec3, radius: f32) -> f32 {
        let depth = (center - self.eye).dot(self.forward).max(0.0);
        radius / (self.half_at_eye.y + self.half_per_depth.y * depth)
    }
}
