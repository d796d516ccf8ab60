//! Chest, waist and hips.

use glam::DVec3;

use super::{INK, Kit, PLATE, bolt, plate, ribs};
use crate::maps::Mark;
use crate::materials::Material::{Metal, Rubber, Shell, Trim, Visor};
use crate::rig::{CHEST, HIPS, RIBS, WAIST};
use crate::shape::{Binding, COARSE, FINE, Frame, Loft, Ring, bevelled, block, rectangle, ring, smooth, tile};

pub(crate) fn add(kit: &mut Kit<'_>) {
    chest(kit);
    controls(kit);
    waist(kit);
    hips(kit);
}

/// The chest's core, which shows between its plates.
pub(crate) fn core() -> Loft {
    Loft::new(Frame::upright(DVec3::ZERO), core_rings(2))
}

fn core_rings(steps: usize) -> Vec<Ring> {
    smooth(
        &[
            ring(1.125, 0.128, 0.1).square(0.3),
            ring(1.18, 0.148, 0.112).square(0.35),
            ring(1.25, 0.165, 0.122).square(0.4),
            ring(1.315, 0.17, 0.124).square(0.4),
            ring(1.365, 0.152, 0.114).square(0.3),
            ring(1.395, 0.122, 0.104).square(0.1),
        ],
        steps,
    )
}

const BREAST: &[[f64; 2]] = &[
    [0.315, 0.34],
    [0.49, 0.34],
    [0.49, 0.90],
    [0.40, 0.93],
    [0.335, 0.86],
    [0.30, 0.60],
];
const BELLY: &[[f64; 2]] = &[[0.425, 0.03], [0.575, 0.03], [0.59, 0.29], [0.41, 0.29]];
const SIDE: &[[f64; 2]] = &[[0.345, 0.03], [0.412, 0.03], [0.397, 0.29], [0.315, 0.29]];
const FLANK: &[[f64; 2]] = &[[0.175, 0.04], [0.325, 0.04], [0.298, 0.29], [0.29, 0.44], [0.175, 0.44]];
const BACK: &[[f64; 2]] = &[
    [0.01, 0.04],
    [0.158, 0.04],
    [0.158, 0.60],
    [0.15, 0.86],
    [0.09, 0.92],
    [0.01, 0.92],
];

fn chest(kit: &mut Kit<'_>) {
    let chest = Binding::Rigid(CHEST);
    let core = core();
    let mut rings = core_rings(1);
    rings.insert(0, rings[0].inset(0.03));
    let closed = Loft::new(core.frame, rings);
    kit.one(Rubber, &closed.grid(COARSE), &chest, &[]);
    let mut breast = plate(&core, BREAST, 0.014);
    breast.bevel = 0.005;
    // It bends most, and large facets would shade themselves where light grazes them.
    breast.longest = 0.034;
    kit.sides(Shell, &breast.grid(), &chest, [NUMBER, NAME]);
    for (outline, lift) in [(SIDE, 0.010), (FLANK, 0.009), (BACK, 0.009)] {
        let mut plate = plate(&core, outline, lift);
        plate.bevel = 0.005;
        kit.pair(Shell, &plate.grid(), &chest, PLATE);
    }
    let mut belly = plate(&core, BELLY, 0.011);
    belly.bevel = 0.005;
    kit.one(Shell, &belly.grid(), &chest, PLATE);
    // The ring that the neck stands in.
    let frame = Frame::upright(DVec3::ZERO);
    let r = |at: f64, right: f64, front: f64| ring(at, right, front);
    let collar = bevelled(&[
        r(1.375, 0.12, 0.11),
        r(1.385, 0.142, 0.124).bevel(0.005),
        r(1.412, 0.13, 0.122).bevel(0.006),
        r(1.416, 0.106, 0.106),
    ]);
    kit.one(Shell, &Loft::new(frame, collar).grid(FINE), &chest, &[]);
    let lock = bevelled(&[
        r(1.40, 0.1, 0.1),
        r(1.405, 0.118, 0.116).bevel(0.003),
        r(1.424, 0.116, 0.114).bevel(0.004),
        r(1.424, 0.1, 0.1),
    ]);
    kit.one(Trim, &Loft::new(frame, lock).grid(FINE), &chest, &[]);
    // Rings that the arms come out of.
    let origin = kit.rig.origin(crate::rig::Side::Left, crate::rig::Limb::UpperArm);
    let side = Frame::along(origin - DVec3::X * 0.075, DVec3::new(0.96, -0.28, 0.0), DVec3::NEG_Z);
    let hole = bevelled(&[
        r(0.0, 0.084, 0.084),
        r(0.034, 0.082, 0.082).bevel(0.005),
        r(0.036, 0.066, 0.066),
    ]);
    kit.pair(Metal, &Loft::new(side, hole).grid(COARSE), &chest, &[]);
}

