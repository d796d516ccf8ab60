//! Numbers and names in columns.

use bindpose::cli::for_tests::{Plain, column_width, grouped};

#[test]
fn thousands_stand_apart() {
    for (count, text) in [
        (0, "0"),
        (999, "999"),
        (1000, "1,000"),
        (13_748, "13,748"),
        (1_234_567, "1,234,567"),
    ] {
        assert_eq!(grouped(count), text);
    }
}

#[test]
fn a_column_is_as_wide_as_its_names_within_reason() {
    assert_eq!(column_width([].into_iter()), 0);
    assert_eq!(column_width(["skin", "höhle"].into_iter()), 5);
    assert_eq!(column_width(["a", &"a".repeat(1_000_000)].into_iter()), 48);
}

#[test]
fn text_from_a_file_cannot_steer_the_terminal() {
    assert_eq!(
        Plain("a\u{1b}[31mb\u{202e}c\nd").to_string(),
        "a\u{fffd}[31mb\u{fffd}c\u{fffd}d"
    );
}
