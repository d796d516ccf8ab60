//! Flying through the scene: the eye moves and turns, instead of orbiting the target.

use glam::Vec3;

use super::{Camera, Projection};

impl Camera {
    /// Moves eye and target: `way` is to the right of the picture, up in the world, and forward, in world units. In an
    /// orthographic view, where coming nearer changes nothing, the picture is enlarged instead. A way that is not
    /// finite is ignored.
    pub fn fly(&mut self, way: Vec3) {
        let sideways = self.right() * way.x + Vec3::Y * way.y;
        match self.projection {
            Projection::Perspective { .. } => self.move_target(sideways + self.forward() * way.z),
            Projection::Orthographic => {
                self.move_target(sideways);
                self.zoom((-way.z / self.distance).exp(), glam::Vec2::ZERO);
            }
        }
    }

    /// Turns the head: the eye stays and the target goes round it. Positive yaw looks to the right, positive pitch up.
    /// Angles that are not finite are ignored.
    pub fn look_around(&mut self, yaw_radians: f32, pitch_radians: f32) {
        let eye = self.eye();
        self.orbit(yaw_radians, -pitch_radians);
        let target = eye + self.forward() * self.distance;
        if target.is_finite() {
            self.target = target;
        }
    }
}
