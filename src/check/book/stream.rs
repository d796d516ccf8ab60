//! What `>>` of a C++ stream takes from a file, and what it leaves for the next read.
//!
//! Words end at blanks. Of a number the longest beginning that is one is taken. A read that fails leaves the stream failed: every later
//! read then does nothing.

use std::fmt;

use super::number::{Misfit, float_length, whole};
use super::row::Row;
use crate::diagnostic::Position;
use crate::format::Cursor;

/// A run of bytes without blanks, and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'a> {
    pub(super) text: &'a [u8],
    pub(super) position: Position,
}

impl Word<'_> {
    fn length(&self) -> u32 {
        u32::try_from(self.text.len()).unwrap_or(u32::MAX)
    }

    /// The word for a message: not all of a long one.
    fn shown(&self) -> String {
        const MOST: usize = 40;
        let cut = &self.text[..self.text.len().min(MOST)];
        let dots = if cut.len() < self.text.len() { "…" } else { "" };
        format!("{}{dots}", String::from_utf8_lossy(cut))
    }

    /// Whether it looks like the line above a section.
    fn is_ruler(&self) -> bool {
        let text = self.text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(self.text);
        text.starts_with(b"***") || text.starts_with(b"---")
    }
}

/// Where reading goes wrong, and how.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// Where it is.
    pub position: Position,
    /// Bytes that are meant.
    pub length: u32,
    /// What was being read.
    pub row: Row,
    /// What happens there, one sentence.
    pub why: String,
}

/// A file that is read with `>>`.
pub(super) struct Stream<'a> {
    cursor: Cursor<'a>,
    /// What is being read, for messages.
    pub(super) row: Row,
    stop: Option<Trouble>,
    /// The first word that was taken for another thing than it is, without a failure.
    mistake: Option<Trouble>,
}

