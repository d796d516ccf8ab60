//! Shoulders, arms and cuffs.

use glam::DVec3;

use super::{INK, Kit, PLATE, plate, ribs};
use crate::maps::Mark;
use crate::materials::Material::{Metal, Rubber, Shell, Trim, Visor};
use crate::rig::{ARM, FORWARD, Limb, Side, joint};
use crate::shape::{Binding, COARSE, FINE, Frame, Loft, Ring, bevelled, block, rectangle, ring, shell, smooth};

/// From the shoulder along the arm.
const ELBOW: f64 = 0.25;
const WRIST: f64 = 0.485;

pub(crate) fn add(kit: &mut Kit<'_>) {
    let of = |limb| joint(Side::Left, limb);
    let frame = Frame::along(kit.rig.origin(Side::Left, Limb::UpperArm), ARM, FORWARD);
    let [upper, lower] = [Limb::UpperArm, Limb::Forearm].map(|limb| Binding::Rigid(of(limb)));
    let r = |at: f64, radius: f64| ring(at, radius, radius);

    // The undersuit, from inside of the chest to the wrist.
    let mut sleeve = vec![r(-0.07, 0.04), r(-0.02, 0.066), r(0.09, 0.05)];
    sleeve.extend(ribs(r(0.178, 0.044), r(0.316, 0.042), 4, 0.0085));
    sleeve.extend(ribs(r(0.44, 0.034), r(0.495, 0.032), 2, 0.006));
    let joints = vec![
        (-0.06, of(Limb::Clavicle)),
        (0.05, of(Limb::UpperArm)),
        (ELBOW - 0.055, of(Limb::UpperArm)),
        (ELBOW + 0.055, of(Limb::Forearm)),
        (WRIST - 0.03, of(Limb::Forearm)),
        (WRIST + 0.015, of(Limb::Hand)),
    ];
    let along = Binding::Along {
        origin: frame.origin,
        along: frame.along,
        joints,
    };
    kit.pair(Rubber, &Loft::new(frame, sleeve).grid(COARSE), &along, &[]);

    let pauldron = Loft::new(frame, pauldron());
    kit.pair(Shell, &pauldron.grid(FINE * 0.7), &upper, PAULDRON);
    let badge = [[0.16, 0.42], [0.34, 0.42], [0.36, 0.74], [0.14, 0.74]];
    kit.pair(Trim, &plate(&pauldron, &badge, 0.006).grid(), &upper, BADGE);

    let sleeve = Loft::new(frame, vec![r(0.098, 0.057), r(0.13, 0.06), r(0.18, 0.057)]);
    kit.pair(Shell, &sleeve.shelled(0.005, 0.02).grid(FINE), &upper, &[]);
    let band = vec![r(0.155, 0.055), r(0.159, 0.0625), r(0.173, 0.0625), r(0.177, 0.055)];
    kit.pair(Trim, &Loft::new(frame, band).grid(FINE), &upper, &[]);

    // A cap over the point of the elbow.
    let elbow = Frame::along(frame.origin + ARM * (ELBOW + 0.004) + DVec3::Z * 0.03, DVec3::Z, ARM);
    let cap = bevelled(&[
        ring(0.0, 0.03, 0.036),
        ring(0.022, 0.029, 0.035).bevel(0.007),
        ring(0.03, 0.016, 0.02),
        ring(0.031, 0.0, 0.0),
    ]);
    kit.pair(Shell, &Loft::new(elbow, cap).grid(FINE), &lower, &[]);

    forearm(kit, frame, &lower);
}

fn pauldron() -> Vec<Ring> {
    let mut dome = smooth(
        &[
            ring(-0.062, 0.05, 0.05).centre(0.018, 0.0),
            ring(-0.046, 0.068, 0.069).centre(0.012, 0.0),
            ring(-0.01, 0.084, 0.085).centre(0.006, 0.0),
            ring(0.03, 0.084, 0.085).centre(0.004, 0.0),
            ring(0.066, 0.074, 0.077).centre(0.003, 0.0),
        ],
        1,
    );
    let last = dome.len() - 1;
    dome[last] = dome[last].tilt(0.35, 0.0);
    dome[last - 1] = dome[last - 1].tilt(0.18, 0.0);
    shell(&dome, 0.006, 0.03)
}

fn forearm(kit: &mut Kit<'_>, frame: Frame, lower: &Binding) {
    let r = |at: f64, radius: f64| ring(at, radius, radius);
    let wall = smooth(
        &[
            r(0.312, 0.052).tilt(0.0, 0.0),
            r(0.34, 0.058),
            r(0.39, 0.059),
            r(0.432, 0.054),
        ],
        1,
    );
    let gauntlet = Loft::new(frame, wall);
    kit.pair(Shell, &gauntlet.shelled(0.005, 0.02).grid(FINE), lower, &[]);
    let cuff = bevelled(&[
        r(0.422, 0.04),
        r(0.424, 0.058).bevel(0.004),
        r(0.44, 0.061).bevel(0.003),
        r(0.462, 0.058).bevel(0.005),
        r(0.464, 0.04),
    ]);
    kit.pair(Trim, &Loft::new(frame, cuff).grid(FINE), lower, &[]);
    let guard = [[0.12, 0.08], [0.40, 0.08], [0.38, 0.84], [0.14, 0.84]];
    kit.pair(Shell, &plate(&gauntlet, &guard, 0.006).grid(), lower, PLATE);
    // A small screen on top.
    let screen = Frame {
        origin: frame.origin + ARM * 0.378 + frame.right * 0.058,
        right: frame.front,
        front: frame.along,
        along: frame.right,
    };
    kit.pair(
        Metal,
        &block(&screen, &rectangle(0.046, 0.06), 0.006, 0.015, 0.003),
        lower,
        &[],
    );
    kit.pair(
        Visor,
        &block(&screen, &rectangle(0.034, 0.044), 0.004, 0.017, 0.001),
        lower,
        &[],
    );
}

const PAULDRON: &[Mark] = &[Mark::LineV(0.8)];
const BADGE: &[Mark] = &[
    Mark::Gap,
    Mark::Word {
        middle: [0.5, 0.5],
        word: "07",
        height: -0.022,
        tone: INK,
    },
];
