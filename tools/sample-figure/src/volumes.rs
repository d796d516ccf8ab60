//! The figure's solids: a small explorer in a soft suit, with helmet, gloves, boots and a pack.

use glam::DVec3;

use crate::rig::{ARM, CHEST, HEAD, HIPS, Limb, NECK, PALM, RIBS, Rig, Side, WAIST, joint};
use crate::sdf::Shape;

/// A solid that one joint moves.
pub(crate) struct Volume {
    pub(crate) joint: usize,
    pub(crate) shape: Shape,
    /// Width over which it melts into the volumes before it, metres.
    pub(crate) blend: f64,
}

/// Width over which the jaw melts into the dome, metres.
pub(crate) const JAW_BLEND: f64 = 0.05;

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
pub(crate) fn helmet() -> [Shape; 2] {
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

/// Both, as one bar through the helmet.
pub(crate) fn ear_cups() -> Shape {
    Shape::RoundBox {
        centre: v(0.0, 1.624, 0.014),
        half: v(0.184, 0.054, 0.054),
        rounding: 0.036,
    }
}

/// The pack on the back.
pub(crate) fn pack() -> Shape {
    Shape::RoundBox {
        centre: v(0.0, 1.25, 0.148),
        half: v(0.11, 0.13, 0.06),
        rounding: 0.045,
    }
}

const fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Trunk, head and pack.
pub(crate) fn centre() -> Vec<Volume> {
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

/// From the clavicle to the fingertips.
pub(crate) fn left_arm(rig: &Rig) -> Vec<Volume> {
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

/// From the hip to the toes.
pub(crate) fn left_leg(rig: &Rig) -> Vec<Volume> {
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
