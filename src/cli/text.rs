//! Words and numbers for a terminal.

use std::fmt;

use crate::format::is_printable;

/// Text from a file on one line, without the characters that control the terminal.
pub struct Plain<'a>(pub &'a str);

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
pub fn grouped(count: usize) -> String {
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
pub fn column_width<'a>(names: impl Iterator<Item = &'a str>) -> usize {
    let widths = names.map(|name| name.chars().take(WIDEST_COLUMN).count());
    widths.max().unwrap_or(0)
}
