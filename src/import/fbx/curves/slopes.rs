//! The slopes of keys that the keys around set. Autodesk does not document them; the formulas fit the curves that its programs draw.

use super::{Key, flags};

/// What sets the slopes of a key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Slopes {
    Given,
    /// By the keys around. A bias of −100…100 leads to the way before or after, one beyond 500 is steeper.
    Auto {
        bias: f64,
        flags: i64,
    },
    /// By tension, continuity and bias: Kochanek and Bartels.
    Tcb([f64; 3]),
}

/// The slopes of a key as the keys around set them; `None` where the file has given them.
pub(super) fn solved([before, key, after]: [Option<Key>; 3], set: Slopes) -> Option<[f64; 2]> {
    let key = key?;
    let slope = |from: Key, to: Key| (to.value - from.value) / (to.secs - from.secs);
    let [left, right] = [
        before.map(|before| slope(before, key)),
        after.map(|after| slope(key, after)),
    ];
    match set {
        Slopes::Given => None,
        Slopes::Tcb([tension, continuity, bias]) => {
            let half = if left.is_some() && right.is_some() { 0.5 } else { 1.0 };
            let [left, right] = [left, right].map(Option::unwrap_or_default);
            let part =
                |of_bias: f64, of_continuity: f64| half * (1.0 - tension) * (1.0 + of_bias) * (1.0 + of_continuity);
            Some([
                part(bias, -continuity) * left + part(-bias, continuity) * right,
                part(bias, continuity) * left + part(-bias, -continuity) * right,
            ])
        }
        Slopes::Auto { bias, flags } => Some(match (before, after) {
            (Some(before), Some(after)) => {
                // Until it is solved, this slope is what the key before has stored for it: minus its bias.
                let in_bias = -key.slopes[0];
                let between = |bias| auto_slope([before, key, after], bias, flags);
                if (key.slopes[0] + bias).abs() <= 1e-4 {
                    [between(bias); 2]
                } else {
                    [between(in_bias), between(bias)]
                }
            }
            (Some(other), None) => [end_slope(slope(other, key), [other.value, key.value], -key.slopes[0], flags); 2],
            (None, Some(other)) => [end_slope(slope(key, other), [other.value, key.value], bias, flags); 2],
            (None, None) => [0.0; 2],
        }),
    }
}

/// Values that differ by less are the same to a slope that is clamped.
const CLAMPED: f64 = 0.001;

fn auto_slope([before, key, after]: [Key; 3], bias: f64, flags: i64) -> f64 {
    let near = |other: Key| (other.value - key.value).abs() <= CLAMPED;
    if flags & flags::CLAMP != 0 && (near(before) || near(after)) {
        return 0.0;
    }
    let slope = |from: Key, to: Key| (to.value - from.value) / (to.secs - from.secs);
    let [whole, left, right] = [slope(before, after), slope(before, key), slope(key, after)];
    let mut steep = whole;
    if flags & flags::TIME_INDEPENDENT == 0 {
        let part = (key.secs - before.secs) / (after.secs - before.secs);
        steep = 0.5 * whole + 0.5 * (left * (1.0 - part) + right * part);
        let weight = bias.abs() / 100.0;
        if weight > 1e-4 {
            let aim = if bias > 0.0 { right } else { left };
            let turn = aim - steep;
            steep += turn * weight;
            let sign = if turn.abs() > 1e-5 { turn } else { bias }.signum();
            steep += steeper(weight) * sign;
        }
    }
    if flags & flags::CLAMP_PROGRESSIVE == 0 {
        return steep;
    }
    // It goes beyond neither key's value.
    let most = |to: Key, weight: f64| {
        let reach = weight * (to.secs - key.secs);
        let most = if reach == 0.0 {
            0.0
        } else {
            steep.signum() * (to.value - key.value) / reach
        };
        if most > 0.0 { most } else { 0.0 }
    };
    steep.signum()
        * steep
            .abs()
            .min(most(before, key.weights[0]))
            .min(most(after, key.weights[1]))
}

/// What a bias beyond 500 adds; `weight` is a hundredth of it.
fn steeper(weight: f64) -> f64 {
    let beyond = (weight - 5.0).max(0.0);
    beyond * beyond * 40.0
}

fn end_slope(slope: f64, [a, b]: [f64; 2], bias: f64, flags: i64) -> f64 {
    if flags & flags::CLAMP_PROGRESSIVE != 0 || (flags & flags::CLAMP != 0 && (a - b).abs() <= CLAMPED) {
        return 0.0;
    }
    match flags & flags::TIME_INDEPENDENT {
        0 => slope + steeper(bias.abs() / 100.0) * bias.signum(),
        _ => slope,
    }
}
