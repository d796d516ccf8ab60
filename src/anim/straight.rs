//! Channels made of straight pieces, as sampling wants them.

use std::borrow::Cow;
use std::cell::Cell;

use glam::{Quat, Vec3};

use crate::model::{Channel, ChannelValue, Track, Way};

/// How far straight pieces may stray from a spline, as a part of what it ranges over; of rotations the angle in radians. A
/// figure's hand is then off by less than a twentieth of a pixel on a large screen.
pub const MOST_ERROR: f32 = 1e-5;

/// A piece between two keys is halved this often at most.
const MOST_HALVINGS: u32 = 9;

/// So often it may always be halved. Beyond this all pieces come out of [`MOST_PIECES`].
const FREE_HALVINGS: u32 = 3;

/// The most pieces that the tracks of all clips become together, beyond those that are free. A file can be made whose curves swing
/// out at each of a million keys.
pub(super) const MOST_PIECES: usize = 1 << 20;

/// A track whose channels all go straight from key to key, and that strays from the given one by less than [`MOST_ERROR`]. A value that
/// is held has a second key, which is the last number before the time of the next. Splines that take more than a million pieces stray further.
pub fn straight(track: &Track) -> Cow<'_, Track> {
    if track.holds() {
        Cow::Owned(of_pieces(track, true, &Cell::new(MOST_PIECES)))
    } else {
        unbent(track, &Cell::new(MOST_PIECES))
    }
}

/// The same, but values that are held stay so. What it takes comes out of `pieces_left`.
pub(super) fn unbent<'t>(track: &'t Track, pieces_left: &Cell<usize>) -> Cow<'t, Track> {
    if track.bends() {
        Cow::Owned(of_pieces(track, false, pieces_left))
    } else {
        Cow::Borrowed(track)
    }
}

/// `splits_steps`: a value that is held gets a second key.
fn of_pieces(track: &Track, splits_steps: bool, pieces_left: &Cell<usize>) -> Track {
    let vectors = |channel: &Channel<Vec3>| {
        let range = match range(channel.values()) {
            0.0 => range(&inner_points(channel)),
            range => range,
        };
        let part = |distance: f32| if range > 0.0 { distance / range } else { 0.0 };
        in_pieces(channel, splits_steps, pieces_left, |a, b| part(a.distance(b)))
    };
    let turn = |a: Quat, b: Quat| 2.0 * (a - b).length().min((a + b).length());
    Track::of_channels(
        vectors(track.translation()),
        in_pieces(track.rotation(), splits_steps, pieces_left, turn),
        vectors(track.scale()),
    )
}

/// What values range over, in their units.
fn range(values: &[Vec3]) -> f32 {
    let (least, greatest) = values
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(least, greatest), value| {
            (least.min(*value), greatest.max(*value))
        });
    (greatest - least)
        .length()
        .max(least.abs().max(greatest.abs()).max_element() * 1e-2)
}

/// The inner points of the Bézier curves of a spline: it may swing out between keys whose values are all 0.
fn inner_points(channel: &Channel<Vec3>) -> Vec<Vec3> {
    let Way::Spline(slopes) = channel.way() else {
        return Vec::new();
    };
    let keys = slopes.array_windows().zip(channel.values().array_windows());
    let lengths = channel.times_secs().array_windows().map(|[from, to]| to - from);
    let inner = keys
        .zip(lengths)
        .flat_map(|(([[_, left], [reached, _]], [from, to]), secs)| {
            [from + left * (secs / 3.0), to - reached * (secs / 3.0)]
        });
    inner.collect()
}

/// `apart` measures how far apart two values are.
fn in_pieces<T: ChannelValue>(
    channel: &Channel<T>,
    splits_steps: bool,
    pieces_left: &Cell<usize>,
    apart: impl Fn(T, T) -> f32,
) -> Channel<T> {
    let add_between = |start, end, keys: &mut Vec<_>| {
        add_between((channel, &apart, pieces_left), start, end, MOST_HALVINGS, keys);
    };
    let key_at = |secs: f32| (secs, channel.at(secs));
    let mut keys = Vec::with_capacity(channel.times_secs().len());
    for pair in channel.times_secs().windows(2) {
        let start = key_at(pair[0]);
        keys.push(start);
        match channel.way() {
            Way::Straight => return channel.clone(),
            Way::Held if !splits_steps => return channel.clone(),
            Way::Held if pair[1].next_down() > pair[0] => keys.push(key_at(pair[1].next_down())),
            Way::Held => {}
            Way::Spline(_) => add_between(start, key_at(pair[1]), &mut keys),
        }
    }
    keys.extend(channel.times_secs().last().map(|&secs| key_at(secs)));
    // Times increase, and a spline is proved not to overflow between its keys: what has no pieces is at rest.
    Channel::straight(keys).unwrap_or_else(|_| channel.clone())
}

/// Adds the keys that are needed between two.
fn add_between<T: ChannelValue>(
    of @ (channel, apart, pieces_left): (&Channel<T>, &impl Fn(T, T) -> f32, &Cell<usize>),
    start: (f32, T),
    end: (f32, T),
    halvings: u32,
    keys: &mut Vec<(f32, T)>,
) {
    let time_at = |part: f32| start.0 + (end.0 - start.0) * part;
    // Not the middle alone: a curve that eases in and out crosses its chord there.
    let strays = |part: f32| {
        let ends = [start.1, end.1.near(start.1).unwrap_or(end.1)];
        apart(T::between(ends, f64::from(part)), channel.at(time_at(part))) > MOST_ERROR
    };
    let middle_secs = time_at(0.5);
    if halvings == 0 || middle_secs <= start.0 || middle_secs >= end.0 || ![0.25, 0.5, 0.75].into_iter().any(strays) {
        return;
    }
    if MOST_HALVINGS - halvings >= FREE_HALVINGS {
        let Some(left) = pieces_left.get().checked_sub(1) else {
            return;
        };
        pieces_left.set(left);
    }
    let middle = (middle_secs, channel.at(middle_secs));
    add_between(of, start, middle, halvings - 1, keys);
    keys.push(middle);
    add_between(of, middle, end, halvings - 1, keys);
}
