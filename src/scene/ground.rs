//! Where the ground lies under a scene, and how its grid is spaced.

use super::Aabb;

/// The ground plane under a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// World y of the plane.
    pub height: f32,
    /// World units between two grid lines: 1, 2 or 5 times a power of ten.
    pub cell: f32,
}

/// How far above y = 0 a model may be, in heights of its own, and still have its ground at y = 0, as in a leap.
const FLOATING_SHARE: f32 = 1.0;
/// What is no higher above y = 0 than this, in heights of its own, stands.
const STANDING_SHARE: f32 = 0.05;
/// By how much the lowest point of a model may go up and down while it still stays on the ground, in heights of its own.
const STEP_SHARE: f32 = 0.1;
/// About how many cells fit the radius of the scene.
const CELLS_PER_RADIUS: f32 = 1.1;

impl Ground {
    /// Where the model stays on the ground, the middle one of its lowest points in several poses of its clip, world y: a sole that dips
    /// into it in one of them does not make all others float. Else y = 0, or the floor of the box when that is lower or far above. An
    /// empty scene lies on y = 0 with cells of 1. `lowest` is put in order.
    pub fn under(world_bounds: &Aabb, lowest: &mut [f32]) -> Self {
        if world_bounds.is_empty() {
            return Self { height: 0.0, cell: 1.0 };
        }
        let floor = world_bounds.min.y;
        let tall = world_bounds.size().y;
        lowest.sort_unstable_by(f32::total_cmp);
        let stays_on_it = |lowest: &[f32]| {
            let ends = [lowest.first()?, lowest.last()?];
            let is_level = ends[1] - ends[0] <= STEP_SHARE * tall;
            (is_level && *ends[0] <= STANDING_SHARE * tall).then(|| lowest[lowest.len() / 2])
        };
        let is_near_zero = (0.0..=FLOATING_SHARE * tall).contains(&floor);
        let under_all = if is_near_zero { 0.0 } else { floor };
        Self {
            height: stays_on_it(lowest).unwrap_or(under_all),
            cell: round_number(world_bounds.radius() / CELLS_PER_RADIUS),
        }
    }
}

/// The number of the series 1, 2, 5, 10, … that is nearest to a length by its logarithm; 1 for none.
fn round_number(length: f32) -> f32 {
    let exponent = length.log10();
    // A single point has no size.
    if !exponent.is_finite() {
        return 1.0;
    }
    let power = 10f32.powf(exponent.floor().clamp(-30.0, 30.0));
    let part = length / power;
    // The ends are geometric means of neighbours.
    let digit = [(1.414, 1.0), (3.162, 2.0), (7.071, 5.0)]
        .into_iter()
        .find(|(end, _)| part < *end);
    power * digit.map_or(10.0, |(_, digit)| digit)
}
