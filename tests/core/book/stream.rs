//! What the stream of a book's loader takes for a word, a number and a label.

use bindpose::check::book::Stream;

fn stream(text: &str) -> Stream<'_> {
    Stream::new(text.as_bytes())
}

#[test]
fn the_longest_beginning_that_is_a_number_is_taken_and_the_rest_stays() {
    for (text, value, rest) in [
        ("1.5 2", 1.5, "2"),
        ("1,5", 1.0, ",5"),
        ("1.0f", 1.0, "f"),
        (".5", 0.5, ""),
        ("5.", 5.0, ""),
        ("-2e-1x", -0.2, "x"),
        ("1e", 1.0, "e"),
        ("1e+", 1.0, "e+"),
        ("-1.#IND", -1.0, "#IND"),
        ("+7", 7.0, ""),
        ("0x10", 0.0, "x10"),
    ] {
        let mut stream = stream(text);
        assert_eq!(stream.float("a number"), value, "{text}");
        assert!(!stream.has_failed(), "{text}");
        let left = stream.name("the rest").unwrap_or_default();
        assert_eq!(left, rest, "{text}");
    }
    let mut stream = stream("1.5");
    assert_eq!(
        (stream.int("a number"), stream.name("the rest").as_deref()),
        (1, Some(".5"))
    );
}

#[test]
fn a_failed_read_gives_zero_and_so_do_all_after_it() {
    for text in [
        "nan 1",
        "inf 1",
        "Normal: 1",
        "1e99 1",
        "",
        "- 1",
        ". 1",
        "-. 1",
        "e5 1",
    ] {
        let mut stream = stream(text);
        assert_eq!((stream.float("a"), stream.float("b")), (0.0, 0.0), "{text}");
        assert!(stream.has_failed(), "{text}");
    }
}

#[test]
fn whole_numbers_have_their_ranges() {
    assert_eq!(stream("-1").uint("a"), u32::MAX);
    assert_eq!(stream("-1").ushort("a"), u16::MAX);
    assert_eq!(stream("65535").ushort("a"), 65_535);
    for text in ["65536", "-65536", "99999999999999999999"] {
        let mut stream = stream(text);
        stream.ushort("a");
        assert!(stream.has_failed(), "{text}");
    }
    for (text, value) in [
        ("0", Some(false)),
        ("1", Some(true)),
        ("2", None),
        ("true", None),
        ("-1", None),
    ] {
        let mut stream = stream(text);
        let read = stream.boolean("a");
        assert_eq!((!stream.has_failed()).then_some(read), value, "{text}");
    }
}

#[test]
fn lines_and_columns_are_counted() {
    let mut stream = stream("a\r\n  b\tx\n");
    stream.skip();
    stream.skip();
    stream.float("a number");
    let (stop, _) = stream.into_troubles();
    let stop = stop.expect("x is no number");
    assert_eq!((stop.position.line, stop.position.column, stop.length), (2, 5, 1));
    assert_eq!(
        stop.why,
        "It reads a number of the header and finds \"x\", which is no number."
    );
}

#[test]
fn labels_of_other_values_are_mistakes_and_other_spellings_are_none() {
    let mut right = stream("#materials: Tex_Coords: P:");
    right.label("Materials", &["Vertices"]);
    right.label("Tex-Coords", &["Normal"]);
    right.label("Position", &["Normal"]);
    assert_eq!(right.into_troubles(), (None, None));
    let mut wrong = stream("Normal: ***Vertices***");
    wrong.label("Tangent", &["Normal"]);
    wrong.label("Tangent", &[]);
    let (_, mistake) = wrong.into_troubles();
    assert_eq!(
        mistake.map(|mistake| mistake.why).as_deref(),
        Some("It takes \"Normal:\" for the label Tangent of the header.")
    );
}
