//! An orbiting camera in the world (left-handed, y up).

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use glam::camera::lh::proj::directx;
use glam::{Mat4, Vec2, Vec3};

use super::Aabb;

/// Field of view of the perspective view: π/4, as in the books' demo.
pub const DEFAULT_FOV_Y_RADIANS: f32 = FRAC_PI_4;

/// Straight up and down are left out by a hair, so that "right" stays defined while dragging.
const MAX_PITCH_RADIANS: f32 = FRAC_PI_2 - 1e-3;

/// Share of the picture's height and width that framing leaves to the model.
const FRAMED_SHARE: f32 = 0.9;

/// Rounds of fitting and centring, which need each other in perspective: the last moves things by less than a thousandth of the picture.
const FRAMING_ROUNDS: usize = 8;

/// Distances at which sizes in view are still numbers.
const LEAST_DISTANCE: f32 = f32::MIN_POSITIVE * 1e6;
const GREATEST_DISTANCE: f32 = f32::MAX * 1e-6;

/// How depth becomes size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Things far away look smaller.
    Perspective {
        /// Vertical field of view.
        fov_y_radians: f32,
    },
    /// Parallel lines stay parallel; the height in view is the one that the perspective view has at the target.
    Orthographic,
}

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

/// Margins of a picture that are covered, for example by panels: shares of its width and height, 0…1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Insets {
    /// Covered share of the width on the left.
    pub left: f32,
    /// Covered share of the width on the right.
    pub right: f32,
    /// Covered share of the height at the top.
    pub top: f32,
    /// Covered share of the height at the bottom.
    pub bottom: f32,
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
    /// How depth becomes size.
    pub projection: Projection,
}

