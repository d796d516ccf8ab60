//! What is typed into the fields of the timeline: times, frames, speeds. Each is read, or refused with the reason.

use super::time_area::seconds;
use crate::anim::{MAX_SPEED, MIN_SPEED};
use crate::model::Clip;
use crate::ui::widgets::{leading_number, number_within};

/// A time that is typed is right if it rounds to the clip's end as it is shown.
const ROUNDING_SECS: f64 = 0.0005;

/// What a number without a unit counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Secs,
    Frames,
}

/// A time of a clip in seconds: `0.33`, `0.33 s`, `f20`, `20 f`. `unit`: of a number alone.
pub(super) fn time(typed: &str, clip: &Clip, unit: Unit) -> Result<f32, String> {
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
pub(super) fn speed(typed: &str) -> Result<f32, String> {
    let typed = typed.trim_end().trim_end_matches(['x', 'X']);
    number_within(typed, &(MIN_SPEED..=MAX_SPEED))
}

/// A number, and what it counts. What stands behind a number alone is ignored where it is no unit: `31 / 75`.
fn number_and_unit(typed: &str, unit: Unit) -> Option<(f64, Unit)> {
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

#[cfg(test)]
mod tests {
    use glam::{Quat, Vec3};

    use super::*;
    use crate::anim::LocalJoint;
    use crate::model::Track;

    #[test]
    fn times_and_frames_are_read_as_people_write_them() {
        for (typed, in_secs, in_frames) in [
            ("0.33", Some((0.33, Unit::Secs)), Some((0.33, Unit::Frames))),
            (" 1,25 s", Some((1.25, Unit::Secs)), Some((1.25, Unit::Secs))),
            ("0.5 seconds", Some((0.5, Unit::Secs)), Some((0.5, Unit::Secs))),
            ("f20", Some((20.0, Unit::Frames)), Some((20.0, Unit::Frames))),
            ("20 f", Some((20.0, Unit::Frames)), Some((20.0, Unit::Frames))),
            ("Frame 20", Some((20.0, Unit::Frames)), Some((20.0, Unit::Frames))),
            ("31 / 75", Some((31.0, Unit::Secs)), Some((31.0, Unit::Frames))),
            ("31 of 75", Some((31.0, Unit::Secs)), Some((31.0, Unit::Frames))),
            ("−2", Some((-2.0, Unit::Secs)), Some((-2.0, Unit::Frames))),
            (".5", Some((0.5, Unit::Secs)), Some((0.5, Unit::Frames))),
            ("", None, None),
            ("soon", None, None),
            ("f", None, None),
            ("20 x", None, None),
            ("f20 s", None, None),
            ("1.2.3", None, None),
        ] {
            assert_eq!(number_and_unit(typed, Unit::Secs), in_secs, "{typed:?}");
            assert_eq!(number_and_unit(typed, Unit::Frames), in_frames, "{typed:?}");
        }
    }

    #[test]
    fn what_is_outside_of_the_clip_is_refused_with_its_end() {
        let joint = LocalJoint {
            rotation: Quat::IDENTITY,
            translation: Vec3::ZERO,
            scale: Vec3::ONE,
        };
        let keys = (0..=15).map(|frame| (0.75 + frame as f32 / 30.0, joint));
        let clip = Clip::new("clip", vec![Track::new(keys).expect("keys in order")]);
        let read = |typed| time(typed, &clip, Unit::Secs);
        assert_eq!(read("1.25"), Ok(1.25));
        assert_eq!(read("1.2504"), Ok(1.25), "it is shown so");
        assert_eq!(read("f15"), Ok(1.25));
        assert_eq!(read("1.3"), Err("Beyond the clip's end, 1.25 s".to_owned()));
        assert_eq!(read("0"), Err("Before the clip's start, 0.75 s".to_owned()));
        assert_eq!(read("16 f"), Err("Beyond the last frame, 15".to_owned()));
        assert_eq!(read("f-1"), Err("Before the first frame, 0".to_owned()));
        assert_eq!(read("soon"), Err("Type seconds, 0.33 s, or a frame, f20".to_owned()));
    }

    #[test]
    fn speeds_are_read_within_their_bounds() {
        assert_eq!(speed("0.5×"), Ok(0.5));
        for typed in ["0", "-1", "5", "fast"] {
            assert_eq!(speed(typed), Err("A number from 0.05 to 4".to_owned()), "{typed}");
        }
    }
}
