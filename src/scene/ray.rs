//! Rays from a point of the picture into the scene.

use glam::{Affine3A, Mat3A, Vec2, Vec3, Vec3A};

use super::{Aabb, Camera, Projection};

/// A half line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin.
    pub origin: Vec3,
    /// Direction, a unit vector.
    pub direction: Vec3,
}

impl Ray {
    /// World -> the ray's space, in which it begins at the origin and goes along z. Keeps lengths.
    pub fn ray_from_world(&self) -> Affine3A {
        let (right, up) = self.direction.any_orthonormal_pair();
        let axes = Mat3A::from_cols(right.into(), up.into(), self.direction.into()).transpose();
        Affine3A {
            matrix3: axes,
            translation: axes * -Vec3A::from(self.origin),
        }
    }
}

impl Ray {
    /// Distance at which it comes into a box: 0 where it begins inside, none where it misses.
    pub fn enters(&self, bounds: &Aabb) -> Option<f32> {
        let to_least = (bounds.min - self.origin) / self.direction;
        let to_greatest = (bounds.max - self.origin) / self.direction;
        // Along a side 0 / 0 is NaN, which `max` and `min` of numbers leave out.
        let enters = to_least.min(to_greatest).to_array().into_iter().fold(0.0, f32::max);
        let leaves = to_least
            .max(to_greatest)
            .to_array()
            .into_iter()
            .fold(f32::INFINITY, f32::min);
        (!bounds.is_empty() && enters <= leaves).then_some(enters)
    }
}

impl Camera {
    /// The ray that a point of the picture shows: x right, y up, −1…1, in a picture of `aspect` = width / height. It
    /// begins on the near plane of [`Camera::depth_range`], since nothing in front of that is drawn.
    pub fn ray(&self, point: Vec2, aspect: f32, world_bounds: &Aabb) -> Ray {
        let (near, _) = self.depth_range(world_bounds);
        let half_height = self.height_in_view() * 0.5;
        let in_plane = (self.right() * (point.x * aspect) + self.up() * point.y) * half_height;
        let forward = self.forward();
        match self.projection {
            Projection::Perspective { .. } => {
                let way = forward + in_plane / self.distance;
                Ray {
                    origin: self.eye() + way * near,
                    direction: way.normalize_or_zero(),
                }
            }
            Projection::Orthographic => Ray {
                origin: self.eye() + in_plane + forward * near,
                direction: forward,
            },
        }
    }
}
