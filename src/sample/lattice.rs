//! The lattice on which the figure is polygonised: finer where hands, face and feet are, bent along the arms.

use glam::DVec3;

use super::rig::ARM;
use super::sdf::ramp;
use super::surface_nets::Lattice;

/// Cell size at a coordinate; sizes between are blended.
type Steps<'a> = &'a [(f64, f64)];

/// Height of the shoulders, around which the arms' part of the lattice shrinks towards the hands.
const SHOULDER_HEIGHT: f64 = 1.358;
/// Distance from the middle at which the lattice begins to follow the arms.
const BEND_START: f64 = 0.16;
/// Over which distance it does.
const BEND_WIDTH: f64 = 0.10;
/// Size of the cells across the hands, in parts of the size at the shoulders.
const HAND_SCALE: f64 = 0.52;

/// The figure's lattice.
pub(super) fn lattice() -> Lattice<impl Fn(DVec3) -> DVec3> {
    let half = lines(
        0.0,
        0.81,
        &[
            (0.0, 0.0185),
            (0.08, 0.0215),
            (0.17, 0.0245),
            (0.3, 0.031),
            (0.48, 0.029),
            (0.58, 0.0145),
            (0.62, 0.012),
            (0.79, 0.011),
        ],
    );
    let xs = half
        .iter()
        .rev()
        .map(|x| -x)
        .chain(half.iter().skip(1).copied())
        .collect();
    let ys = lines(
        -0.025,
        1.84,
        &[
            (0.0, 0.019),
            (0.10, 0.025),
            (0.3, 0.031),
            (0.8, 0.032),
            (1.15, 0.0265),
            (1.22, 0.019),
            (1.33, 0.019),
            (1.38, 0.021),
            (1.45, 0.0205),
            (1.8, 0.0215),
        ],
    );
    let back = lines(0.0, 0.26, &[(0.0, 0.0235), (0.26, 0.0255)]);
    let zs = back
        .iter()
        .rev()
        .map(|z| -z)
        .chain(back.iter().skip(1).copied())
        .collect();
    Lattice {
        lines: [xs, ys, zs],
        warp,
    }
}

/// Lattice space to model space. Columns beyond the shoulders slide down along the arms, and shrink towards the hands.
fn warp(point: DVec3) -> DVec3 {
    let beyond = (point.x.abs() - BEND_START).max(0.0);
    // A parabola, then its tangent: the slide starts without a kink.
    let slid = if beyond < BEND_WIDTH {
        beyond * beyond / (2.0 * BEND_WIDTH)
    } else {
        beyond - BEND_WIDTH / 2.0
    };
    let scale = 1.0 - (1.0 - HAND_SCALE) * ramp(0.42, 0.64, point.x.abs());
    let y = SHOULDER_HEIGHT + (point.y - SHOULDER_HEIGHT) * scale + slid * ARM.y / ARM.x;
    DVec3::new(point.x, y, point.z * scale)
}

/// Lines from `from` until past `to`, as far apart as `steps` says.
fn lines(from: f64, to: f64, steps: Steps<'_>) -> Vec<f64> {
    let mut lines = vec![from];
    let mut at = from;
    while at < to {
        at += step_at(steps, at);
        lines.push(at);
    }
    lines
}

fn step_at(steps: Steps<'_>, at: f64) -> f64 {
    let after = steps.partition_point(|step| step.0 <= at);
    if after == 0 || after == steps.len() {
        return steps[after.min(steps.len() - 1)].1;
    }
    let ((from, a), (to, b)) = (steps[after - 1], steps[after]);
    a + (b - a) * (at - from) / (to - from)
}
