//! The pack on the back, its tanks and hoses.

use glam::DVec3;

use super::torso::{SOCKET, SOCKET_ALONG};
use super::{INK, Kit, bolt};
use crate::maps::Mark;
use crate::materials::Material::{Metal, Rubber, Shell, Trim};
use crate::rig::CHEST;
use crate::shape::{Binding, FINE, Frame, Loft, bevelled, block, rectangle, ring, tile, tube};

pub(crate) fn add(kit: &mut Kit<'_>) {
    let chest = Binding::Rigid(CHEST);
    let back = |x: f64, y: f64, z: f64| Frame {
        origin: DVec3::new(x, y, z),
        right: DVec3::NEG_X,
        front: DVec3::Y,
        along: DVec3::Z,
    };
    kit.one(
        Metal,
        &block(&back(0.0, 1.25, 0.1), &rectangle(0.2, 0.25), 0.0, 0.05, 0.008),
        &chest,
        &[],
    );
    let body = [
        [-0.122, -0.12],
        [0.122, -0.12],
        [0.132, 0.05],
        [0.098, 0.155],
        [-0.098, 0.155],
        [-0.132, 0.05],
    ];
    kit.one(
        Shell,
        &tile(&back(0.0, 1.25, 0.128), &body, 0.03, 0.09, 0.016),
        &chest,
        BODY,
    );
    let panel = [
        [-0.062, -0.074],
        [0.062, -0.074],
        [0.066, 0.03],
        [0.046, 0.07],
        [-0.046, 0.07],
        [-0.066, 0.03],
    ];
    kit.one(
        Trim,
        &block(&back(0.0, 1.275, 0.21), &panel, 0.014, 0.018, 0.006),
        &chest,
        PANEL,
    );
    for [x, y] in [panel[0], panel[1], panel[2], panel[5]] {
        let place = DVec3::new(-x * 1.22, 1.275 + y * 1.22, 0.217);
        kit.one(Metal, &bolt(place, DVec3::Z, 0.004), &chest, &[]);
    }
    // Louvres below the panel.
    for row in 0..3 {
        let slat = back(0.0, 1.178 - 0.016 * f64::from(row), 0.212);
        kit.one(
            Metal,
            &block(&slat, &rectangle(0.11, 0.009), 0.003, 0.009, 0.002),
            &chest,
            &[],
        );
    }
    // Tanks.
    let tank = Frame::upright(DVec3::new(0.152, 0.0, 0.158));
    let r = |at: f64, radius: f64| ring(at, radius, radius);
    let wall = vec![
        r(1.100, 0.0),
        r(1.104, 0.024),
        r(1.114, 0.039),
        r(1.130, 0.045),
        r(1.332, 0.045),
        r(1.352, 0.038),
        r(1.364, 0.024),
        r(1.366, 0.0),
    ];
    kit.pair(Trim, &Loft::new(tank, wall).grid(FINE), &chest, TANK);
    for at in [1.155, 1.30] {
        let band = vec![
            r(at - 0.002, 0.044),
            r(at + 0.002, 0.049),
            r(at + 0.016, 0.049),
            r(at + 0.02, 0.044),
        ];
        kit.pair(Metal, &Loft::new(tank, band).grid(FINE), &chest, &[]);
    }
    let valve = bevelled(&[
        r(1.36, 0.014),
        r(1.384, 0.014),
        r(1.386, 0.02),
        r(1.404, 0.02).bevel(0.004),
        r(1.404, 0.0),
    ]);
    kit.pair(Metal, &Loft::new(tank, valve).grid(FINE), &chest, &[]);
    // From the tanks over the shoulders to the chest.
    let hose = [
        DVec3::new(0.09, 1.372, 0.165),
        DVec3::new(0.112, 1.425, 0.132),
        DVec3::new(0.136, 1.447, 0.05),
        DVec3::new(0.142, 1.43, -0.05),
        DVec3::new(0.134, 1.375, -0.142),
        DVec3::new(0.112, 1.315, -0.178),
        SOCKET + SOCKET_ALONG * 0.004,
    ];
    let ribbed = |step: usize| if step.is_multiple_of(2) { 0.017 } else { 0.014 };
    kit.pair(Rubber, &tube(&hose, 4, 6, ribbed), &chest, &[]);
    let fitting = Frame::along(
        hose[0] - DVec3::new(0.0, 0.03, 0.014),
        DVec3::new(0.1, 0.9, -0.25),
        DVec3::X,
    );
    let nut = bevelled(&[r(0.0, 0.024), r(0.034, 0.022).bevel(0.004), r(0.034, 0.0)]);
    kit.pair(Metal, &Loft::new(fitting, nut).grid(FINE), &chest, &[]);
}

const BODY: &[Mark] = &[Mark::Word {
    middle: [0.5, 0.81],
    word: "BINDPOSE",
    height: 0.017,
    tone: INK,
}];
const PANEL: &[Mark] = &[
    Mark::Border(0.014),
    Mark::Word {
        middle: [0.5, 0.5],
        word: "07",
        height: 0.05,
        tone: INK,
    },
];
const TANK: &[Mark] = &[Mark::LineV(0.5)];
