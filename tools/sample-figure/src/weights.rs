//! Which joints move a vertex: the volumes that make the skin there, smoothed along the skin.

use glam::DVec3;

use crate::body::Body;
use crate::rig::{HIPS, JOINT_COUNT, Limb, Rig, Side, joint};
use crate::sdf::ramp;
use crate::skin::Skin;

/// Weights of all joints for one vertex.
pub(crate) type Weights = [f64; JOINT_COUNT];

/// How much further than the nearest volume a neighbouring joint's volume may be and still have a say, metres. On a limb of
/// radius r this blends over about √(2 r · REACH) to each side of a joint.
const REACH: f64 = 0.03;
/// Rounds of averaging along the skin, for soft bends at hips, shoulders and neck.
const SMOOTH_ROUNDS: usize = 4;
/// Within this distance from the middle the thighs give way to the hips, metres: a step of one leg does not pull the other.
const MIDDLE: f64 = 0.05;

/// Up to four joints and their weights in ten-thousandths, which sum to 10 000; the heaviest first.
pub(crate) type Influences = [(usize, u32); 4];

/// Influences of each vertex of the skin.
pub(crate) fn influences(skin: &Skin, body: &Body, rig: &Rig) -> Vec<Influences> {
    let mut weights: Vec<Weights> = skin
        .positions
        .iter()
        .map(|point| by_distance(body, rig, *point))
        .collect();
    for _ in 0..SMOOTH_ROUNDS {
        weights = smoothed(&weights, &skin.neighbours);
    }
    weights
        .iter()
        .zip(&skin.positions)
        .map(|(weights, point)| strongest(weights, rig, *point))
        .collect()
}

/// The nearest volume's joint, and its parent and children where their volumes are nearly as near.
fn by_distance(body: &Body, rig: &Rig, point: DVec3) -> Weights {
    let mut distances = [f64::INFINITY; JOINT_COUNT];
    body.for_each_joint_distance(point, |joint, distance| {
        distances[joint] = distances[joint].min(distance);
    });
    let nearest = (0..JOINT_COUNT).fold(0, |best, joint| {
        if distances[joint] < distances[best] {
            joint
        } else {
            best
        }
    });

    let mut weights = [0.0; JOINT_COUNT];
    for (joint, weight) in weights.iter_mut().enumerate() {
        if related(rig, joint, nearest) {
            let nearness = 1.0 - (distances[joint] - distances[nearest]) / REACH;
            *weight = nearness.max(0.0) * nearness.max(0.0);
        }
    }
    let side_weight = ramp(0.0, MIDDLE, point.x.abs());
    for side in Side::BOTH {
        let thigh = joint(side, Limb::Thigh);
        let moved = weights[thigh] * (1.0 - side_weight);
        weights[thigh] -= moved;
        weights[HIPS] += moved;
    }
    normalised(weights)
}

/// Whether one is the other's parent, or they are the same.
fn related(rig: &Rig, a: usize, b: usize) -> bool {
    a == b || rig.joints[a].parent == Some(b) || rig.joints[b].parent == Some(a)
}

fn normalised(mut weights: Weights) -> Weights {
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= sum);
    weights
}

/// Each vertex half its own, half the mean of its neighbours.
fn smoothed(weights: &[Weights], neighbours: &[Vec<u32>]) -> Vec<Weights> {
    let mix = |(own, around): (&Weights, &Vec<u32>)| {
        let mut mixed = own.map(|weight| weight * 0.5);
        for neighbour in around {
            for (mixed, weight) in mixed.iter_mut().zip(&weights[*neighbour as usize]) {
                *mixed += weight * 0.5 / around.len() as f64;
            }
        }
        mixed
    };
    weights.iter().zip(neighbours).map(mix).collect()
}

/// The four strongest, without those of the other leg, in whole ten-thousandths.
fn strongest(weights: &Weights, rig: &Rig, point: DVec3) -> Influences {
    /// Below this a joint is felt by nobody, but costs the file a digit.
    const LEAST: f64 = 0.004;
    let other = if point.x < 0.0 { Side::Left } else { Side::Right };
    let allowed = |j: usize| !is_below(rig, j, joint(other, Limb::Thigh));
    let mut order: Vec<usize> = (0..JOINT_COUNT)
        .filter(|j| weights[*j] > LEAST && allowed(*j))
        .collect();
    order.sort_by(|a, b| weights[*b].total_cmp(&weights[*a]));
    order.truncate(4);

    let sum: f64 = order.iter().map(|joint| weights[*joint]).sum();
    let mut influences = [(0, 0); 4];
    for (slot, joint) in influences.iter_mut().zip(order) {
        *slot = (joint, (weights[joint] / sum * 10_000.0).round() as u32);
    }
    // What rounding lost or gained goes to the strongest.
    influences[0].1 = 10_000 - influences[1..].iter().map(|slot| slot.1).sum::<u32>();
    // That can put it just behind its equal.
    influences.sort_by_key(|slot| std::cmp::Reverse(slot.1));
    influences
}

/// Whether `joint` is `ancestor` or below it.
fn is_below(rig: &Rig, joint: usize, ancestor: usize) -> bool {
    let mut at = Some(joint);
    while let Some(joint) = at {
        if joint == ancestor {
            return true;
        }
        at = rig.joints[joint].parent;
    }
    false
}
