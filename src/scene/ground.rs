//! Where the ground lies under a scene, and how its grid is spaced.

use super::Aabb;

/// The ground plane under a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// World y of the plane.
    pub height: f32,
    /// World units between two minor grid lines, a power of ten; ten of them lie between two major lines.
    pub cell: f32,
}

/// How far above y = 0 a model may be, in heights of its own, and still have its ground at y = 0, as in a leap.
const FLOATING_SHARE: f32 = 1.0;
/// About how many minor cells fit the radius of the scene.
const CELLS_PER_RADIUS: f32 = 6.0;

impl Ground {
    /// y = 0, or the floor of the box when that is lower (the ground never cuts a model) or far above. An empty scene lies on y = 0 with cells of 1.
    pub fn under(world_bounds: &Aabb) -> Self {
        if world_bounds.is_empty() {
            return Self { height: 0.0, cell: 1.0 };
        }
        let floor = world_bounds.min.y;
        let tall = world_bounds.size().y;
        let is_near_zero = (0.0..=FLOATING_SHARE * tall).contains(&floor);
        let exponent = (world_bounds.radius() / CELLS_PER_RADIUS).log10().round();
        Self {
            height: if is_near_zero { 0.0 } else { floor },
            // A single point has no size.
            cell: if exponent.is_finite() {
                10f32.powf(exponent.clamp(-30.0, 30.0))
            } else {
                1.0
            },
        }
    }
}
