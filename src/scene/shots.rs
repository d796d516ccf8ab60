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
