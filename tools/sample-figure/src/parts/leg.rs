//! Thighs, knees, shins and boots.

use glam::DVec3;

use super::{Kit, PLATE, bolt, plate, ribs};
use crate::materials::Material::{Metal, Rubber, Shell, Trim};
use crate::rig::{HIPS, Limb, Side, joint};
use crate::shape::{Binding, COARSE, FINE, Frame, Loft, Ring, bevelled, block, rectangle, ring, smooth, tile};

/// Middle of the leg, and of the boot, metres to the left.
const X: f64 = 0.106;
const BOOT_X: f64 = 0.109;

pub(crate) fn add(kit: &mut Kit<'_>) {
    let of = |limb| joint(Side::Left, limb);
    let frame = Frame::upright(DVec3::new(X, 0.0, 0.0));
    let r = |at: f64, radius: f64| ring(at, radius, radius);

    // The undersuit, from inside of the hips to the ankle.
    let mut leg = vec![
        r(0.925, 0.055).centre(-0.025, 0.0),
        r(0.88, 0.082).centre(-0.012, 0.0),
        r(0.83, 0.085).centre(-0.006, 0.0),
        r(0.77, 0.08),
        r(0.6, 0.062),
    ];
    leg.extend(ribs(
        r(0.575, 0.058).centre(0.0, 0.004),
        r(0.415, 0.054).centre(0.0, 0.002),
        4,
        0.01,
    ));
    leg.extend(ribs(
        r(0.185, 0.043).centre(0.002, -0.008),
        r(0.095, 0.043).centre(0.002, -0.006),
        2,
        0.008,
    ));
    let binding = Binding::Along {
        origin: DVec3::ZERO,
        along: DVec3::NEG_Y,
        joints: vec![
            (-0.935, HIPS),
            (-0.84, of(Limb::Thigh)),
            (-0.55, of(Limb::Thigh)),
            (-0.43, of(Limb::Shin)),
            (-0.16, of(Limb::Shin)),
            (-0.085, of(Limb::Foot)),
        ],
    };
    kit.pair(Rubber, &Loft::new(frame, leg).grid(COARSE), &binding, &[]);
    thigh(kit, frame);
    shin(kit, frame);
    boot(kit);
}

fn thigh(kit: &mut Kit<'_>, frame: Frame) {
    let bone = Binding::Rigid(joint(Side::Left, Limb::Thigh));
    let wall = Loft::new(
        frame,
        smooth(
            &[
                ring(0.795, 0.092, 0.096).tilt(0.55, 0.12).square(0.1),
                ring(0.74, 0.092, 0.096).tilt(0.3, 0.06).square(0.15),
                ring(0.66, 0.084, 0.088).square(0.15),
                ring(0.59, 0.075, 0.078).square(0.1),
            ],
            1,
        ),
    );
    kit.pair(Shell, &wall.shelled(0.006, 0.02).grid(FINE), &bone, &[]);
    let side = [[0.15, 0.14], [0.35, 0.14], [0.33, 0.78], [0.17, 0.78]];
    kit.pair(Trim, &plate(&wall, &side, 0.007).grid(), &bone, PLATE);
    let front = [[0.40, 0.16], [0.60, 0.16], [0.58, 0.84], [0.42, 0.84]];
    kit.pair(Shell, &plate(&wall, &front, 0.006).grid(), &bone, PLATE);
    let band = vec![
        ring(0.604, 0.073, 0.076),
        ring(0.600, 0.081, 0.084),
        ring(0.587, 0.079, 0.082),
        ring(0.583, 0.072, 0.075),
    ];
    kit.pair(Metal, &Loft::new(frame, band).grid(FINE), &bone, &[]);
}