const NUMBER: &[Mark] = &[
    Mark::Gap,
    Mark::Border(0.012),
    Mark::Word {
        middle: [0.5, 0.26],
        word: "07",
        height: 0.026,
        tone: INK,
    },
];
const NAME: &[Mark] = &[
    Mark::Gap,
    Mark::Border(0.012),
    Mark::Word {
        middle: [0.59, 0.26],
        word: "BINDPOSE",
        height: 0.0115,
        tone: INK,
    },
];

/// The unit on the chest.
fn controls(kit: &mut Kit<'_>) {
    let chest = Binding::Rigid(CHEST);
    let face = Frame {
        origin: DVec3::new(0.0, 1.243, -0.118),
        right: DVec3::X,
        front: DVec3::Y,
        along: DVec3::new(0.0, 0.0, -1.0),
    };
    let on = |x: f64, y: f64, z: f64| Frame {
        origin: face.origin + DVec3::new(x, y, -z),
        ..face
    };
    let outline = [
        [-0.066, -0.042],
        [0.066, -0.042],
        [0.072, 0.02],
        [0.052, 0.044],
        [-0.052, 0.044],
        [-0.072, 0.02],
    ];
    kit.one(
        Metal,
        &block(&on(0.0, 0.0, 0.0), &outline, 0.006, 0.034, 0.005),
        &chest,
        &[],
    );
    let lid = outline.map(|[x, y]| [x * 0.86, y * 0.8]);
    kit.one(
        Trim,
        &block(&on(0.0, 0.0, 0.03), &lid, 0.006, 0.014, 0.003),
        &chest,
        &[],
    );
    kit.one(
        Visor,
        &block(&on(-0.018, 0.008, 0.04), &rectangle(0.056, 0.026), 0.004, 0.006, 0.0015),
        &chest,
        &[],
    );
    let r = |at: f64, radius: f64| ring(at, radius, radius);
    let knob = bevelled(&[r(0.0, 0.0115), r(0.014, 0.0105).bevel(0.003), r(0.014, 0.0)]);
    kit.one(Metal, &Loft::new(on(0.034, 0.006, 0.04), knob).grid(FINE), &chest, &[]);
    for x in [-0.036, -0.018, 0.0] {
        let button = bevelled(&[r(0.0, 0.005), r(0.007, 0.0045).bevel(0.0015), r(0.007, 0.0)]);
        kit.one(Shell, &Loft::new(on(x, -0.02, 0.04), button).grid(FINE), &chest, &[]);
    }
    for (x, y) in [(0.062, -0.03), (-0.062, -0.03)] {
        kit.one(Metal, &bolt(on(x, y, 0.034).origin, face.along, 0.0035), &chest, &[]);
    }
    // Sockets of the hoses.
    let socket = bevelled(&[
        r(0.0, 0.03),
        r(0.02, 0.028).bevel(0.004),
        r(0.02, 0.021),
        r(0.034, 0.021).bevel(0.003),
        r(0.034, 0.0),
    ]);
    let place = Frame::along(SOCKET - SOCKET_ALONG * 0.026, SOCKET_ALONG, DVec3::Y);
    kit.pair(Trim, &Loft::new(place, socket).grid(FINE), &chest, &[]);
}

