//! An orbiting camera in the world (left-handed, y up).

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, FRAC_PI_6, PI, TAU};

use glam::camera::lh::proj::directx;
use glam::{Mat4, Vec2, Vec3};

use super::{Aabb, Light};
use crate::modes::modes;

/// Field of view of the perspective view: 30°, as a portrait is taken.
pub const DEFAULT_FOV_Y_RADIANS: f32 = FRAC_PI_6;
/// The same under the light of the books' demos, which have it: 45°.
const BOOK_FOV_Y_RADIANS: f32 = FRAC_PI_4;

/// The greatest pitch, radians: a little less than straight up, so that "right" stays defined while dragging.
pub const MAX_PITCH_RADIANS: f32 = FRAC_PI_2 - 1e-3;

/// Distances at which sizes in view stay finite.
pub(super) const LEAST_DISTANCE: f32 = f32::MIN_POSITIVE * 1e6;
pub(super) const GREATEST_DISTANCE: f32 = f32::MAX * 1e-6;

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
    /// Yaw and pitch of [`Camera`], radians. The front of a model faces −z.
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

/// How size in the picture depends on depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Things far away look smaller.
    Perspective {
        /// Vertical field of view.
        fov_y_radians: f32,
    },
    /// Parallel lines stay parallel; the height in view is the one that the studio's perspective view has at the target.
    Orthographic,
}

/// Looks at `target` from a distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Point looked at, world space.
    pub target: Vec3,
    /// Distance from eye to target, world units, above 0.
    pub distance: f32,
    /// Turn about y, radians. At 0 the eye is on the −z side and looks along +z; at π/2 it looks along +x.
    pub yaw_radians: f32,
    /// Lift of the eye above the horizon, radians, −π/2…π/2.
    pub pitch_radians: f32,
    /// How size in the picture depends on depth.
    pub projection: Projection,
}

impl Projection {
    /// The perspective view under a light.
    pub fn perspective(light: Light) -> Self {
        Self::Perspective {
            fov_y_radians: match light {
                Light::Studio => DEFAULT_FOV_Y_RADIANS,
                Light::Book => BOOK_FOV_Y_RADIANS,
            },
        }
    }
}

impl Default for Camera {
    fn default() -> Self {
        let (yaw_radians, pitch_radians) = ViewPreset::ThreeQuarter.yaw_pitch_radians();
        let projection = Projection::perspective(Light::Studio);
        Self {
            target: Vec3::ZERO,
            distance: 4.0,
            yaw_radians,
            pitch_radians,
            projection,
        }
    }
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
        let view_axes = Mat4::from_cols(
            self.right().extend(0.0),
            self.up().extend(0.0),
            self.forward().extend(0.0),
            glam::Vec4::W,
        );
        view_axes.transpose() * Mat4::from_translation(-self.eye())
    }

    /// Changes how size depends on depth. What is at the target keeps its size in the picture.
    pub fn set_projection(&mut self, projection: Projection) {
        let height = self.height_in_view();
        self.projection = projection;
        self.distance *= height / self.height_in_view();
    }

    /// World height that the picture shows at the target's distance.
    pub fn height_in_view(&self) -> f32 {
        let fov_y_radians = match self.projection {
            Projection::Perspective { fov_y_radians } => fov_y_radians,
            Projection::Orthographic => DEFAULT_FOV_Y_RADIANS,
        };
        2.0 * self.distance * (fov_y_radians * 0.5).tan()
    }

    /// Distances of the near and far planes along the view, so that they never cut what `world_bounds` holds:
    /// `near < far`; near is above 0 in perspective and may be negative in an orthographic view.
    pub fn depth_range(&self, world_bounds: &Aabb) -> (f32, f32) {
        let radius = world_bounds.radius().max(self.distance * 1e-3);
        let to_center = (world_bounds.center() - self.eye()).dot(self.forward());
        let far = (to_center + radius * 1.1).max(self.distance);
        match self.projection {
            Projection::Perspective { .. } => ((to_center - radius * 1.1).max(far * 1e-3), far),
            Projection::Orthographic => ((to_center - radius * 1.1).min(0.0), far),
        }
    }

    /// View -> clip (depth 0…1) for an aspect ratio of width / height.
    pub fn clip_from_view(&self, aspect: f32, world_bounds: &Aabb) -> Mat4 {
        let (near, far) = self.depth_range(world_bounds);
        match self.projection {
            Projection::Perspective { fov_y_radians } => directx::perspective(fov_y_radians, aspect, near, far),
            Projection::Orthographic => {
                let half_height = self.height_in_view() * 0.5;
                let half_width = half_height * aspect;
                directx::orthographic(-half_width, half_width, -half_height, half_height, near, far)
            }
        }
    }

    /// Turns about the target. Positive yaw moves the eye to its left, positive pitch lifts it. Angles that are not
    /// finite are ignored.
    pub fn orbit(&mut self, yaw_radians: f32, pitch_radians: f32) {
        if !(yaw_radians.is_finite() && pitch_radians.is_finite()) {
            return;
        }
        self.yaw_radians = (self.yaw_radians + yaw_radians).rem_euclid(TAU);
        self.pitch_radians = (self.pitch_radians + pitch_radians).clamp(-MAX_PITCH_RADIANS, MAX_PITCH_RADIANS);
    }

    /// Moves the target so that what lies at its depth follows a drag. `drag` is in fractions of the picture's height,
    /// x to the right and y down. A drag that leads to a target that is not finite is ignored.
    pub fn pan(&mut self, drag: Vec2) {
        self.move_target((self.up() * drag.y - self.right() * drag.x) * self.height_in_view());
    }

    pub(super) fn move_target(&mut self, way: Vec3) {
        if (self.target + way).is_finite() {
            self.target += way;
        }
    }

    /// Scales the distance by `factor` (below 1 comes nearer), and keeps the point under the pointer in its place, in
    /// the plane of the target. `pointer` is in fractions of the picture's height from its centre, x to the right and y
    /// down. NaN is ignored.
    pub fn zoom(&mut self, factor: f32, pointer: Vec2) {
        if factor.is_nan() {
            return;
        }
        let height_before = self.height_in_view();
        self.distance = (self.distance * factor).clamp(LEAST_DISTANCE, GREATEST_DISTANCE);
        let shrunk = height_before - self.height_in_view();
        self.move_target((self.right() * pointer.x - self.up() * pointer.y) * shrunk);
    }

    /// Looks from a preset's direction; target and distance stay.
    pub fn look_from(&mut self, preset: ViewPreset) {
        (self.yaw_radians, self.pitch_radians) = preset.yaw_pitch_radians();
    }
}
