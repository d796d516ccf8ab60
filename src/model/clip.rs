//! Named motions and their frames.

use super::Track;

/// Frames a second of a clip in which no track has two keys.
const DEFAULT_KEYS_PER_SEC: f32 = 30.0;

/// A time this close to a frame, in frames, is on it: what files and f32 lose of a time is less.
const ON_FRAME: f64 = 0.01;

/// A named motion: one track per joint, in the skeleton's order.
///
/// Its unit of time is the frame, the usual step between keys. Frames count from 0 at `start_secs` to
/// [`Clip::last_frame`] at `end_secs`. Where a key stands on a frame, the frame's time is the key's to the bit, so that what
/// is seen there is the key and no blend.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clip {
    /// Name to show, unique in the model.
    pub name: String,
    /// One per joint.
    pub tracks: Vec<Track>,
    /// Least key time of all tracks.
    pub start_secs: f32,
    /// Greatest key time of all tracks.
    pub end_secs: f32,
    /// Keys a second of the densest track: the unit of a frame. 30 when no track has two keys.
    pub keys_per_sec: f32,
    /// Number of keys the file has for it.
    pub key_count: usize,
    /// The track with the most keys, whose keys are the frames; `None` without tracks.
    densest: Option<usize>,
}

impl Clip {
    /// A clip of one track per joint; span, key rate and key count are those of its tracks. A joint that rests at every time
    /// takes no part in them.
    pub fn new(name: impl Into<String>, tracks: Vec<Track>) -> Self {
        let keyed = || tracks.iter().filter(|track| track.has_keys());
        let (start_secs, end_secs) = span(keyed());
        Self {
            name: name.into(),
            start_secs,
            end_secs,
            keys_per_sec: keys_per_sec(keyed()),
            key_count: keyed().map(Track::key_count).sum(),
            densest: densest(&tracks),
            tracks,
        }
    }

    /// Whether it shows one pose from its start to its end.
    pub fn is_still(&self) -> bool {
        self.tracks.iter().all(Track::is_still)
    }

    /// Length in seconds, 0 or more.
    pub fn duration_secs(&self) -> f32 {
        self.end_secs - self.start_secs
    }

    /// Number of the frame at `end_secs`, counted from 0. A length that is no whole number of frames has its remainder in
    /// the last step.
    pub fn last_frame(&self) -> u32 {
        // A cast from a float saturates.
        (f64::from(self.duration_secs()) * f64::from(self.keys_per_sec)).round() as u32
    }

    /// Number of frames, 1 or more: both ends are frames.
    pub fn frame_count(&self) -> u32 {
        self.last_frame().saturating_add(1)
    }

    /// The frame nearest to a time, inside the clip.
    pub fn frame_at(&self, time_secs: f32) -> u32 {
        self.place_of(time_secs).round() as u32
    }

    /// The time of a frame; the last frame and any beyond it are at `end_secs`.
    pub fn time_of_frame(&self, frame: u32) -> f32 {
        if frame == 0 {
            return self.start_secs;
        }
        if frame >= self.last_frame() {
            return self.end_secs;
        }
        let time_secs = self.time_of_place(f64::from(frame));
        self.key_on_frame(time_secs).unwrap_or(time_secs)
    }

    /// The time of a place in frames, inside the clip: 30.5 is half way from frame 30 to frame 31. NaN is the start.
    pub fn time_at_place(&self, place: f64) -> f32 {
        // The bounds in this order turn NaN into 0.
        let place = place.max(0.0).min(f64::from(self.last_frame()));
        if place.fract() == 0.0 {
            self.time_of_frame(place as u32)
        } else {
            self.time_of_place(place)
        }
    }

    fn time_of_place(&self, place: f64) -> f32 {
        let since_start_secs = place / f64::from(self.keys_per_sec);
        ((f64::from(self.start_secs) + since_start_secs) as f32).clamp(self.start_secs, self.end_secs)
    }

