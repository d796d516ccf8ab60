//! Curves made of straight pieces, as sampling wants them.

use std::borrow::Cow;

use glam::Vec3;

use crate::model::{Curve, LocalJoint, Track};

/// How far straight pieces may stray from a curve, as a part of what the curve ranges over; of rotations the angle in radians. A
/// figure's hand is then off by less than a twentieth of a pixel on a large screen.
pub const MOST_ERROR: f32 = 1e-5;

/// A piece between two keys is halved this often at most.
const MOST_HALVINGS: u32 = 9;

/// A track whose parts all go straight from key to key, and that strays from the given one by less than [`MOST_ERROR`]. A value that
/// is held has a second key, which is the last number before the time of the next.
pub fn straight(track: &Track) -> Cow<'_, Track> {
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
