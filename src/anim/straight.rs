//! Curves made of straight pieces, as sampling wants them.

use std::borrow::Cow;

use glam::Vec3;

use crate::model::{Curve, LocalJoint, Track};

/// How far straight pieces may stray from a curve, as a part of what the curve ranges over; of rotations the angle in radians. A
/// figure's hand is then off by less than a twentieth of a pixel on a large screen.
pub(crate) const MOST_ERROR: f32 = 1e-5;

/// A piece between two keys is halved this often at most.
const MOST_HALVINGS: u32 = 9;

/// A track whose parts all go straight from key to key, and that strays from the given one by less than [`MOST_ERROR`]. A value that
/// is held has a second key, which is the last number before the time of the next.
pub(crate) fn straight(track: &Track) -> Cow<'_, Track> {
    let Some(curves) = track.curves() else {
        return Cow::Borrowed(track);
    };
    let is_held = curves.holds();
    let ranges = Ranges {
        translation: curves.translation.as_ref().map_or(0.0, range),
        scale: curves.scale.as_ref().map_or(0.0, range),
    };
    let mut keys = Vec::with_capacity(track.key_count());
    for pair in track.times_secs().windows(2) {
        let [start_secs, next_secs] = [pair[0], pair[1]];
        let start = (start_secs, track.at(start_secs));
        keys.push(start);
        let end_secs = if is_held { next_secs.next_down() } else { next_secs };
        if end_secs <= start_secs {
            continue;
        }
        let end = (end_secs, track.at(end_secs));
        add_between(track, &ranges, start, end, MOST_HALVINGS, &mut keys);
        if is_held {
            keys.push(end);
        }
    }
    keys.push((track.end_secs(), track.at(track.end_secs())));
    // It always can: times increase, and a curve is proved not to overflow between its keys.
    Track::new(keys).map_or(Cow::Borrowed(track), Cow::Owned)
}

/// What curves range over, in their units.
struct Ranges {
    translation: f32,
    scale: f32,
}

fn range(curve: &Curve<Vec3>) -> f32 {
    let (least, greatest) = curve
        .values()
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(least, greatest), value| {
            (least.min(*value), greatest.max(*value))
        });
    (greatest - least)
        .length()
        .max(least.abs().max(greatest.abs()).max_element() * 1e-2)
}

/// Adds the keys that are needed between two.
fn add_between(
    track: &Track,
    ranges: &Ranges,
    start: (f32, LocalJoint),
    end: (f32, LocalJoint),
    halvings: u32,
    keys: &mut Vec<(f32, LocalJoint)>,
) {
    let time_at = |part: f32| start.0 + (end.0 - start.0) * part;
    // Not the middle alone: a curve that eases in and out crosses its chord there.
    let strays = |part: f32| ranges.apart(&blend(&start.1, &end.1, part), &track.at(time_at(part))) > MOST_ERROR;
    let middle_secs = time_at(0.5);
    if halvings == 0 || middle_secs <= start.0 || middle_secs >= end.0 || ![0.25, 0.5, 0.75].into_iter().any(strays) {
        return;
    }
    let middle = (middle_secs, track.at(middle_secs));
    add_between(track, ranges, start, middle, halvings - 1, keys);
    keys.push(middle);
    add_between(track, ranges, middle, end, halvings - 1, keys);
}

fn blend(from: &LocalJoint, to: &LocalJoint, part: f32) -> LocalJoint {
    LocalJoint {
        rotation: from.rotation.slerp(to.rotation, part),
        translation: from.translation.lerp(to.translation, part),
        scale: from.scale.lerp(to.scale, part),
    }
}

impl Ranges {
    /// The greatest of the three distances, each by its measure.
    fn apart(&self, a: &LocalJoint, b: &LocalJoint) -> f32 {
        let part = |distance: f32, range: f32| if range > 0.0 { distance / range } else { 0.0 };
        let chord = (a.rotation - b.rotation)
            .length()
            .min((a.rotation + b.rotation).length());
        part(a.translation.distance(b.translation), self.translation)
            .max(part(a.scale.distance(b.scale), self.scale))
            .max(2.0 * chord)
    }
}

#[cfg(test)]
mod tests {
    use glam::{Quat, Vec4};

    use super::*;
    use crate::model::Curves;

    fn track(curves: Curves) -> Track {
        let still = |time_secs| (time_secs, LocalJoint::IDENTITY);
        let keys = Track::new([still(0.0), still(1.0), still(2.0)]).expect("times increase");
        keys.with_curves(curves)
    }

    fn greatest_error(track: &Track) -> f32 {
        let straight = straight(track);
        let apart = |time_secs| {
            let [a, b] = [track.at(time_secs), straight.at(time_secs)];
            a.translation
                .distance(b.translation)
                .max(2.0 * (a.rotation - b.rotation).length())
        };
        (0..=4000).map(|step| apart(step as f32 * 0.0005)).fold(0.0, f32::max)
    }

    #[test]
    fn pieces_stay_beside_a_spline_that_eases_in_and_out() {
        let key = |time_secs, x| (time_secs, Vec3::X * x, [Vec3::ZERO; 2]);
        let turn = |time_secs, radians| {
            let rotation = Vec4::from(Quat::from_rotation_y(radians));
            (time_secs, rotation, [Vec4::ZERO; 2])
        };
        let curves = Curves {
            translation: Curve::cubic([key(0.0, 0.0), key(1.0, 10.0), key(2.0, -5.0)]).ok(),
            rotation: Curve::cubic([turn(0.0, 0.0), turn(1.0, 1.5), turn(2.0, 3.0)]).ok(),
            scale: None,
        };
        let track = track(curves);
        let error = greatest_error(&track);
        assert!(error < 4.0 * 15.0 * MOST_ERROR, "{error}");
        let keys = straight(&track).key_count();
        assert!((100..1200).contains(&keys), "{keys}");
    }

    #[test]
    fn a_held_value_is_held_to_the_last_number_before_the_next_key() {
        let curves = Curves {
            translation: Curve::step([(0.0, Vec3::X), (1.0, Vec3::Y), (2.0, Vec3::Z)]).ok(),
            ..Curves::default()
        };
        let track = track(curves);
        let straight = straight(&track);
        for time_secs in [0.0, 0.5, 1.0_f32.next_down(), 1.0, 1.5, 2.0_f32.next_down(), 2.0] {
            assert_eq!(straight.at(time_secs), track.at(time_secs), "{time_secs}");
        }
        assert_eq!(straight.key_count(), 5);
    }
}
