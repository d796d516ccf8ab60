//! Numbers in words.

use bindpose::ui::for_tests::{bytes, grouped, measured, milliseconds};

#[test]
fn thousands_are_grouped() {
    let cases = [
        (0, "0"),
        (999, "999"),
        (1000, "1\u{2009}000"),
        (13_748, "13\u{2009}748"),
        (1_234_567, "1\u{2009}234\u{2009}567"),
    ];
    for (number, text) in cases {
        assert_eq!(grouped(number), text);
    }
}

#[test]
fn times_and_amounts_of_data_keep_about_three_digits() {
    let times = [
        (0.0, "0.00 ms"),
        (0.000_418, "0.42 ms"),
        (0.009_996, "10.0 ms"),
        (0.25, "250.0 ms"),
    ];
    for (secs, text) in times {
        assert_eq!(milliseconds(secs), text);
    }
    let amounts = [
        (0, "0 B"),
        (999, "999 B"),
        (1_540, "1.54 kB"),
        (48_000, "48.0 kB"),
        (999_600, "1.00 MB"),
        (123_456_789, "123 MB"),
        (5_000_000_000, "5.00 GB"),
        (5_000_000_000_000, "5000 GB"),
    ];
    for (count, text) in amounts {
        assert_eq!(bytes(count), text);
    }
}

#[test]
fn lengths_keep_about_three_digits() {
    let cases = [
        (0.0, "0"),
        (73.42, "73.4"),
        (1.8, "1.80"),
        (0.437_6, "0.438"),
        (0.012_34, "0.0123"),
        (1e9, "1.00e9"),
        (-2000.0, "−2\u{2009}000"),
        (f32::NAN, "–"),
    ];
    for (length, text) in cases {
        assert_eq!(measured(length), text);
    }
}
