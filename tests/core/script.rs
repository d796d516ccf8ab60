//! Arguments of script calls.

use bindpose::script::{Given, Misuse, factor, name, natural, secs, whole};

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
