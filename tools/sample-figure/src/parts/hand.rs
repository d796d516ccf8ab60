//! Gloves: a palm, four fingers and a thumb.

use glam::DVec3;

use super::Kit;
use crate::materials::Material::{Rubber, Shell, Trim};
use crate::rig::{ARM, FORWARD, Limb, PALM, Side, joint};
use crate::shape::{Binding, FINE, Frame, Loft, Ring, block, rectangle, ring, smooth};

pub(crate) fn add(kit: &mut Kit<'_>) {
    let hand = Binding::Rigid(joint(Side::Left, Limb::Hand));
    let wrist = kit.rig.origin(Side::Left, Limb::Hand);
    let frame = Frame::along(wrist, ARM, FORWARD);
    let palm = smooth(
        &[
            ring(-0.012, 0.0, 0.0),
            ring(-0.008, 0.024, 0.028).square(0.3),
            ring(0.012, 0.027, 0.036).square(0.5),
            ring(0.045, 0.026, 0.05).square(0.7),
            ring(0.085, 0.022, 0.055).square(0.75),
            ring(0.1, 0.015, 0.05).square(0.7),
            ring(0.102, 0.0, 0.0),
        ],
        1,
    );
    kit.pair(Rubber, &Loft::new(frame, palm).grid(FINE), &hand, &[]);
    // A plate on the back of the hand, and one over each knuckle.
    let back = Frame {
        origin: wrist + ARM * 0.052 + frame.right * 0.019,
        right: frame.front,
        front: frame.along,
        along: frame.right,
    };
    let outline = [
        [-0.034, -0.04],
        [0.034, -0.04],
        [0.052, 0.012],
        [0.05, 0.034],
        [-0.05, 0.034],
        [-0.052, 0.012],
    ];
    kit.pair(Shell, &block(&back, &outline, 0.01, 0.013, 0.004), &hand, &[]);
    let knuckles = Frame {
        origin: wrist + ARM * 0.056 + frame.right * 0.03,
        ..back
    };
    let inlay = outline.map(|[x, y]| [x * 0.6, y * 0.55]);
    kit.pair(Trim, &block(&knuckles, &inlay, 0.0, 0.005, 0.002), &hand, &[]);
    fingers(kit);
}

fn fingers(kit: &mut Kit<'_>) {
    let fingers = [
        (Limb::Index, Limb::IndexTip, 0.0, 1.0, 0.016),
        (Limb::Middle, Limb::MiddleTip, 0.0, 1.0, 0.0165),
        (Limb::Outer, Limb::OuterTip, -0.014, 1.04, 0.016),
        (Limb::Outer, Limb::OuterTip, 0.0145, 0.84, 0.0145),
        (Limb::Thumb, Limb::ThumbTip, 0.0, 1.0, 0.019),
    ];
    for (base, tip, aside, part, radius) in fingers {
        let [base, tip] = [base, tip].map(|limb| joint(Side::Left, limb));
        let (from, to) = (kit.rig.joints[base].origin, kit.rig.joints[tip].tip);
        let knuckle = kit.rig.joints[tip].origin.distance(from);
        let length = to.distance(from) * part;
        let along = (to - from + DVec3::Z * aside * 0.35).normalize();
        let thumb = base == joint(Side::Left, Limb::Thumb);
        let back = if thumb {
            (-PALM + DVec3::Z * 0.2).normalize()
        } else {
            -PALM
        };
        let frame = Frame::along(from + DVec3::Z * aside, along, back);
        let hand = joint(Side::Left, Limb::Hand);
        let binding = Binding::Along {
            origin: frame.origin,
            along,
            joints: vec![
                (-0.016, hand),
                (0.006, base),
                (knuckle - 0.011, base),
                (knuckle + 0.011, tip),
            ],
        };
        kit.pair(
            Rubber,
            &Loft::new(frame, finger(length, radius, knuckle)).grid(FINE),
            &binding,
            &[],
        );
        if thumb {
            continue;
        }
        // A hard cover on its back.
        let reach = knuckle - 0.014;
        let cover = Frame {
            origin: frame.origin + along * (0.01 + reach / 2.0) + frame.front * (radius * 0.55),
            right: frame.right,
            front: along,
            along: frame.front,
        };
        let outline = rectangle(radius * 1.5, reach);
        kit.pair(
            Shell,
            &block(&cover, &outline, 0.004, radius * 0.66, 0.003),
            &Binding::Rigid(base),
            &[],
        );
    }
    let wrist = kit.rig.origin(Side::Left, Limb::Hand);
    let thumb = kit.rig.origin(Side::Left, Limb::Thumb);
    let ball = smooth(
        &[
            ring(-0.02, 0.0, 0.0),
            ring(-0.014, 0.018, 0.018),
            ring(0.01, 0.023, 0.022),
            ring(0.03, 0.019, 0.019),
            ring(0.04, 0.0, 0.0),
        ],
        1,
    );
    let frame = Frame::along(
        wrist + ARM * 0.012 + FORWARD * 0.012 + PALM * 0.004,
        thumb - wrist,
        PALM,
    );
    kit.pair(
        Rubber,
        &Loft::new(frame, ball).grid(FINE),
        &Binding::Rigid(joint(Side::Left, Limb::Hand)),
        &[],
    );
}

fn finger(length: f64, radius: f64, knuckle: f64) -> Vec<Ring> {
    let r = |at: f64, part: f64| ring(at, radius * part, radius * part);
    vec![
        r(-0.004, 0.96),
        r(knuckle - 0.008, 0.97),
        r(knuckle, 1.05),
        r(knuckle + 0.008, 0.93),
        r(length - 0.014, 0.9),
        r(length - 0.003, 0.6),
        r(length, 0.0),
    ]
}
