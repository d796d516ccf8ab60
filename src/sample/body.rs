//! The figure's solids: a small explorer in a soft suit, with helmet, gloves, boots and a pack.

use glam::DVec3;

use super::rig::{ARM, CHEST, HEAD, HIPS, Limb, NECK, PALM, RIBS, Rig, Side, WAIST, joint};
use super::sdf::{Shape, smooth_intersection, smooth_union};

/// A solid that one joint moves.
pub(super) struct Volume {
    pub(super) joint: usize,
    shape: Shape,
    /// Width over which it melts into the volumes before it, metres.
    blend: f64,
}

/// All solids of the figure. Limbs are listed for the left side and evaluated for both.
pub(super) struct Body {
    centre: Vec<Volume>,
    arm: Group,
    leg: Group,
}

/// A part that regions of the skin follow.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
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
/// Width over which the jaw melts into the dome, metres.
const JAW_BLEND: f64 = 0.05;
/// Rounding of the soles' edge, metres.
const SOLE_ROUNDING: f64 = 0.016;

impl Body {
    /// The figure on this rig.
    pub(super) fn new(rig: &Rig) -> Body {
        Body {
            centre: centre(),
            arm: Group::new(left_arm(rig)),
            leg: Group::new(left_leg(rig)),
        }
    }