fn shin(kit: &mut Kit<'_>, frame: Frame) {
    let bone = Binding::Rigid(joint(Side::Left, Limb::Shin));
    let wall = Loft::new(
        frame,
        smooth(
            &[
                ring(0.41, 0.066, 0.07).centre(0.0, 0.0).tilt(0.0, 0.25),
                ring(0.36, 0.072, 0.078).centre(0.0, -0.006).tilt(0.0, 0.1),
                ring(0.29, 0.07, 0.076).centre(0.0, -0.008),
                ring(0.215, 0.062, 0.066).centre(0.001, -0.006),
                ring(0.18, 0.064, 0.068).centre(0.001, -0.006),
            ],
            1,
        ),
    );
    kit.pair(Shell, &wall.shelled(0.006, 0.024).grid(FINE), &bone, &[]);
    let greave = [[0.41, 0.07], [0.59, 0.07], [0.565, 0.92], [0.435, 0.92]];
    kit.pair(Shell, &plate(&wall, &greave, 0.009).grid(), &bone, PLATE);
    let band = vec![
        ring(0.224, 0.059, 0.063).centre(0.001, -0.006),
        ring(0.2195, 0.0685, 0.0725).centre(0.001, -0.006),
        ring(0.2025, 0.0685, 0.0725).centre(0.001, -0.006),
        ring(0.198, 0.059, 0.063).centre(0.001, -0.006),
    ];
    kit.pair(Trim, &Loft::new(frame, band).grid(FINE), &bone, &[]);
    // Knee cap: a shield in front of the joint.
    let knee = Frame::along(DVec3::new(X, 0.492, -0.046), DVec3::NEG_Z, DVec3::Y);
    let cap = bevelled(&[
        ring(0.0, 0.044, 0.058).square(0.5),
        ring(0.016, 0.05, 0.064).square(0.5).bevel(0.004),
        ring(0.03, 0.043, 0.056).square(0.5).bevel(0.006),
        ring(0.038, 0.022, 0.03).square(0.4),
        ring(0.039, 0.0, 0.0),
    ]);
    kit.pair(Trim, &Loft::new(knee, cap).grid(FINE), &bone, &[]);
    let hinge = |x: f64| Frame::along(DVec3::new(X + x, 0.492, 0.0), DVec3::X * x.signum(), DVec3::NEG_Z);
    for x in [0.057, -0.057] {
        let disc = bevelled(&[
            ring(0.0, 0.033, 0.033),
            ring(0.018, 0.032, 0.032).bevel(0.004),
            ring(0.018, 0.02, 0.02),
            ring(0.014, 0.018, 0.018),
            ring(0.014, 0.0, 0.0),
        ]);
        let hinge = hinge(x);
        kit.pair(Metal, &Loft::new(hinge, disc).grid(FINE), &bone, &[]);
        if x < 0.0 {
            // The bolt of the inner one is not seen.
            continue;
        }
        kit.pair(
            Metal,
            &bolt(hinge.origin + hinge.along * 0.014, hinge.along, 0.008),
            &bone,
            &[],
        );
    }
}

/// From heel to toe: place, half width, half height, height of the middle.
const UPPER: [[f64; 4]; 10] = [
    [-0.078, 0.0, 0.0, 0.055],
    [-0.076, 0.03, 0.026, 0.058],
    [-0.066, 0.048, 0.039, 0.071],
    [-0.036, 0.059, 0.053, 0.083],
    [0.01, 0.061, 0.053, 0.083],
    [0.06, 0.06, 0.047, 0.076],
    [0.11, 0.063, 0.036, 0.066],
    [0.155, 0.061, 0.031, 0.06],
    [0.19, 0.046, 0.024, 0.053],
    [0.208, 0.0, 0.0, 0.048],
];

