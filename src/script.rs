//! The arguments of script calls: which of them make sense, and the words for those that do not.
//!
//! One of a wrong type is a [`Misuse::Type`]. A number without a meaning (NaN, infinite, half a frame, a speed of 0) is a
//! [`Misuse::Range`]. Other numbers are right: the viewer clamps them to the clip or to its limits.

use std::fmt;

/// A value that a script gave.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// A number, NaN and infinity included.
    Number(f64),
    /// A text.
    Text(String),
    /// Anything else, as it is called in a message: `undefined`, `an object`.
    Other(String),
}

/// Why a call does nothing, in words for who wrote it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Misuse {
    /// `TypeError` in a script.
    Type(String),
    /// `RangeError` in a script.
    Range(String),
}

impl fmt::Display for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) if number.is_infinite() && *number > 0.0 => f.write_str("Infinity"),
            Self::Number(number) if number.is_infinite() => f.write_str("-Infinity"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::Other(words) => f.write_str(words),
        }
    }
}

/// A time in seconds: any finite number.
///
/// # Errors
/// When it is none.
pub fn secs(call: &str, given: &Given) -> Result<f32, Misuse> {
    let wanted = "a finite number of seconds";
    let number = number(call, given, wanted)?;
    check(call, given, wanted, number.is_finite())?;
    // A time that is too great for an f32 lies beyond every clip.
    Ok(number.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32)
}

/// A count of steps: a whole number.
///
/// # Errors
/// When it is none.
pub fn whole(call: &str, given: &Given) -> Result<i32, Misuse> {
    let wanted = "a whole number";
    let number = number(call, given, wanted)?;
    check(call, given, wanted, number.fract() == 0.0)?;
    Ok(number as i32)
}

/// A number of something that is counted from 0, or a seed.
///
/// # Errors
/// When it is none.
pub fn natural(call: &str, given: &Given) -> Result<u32, Misuse> {
    let wanted = "a whole number from 0 to 4294967295";
    let number = number(call, given, wanted)?;
    let is_natural = number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number);
    check(call, given, wanted, is_natural)?;
    Ok(number as u32)
}

/// A factor: a finite number above 0.
///
/// # Errors
/// When it is none.
pub fn factor(call: &str, given: &Given) -> Result<f32, Misuse> {
    let wanted = "a finite number above 0";
    let number = number(call, given, wanted)?;
    check(call, given, wanted, number.is_finite() && number > 0.0)?;
    Ok(number.clamp(f64::from(f32::MIN_POSITIVE), f64::from(f32::MAX)) as f32)
}

/// A name.
///
/// # Errors
/// When it is no text.
pub fn name<'a>(call: &str, given: &'a Given) -> Result<&'a str, Misuse> {
    match given {
        Given::Text(name) => Ok(name),
        _ => Err(Misuse::Type(message(call, given, "a name"))),
    }
}

fn number(call: &str, given: &Given, wanted: &str) -> Result<f64, Misuse> {
    match given {
        Given::Number(number) => Ok(*number),
        _ => Err(Misuse::Type(message(call, given, wanted))),
    }
}

fn check(call: &str, given: &Given, wanted: &str, is_right: bool) -> Result<(), Misuse> {
    let misuse = || Misuse::Range(message(call, given, wanted));
    is_right.then_some(()).ok_or_else(misuse)
}

fn message(call: &str, given: &Given, wanted: &str) -> String {
    format!("{call} takes {wanted}, not {given}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONSENSE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

    fn range_error(words: &str) -> Misuse {
        Misuse::Range(words.to_owned())
    }

    fn type_error(words: &str) -> Misuse {
        Misuse::Type(words.to_owned())
    }

    #[test]
    fn times_are_finite_numbers() {
        assert_eq!(secs("seek", &Given::Number(-1.5)), Ok(-1.5));
        assert_eq!(
            secs("seek", &Given::Number(1e300)),
            Ok(f32::MAX),
            "it is clamped to the clip"
        );
        assert_eq!(
            secs("seek", &Given::Number(f64::NAN)),
            Err(range_error("seek takes a finite number of seconds, not NaN"))
        );
        assert_eq!(
            secs("setRangeStart", &Given::Number(f64::NEG_INFINITY)),
            Err(range_error(
                "setRangeStart takes a finite number of seconds, not -Infinity"
            ))
        );
        assert_eq!(
            secs("seek", &Given::Text("x".to_owned())),
            Err(type_error("seek takes a finite number of seconds, not \"x\""))
        );
        assert_eq!(
            secs("seek", &Given::Other("undefined".to_owned())),
            Err(type_error("seek takes a finite number of seconds, not undefined"))
        );
    }

    #[test]
    fn counts_are_whole_numbers() {
        for count in [-3, 0, 10] {
            assert_eq!(whole("stepFrames", &Given::Number(f64::from(count))), Ok(count));
        }
        assert_eq!(
            whole("stepFrames", &Given::Number(1e12)),
            Ok(i32::MAX),
            "it ends with the clip"
        );
        assert_eq!(
            whole("stepFrames", &Given::Number(1.5)),
            Err(range_error("stepFrames takes a whole number, not 1.5"))
        );
        for number in NONSENSE {
            assert!(matches!(
                whole("stepFrames", &Given::Number(number)),
                Err(Misuse::Range(_))
            ));
        }
    }

    #[test]
    fn seeds_are_whole_numbers_of_32_bits() {
        for seed in [0, 7, u32::MAX] {
            assert_eq!(natural("setCrowd({seed})", &Given::Number(f64::from(seed))), Ok(seed));
        }
        assert_eq!(
            natural("setCrowd({seed})", &Given::Number(-1.0)),
            Err(range_error(
                "setCrowd({seed}) takes a whole number from 0 to 4294967295, not -1"
            ))
        );
        for number in NONSENSE.into_iter().chain([0.5, 4_294_967_296.0]) {
            assert!(
                matches!(
                    natural("setCrowd({seed})", &Given::Number(number)),
                    Err(Misuse::Range(_))
                ),
                "{number}"
            );
        }
        assert!(matches!(
            natural("setCrowd({seed})", &Given::Text("7".to_owned())),
            Err(Misuse::Type(_))
        ));
    }

    #[test]
    fn factors_are_above_0() {
        assert_eq!(factor("setSpeed", &Given::Number(0.5)), Ok(0.5));
        for number in [1e-300, 1e300] {
            let found = factor("setSpeed", &Given::Number(number)).expect("it is clamped to the viewer's limits");
            assert!(found > 0.0 && found.is_finite());
        }
        assert_eq!(
            factor("setSpeed", &Given::Number(-3.0)),
            Err(range_error("setSpeed takes a finite number above 0, not -3"))
        );
        for number in NONSENSE.into_iter().chain([0.0, -0.0]) {
            assert!(
                matches!(factor("setSpeed", &Given::Number(number)), Err(Misuse::Range(_))),
                "{number}"
            );
        }
        assert!(matches!(
            factor("setSpeed", &Given::Other("null".to_owned())),
            Err(Misuse::Type(_))
        ));
    }

    #[test]
    fn names_are_texts() {
        assert_eq!(name("setLoop", &Given::Text("once".to_owned())), Ok("once"));
        assert_eq!(
            name("setLoop", &Given::Number(5.0)),
            Err(type_error("setLoop takes a name, not 5"))
        );
    }
}
