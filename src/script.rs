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
