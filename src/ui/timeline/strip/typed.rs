//! What is typed into the fields of the timeline: times, frames, speeds. Each is read, or refused with the reason.

use crate::anim::{MAX_SPEED, MIN_SPEED};
use crate::model::Clip;
use crate::ui::kit::{leading_number, number_within};
use crate::ui::timeline::time_area::seconds;

/// A time that is typed is right if it rounds to the clip's end as it is shown.
const ROUNDING_SECS: f64 = 0.0005;

/// What a number without a unit counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    Secs,
    Frames,
}

/// A time of a clip in seconds: `0.33`, `0.33 s`, `f20`, `20 f`. `unit`: of a number alone.
pub fn time(typed: &str, clip: &Clip, unit: Unit) -> Result<f32, String> {
    let Some((number, unit)) = number_and_unit(typed, unit) else {
        return Err("Type seconds, 0.33 s, or a frame, f20".to_owned());
    };
    let [start, end] = [clip.start_secs, clip.end_secs].map(f64::from);
    match unit {
        Unit::Frames if number < 0.0 => Err("Before the first frame, 0".to_owned()),
        Unit::Frames if number > f64::from(clip.last_frame()) => {
            Err(format!("Beyond the last frame, {}", clip.last_frame()))
        }
        Unit::Frames => Ok(clip.time_at_place(number)),
        Unit::Secs if number < start - ROUNDING_SECS => {
            Err(format!("Before the clip's start, {} s", seconds(clip.start_secs)))
        }
        Unit::Secs if number > end + ROUNDING_SECS => {
            Err(format!("Beyond the clip's end, {} s", seconds(clip.end_secs)))
        }
        Unit::Secs => Ok((number as f32).clamp(clip.start_secs, clip.end_secs)),
    }
}

/// A speed: `0.3`, `2×`.
pub fn speed(typed: &str) -> Result<f32, String> {
    let typed = typed.trim_end().trim_end_matches(['x', 'X']);
    number_within(typed, &(MIN_SPEED..=MAX_SPEED))
}

/// A number, and what it counts. What stands behind a number alone is ignored where it is no unit: `31 / 75`.
pub fn number_and_unit(typed: &str, unit: Unit) -> Option<(f64, Unit)> {
    let typed = typed.trim().to_lowercase();
    let after = typed.trim_start_matches(|letter: char| letter.is_alphabetic());
    let before = typed[..typed.len() - after.len()].trim_end();
    let (number, rest) = leading_number(after.trim_start())?;
    let behind: String = rest
        .trim_start()
        .chars()
        .take_while(|letter| letter.is_alphabetic())
        .collect();
    let unit_of = |word: &str| match word {
        "f" | "fr" | "frame" | "frames" => Some(Unit::Frames),
        "s" | "sec" | "secs" | "second" | "seconds" => Some(Unit::Secs),
        "" | "of" => Some(unit),
        _ => None,
    };
    match (before, behind.as_str()) {
        ("", behind) => Some((number, unit_of(behind)?)),
        (before, "" | "of") => Some((number, unit_of(before)?)),
        _ => None,
    }
}