fn boot(kit: &mut Kit<'_>) {
    let [foot, toe] = [Limb::Foot, Limb::Toe].map(|limb| joint(Side::Left, limb));
    // From heel to toe, its front up.
    let frame = Frame {
        origin: DVec3::new(BOOT_X, 0.0, 0.0),
        right: DVec3::X,
        front: DVec3::Y,
        along: DVec3::NEG_Z,
    };
    let soft = Binding::Along {
        origin: DVec3::ZERO,
        along: DVec3::NEG_Z,
        joints: vec![(0.09, foot), (0.135, toe)],
    };
    let upper = UPPER.map(|[at, width, height, middle]| ring(at, width, height).centre(0.0, middle).square(0.3));
    let upper = Loft::new(frame, smooth(&upper, 1));
    // Its ends are under the caps.
    let seen = Loft::new(frame, upper.rings[2..8].to_vec());
    kit.pair(Shell, &seen.grid(FINE), &soft, &[]);
    // A band where the foot bends, and hard caps over toes and heel.
    let cut = |from: f64, to: f64, by: f64| -> Vec<Ring> {
        let rings = smooth(&upper.rings, 2).into_iter();
        let inside = rings.filter(|ring| (from..=to).contains(&ring.at));
        inside
            .map(|ring| {
                if ring.half.x > 0.0 {
                    ring.inset(-by)
                } else {
                    ring.moved(by)
                }
            })
            .collect()
    };
    let mut band = cut(0.075, 0.135, 0.006);
    band.insert(0, band[0].inset(0.02));
    band.push(band[band.len() - 1].inset(0.02));
    kit.pair(Rubber, &Loft::new(frame, band).grid(COARSE), &soft, &[]);
    let mut toes = cut(0.13, 0.3, 0.008);
    let edge = toes[0];
    toes.splice(..1, [edge.inset(0.02), edge]);
    kit.pair(Metal, &Loft::new(frame, toes).grid(FINE), &Binding::Rigid(toe), &[]);
    let mut heel = cut(-0.1, -0.03, 0.008);
    heel[0] = heel[0].moved(-0.012);
    let edge = heel.pop().expect("a heel");
    heel.extend([edge, edge.inset(0.02)]);
    kit.pair(Rubber, &Loft::new(frame, heel).grid(COARSE), &Binding::Rigid(foot), &[]);
    let collar = bevelled(&[
        ring(0.105, 0.05, 0.052).centre(0.0, -0.006),
        ring(0.108, 0.063, 0.066).centre(0.0, -0.006).tilt(0.0, -0.12),
        ring(0.152, 0.066, 0.069)
            .centre(0.0, -0.006)
            .tilt(0.0, -0.12)
            .bevel(0.005),
        ring(0.154, 0.054, 0.056).centre(0.0, -0.006).tilt(0.0, -0.12),
    ]);
    let ankle = Frame::upright(frame.origin);
    kit.pair(Shell, &Loft::new(ankle, collar).grid(FINE), &Binding::Rigid(foot), &[]);
    let instep = [[0.36, 0.40], [0.64, 0.40], [0.62, 0.52], [0.38, 0.52]];
    kit.pair(
        Trim,
        &plate(&upper, &instep, 0.007).grid(),
        &Binding::Rigid(foot),
        PLATE,
    );
    sole(kit, &soft);
}

fn sole(kit: &mut Kit<'_>, soft: &Binding) {
    let up = Frame {
        origin: DVec3::new(BOOT_X, 0.012, 0.0),
        right: DVec3::X,
        front: DVec3::NEG_Z,
        along: DVec3::Y,
    };
    let outline = [
        [-0.05, -0.086],
        [0.05, -0.086],
        [0.064, -0.03],
        [0.06, 0.04],
        [0.069, 0.12],
        [0.064, 0.175],
        [0.03, 0.216],
        [-0.03, 0.216],
        [-0.06, 0.175],
        [-0.065, 0.12],
        [-0.056, 0.04],
        [-0.062, -0.03],
    ];
    kit.pair(Rubber, &tile(&up, &outline, 0.0, 0.026, 0.004), soft, &[]);
    // Lugs under it.
    for (at, width, bone) in [
        (-0.066, 0.1, Limb::Foot),
        (-0.03, 0.12, Limb::Foot),
        (0.062, 0.116, Limb::Foot),
        (0.09, 0.126, Limb::Foot),
        (0.118, 0.132, Limb::Toe),
        (0.146, 0.13, Limb::Toe),
        (0.174, 0.118, Limb::Toe),
        (0.2, 0.08, Limb::Toe),
    ] {
        let down = Frame {
            origin: DVec3::new(BOOT_X, 0.014, -at),
            right: DVec3::X,
            front: DVec3::Z,
            along: DVec3::NEG_Y,
        };
        let lug = block(&down, &rectangle(width, 0.017), 0.0, 0.014, 0.0);
        kit.pair(Rubber, &lug, &Binding::Rigid(joint(Side::Left, bone)), &[]);
    }
}
