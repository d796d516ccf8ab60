//! An orbiting camera in the world (left-handed, y up).

use glam::{Mat4, Vec2, Vec3};

use super::Aabb;

/// How depth becomes size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Things far away look smaller.
    Perspective {
        /// Vertical field of view.
        fov_y_radians: f32,
    },
    /// Parallel lines stay parallel; the height in view follows the distance.
    Orthographic,
}

/// Looks at `target` from a distance. `yaw` 0 looks along +z, seeing the front of a model that faces −z; positive yaw
/// moves the eye to the model's left (+x when yaw is −π/2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Point looked at, world space.
    pub target: Vec3,
    /// Distance from eye to target, world units, above 0.
    pub distance: f32,
    /// Turn about y, radians.
    pub yaw_radians: f32,
    /// Lift above the horizon, radians, −π/2…π/2.
    pub pitch_radians: f32,
    /// How depth becomes size.
    pub projection: Projection,
}

impl Camera {
    /// Unit vector from the eye to the target.
    pub fn forward(&self) -> Vec3 {
        let (sin_yaw, cos_yaw) = self.yaw_radians.sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch_radians.sin_cos();
        Vec3::new(sin_yaw * cos_pitch, -sin_pitch, cos_yaw * cos_pitch)
    }

    /// Eye in the world.
    pub fn eye(&self) -> Vec3 {
        self.target - self.forward() * self.distance
    }

    /// Unit vector to the right of the picture.
    pub fn right(&self) -> Vec3 {
        let (sin_yaw, cos_yaw) = self.yaw_radians.sin_cos();
        Vec3::new(cos_yaw, 0.0, -sin_yaw)
    }

    /// Unit vector to the top of the picture.
    pub fn up(&self) -> Vec3 {
        self.forward().cross(self.right())
    }

    /// World -> view (x right, y up, z forward: left-handed).
    pub fn view_from_world(&self) -> Mat4 {
        let (right, up, forward, eye) = (self.right(), self.up(), self.forward(), self.eye());
        Mat4::from_cols(
            right.extend(0.0),
            up.extend(0.0),
            forward.extend(0.0),
            Vec3::ZERO.extend(1.0),
        )
        .transpose()
            * Mat4::from_translation(-eye)
    }

    /// Near and far planes that never cut a scene box: distances along the view from the eye, `0 < near < far`.
    pub fn depth_range(&self, world_bounds: &Aabb) -> (f32, f32) {
        let radius = world_bounds.radius().max(1e-6);
        let to_center = (world_bounds.center() - self.eye()).dot(self.forward());
        let far = (to_center + radius).max(self.distance) * 1.01 + radius;
        let near = (to_center - radius * 1.5).max(far * 1e-4);
        (near, far)
    }
    // clip_from_view, framing, orbit, pan, zoom follow.

    /// Movement of the target for a drag of `pixels` in a view of `height_pixels`.
    pub fn pan_offset(&self, pixels: Vec2, height_pixels: f32) -> Vec3 {
        let per_pixel = self.height_in_view() / height_pixels.max(1.0);
        (self.up() * pixels.y - self.right() * pixels.x) * per_pixel
    }

    /// World height that the view shows at the target's distance.
    pub fn height_in_view(&self) -> f32 {
        match self.projection {
            Projection::Perspective { fov_y_radians } => 2.0 * self.distance * (fov_y_radians * 0.5).tan(),
            Projection::Orthographic => self.distance,
        }
    }

    /// View -> clip (depth 0…1) for an aspect ratio of width / height.
    pub fn clip_from_view(&self, aspect: f32, world_bounds: &Aabb) -> Mat4 {
        let (near, far) = self.depth_range(world_bounds);
        match self.projection {
            Projection::Perspective { fov_y_radians } => {
                glam::camera::lh::proj::directx::perspective(fov_y_radians, aspect, near, far)
            }
            Projection::Orthographic => {
                let half_height = self.height_in_view() * 0.5;
                let half_width = half_height * aspect;
                glam::camera::lh::proj::directx::orthographic(
                    -half_width,
                    half_width,
                    -half_height,
                    half_height,
                    near,
                    far,
                )
            }
        }
    }
}
