//! The pictures of a series: at which times of a clip, and from which sides of the model.

use std::f32::consts::TAU;

use crate::model::Clip;

/// The most pictures of a series.
pub const MOST_SHOTS: u32 = 100_000;

/// A picture that would begin this close to the end of the span, in pictures, is the end: what f32 loses of a time is less.
const AT_END: f64 = 0.01;

/// How many pictures a span of time has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Frames {
    /// So many, evenly spaced.
    Count(u32),
    /// So many a second, above 0.
    PerSec(f64),
}

impl Frames {
    /// Number of pictures of a span in seconds, 1 or more. It may be more than [`MOST_SHOTS`].
    pub fn count(self, [start_secs, end_secs]: [f32; 2]) -> u32 {
        let span_secs = f64::from(end_secs) - f64::from(start_secs);
        match self {
            Self::Count(count) => count.max(1),
            // A cast from a float saturates.
            Self::PerSec(rate) => ((span_secs * rate - AT_END).ceil() as u32).max(1),
        }
    }

    /// The times of the pictures: the first is at the start, and the end is left out, so that the last is followed by the first.
    /// At most [`MOST_SHOTS`].
    pub fn times_secs(self, span_secs: [f32; 2]) -> Vec<f32> {
        let count = self.count(span_secs).min(MOST_SHOTS);
        let [start_secs, end_secs] = span_secs.map(f64::from);
        let at = |index: u32| {
            let since_start_secs = match self {
                Self::Count(_) => f64::from(index) * (end_secs - start_secs) / f64::from(count),
                Self::PerSec(rate) => f64::from(index) / rate,
            };
            (start_secs + since_start_secs) as f32
        };
        (0..count).map(at).collect()
    }
}

/// One picture of a series. The default is the picture of now.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shot {
    /// Seconds of the clip's own time; `None` is the time that the session has.
    pub time_secs: Option<f32>,
    /// How far the camera is turned about the model, to its left as with [`super::Camera::orbit`]; `None` where it does not turn.
    pub turn_radians: Option<f32>,
}

impl Shot {
    /// A series over times and over `views` sides around the model, as many pictures as the larger number says. The other one begins
    /// again at its end: a clip goes on while the camera turns.
    pub fn series(times_secs: &[f32], views: u32) -> Vec<Self> {
        let view_count = views as usize;
        let count = times_secs.len().max(view_count);
        let shot = |index: usize| Self {
            time_secs: times_secs.get(index % times_secs.len().max(1)).copied(),
            turn_radians: (views > 0).then(|| TAU * ((index % view_count) as f32 / views as f32)),
        };
        (0..count).map(shot).collect()
    }

    /// What a label says of the picture, the most important first: time and frame of the clip, then the turn.
    pub fn caption(&self, clip: Option<&Clip>) -> Vec<String> {
        let mut parts = Vec::new();
        if let (Some(time_secs), Some(clip)) = (self.time_secs, clip) {
            parts.push(format!("{time_secs:.3} s"));
            parts.push(format!("frame {}", trimmed(clip.place_of(time_secs))));
        }
        if let Some(turn) = self.turn_radians {
            parts.push(format!("{}°", trimmed(f64::from(turn.to_degrees()))));
        }
        parts
    }
}

/// With one decimal, and without one where that is 0.
fn trimmed(number: f64) -> String {
    let text = format!("{number:.1}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_is_left_out_and_the_first_is_the_start() {
        assert_eq!(Frames::Count(4).times_secs([1.0, 3.0]), [1.0, 1.5, 2.0, 2.5]);
        assert_eq!(Frames::Count(1).times_secs([1.0, 3.0]), [1.0]);
        assert_eq!(Frames::PerSec(2.0).times_secs([-1.0, 0.5]), [-1.0, -0.5, 0.0]);
        assert_eq!(
            Frames::PerSec(2.0).times_secs([0.0, 1.2]),
            [0.0, 0.5, 1.0],
            "the last lasts shorter"
        );
        // 75 frames at 30 a second, written with seven digits.
        assert_eq!(Frames::PerSec(30.0).count([0.0, 2.500_000_2]), 75);
    }

    #[test]
    fn a_clip_without_length_has_one_frame_a_second_or_as_many_as_asked() {
        assert_eq!(Frames::PerSec(30.0).times_secs([2.0, 2.0]), [2.0]);
        assert_eq!(Frames::Count(2).times_secs([2.0, 2.0]), [2.0, 2.0]);
        assert_eq!(Frames::PerSec(1e12).count([0.0, 1.0]), 4_294_967_295);
        assert_eq!(Frames::PerSec(1e12).times_secs([0.0, 1.0]).len(), MOST_SHOTS as usize);
    }

    #[test]
    fn the_shorter_of_clip_and_turn_begins_again() {
        let turns = |shots: &[Shot]| -> Vec<_> {
            let quarter = |shot: &Shot| (shot.turn_radians.unwrap_or(-1.0) / TAU * 4.0).round();
            shots.iter().map(|shot| (shot.time_secs, quarter(shot))).collect()
        };
        assert_eq!(
            turns(&Shot::series(&[0.0, 0.5], 4)),
            [(Some(0.0), 0.0), (Some(0.5), 1.0), (Some(0.0), 2.0), (Some(0.5), 3.0)]
        );
        assert_eq!(
            turns(&Shot::series(&[0.0, 0.5, 1.0], 2)),
            [(Some(0.0), 0.0), (Some(0.5), 2.0), (Some(1.0), 0.0)]
        );
        assert_eq!(turns(&Shot::series(&[], 2)), [(None, 0.0), (None, 2.0)]);
        let without = Shot::series(&[0.0], 0);
        assert_eq!((without.len(), without[0].turn_radians), (1, None));
    }

    #[test]
    fn a_caption_says_time_frame_and_turn() {
        let mut clip = Clip::new("walk", Vec::new());
        clip.end_secs = 2.0;
        let caption = |time_secs, turn_radians| {
            let shot = Shot {
                time_secs,
                turn_radians,
            };
            shot.caption(Some(&clip)).join(" · ")
        };
        assert_eq!(caption(Some(1.0), None), "1.000 s · frame 30");
        assert_eq!(caption(Some(0.05), Some(TAU / 16.0)), "0.050 s · frame 1.5 · 22.5°");
        assert_eq!(caption(None, Some(TAU / 4.0)), "90°");
    }
}
