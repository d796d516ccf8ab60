//! The figure as one signed distance: its volumes melted into each other, limbs on both sides.

use glam::DVec3;

use crate::rig::{Limb, Rig, Side, joint};
use crate::sdf::{smooth_intersection, smooth_union};
use crate::volumes::{JAW_BLEND, Volume, centre, ear_cups, helmet, left_arm, left_leg, pack};

/// All solids of the figure. Limbs are listed for the left side and evaluated for both.
pub(crate) struct Body {
    centre: Vec<Volume>,
    arm: Group,
    leg: Group,
}

/// A part that regions of the skin follow.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Part {
    Helmet,
    EarCups,
    Pack,
}

/// Volumes of the left side that melt into each other, and a box around them.
struct Group {
    volumes: Vec<Volume>,
    min: DVec3,
    max: DVec3,
}

/// Widths over which arms and legs melt into the torso, metres.
const SHOULDER_BLEND: f64 = 0.09;
const HIP_BLEND: f64 = 0.1;
const CROTCH_BLEND: f64 = 0.08;
/// Rounding of the soles' edge, metres.
const SOLE_ROUNDING: f64 = 0.016;

impl Body {
    /// The figure on this rig.
    pub(crate) fn new(rig: &Rig) -> Body {
        Body {
            centre: centre(),
            arm: Group::new(left_arm(rig)),
            leg: Group::new(left_leg(rig)),
        }
    }

    /// Signed distance from the skin at `point` in the bind pose: the same at mirrored points, to the last bit.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        let mirrored = DVec3::new(-point.x, point.y, point.z);
        let torso = blend(&self.centre, point);
        let near = |group: &Group, point, reach: f64| group.distance_if_within(point, torso + reach);
        let legs = smooth_union(
            near(&self.leg, point, HIP_BLEND),
            near(&self.leg, mirrored, HIP_BLEND),
            CROTCH_BLEND,
        );
        let legs = smooth_intersection(legs, -point.y, SOLE_ROUNDING);
        let arms = near(&self.arm, point, SHOULDER_BLEND).min(near(&self.arm, mirrored, SHOULDER_BLEND));
        smooth_union(smooth_union(torso, legs, HIP_BLEND), arms, SHOULDER_BLEND)
    }

    /// Calls `visit` with each joint and the distance of one of its volumes from `point`.
    pub(crate) fn for_each_joint_distance(&self, point: DVec3, mut visit: impl FnMut(usize, f64)) {
        for volume in &self.centre {
            visit(volume.joint, volume.shape.distance(point));
        }
        for side in Side::BOTH {
            let on_left = side.mirror(point);
            for volume in self.arm.volumes.iter().chain(&self.leg.volumes) {
                // Volumes carry the left joint; the right one has the same place in its own list.
                let offset = joint(side, Limb::Clavicle) - joint(Side::Left, Limb::Clavicle);
                visit(volume.joint + offset, volume.shape.distance(on_left));
            }
        }
    }

    /// Signed distance from one part by itself, for borders that follow a seam.
    pub(crate) fn part_distance(&self, part: Part, point: DVec3) -> f64 {
        match part {
            Part::Helmet => {
                let [dome, jaw] = helmet().map(|shape| shape.distance(point));
                smooth_union(dome, jaw, JAW_BLEND)
            }
            Part::EarCups => ear_cups().distance(point),
            Part::Pack => pack().distance(point),
        }
    }
}

impl Group {
    fn new(volumes: Vec<Volume>) -> Group {
        let bounds = volumes.iter().map(|volume| volume.shape.bounds());
        let (min, max) = bounds.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or_default();
        Group { volumes, min, max }
    }

    /// Signed distance where it can be below `limit`, otherwise a number that is not below it: most points are far from
    /// most limbs, and a smooth union does not feel what is further than its width.
    fn distance_if_within(&self, point: DVec3, limit: f64) -> f64 {
        let to_box = (point - point.clamp(self.min, self.max)).length();
        // Blends swell the surface past the box of its parts.
        if to_box - 0.02 > limit {
            limit + FAR
        } else {
            blend(&self.volumes, point)
        }
    }
}

/// Added to a limit to say "further", metres.
const FAR: f64 = 1.0;

/// Smooth union of a list of volumes, in order.
fn blend(volumes: &[Volume], point: DVec3) -> f64 {
    volumes.iter().fold(f64::INFINITY, |nearest, volume| {
        let distance = volume.shape.distance(point);
        if nearest.is_finite() {
            smooth_union(nearest, distance, volume.blend)
        } else {
            distance
        }
    })
}
