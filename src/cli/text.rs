//! Words and numbers for a terminal.

use std::fmt;

use crate::format::is_printable;

/// Text from a file on one line, without the characters that control the terminal.
pub(super) struct Plain<'a>(pub(super) &'a str);

impl fmt::Display for Plain<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use fmt::Write as _;
        self.0.chars().try_for_each(|character| {
            f.write_char(if is_printable(character) {
                character
            } else {
                char::REPLACEMENT_CHARACTER
            })
        })
    }
}

/// A count with its thousands apart: `13,748`.
pub(super) fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// `1 note`, `2 notes`.
pub(super) fn counted(count: usize, word: &str) -> String {
    format!("{} {word}{}", grouped(count), if count == 1 { "" } else { "s" })
}

/// Characters of the widest column of names. A longer name sticks out of its own row only.
const WIDEST_COLUMN: usize = 48;

/// Characters of a column that holds these names. The names come from a file, and the formatter takes no width above 65 535.
pub(super) fn column_width<'a>(names: impl Iterator<Item = &'a str>) -> usize {
    let widths = names.map(|name| name.chars().take(WIDEST_COLUMN).count());
    widths.max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(column_width(["a", &"a".repeat(1_000_000)].into_iter()), WIDEST_COLUMN);
    }

    #[test]
    fn text_from_a_file_cannot_steer_the_terminal() {
        assert_eq!(
            Plain("a\u{1b}[31mb\u{202e}c\nd").to_string(),
            "a\u{fffd}[31mb\u{fffd}c\u{fffd}d"
        );
    }
}