    /// The key of the densest track that is on the frame of this time, if one is.
    fn key_on_frame(&self, time_secs: f32) -> Option<f32> {
        let times_secs = self.tracks.get(self.densest?)?.times_secs();
        let next = times_secs.partition_point(|&key_secs| key_secs < time_secs);
        let around = &times_secs[next.saturating_sub(1)..times_secs.len().min(next + 1)];
        let away_secs = |key_secs: f32| (f64::from(key_secs) - f64::from(time_secs)).abs();
        let nearest = around
            .iter()
            .copied()
            .min_by(|&a, &b| away_secs(a).total_cmp(&away_secs(b)))?;
        (away_secs(nearest) * f64::from(self.keys_per_sec) <= ON_FRAME).then_some(nearest)
    }

    /// The time `frames` further on, or back when negative: always a whole frame inside the clip. Between two frames the
    /// first step reaches the next whole frame on its way.
    pub fn step_frames(&self, time_secs: f32, frames: i32) -> f32 {
        let place = self.place_of(time_secs);
        let from = if frames >= 0 {
            (place + ON_FRAME).floor()
        } else {
            (place - ON_FRAME).ceil()
        };
        // A cast from a float saturates, so a step below 0 is frame 0.
        self.time_of_frame((from + f64::from(frames)) as u32)
    }

    /// Where a time lies, in frames, inside the clip: 30.5 is half way from frame 30 to frame 31. NaN is at the start.
    pub fn place_of(&self, time_secs: f32) -> f64 {
        let since_start_secs = f64::from(time_secs) - f64::from(self.start_secs);
        let place = since_start_secs * f64::from(self.keys_per_sec);
        // The bounds in this order turn NaN into 0.
        place.max(0.0).min(f64::from(self.last_frame()))
    }
}

/// Least and greatest key time; 0 and 0 without tracks.
fn span<'a>(tracks: impl IntoIterator<Item = &'a Track>) -> (f32, f32) {
    let (start_secs, end_secs) = tracks
        .into_iter()
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(start_secs, end_secs), track| {
            (start_secs.min(track.start_secs()), end_secs.max(track.end_secs()))
        });
    if start_secs <= end_secs {
        (start_secs, end_secs)
    } else {
        (0.0, 0.0)
    }
}

/// The first of the tracks with the most keys.
fn densest<'a>(tracks: impl IntoIterator<Item = &'a Track>) -> Option<usize> {
    let tracks = tracks.into_iter().enumerate();
    // Of equal ones `max_by_key` gives the last.
    tracks
        .max_by_key(|(index, track)| (track.key_count(), std::cmp::Reverse(*index)))
        .map(|(index, _)| index)
}

/// Keys a second of the track with the most keys: the middle one of its steps, so that a gap or a jump does not count.
/// Files round their times, so a rate within 0.1 % of a whole number is that number.
fn keys_per_sec<'a>(tracks: impl IntoIterator<Item = &'a Track>) -> f32 {
    let Some(densest) = tracks
        .into_iter()
        .reduce(|a, b| if b.key_count() > a.key_count() { b } else { a })
    else {
        return DEFAULT_KEYS_PER_SEC;
    };
    let mut steps_secs: Vec<f64> = densest
        .times_secs()
        .windows(2)
        .map(|pair| f64::from(pair[1]) - f64::from(pair[0]))
        .collect();
    if steps_secs.is_empty() {
        return DEFAULT_KEYS_PER_SEC;
    }
    let middle = steps_secs.len() / 2;
    let (_, &mut step_secs, _) = steps_secs.select_nth_unstable_by(middle, f64::total_cmp);
    let rate = 1.0 / step_secs;
    let whole = rate.round();
    let rate = if (rate - whole).abs() <= 1e-3 * whole {
        whole
    } else {
        rate
    };
    rate.clamp(1e-6, 1e6) as f32
}
