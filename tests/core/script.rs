//! Arguments of script calls.

use bindpose::script::{Given, Misuse, factor, name, natural, secs, whole};

const NONSENSE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn range_error<T>(words: &str) -> Result<T, Misuse> {
    Err(Misuse::Range(words.to_owned()))
}

fn type_error<T>(words: &str) -> Result<T, Misuse> {
    Err(Misuse::Type(words.to_owned()))
}

fn text(text: &str) -> Given {
    Given::Text(text.to_owned())
}

fn other(kind: &str) -> Given {
    Given::Other(kind.to_owned())
}

#[test]
fn times_are_finite_numbers() {
    let words = |given: &str| format!("seek takes a finite number of seconds, not {given}");
    for (given, expected) in [
        (Given::Number(-1.5), Ok(-1.5)),
        // It is clamped to the clip.
        (Given::Number(1e300), Ok(f32::MAX)),
        (Given::Number(f64::NAN), range_error(&words("NaN"))),
        (Given::Number(f64::NEG_INFINITY), range_error(&words("-Infinity"))),
        (text("x"), type_error(&words("\"x\""))),
        (other("undefined"), type_error(&words("undefined"))),
    ] {
        assert_eq!(secs("seek", &given), expected, "{given:?}");
    }
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
    let words = "stepFrames takes a whole number, not 1.5";
    assert_eq!(whole("stepFrames", &Given::Number(1.5)), range_error(words));
    for number in NONSENSE {
        let found = whole("stepFrames", &Given::Number(number));
        assert!(matches!(found, Err(Misuse::Range(_))), "{number}");
    }
}

#[test]
fn seeds_are_whole_numbers_of_32_bits() {
    for seed in [0, 7, u32::MAX] {
        assert_eq!(natural("setCrowd({seed})", &Given::Number(f64::from(seed))), Ok(seed));
    }
    let words = "setCrowd({seed}) takes a whole number from 0 to 4294967295, not -1";
    assert_eq!(natural("setCrowd({seed})", &Given::Number(-1.0)), range_error(words));
    for number in NONSENSE.into_iter().chain([0.5, 4_294_967_296.0]) {
        let found = natural("setCrowd({seed})", &Given::Number(number));
        assert!(matches!(found, Err(Misuse::Range(_))), "{number}");
    }
    let found = natural("setCrowd({seed})", &text("7"));
    assert!(matches!(found, Err(Misuse::Type(_))), "{found:?}");
}

#[test]
fn factors_are_above_0() {
    assert_eq!(factor("setSpeed", &Given::Number(0.5)), Ok(0.5));
    for number in [1e-300, 1e300] {
        let found = factor("setSpeed", &Given::Number(number)).expect("it is clamped to the viewer's limits");
        assert!(found > 0.0 && found.is_finite());
    }
    let words = "setSpeed takes a finite number above 0, not -3";
    assert_eq!(factor("setSpeed", &Given::Number(-3.0)), range_error(words));
    for number in NONSENSE.into_iter().chain([0.0, -0.0]) {
        let found = factor("setSpeed", &Given::Number(number));
        assert!(matches!(found, Err(Misuse::Range(_))), "{number}");
    }
    let found = factor("setSpeed", &other("null"));
    assert!(matches!(found, Err(Misuse::Type(_))), "{found:?}");
}

#[test]
fn names_are_texts() {
    assert_eq!(name("setLoop", &text("once")), Ok("once"));
    let refused = type_error("setLoop takes a name, not 5");
    assert_eq!(name("setLoop", &Given::Number(5.0)), refused);
}
