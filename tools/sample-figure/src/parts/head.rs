//! Helmet, visor, ear cups, neck.

use glam::DVec3;

use super::{Kit, PLATE, plate, ribs};
use crate::maps::Mark;
use crate::materials::Material::{Metal, Rubber, Shell, Trim, Visor};
use crate::rig::{CHEST, HEAD, NECK};
use crate::shape::{Binding, COARSE, FINE, Frame, Loft, Ring, bevelled, block, rectangle, ring, tile, tube};

/// How near to round the helmet and what is on it are, metres.
const ROUND: f64 = 0.0007;

/// Middle of the helmet.
const MIDDLE: DVec3 = DVec3::new(0.0, 1.608, 0.0);

pub(crate) fn add(kit: &mut Kit<'_>) {
    let head = Binding::Rigid(HEAD);
    // From the back of the head to the face, its front up.
    let frame = Frame {
        origin: MIDDLE,
        right: DVec3::X,
        front: DVec3::Y,
        along: DVec3::NEG_Z,
    };
    let helmet = Loft::new(frame, helmet());
    kit.one(Shell, &helmet.grid(ROUND), &head, HELMET);
    kit.one(Metal, &Loft::new(frame, rim()).grid(ROUND), &head, &[]);
    kit.one(Visor, &Loft::new(frame, visor()).grid(ROUND), &head, &[]);

    // A crest over the crown.
    let crest = [[0.475, 0.12], [0.525, 0.12], [0.525, 0.86], [0.475, 0.86]];
    kit.one(Trim, &plate(&helmet, &crest, 0.008).grid(), &head, PLATE);

    ear_cup(kit, &head);
    neck(kit, &head);
}

const HELMET: &[Mark] = &[
    Mark::LineV(0.62),
    Mark::LineV(0.30),
    Mark::Rivets(0.655, 30.0),
    Mark::Rivets(0.27, 15.0),
];

fn helmet() -> Vec<Ring> {
    let wall = [
        ring(-0.192, 0.0, 0.0),
        ring(-0.186, 0.048, 0.048),
        ring(-0.168, 0.094, 0.093),
        ring(-0.132, 0.14, 0.139),
        ring(-0.08, 0.175, 0.172),
        ring(-0.02, 0.189, 0.184),
        ring(0.04, 0.185, 0.178),
        ring(0.085, 0.171, 0.16).square(0.15),
        ring(0.116, 0.156, 0.142).square(0.3),
    ];
    let mut rings = Vec::from(wall);
    rings.push(ring(0.118, 0.14, 0.126).square(0.35));
    rings
}

/// The ring that holds the visor.
fn rim() -> Vec<Ring> {
    bevelled(&[
        ring(0.1, 0.15, 0.136).square(0.35),
        ring(0.1, 0.163, 0.149).square(0.35),
        ring(0.128, 0.159, 0.145).square(0.38).bevel(0.006),
        ring(0.134, 0.143, 0.129).square(0.4).bevel(0.004),
        ring(0.118, 0.133, 0.119).square(0.4),
    ])
}

fn visor() -> Vec<Ring> {
    vec![
        ring(0.110, 0.140, 0.126).square(0.4),
        ring(0.126, 0.136, 0.122).square(0.4),
        ring(0.138, 0.128, 0.115).square(0.37),
        ring(0.151, 0.116, 0.103).square(0.33),
        ring(0.163, 0.101, 0.089).square(0.28),
        ring(0.174, 0.083, 0.073).square(0.22),
        ring(0.183, 0.06, 0.052).square(0.14),
        ring(0.188, 0.033, 0.029).square(0.06),
        ring(0.190, 0.0, 0.0),
    ]
}

fn ear_cup(kit: &mut Kit<'_>, head: &Binding) {
    let origin = MIDDLE + DVec3::new(0.168, 0.0, 0.018);
    let frame = Frame::along(origin, DVec3::X, DVec3::NEG_Z);
    let r = |at: f64, radius: f64| ring(at, radius, radius);
    let base = bevelled(&[r(-0.02, 0.07), r(0.016, 0.068).bevel(0.005), r(0.018, 0.03)]);
    kit.pair(Metal, &Loft::new(frame, base).grid(0.001), head, &[]);
    let cup = bevelled(&[
        r(0.0, 0.058),
        r(0.034, 0.056).bevel(0.007),
        r(0.036, 0.036).bevel(0.003),
        r(0.026, 0.033),
        r(0.026, 0.0),
    ]);
    kit.pair(Trim, &Loft::new(frame, cup).grid(0.001), head, &[]);
    let hub = bevelled(&[r(0.02, 0.022), r(0.038, 0.02).bevel(0.004), r(0.039, 0.0)]);
    kit.pair(Metal, &Loft::new(frame, hub).grid(0.001), head, &[]);
    // A lamp above each cup, and an aerial on the left.
    let lamp = Frame::along(MIDDLE + DVec3::new(0.152, 0.095, -0.03), DVec3::NEG_Z, DVec3::Y);
    kit.pair(
        Metal,
        &tile(&lamp, &rectangle(0.044, 0.04), 0.012, 0.055, 0.005),
        head,
        &[],
    );
    let glass = Frame {
        origin: lamp.origin + DVec3::NEG_Z * 0.05,
        ..lamp
    };
    kit.pair(
        Visor,
        &block(&glass, &rectangle(0.03, 0.026), 0.008, 0.008, 0.002),
        head,
        &[],
    );
    let foot = origin + DVec3::new(0.012, 0.05, 0.03);
    let aerial = [
        foot,
        foot + DVec3::new(0.004, 0.06, 0.012),
        foot + DVec3::new(0.006, 0.13, 0.03),
    ];
    kit.one(
        Metal,
        &tube(&aerial, 2, 6, |step| 0.0045 - 0.0004 * step as f64),
        head,
        &[],
    );
}

fn neck(kit: &mut Kit<'_>, head: &Binding) {
    let frame = Frame::upright(DVec3::ZERO);
    let r = |at: f64, radius: f64| ring(at, radius, radius);
    let collar = bevelled(&[
        r(1.446, 0.085),
        r(1.438, 0.112).bevel(0.004),
        r(1.458, 0.124).bevel(0.005),
        r(1.485, 0.11),
    ]);
    kit.one(Metal, &Loft::new(frame, collar).grid(FINE), head, &[]);
    let bellows = ribs(r(1.385, 0.092), r(1.465, 0.092), 2, 0.009);
    let joints = vec![(1.40, CHEST), (1.43, NECK), (1.46, HEAD)];
    let binding = Binding::Along {
        origin: DVec3::ZERO,
        along: DVec3::Y,
        joints,
    };
    kit.one(Rubber, &Loft::new(frame, bellows).grid(COARSE), &binding, &[]);
}