impl Default for Camera {
    fn default() -> Self {
        let (yaw_radians, pitch_radians) = ViewPreset::ThreeQuarter.yaw_pitch_radians();
        let projection = Projection::Perspective {
            fov_y_radians: DEFAULT_FOV_Y_RADIANS,
        };
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

    /// Turns about the target. Positive yaw moves the eye to its left, positive pitch lifts it. Angles that are not finite
    /// are left out.
    pub fn orbit(&mut self, yaw_radians: f32, pitch_radians: f32) {
        if !(yaw_radians.is_finite() && pitch_radians.is_finite()) {
            return;
        }
        self.yaw_radians = (self.yaw_radians + yaw_radians).rem_euclid(TAU);
        self.pitch_radians = (self.pitch_radians + pitch_radians).clamp(-MAX_PITCH_RADIANS, MAX_PITCH_RADIANS);
    }

    /// Moves the target so that what lies at its depth follows a drag. `drag` is in shares of the picture's height, x to
    /// the right and y down. A drag out of all numbers is left out.
    pub fn pan(&mut self, drag: Vec2) {
        self.move_target((self.up() * drag.y - self.right() * drag.x) * self.height_in_view());
    }

    fn move_target(&mut self, way: Vec3) {
        if (self.target + way).is_finite() {
            self.target += way;
        }
    }

    /// Scales the distance by `factor` (below 1 comes nearer), holding still the point of the target's plane under the
    /// pointer. `pointer` is in shares of the picture's height from its centre, x to the right and y down. NaN is left out.
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

    /// Moves target and distance so that all points fill the uncovered part of the picture; the direction stays. Without
    /// points nothing changes.
    pub fn frame(&mut self, world_points: &[Vec3], aspect: f32, insets: Insets) {
        let bounds = Aabb::from_points(world_points.iter().copied());
        if bounds.is_empty() {
            return;
        }
        let free_width = (1.0 - insets.left - insets.right).clamp(0.2, 1.0);
        let free_height = (1.0 - insets.top - insets.bottom).clamp(0.2, 1.0);
        let tan_half_y = self.height_in_view() * 0.5 / self.distance;
        let tan_half = Vec2::new(tan_half_y * aspect, tan_half_y);
        let fitted = tan_half * Vec2::new(free_width, free_height) * FRAMED_SHARE;
        let middle_of_free = tan_half * Vec2::new(insets.left - insets.right, insets.bottom - insets.top);
        let (right, up, forward) = (self.right(), self.up(), self.forward());
        let perspective = matches!(self.projection, Projection::Perspective { .. });

        // Tangents of the view that the points may reach, from the picture's middle: to the right and up, to the left and down.
        let reach_up = (fitted + middle_of_free).max(Vec2::splat(1e-3));
        let reach_down = (fitted - middle_of_free).max(Vec2::splat(1e-3));

        let mut center = bounds.center();
        for round in 0..=FRAMING_ROUNDS {
            let mut distance = 0.0_f32;
            for &point in world_points {
                let offset = point - center;
                let in_plane = Vec2::new(offset.dot(right), offset.dot(up));
                let toward_eye = if perspective { -offset.dot(forward) } else { 0.0 };
                let needed = (in_plane / reach_up).max(-in_plane / reach_down).max_element();
                distance = distance.max(needed + toward_eye);
            }
            // A single point has no size to frame; one unit around it is as good as any.
            self.distance = if distance > 0.0 {
                distance.clamp(LEAST_DISTANCE, GREATEST_DISTANCE)
            } else {
                1.0
            };
            if round == FRAMING_ROUNDS {
                break;
            }
            let in_picture = Aabb::from_points(world_points.iter().map(|&point| {
                let offset = point - center;
                let depth = self.distance + if perspective { offset.dot(forward) } else { 0.0 };
                Vec3::new(offset.dot(right), offset.dot(up), 0.0) / depth.max(self.distance * 1e-3)
            }));
            let off_middle = in_picture.center().truncate() - middle_of_free;
            let way = (right * off_middle.x + up * off_middle.y) * self.distance;
            if !(center + way).is_finite() {
                break;
            }
            center += way;
        }
        self.target = center;
    }
}

impl Camera {
    /// How far some points reach in the picture: shares of its width, from the left edge to the leftmost and from the
    /// right edge to the rightmost.
    pub fn free_at_sides(&self, world_points: &[Vec3], aspect: f32) -> (f32, f32) {
        let bounds = Aabb::from_points(world_points.iter().copied());
        let clip_from_world = self.clip_from_view(aspect, &bounds) * self.view_from_world();
        let x_clip = world_points
            .iter()
            .map(|&point| clip_from_world.project_point3(point).x);
        x_clip.fold((f32::INFINITY, f32::INFINITY), |(left, right), x| {
            (left.min(0.5 + 0.5 * x), right.min(0.5 - 0.5 * x))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_box() -> Aabb {
        Aabb {
            min: Vec3::splat(-1.0),
            max: Vec3::splat(1.0),
        }
    }

    /// Corners of a box in clip space, divided by w.
    fn corners_in_clip(camera: &Camera, bounds: &Aabb, aspect: f32) -> Vec<Vec3> {
        let clip_from_world = camera.clip_from_view(aspect, bounds) * camera.view_from_world();
        bounds
            .corners()
            .map(|corner| clip_from_world.project_point3(corner))
            .to_vec()
    }

    #[test]
    fn the_view_is_left_handed_with_y_up() {
        let camera = Camera {
            yaw_radians: 0.0,
            pitch_radians: 0.0,
            ..Camera::default()
        };
        assert_eq!(
            (camera.right(), camera.up(), camera.forward()),
            (Vec3::X, Vec3::Y, Vec3::Z)
        );
        let in_view = camera.view_from_world().transform_point3(camera.target);
        assert!((in_view - Vec3::new(0.0, 0.0, camera.distance)).length() < 1e-5);
    }

    #[test]
    fn framing_fills_the_picture_and_no_plane_cuts_from_any_side() {
        let bounds = Aabb {
            min: Vec3::new(-3.0, 0.0, -0.1),
            max: Vec3::new(50.0, 7.0, 9.0),
        };
        for preset in ViewPreset::ALL {
            for projection in [Camera::default().projection, Projection::Orthographic] {
                let mut camera = Camera {
                    projection,
                    ..Camera::default()
                };
                camera.look_from(preset);
                camera.frame(&bounds.corners(), 1.6, Insets::default());
                let corners = corners_in_clip(&camera, &bounds, 1.6);
                let reach = corners.iter().map(|c| c.x.abs().max(c.y.abs())).fold(0.0, f32::max);
                assert!(
                    (reach - FRAMED_SHARE).abs() < 1e-3,
                    "{preset:?} {projection:?} reaches {reach}"
                );
                assert!(
                    corners.iter().all(|c| (0.0..=1.0).contains(&c.z)),
                    "{preset:?} {projection:?}"
                );
            }
        }
    }

    #[test]
    fn framing_keeps_clear_of_covered_margins() {
        let mut camera = Camera::default();
        let insets = Insets {
            left: 0.3,
            bottom: 0.2,
            ..Insets::default()
        };
        camera.frame(&unit_box().corners(), 1.5, insets);
        for corner in corners_in_clip(&camera, &unit_box(), 1.5) {
            assert!(corner.x > -1.0 + 2.0 * insets.left - 0.02, "{corner}");
            assert!(corner.y > -1.0 + 2.0 * insets.bottom - 0.02, "{corner}");
            assert!(corner.x < 1.0 && corner.y < 1.0, "{corner}");
        }
    }

    #[test]
    fn zoom_holds_the_point_under_the_pointer() {
        let mut camera = Camera::default();
        let pointer = Vec2::new(0.3, -0.2);
        let under_pointer = |camera: &Camera| {
            camera.target + (camera.right() * pointer.x - camera.up() * pointer.y) * camera.height_in_view()
        };
        let before = under_pointer(&camera);
        camera.zoom(0.25, pointer);
        assert!((under_pointer(&camera) - before).length() < 1e-5);
        assert!((camera.distance - 1.0).abs() < 1e-6);
    }

    #[test]
    fn panning_moves_the_scene_with_the_pointer() {
        let mut camera = Camera {
            yaw_radians: 0.0,
            pitch_radians: 0.0,
            ..Camera::default()
        };
        let point = camera.target;
        camera.pan(Vec2::new(0.5, 0.0));
        let clip = (camera.clip_from_view(1.0, &unit_box()) * camera.view_from_world()).project_point3(point);
        assert!(
            (clip.x - 1.0).abs() < 1e-5 && clip.y.abs() < 1e-5,
            "half a height to the right is the edge: {clip}"
        );
    }

    #[test]
    fn a_box_around_the_eye_still_has_a_near_plane_before_its_far_plane() {
        for distance in [1e-3, 1.0, 1e5] {
            let camera = Camera {
                distance,
                ..Camera::default()
            };
            let (near, far) = camera.depth_range(&unit_box());
            assert!(0.0 < near && near < far, "{near} {far}");
        }
    }

    #[test]
    fn orbit_never_tips_over() {
        let mut camera = Camera::default();
        camera.orbit(100.0, 100.0);
        assert!(camera.pitch_radians < FRAC_PI_2 && (0.0..TAU).contains(&camera.yaw_radians));
        assert!(camera.up().y > 0.0);
    }
}
