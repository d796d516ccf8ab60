//! The thorough reader: one value, label or ruler at a time, with an error or a diagnostic for all that is odd.
//!
//! The long sections try [`quick`](super::quick) first and come here for the rows that it turns away.

use super::cursor::{Cursor, Token, length_of};
use super::error::{Value, quoted, row_count};
use super::kind::{DiagnosticKind, KindCounts};
use super::label::{Section, is_bare_ruler, is_ruler, same, same_as_any};
use super::number::{self, Reading};
use crate::diagnostic::{Diagnostic, Fault, Position, codes};
use crate::slices::{Pause, Slices, Stage};

/// So many rows are read between two places at which reading can stop: a tenth of a millisecond or two.
const ROWS_A_PIECE: usize = 128;

/// What the reader is at, and what it noticed on the way.
#[derive(Clone, Debug)]
pub(super) struct Reader<'a> {
    pub(super) cursor: Cursor<'a>,
    pub(super) kinds: KindCounts,
    /// The section that was entered last.
    pub(super) section: Section,
    /// A ruler of dashes was seen.
    pub(super) dashes: bool,
    /// The header's counts that were read, with the spellings of their labels.
    pub(super) counts: Vec<(&'static [&'static str], Token<'a>)>,
    slices: Slices,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Beginning {
    /// With its ruler, or one that says something else; the reader stands behind it.
    Ruler,
    /// Without one.
    Bare,
    /// Not at all: the file ends.
    End,
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8], slices: &Slices) -> Self {
        Self {
            cursor: Cursor::new(bytes),
            kinds: KindCounts::default(),
            section: Section::Header,
            dashes: false,
            counts: Vec::new(),
            slices: slices.clone(),
        }
    }

    /// [`pause`](Self::pause) at every so many rows. `row` counts them.
    #[inline(always)]
    pub(super) async fn pause_every(&self, row: usize) {
        if row.is_multiple_of(ROWS_A_PIECE) {
            self.pause().await;
        }
    }

    fn pause(&self) -> Pause {
        let cursor = &self.cursor;
        self.slices.pause_at(Stage::Reading, cursor.at, cursor.bytes.len())
    }

    pub(super) fn error_at(token: Token<'_>, fault: Diagnostic) -> Fault {
        fault.at(token.position, token.length()).into()
    }

    /// The error of a file that ends where `expected` should come.
    pub(super) fn end(&self, expected: impl Into<String>) -> Fault {
        let (section, expected) = (self.section.name(), expected.into());
        let message = format!("The file ends inside the {section} section, where {expected} was expected.");
        let fault = codes::UNEXPECTED_END.says(message).expected(expected);
        let fault = fault.found("the end of the file");
        fault.at(self.cursor.end_position(), 0).into()
    }

    /// Counts an occurrence of a kind at a token.
    pub(super) fn note(&mut self, token: Token<'_>, kind: DiagnosticKind) {
        self.kinds.add(kind, token.position, token.length());
    }

    /// How many rows to make room for: as many as announced, but no more than the bytes left can hold.
    pub(super) fn room_for(&self, rows: u32, smallest_row: usize) -> usize {
        (rows as usize).min(self.cursor.bytes_left() / smallest_row + 1)
    }

    /// Passes the ruler of `section`. What the books ask of a ruler is only that it is there.
    pub(super) fn begin(&mut self, section: Section) -> Result<Beginning, Fault> {
        loop {
            let Some(ruler) = self.peek_ruler() else {
                return Ok(if self.cursor.peek_token().is_none() {
                    Beginning::End
                } else {
                    Beginning::Bare
                });
            };
            self.dashes |= ruler.text.starts_with(b"-");
            let named = Section::of_ruler(ruler.text);
            if let Some(found) = named.filter(|&found| found != section) {
                let [expected, found] = [section, found].map(|section| format!("{} section", section.name()));
                let message = format!("The {expected} must come here, but the {found} was found.");
                let fault = codes::WRONG_SECTION.says(message);
                let fault = fault.expected(format!("the {expected}")).found(format!("the {found}"));
                return Err(Self::error_at(ruler, fault));
            }
            self.cursor.skip_space();
            self.cursor.rest_of_line();
            if named.is_none() && is_bare_ruler(ruler.text) {
                continue;
            }
            if named.is_none() || (section == Section::Header && !same(ruler.text, section.name())) {
                self.note(
                    ruler,
                    DiagnosticKind::RulerUnknown {
                        section,
                        found: quoted(ruler.text),
                    },
                );
            }
            self.section = section;
            self.pass_bare_rulers();
            return Ok(Beginning::Ruler);
        }
    }

    fn pass_bare_rulers(&mut self) {
        while self.peek_ruler().is_some_and(|ruler| is_bare_ruler(ruler.text)) {
            self.cursor.skip_space();
            self.cursor.rest_of_line();
        }
    }

    /// [`begin`](Self::begin) for a section that has rows: it must come, though its ruler may be missing.
    pub(super) fn begin_rows(&mut self, section: Section) -> Result<(), Fault> {
        match self.begin(section)? {
            Beginning::Ruler => {}
            Beginning::End => return Err(self.end(format!("the {} section", section.name()))),
            Beginning::Bare => self.ruler_missing(section),
        }
        Ok(())
    }

    /// Notes that `section` begins here without a ruler.
    pub(super) fn ruler_missing(&mut self, section: Section) {
        self.section = section;
        if let Some(token) = self.cursor.peek_token() {
            self.note(token, DiagnosticKind::RulerMissing(section));
        }
    }

    /// The whole line of the ruler that comes next, if one does.
    pub(super) fn peek_ruler(&self) -> Option<Token<'a>> {
        let mut ahead = self.cursor;
        ahead.skip_space();
        is_ruler(ahead.rest()).then(|| ahead.rest_of_line())
    }

    /// The label that comes next, across line ends, and where its value begins. It ends behind a colon or before a blank.
    pub(super) fn peek_label(&self) -> Option<(Token<'a>, Cursor<'a>)> {
        let mut ahead = self.cursor;
        ahead.skip_space();
        let start = ahead.at;
        let token = ahead.token()?;
        if let Some(colon) = memchr::memchr(b':', token.text) {
            ahead.at = start + colon + 1;
            return Some((
                Token {
                    text: token.text.get(..=colon).unwrap_or_default(),
                    ..token
                },
                ahead,
            ));
        }
        // A colon may stand apart.
        let mut behind = ahead;
        behind.skip_blanks();
        if behind.peek() == Some(b':') {
            behind.at += 1;
            return Some((token, behind));
        }
        Some((token, ahead))
    }

    /// Reads the label that comes next, which must be one of `names`; errors call it `label`.
    pub(super) fn label(&mut self, label: &'static str, names: &[&str]) -> Result<Token<'a>, Fault> {
        let Some((token, behind)) = self.peek_label() else {
            return Err(self.end(format!("{label}:")));
        };
        if !same_as_any(token.text, names) {
            return Err(Self::wrong_label(token, label));
        }
        self.cursor = behind;
        Ok(token)
    }

    /// The error of a label that is not `expected`.
    pub(super) fn wrong_label(token: Token<'_>, expected: &'static str) -> Fault {
        let found = quoted(token.text.strip_suffix(b":").unwrap_or(token.text));
        let message = format!("{expected} must come here, but \"{found}\" was found.");
        let fault = codes::WRONG_LABEL.says(message);
        Self::error_at(token, fault.expected(expected).found(found))
    }

    /// The next token of this line, which must be there.
    pub(super) fn value_token(&mut self, value: Value) -> Result<Token<'a>, Fault> {
        self.cursor.skip_blanks();
        if self.cursor.at_line_end() {
            return Err(self.value_missing(value));
        }
        self.cursor.token().ok_or_else(|| self.end(value.expected()))
    }

    fn value_missing(&self, value: Value) -> Fault {
        if self.cursor.peek_token().is_none() {
            return self.end(value.expected());
        }
        value.missing().at(self.cursor.position(), 0).into()
    }

    /// A token as a number; one that is not finite becomes `replacement`, with a diagnostic unless that is not finite either.
    pub(super) fn number_of(&mut self, token: Token<'_>, value: Value, replacement: f32) -> Result<f32, Fault> {
        match number::read(token.text) {
            Some(Reading::Plain(number)) => Ok(number),
            Some(Reading::Mended(number)) => {
                self.note(token, DiagnosticKind::NumberMended);
                Ok(number)
            }
            Some(Reading::NotFinite) => {
                if replacement.is_finite() {
                    self.note(token, DiagnosticKind::NumberNotFinite);
                }
                Ok(replacement)
            }
            None => Err(Self::error_at(token, value.not_a_number(token.text))),
        }
    }

    /// Reads a row of up to `N` numbers, of which the first `required` must be there; `defaults` stand in for the rest, and
    /// for numbers that are not finite. More numbers on the line are passed and noted. Says how many were there.
    pub(super) fn numbers<const N: usize>(
        &mut self,
        value: Value,
        required: usize,
        defaults: [f32; N],
    ) -> Result<([f32; N], usize), Fault> {
        let mut numbers = defaults;
        let mut split = false;
        for (index, number) in numbers.iter_mut().enumerate() {
            self.cursor.skip_blanks();
            if self.cursor.at_line_end() || !self.number_follows() {
                let on_this_line = !self.cursor.at_line_end();
                if !self.number_follows() {
                    if index >= required {
                        return Ok((numbers, index));
                    }
                    if !on_this_line {
                        return Err(self.value_missing(value));
                    }
                } else if !split {
                    split = true;
                    self.kinds.add(DiagnosticKind::RowSplit, self.cursor.position(), 0);
                }
            }
            let Some(token) = self.cursor.token() else {
                return Err(self.end(value.expected()));
            };
            *number = self.number_of(token, value, *number)?;
        }
        self.pass_surplus_numbers();
        Ok((numbers, N))
    }

    /// True when the next token, across line ends, is meant as a number.
    pub(super) fn number_follows(&self) -> bool {
        self.cursor
            .peek_token()
            .is_some_and(|token| looks_like_number(token.text))
    }

    /// Passes more numbers on this line, with a diagnostic.
    pub(super) fn pass_surplus_numbers(&mut self) {
        let mut noted = false;
        loop {
            self.cursor.skip_blanks();
            if self.cursor.at_line_end() || !self.number_follows() {
                return;
            }
            if let Some(token) = self.cursor.token()
                && !noted
            {
                noted = true;
                self.note(token, DiagnosticKind::ValuesSurplus);
            }
        }
    }

    /// Reads a whole number on this line, `smallest..=largest`.
    pub(super) fn whole(&mut self, value: Value, smallest: i64, largest: i64) -> Result<i64, Fault> {
        let token = self.value_token(value)?;
        self.whole_of(token, value, smallest, largest)
    }

    /// A token as a whole number, `smallest..=largest`.
    pub(super) fn whole_of(
        &mut self,
        token: Token<'_>,
        value: Value,
        smallest: i64,
        largest: i64,
    ) -> Result<i64, Fault> {
        let digits = token.text.strip_suffix(b",").unwrap_or(token.text);
        match std::str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok()) {
            Some(number) if (smallest..=largest).contains(&number) => {
                if digits.len() < token.text.len() {
                    self.note(token, DiagnosticKind::NumberMended);
                }
                Ok(number)
            }
            _ => Err(Self::error_at(token, value.not_in_range(smallest, largest, token.text))),
        }
    }

    /// Reads a whole number on this line, from 0 to the largest count.
    pub(super) fn count(&mut self, value: Value) -> Result<u32, Fault> {
        // In range, so the conversion holds.
        self.whole(value, 0, i64::from(u32::MAX))
            .map(|count| u32::try_from(count).unwrap_or(u32::MAX))
    }

    /// The error of rows that are not as many as announced, where they end: at the next ruler or word, or at the
    /// end of the file.
    pub(super) fn where_rows_end(&self, fault: Diagnostic) -> Fault {
        let (position, length) = match self.peek_ruler().or_else(|| self.cursor.peek_token()) {
            Some(token) => (token.position, length_of(token.text)),
            None => (self.cursor.end_position(), 0),
        };
        fault.at(position, length).into()
    }

    /// The error of a section whose rows are not as many as the header announced. Stands at the count of the header, if it has one.
    pub(super) fn section_row_count(&self, rows: &'static str, announced: u32, counted: usize) -> Fault {
        let fault = |holder: &str| row_count("The header", rows, holder, announced, counted);
        let section = format!("the {} section", self.section.name());
        let count = |rows| self.counts.iter().rfind(|(names, _)| names.contains(&rows));
        // Without a count of its own the subset table has a row for each material.
        match count(rows).or_else(|| count("materials").filter(|_| rows == "subsets")) {
            Some(&(_, count)) => {
                let end = self.next_position().line;
                Self::error_at(count, fault(&format!("{section}, which ends at line {end},")))
            }
            None => self.where_rows_end(fault(&section)),
        }
    }

    /// Passes lines up to the next ruler or the end, and says how many of them `counts`.
    pub(super) async fn count_lines(&mut self, counts: impl Fn(&[u8]) -> bool) -> usize {
        let mut counted = 0;
        for line in 0usize.. {
            self.pause_every(line).await;
            self.cursor.skip_space();
            if self.cursor.peek().is_none() || is_ruler(self.cursor.rest()) {
                return counted;
            }
            let line = self.cursor.rest_of_line();
            let first = line.text.split(u8::is_ascii_whitespace).next().unwrap_or_default();
            counted += usize::from(counts(first));
        }
        counted
    }

    /// Passes the rest of this line as unknown.
    pub(super) fn pass_unknown_line(&mut self, label: Token<'_>) {
        self.note(label, DiagnosticKind::unknown(self.section, label.text));
        self.cursor.skip_space();
        self.cursor.rest_of_line();
    }

    /// Place of the next token, or the end of the file.
    pub(super) fn next_position(&self) -> Position {
        self.cursor
            .peek_token()
            .map_or_else(|| self.cursor.end_position(), |token| token.position)
    }
}

/// True for what is meant as a number, well or badly written.
pub(super) fn looks_like_number(token: &[u8]) -> bool {
    match token {
        _ if is_ruler(token) => false,
        [b'0'..=b'9', ..] | [b'+' | b'-' | b'.', b'0'..=b'9' | b'.', ..] => true,
        _ => number::read(token).is_some(),
    }
}