/// Where the left hose ends on the chest, and where it comes from there.
pub(crate) const SOCKET: DVec3 = DVec3::new(0.088, 1.292, -0.146);
pub(crate) const SOCKET_ALONG: DVec3 = DVec3::new(0.28, 0.0, -0.96);

fn waist(kit: &mut Kit<'_>) {
    let frame = Frame::upright(DVec3::ZERO);
    let mut rings = vec![ring(0.93, 0.12, 0.094).square(0.3)];
    rings.extend(ribs(
        ring(0.985, 0.121, 0.093).square(0.3),
        ring(1.135, 0.117, 0.091).square(0.3),
        4,
        0.011,
    ));
    rings.push(ring(1.16, 0.11, 0.09).square(0.3));
    let binding = Binding::Along {
        origin: DVec3::ZERO,
        along: DVec3::Y,
        joints: vec![(0.985, HIPS), (1.045, WAIST), (1.09, RIBS), (1.13, CHEST)],
    };
    kit.one(Rubber, &Loft::new(frame, rings).grid(COARSE), &binding, &[]);
}

/// The hips' shell.
fn pelvis() -> Vec<Ring> {
    smooth(
        &[
            ring(0.785, 0.028, 0.05).square(0.6).centre(0.0, 0.0),
            ring(0.82, 0.048, 0.085).square(0.5),
            ring(0.86, 0.088, 0.106).square(0.4),
            ring(0.91, 0.132, 0.114).square(0.35),
            ring(0.955, 0.147, 0.115).square(0.35),
        ],
        1,
    )
}

fn hips(kit: &mut Kit<'_>) {
    let hips = Binding::Rigid(HIPS);
    let frame = Frame::upright(DVec3::ZERO);
    let pelvis = Loft::new(frame, pelvis());
    kit.one(Shell, &pelvis.shelled(0.006, 0.03).grid(FINE), &hips, &[]);
    let belt = bevelled(&[
        ring(0.945, 0.14, 0.108).square(0.35),
        ring(0.948, 0.155, 0.123).square(0.35).bevel(0.004),
        ring(0.992, 0.148, 0.118).square(0.35).bevel(0.005),
        ring(0.996, 0.128, 0.1).square(0.35),
    ]);
    kit.one(Trim, &Loft::new(frame, belt).grid(FINE), &hips, &[]);
    let front = [[0.42, 0.28], [0.58, 0.28], [0.565, 0.84], [0.435, 0.84]];
    kit.one(Shell, &plate(&pelvis, &front, 0.007).grid(), &hips, PLATE);
    let buckle = Frame {
        origin: DVec3::new(0.0, 0.97, -0.115),
        right: DVec3::X,
        front: DVec3::Y,
        along: DVec3::NEG_Z,
    };
    kit.one(
        Metal,
        &block(&buckle, &rectangle(0.074, 0.052), 0.008, 0.016, 0.004),
        &hips,
        &[],
    );
    kit.one(
        Shell,
        &block(&buckle, &rectangle(0.042, 0.026), 0.005, 0.021, 0.003),
        &hips,
        &[],
    );
    // Plates over the hip joints.
    let hip = Frame::along(DVec3::new(0.156, 0.897, 0.0), DVec3::new(0.96, 0.28, 0.0), DVec3::Y);
    let outline = [[-0.042, -0.046], [0.042, -0.046], [0.052, 0.048], [-0.052, 0.048]];
    kit.pair(Shell, &tile(&hip, &outline, 0.006, 0.03, 0.004), &hips, &[]);
    // Pouches on the belt.
    for (x, z, turn) in [(0.118, -0.086, -0.55), (0.152, 0.012, 0.0)] {
        let along = if turn == 0.0 {
            DVec3::X
        } else {
            DVec3::new(0.6, 0.0, -0.8)
        };
        let pouch = Frame::along(DVec3::new(x, 0.966, z), along, DVec3::Y);
        kit.pair(
            Metal,
            &block(&pouch, &rectangle(0.05, 0.058), 0.006, 0.026, 0.004),
            &hips,
            &[],
        );
    }
}
