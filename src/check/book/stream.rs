//! What `>>` of a C++ stream takes from a file, and what it leaves for the next read.
//!
//! Words end at blanks. Of a number the longest beginning that is one is taken. A read that fails leaves the stream failed: every later
//! read then does nothing.

use std::fmt;

use super::number::{Misfit, float_length, whole};
use crate::diagnostic::{Entry, Position};
use crate::format::{Cursor, QuickRun};

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
    pub entry: Entry,
    /// What happens there, one sentence.
    pub why: String,
}

/// A file that is read with `>>`.
pub struct Stream<'a> {
    cursor: Cursor<'a>,
    /// What is being read, for messages.
    pub(super) entry: Entry,
    stop: Option<Trouble>,
    /// The first word that was taken for another thing than it is, without a failure.
    mistake: Option<Trouble>,
}

impl<'a> Stream<'a> {
    /// A stream at its beginning.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            // A byte order mark is a part of the first word.
            cursor: Cursor {
                bytes,
                at: 0,
                line: 1,
                line_start: 0,
            },
            entry: Entry::Header,
            stop: None,
            mistake: None,
        }
    }

    /// Whether a read has failed, so that all others fail too.
    pub fn has_failed(&self) -> bool {
        self.stop.is_some()
    }

    /// The failed read, and the first mistake.
    pub fn into_troubles(self) -> (Option<Trouble>, Option<Trouble>) {
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

    /// Passes over rows that [`quick`](Self::quick) reads as they are meant, of which `last` is the last. False, and nothing is passed,
    /// where they do not begin here.
    pub(super) fn pass_over(&mut self, rows: &QuickRun, last: Entry) -> bool {
        let passes = !self.has_failed() && rows.pass(&mut self.cursor);
        if passes {
            self.entry = last;
        }
        passes
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
    pub fn label(&mut self, label: &'static str, others: &[&str]) {
        let entry = self.entry;
        let Some(word) = self.word(format_args!("the label {label} of {entry}")) else {
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
            let why = format!("It takes \"{}\" for the label {label} of {entry}.", word.shown());
            self.note_mistake(word, why);
        }
    }

    /// Reads a word that is kept, or `None` when the stream fails.
    pub fn name(&mut self, what: &'static str) -> Option<String> {
        let entry = self.entry;
        let word = self.word(format_args!("{what} of {entry}"))?;
        Some(String::from_utf8_lossy(word.text).into_owned())
    }

    /// Reads a brace or any other word that nobody looks at.
    pub fn skip(&mut self) {
        let entry = self.entry;
        self.word(format_args!("a word of {entry}"));
    }

    fn note_mistake(&mut self, word: Word<'_>, why: String) {
        self.mistake.get_or_insert(Trouble {
            position: word.position,
            length: word.length(),
            entry: self.entry,
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
            entry: self.entry,
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
        let entry = self.entry;
        match take(word.text) {
            Ok((length, value)) => {
                self.cursor.at += length;
                return value;
            }
            Err(_) if word.text.is_empty() => {
                self.fail(word, format!("The file ends where it reads {what} of {entry}."));
            }
            Err(Misfit::NoNumber) => {
                let why = format!(
                    "It reads {what} of {entry} and finds \"{}\", which is no {kind}.",
                    word.shown()
                );
                self.fail(word, why);
            }
            Err(Misfit::OutOfRange) => {
                let why = format!(
                    "It reads {what} of {entry} and finds \"{}\", which is out of range for {kind}.",
                    word.shown()
                );
                self.fail(word, why);
            }
        }
        T::default()
    }

    /// Reads a `float`.
    pub fn float(&mut self, what: &'static str) -> f32 {
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
    pub fn int(&mut self, what: &'static str) -> i32 {
        self.number(what, "whole number", |word| {
            let (length, value) = whole(word)?;
            Ok((length, i32::try_from(value).map_err(|_| Misfit::OutOfRange)?))
        })
    }

    /// Reads a `UINT`. A negative number counts down from the greatest one.
    pub fn uint(&mut self, what: &'static str) -> u32 {
        self.number(what, "whole number", |word| {
            let (length, value) = whole(word)?;
            let magnitude = u32::try_from(value.unsigned_abs()).map_err(|_| Misfit::OutOfRange)?;
            Ok((length, if value < 0 { magnitude.wrapping_neg() } else { magnitude }))
        })
    }

    /// Reads a `USHORT`. A negative number counts down from the greatest one.
    pub fn ushort(&mut self, what: &'static str) -> u16 {
        self.number(what, "16-bit number", |word| {
            let (length, value) = whole(word)?;
            let magnitude = u16::try_from(value.unsigned_abs()).map_err(|_| Misfit::OutOfRange)?;
            Ok((length, if value < 0 { magnitude.wrapping_neg() } else { magnitude }))
        })
    }

    /// Reads a `bool`, which is 0 or 1: the loaders do not ask for words.
    pub fn boolean(&mut self, what: &'static str) -> bool {
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