    /// Signed distance from the skin at `point` in the bind pose: the same at mirrored points, to the last bit.
    pub(super) fn distance(&self, point: DVec3) -> f64 {
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
    pub(super) fn for_each_joint_distance(&self, point: DVec3, mut visit: impl FnMut(usize, f64)) {
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
    pub(super) fn part_distance(&self, part: Part, point: DVec3) -> f64 {
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

fn cone(joint: usize, from: DVec3, from_radius: f64, to: DVec3, to_radius: f64, blend: f64) -> Volume {
    Volume {
        joint,
        shape: Shape::RoundCone {
            from,
            to,
            from_radius,
            to_radius,
        },
        blend,
    }
}

fn ellipsoid(joint: usize, centre: DVec3, radii: DVec3, blend: f64) -> Volume {
    Volume {
        joint,
        shape: Shape::Ellipsoid { centre, radii },
        blend,
    }
}

/// A dome, and a jaw that carries the face forwards.
fn helmet() -> [Shape; 2] {
    [
        Shape::Ellipsoid {
            centre: v(0.0, 1.638, 0.004),
            radii: v(0.162, 0.16, 0.17),
        },
        Shape::Ellipsoid {
            centre: v(0.0, 1.592, -0.022),
            radii: v(0.132, 0.114, 0.138),
        },
    ]
}

fn ear_cups() -> Shape {
    let (from, to) = (v(-0.152, 1.624, 0.014), v(0.152, 1.624, 0.014));
    Shape::RoundCone {
        from,
        to,
        from_radius: 0.048,
        to_radius: 0.048,
    }
}

fn pack() -> Shape {
    Shape::RoundBox {
        centre: v(0.0, 1.25, 0.148),
        half: v(0.11, 0.13, 0.06),
        rounding: 0.045,
    }
}

const fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn centre() -> Vec<Volume> {
    let [dome, jaw] = helmet();
    vec![
        ellipsoid(HIPS, v(0.0, 0.94, 0.006), v(0.142, 0.11, 0.11), 0.05),
        ellipsoid(WAIST, v(0.0, 1.06, 0.0), v(0.13, 0.125, 0.098), 0.08),
        ellipsoid(RIBS, v(0.0, 1.19, -0.002), v(0.144, 0.13, 0.106), 0.08),
        ellipsoid(CHEST, v(0.0, 1.29, 0.0), v(0.16, 0.115, 0.114), 0.06),
        cone(CHEST, v(-0.09, 1.335, 0.004), 0.074, v(0.09, 1.335, 0.004), 0.074, 0.06),
        cone(NECK, v(0.0, 1.38, 0.0), 0.08, v(0.0, 1.53, 0.0), 0.076, 0.03),
        cone(CHEST, v(0.0, 1.33, 0.002), 0.108, v(0.0, 1.405, 0.0), 0.092, 0.05),
        Volume {
            joint: HEAD,
            shape: dome,
            blend: 0.03,
        },
        Volume {
            joint: HEAD,
            shape: jaw,
            blend: JAW_BLEND,
        },
        Volume {
            joint: HEAD,
            shape: ear_cups(),
            blend: 0.012,
        },
        Volume {
            joint: CHEST,
            shape: pack(),
            blend: 0.04,
        },
        // Badge on the breast.
        ellipsoid(CHEST, v(0.0, 1.275, -0.1), v(0.05, 0.05, 0.022), 0.012),
    ]
}

fn left_arm(rig: &Rig) -> Vec<Volume> {
    let of = |limb| joint(Side::Left, limb);
    let at = |limb| rig.origin(Side::Left, limb);
    let (shoulder, elbow, wrist) = (at(Limb::UpperArm), at(Limb::Forearm), at(Limb::Hand));
    let mut volumes = vec![
        cone(
            of(Limb::Clavicle),
            v(0.07, 1.352, 0.004),
            0.062,
            v(0.15, 1.354, 0.004),
            0.064,
            0.05,
        ),
        ellipsoid(of(Limb::UpperArm), shoulder + ARM * 0.015, v(0.07, 0.068, 0.07), 0.05),
        cone(of(Limb::UpperArm), shoulder, 0.062, elbow, 0.049, 0.05),
        cone(of(Limb::Forearm), elbow, 0.05, wrist - ARM * 0.02, 0.038, 0.03),
        // Cuff of the glove.
        cone(
            of(Limb::Forearm),
            wrist - ARM * 0.085,
            0.056,
            wrist - ARM * 0.035,
            0.047,
            0.012,
        ),
    ];
    // Palm: a fan of cones from the wrist to the knuckles.
    for (limb, radius) in [(Limb::Index, 0.027), (Limb::Middle, 0.0285), (Limb::Outer, 0.026)] {
        volumes.push(cone(
            of(Limb::Hand),
            wrist + ARM * 0.004,
            0.033,
            at(limb) - ARM * 0.004,
            radius,
            0.028,
        ));
    }
    let fingers = [
        (Limb::Index, Limb::IndexTip, 0.0215),
        (Limb::Middle, Limb::MiddleTip, 0.0225),
        (Limb::Outer, Limb::OuterTip, 0.0205),
        (Limb::Thumb, Limb::ThumbTip, 0.0245),
    ];
    for (base, tip, radius) in fingers {
        let end = rig.joints[of(tip)].tip;
        // The last sphere ends at the bone's tip.
        let end = end - (end - at(tip)).normalize() * (0.6 * radius);
        volumes.push(cone(of(base), at(base), radius, at(tip), 0.94 * radius, 0.024));
        volumes.push(cone(of(tip), at(tip), 0.94 * radius, end, 0.84 * radius, 0.008));
    }
    // Thumb's ball, on the palm's side.
    volumes.push(cone(
        of(Limb::Hand),
        wrist + ARM * 0.012,
        0.028,
        at(Limb::Thumb) + PALM * 0.004,
        0.023,
        0.02,
    ));
    volumes
}

fn left_leg(rig: &Rig) -> Vec<Volume> {
    let of = |limb| joint(Side::Left, limb);
    let at = |limb| rig.origin(Side::Left, limb);
    let (hip, knee, ankle, ball) = (at(Limb::Thigh), at(Limb::Shin), at(Limb::Foot), at(Limb::Toe));
    vec![
        cone(of(Limb::Thigh), hip + v(-0.003, -0.03, 0.004), 0.085, knee, 0.061, 0.05),
        cone(of(Limb::Shin), knee, 0.06, ankle, 0.045, 0.04),
        // Calf.
        cone(
            of(Limb::Shin),
            v(0.102, 0.40, 0.016),
            0.05,
            v(0.102, 0.27, 0.016),
            0.044,
            0.05,
        ),
        // Knee pad.
        ellipsoid(of(Limb::Shin), knee + v(0.0, 0.0, -0.03), v(0.042, 0.055, 0.042), 0.012),
        // Shaft of the boot, with a collar.
        cone(
            of(Limb::Shin),
            v(0.102, 0.245, 0.01),
            0.065,
            v(0.102, 0.12, 0.014),
            0.058,
            0.012,
        ),
        cone(
            of(Limb::Shin),
            v(0.102, 0.25, 0.009),
            0.071,
            v(0.102, 0.243, 0.009),
            0.071,
            0.008,
        ),
        cone(
            of(Limb::Foot),
            v(0.102, 0.055, 0.038),
            0.057,
            v(0.104, 0.047, -0.075),
            0.056,
            0.03,
        ),
        cone(
            of(Limb::Foot),
            v(0.102, 0.11, 0.0),
            0.053,
            v(0.104, 0.062, -0.085),
            0.046,
            0.04,
        ),
        ellipsoid(
            of(Limb::Toe),
            ball + v(0.002, 0.012, -0.03),
            v(0.066, 0.052, 0.085),
            0.03,
        ),
    ]
}