impl<'a> Stream<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            // A byte order mark is a part of the first word.
            cursor: Cursor {
                bytes,
                at: 0,
                line: 1,
                line_start: 0,
            },
            row: Row::Header,
            stop: None,
            mistake: None,
        }
    }

    /// Whether a read has failed, so that all others fail too.
    pub(super) fn has_failed(&self) -> bool {
        self.stop.is_some()
    }

    /// The failed read, and the first mistake.
    pub(super) fn into_troubles(self) -> (Option<Trouble>, Option<Trouble>) {
        (self.stop, self.mistake)
    }

    /// Reads a row that is as the books' exporter writes it, which the quick reader of [`format`](crate::format) takes as `>>` does. `None` for
    /// any other, and nothing is read then.
    pub(super) fn quick<T>(&mut self, read: impl FnOnce(&mut Cursor<'a>) -> Option<T>) -> Option<T> {
        if self.has_failed() {
            return None;
        }
        self.cursor.pass_empty_lines();
        read(&mut self.cursor)
    }

    /// Reads a word that nobody looks at: the line above a section.
    pub(super) fn ruler(&mut self, section: &'static str) {
        if let Some(word) = self.word(format_args!("the line above {section}"))
            && !word.is_ruler()
        {
            let why = format!("It skips \"{}\" as if it were the line above {section}.", word.shown());
            self.note_mistake(word, why);
        }
    }

    /// Reads a word that nobody looks at: the label of a value. `others` are the labels that stand near it.
    pub(super) fn label(&mut self, label: &'static str, others: &[&str]) {
        let row = self.row;
        let Some(word) = self.word(format_args!("the label {label} of {row}")) else {
            return;
        };
        // As nearly all of them are written.
        if word.text.strip_suffix(b":") == Some(label.as_bytes()) {
            return;
        }
        let is = |label: &str| {
            let named = word
                .text
                .iter()
                .filter(|byte| !matches!(byte, b'#' | b':' | b'-' | b'_'));
            let mut expected = label.bytes().filter(|byte| *byte != b'-');
            named
                .map(u8::to_ascii_lowercase)
                .eq(expected.by_ref().map(|byte| byte.to_ascii_lowercase()))
        };
        if word.is_ruler() || (!is(label) && others.iter().any(|other| is(other))) {
            let why = format!("It takes \"{}\" for the label {label} of {row}.", word.shown());
            self.note_mistake(word, why);
        }
    }

    /// Reads a word that is kept, or `None` when the stream fails.
    pub(super) fn name(&mut self, what: &'static str) -> Option<String> {
        let row = self.row;
        let word = self.word(format_args!("{what} of {row}"))?;
        Some(String::from_utf8_lossy(word.text).into_owned())
    }

    /// Reads a brace or any other word that nobody looks at.
    pub(super) fn skip(&mut self) {
        let row = self.row;
        self.word(format_args!("a word of {row}"));
    }

    fn note_mistake(&mut self, word: Word<'_>, why: String) {
        self.mistake.get_or_insert(Trouble {
            position: word.position,
            length: word.length(),
            row: self.row,
            why,
        });
    }

    /// The next word. At the end of the file the stream fails, since it wanted `what`.
    fn word(&mut self, what: fmt::Arguments<'_>) -> Option<Word<'a>> {
        if self.has_failed() {
            return None;
        }
        let word = self.peek();
        if word.text.is_empty() {
            self.fail(word, format!("The file ends where it reads {what}."));
            return None;
        }
        self.cursor.at += word.text.len();
        Some(word)
    }

    /// The word that comes next; empty at the end of the file.
    fn peek(&mut self) -> Word<'a> {
        self.cursor.skip_space();
        let rest = &self.cursor.bytes[self.cursor.at..];
        let length = rest.iter().position(|&byte| is_blank(byte)).unwrap_or(rest.len());
        Word {
            text: &rest[..length],
            position: self.cursor.position(),
        }
    }

    fn fail(&mut self, word: Word<'_>, why: String) {
        self.stop = Some(Trouble {
            position: word.position,
            length: word.length(),
            row: self.row,
            why,
        });
    }

    /// Reads a number by `take`, which says how many bytes of a word it takes, and what they are worth. When it takes none, or the
    /// number does not fit, the stream fails and gives 0.
    fn number<T: Default>(
        &mut self,
        what: &'static str,
        kind: &'static str,
        take: impl FnOnce(&[u8]) -> Result<(usize, T), Misfit>,
    ) -> T {
        if self.has_failed() {
            return T::default();
        }
        let word = self.peek();
        let row = self.row;
        match take(word.text) {
            Ok((length, value)) => {
                self.cursor.at += length;
                return value;
            }
            Err(_) if word.text.is_empty() => self.fail(word, format!("The file ends where it reads {what} of {row}.")),
            Err(Misfit::NoNumber) => {
                let why = format!(
                    "It reads {what} of {row} and finds \"{}\", which is no {kind}.",
                    word.shown()
                );
                self.fail(word, why);
            }
            Err(Misfit::OutOfRange) => {
                let why = format!(
                    "It reads {what} of {row} and finds \"{}\", which is out of range for {kind}.",
                    word.shown()
                );
                self.fail(word, why);
            }
        }
        T::default()
    }

    /// Reads a `float`.
    pub(super) fn float(&mut self, what: &'static str) -> f32 {
        self.number(what, "number", |word| {
            let length = float_length(word).ok_or(Misfit::NoNumber)?;
            let value: f32 = fast_float2::parse(&word[..length]).map_err(|_| Misfit::NoNumber)?;
            if value.is_finite() {
                Ok((length, value))
            } else {
                Err(Misfit::OutOfRange)
            }
        })
    }

    /// Reads some `float`s in a row.
    pub(super) fn floats<const N: usize>(&mut self, what: &'static str) -> [f32; N] {
        std::array::from_fn(|_| self.float(what))
    }

    /// Reads an `int`.
    pub(super) fn int(&mut self, what: &'static str) -> i32 {
        self.number(what, "whole number", |word| {
            let (length, value) = whole(word)?;
            Ok((length, i32::try_from(value).map_err(|_| Misfit::OutOfRange)?))
        })
    }

    /// Reads a `UINT`. A negative number counts down from the greatest one.
    pub(super) fn uint(&mut self, what: &'static str) -> u32 {
        self.number(what, "whole number", |word| {
            let (length, value) = whole(word)?;
            let magnitude = u32::try_from(value.unsigned_abs()).map_err(|_| Misfit::OutOfRange)?;
            Ok((length, if value < 0 { magnitude.wrapping_neg() } else { magnitude }))
        })
    }

    /// Reads a `USHORT`. A negative number counts down from the greatest one.
    pub(super) fn ushort(&mut self, what: &'static str) -> u16 {
        self.number(what, "16-bit number", |word| {
            let (length, value) = whole(word)?;
            let magnitude = u16::try_from(value.unsigned_abs()).map_err(|_| Misfit::OutOfRange)?;
            Ok((length, if value < 0 { magnitude.wrapping_neg() } else { magnitude }))
        })
    }

    /// Reads a `bool`, which is 0 or 1: the loaders do not ask for words.
    pub(super) fn boolean(&mut self, what: &'static str) -> bool {
        self.number(what, "0 or 1", |word| match whole(word)? {
            (length, 0) => Ok((length, false)),
            (length, 1) => Ok((length, true)),
            _ => Err(Misfit::NoNumber),
        })
    }
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r')
}

#[cfg(test)]
mod tests {
    use super::*;

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
            ("-1.#IND", -1.0, "#IND"),
            ("+7", 7.0, ""),
            ("0x10", 0.0, "x10"),
        ] {
            let mut stream = stream(text);
            assert_eq!(stream.float("a number"), value, "{text}");
            assert!(!stream.has_failed(), "{text}");
            assert_eq!(String::from_utf8_lossy(stream.peek().text), rest, "{text}");
        }
        let mut stream = stream("1.5");
        assert_eq!((stream.int("a number"), stream.peek().text), (1, &b".5"[..]));
    }

    #[test]
    fn a_failed_read_gives_zero_and_so_do_all_after_it() {
        for text in ["nan 1", "inf 1", "Normal: 1", "1e99 1", "", "- 1", ". 1"] {
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
}
