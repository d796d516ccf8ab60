//! Framing: moves the camera so that points fill the picture.

use std::f32::consts::TAU;

use glam::{Quat, Vec2, Vec3};

use super::camera::{GREATEST_DISTANCE, LEAST_DISTANCE};
use super::{Aabb, Camera, Projection};

/// Fraction of the uncovered height and width that framing fills.
const FRAMED_FRACTION: f32 = 0.9;

/// Rounds of fitting and centring, since each changes the other in perspective. The last moves points by less than a
/// thousandth of the picture.
const FRAMING_ROUNDS: usize = 8;

/// Margins of a picture that are covered, for example by panels: fractions of its width and height, 0…1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Insets {
    /// Covered fraction of the width on the left.
    pub left: f32,
    /// Covered fraction of the width on the right.
    pub right: f32,
    /// Covered fraction of the height at the top.
    pub top: f32,
    /// Covered fraction of the height at the bottom.
    pub bottom: f32,
}

/// Directions in which the outline of what turns is found, and steps of the turn.
const SWEEP_STEPS: u16 = 32;

/// Points that reach as far as the given ones do while they turn about the vertical axis through the middle of their box. With them goes
/// that middle.
pub fn swept_about_y(world_points: &[Vec3]) -> (Vec<Vec3>, Vec3) {
    let center = Aabb::from_points(world_points.iter().copied()).center();
    let angles = || (0..SWEEP_STEPS).map(|step| TAU * f32::from(step) / f32::from(SWEEP_STEPS));
    // Distance from the axis, and height.
    let outline = angles().filter_map(|angle| {
        let direction = Vec2::from_angle(angle);
        let around = |point: &Vec3| Vec2::new((point - center).with_y(0.0).length(), point.y - center.y);
        let places = world_points.iter().map(around);
        places.max_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction)))
    });
    let outline: Vec<Vec2> = outline.collect();
    let turned = |angle| {
        let turn = Quat::from_rotation_y(angle);
        outline.iter().map(move |place| center + turn * place.extend(0.0))
    };
    (angles().flat_map(turned).collect(), center)
}

impl Camera {
    /// Moves the target along the line of sight to where it is nearest to the vertical axis through a point, about which the camera then
    /// turns. The picture stays.
    pub fn aim_at_axis(&mut self, point: Vec3) {
        let forward = self.forward();
        let level = forward.with_y(0.0);
        let way = (point - self.target).dot(level) / level.length_squared();
        let distance = match self.projection {
            Projection::Perspective { .. } => self.distance + way,
            Projection::Orthographic => self.distance,
        };
        let target = self.target + forward * way;
        if target.is_finite() && distance >= LEAST_DISTANCE {
            (self.target, self.distance) = (target, distance);
        }
    }

    /// Frames points: moves target and distance so that they fill the uncovered part of the picture. The direction
    /// stays. Without points nothing changes.
    pub fn frame(&mut self, world_points: &[Vec3], aspect: f32, insets: Insets) {
        let bounds = Aabb::from_points(world_points.iter().copied());
        if bounds.is_empty() {
            return;
        }
        let free_width = (1.0 - insets.left - insets.right).clamp(0.1, 1.0);
        let free_height = (1.0 - insets.top - insets.bottom).clamp(0.1, 1.0);
        let tan_half_y = self.height_in_view() * 0.5 / self.distance;
        let tan_half = Vec2::new(tan_half_y * aspect, tan_half_y);
        let fitted = tan_half * Vec2::new(free_width, free_height) * FRAMED_FRACTION;
        let middle_of_free = tan_half * Vec2::new(insets.left - insets.right, insets.bottom - insets.top);
        let (right, up, forward) = (self.right(), self.up(), self.forward());
        let perspective = matches!(self.projection, Projection::Perspective { .. });

        // Tangents of the view that the points may reach, from the picture's middle: to the right and up, to the left and down.
        let reach_up = (fitted + middle_of_free).max(Vec2::splat(1e-3));
        let reach_down = (fitted - middle_of_free).max(Vec2::splat(1e-3));

        // The distance is right now; only the centre is left to find.
        let mut center = self.first_center(world_points, bounds.center(), fitted, middle_of_free);
        for round in 0..=FRAMING_ROUNDS {
            let mut distance = 0.0_f32;
            for &point in world_points {
                let offset = point - center;
                let in_plane = Vec2::new(offset.dot(right), offset.dot(up));
                let toward_eye = if perspective { -offset.dot(forward) } else { 0.0 };
                let needed = (in_plane / reach_up).max(-in_plane / reach_down).max_element();
                distance = distance.max(needed + toward_eye);
            }
            // A single point has no size; one unit around it is framed.
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

    /// A target near that of the framed picture: with a distance of its own all points are between the tangents
    /// `middle ± fitted`, right and up, and no nearer eye has that. In each direction the eye's place along the picture, `c`, and
    /// its distance `d` obey `max(p − t⁺z) − t⁺d ≤ c ≤ min(p − t⁻z) − t⁻d` over points at `p`, `z` behind the first center, with
    /// `t±` the tangents; the least `d` makes both ends meet.
    fn first_center(&self, world_points: &[Vec3], center: Vec3, fitted: Vec2, middle: Vec2) -> Vec3 {
        let (right, up, forward) = (self.right(), self.up(), self.forward());
        let perspective = matches!(self.projection, Projection::Perspective { .. });
        let (most, least) = (middle + fitted, middle - fitted);
        let (mut from, mut to) = (Vec2::NEG_INFINITY, Vec2::INFINITY);
        for &point in world_points {
            let offset = point - center;
            let in_plane = Vec2::new(offset.dot(right), offset.dot(up));
            let behind = if perspective { offset.dot(forward) } else { 0.0 };
            from = from.max(in_plane - most * behind);
            to = to.min(in_plane - least * behind);
        }
        let distance = ((from - to) / (most - least)).max_element();
        let place = ((from - most * distance) + (to - least * distance)) * 0.5;
        let moved = center + right * place.x + up * place.y;
        if moved.is_finite() { moved } else { center }
    }

    /// How far points reach in the picture: fractions of its width, from the left edge to the leftmost and from the
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
