//! Files of text.

use std::borrow::Cow;

use super::array::{Array, Content};
use super::document::{Document, Growing, Record, Value, check_version};
use super::place::Place;
use crate::diagnostic::collect::quoted;
use crate::diagnostic::{Fault, Position};
use crate::slices::Slices;

/// More numbers in a row than these are an array, as those of version 6.1 are that have no `*`.
const MOST_SINGLE: usize = 16;

/// Whether the first line that is no blank is a comment which names FBX, or a record of its header.
pub(super) fn begins(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let line = bytes
        .split(|byte| matches!(byte, b'\n' | b'\r'))
        .next()
        .unwrap_or_default();
    (line.starts_with(b";") && memchr::memmem::find(line, b"FBX").is_some()) || line.starts_with(b"FBXHeaderExtension")
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u32,
    line_start: usize,
    /// Whether it reads an array: none lies in another.
    in_array: bool,
}

pub(super) async fn parse<'a>(bytes: &'a [u8], slices: &Slices) -> Result<Document<'a>, Fault> {
    let mut reader = Reader {
        bytes,
        at: bytes.len() - bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).len(),
        line: 1,
        line_start: 0,
        in_array: false,
    };
    let told = version_of_comment(bytes);
    if let Some(version) = told {
        check_version(version, reader.place())?;
    }
    let mut growing = Growing::default();
    for count in 0.. {
        slices.pause_before(count).await;
        reader.skip_space();
        let place = reader.place();
        match reader.peek() {
            None => break,
            Some(b'}') => {
                reader.at += 1;
                if !growing.close() {
                    return Err(place.damaged("A } ends what did not begin."));
                }
            }
            Some(_) => {
                let record = reader.record(slices).await.map_err(|fault| growing.named(fault))?;
                reader.skip_space();
                if reader.peek() == Some(b'{') {
                    reader.at += 1;
                    growing.open(record)?;
                } else {
                    growing.add(record);
                }
            }
        }
    }
    if let Some(open) = growing.open.last() {
        let message = format!("The file ends in {}, which begins in another line.", quoted(&open.name));
        return Err(reader.place().damaged(message));
    }
    let document = Document {
        version: told.unwrap_or_default(),
        is_binary: false,
        records: growing.done,
    };
    let said = document
        .find("FBXHeaderExtension")
        .and_then(|header| header.find("FBXVersion"))
        .and_then(|version| Some((u32::try_from(version.integer(0)?).ok()?, version.place)));
    let Some((version, place)) = said else {
        check_version(document.version, Place::At(Position { line: 1, column: 1 }))?;
        return Ok(document);
    };
    check_version(version, place)?;
    Ok(Document { version, ..document })
}

/// Of a first line such as `; FBX 7.3.0 project file`.
fn version_of_comment(bytes: &[u8]) -> Option<u32> {
    let line = bytes.split(|byte| matches!(byte, b'\n' | b'\r')).next()?;
    let at = memchr::memmem::find(line, b"FBX ")?;
    let mut parts = std::str::from_utf8(line.get(at + 4..)?).ok()?.split(['.', ' ']);
    let mut part = || parts.next()?.parse::<u32>().ok().filter(|part| *part < 100);
    Some(part()? * 1000 + part()? * 100)
}

impl<'a> Reader<'a> {
    fn place(&self) -> Place {
        let column = u32::try_from(self.at - self.line_start).unwrap_or(u32::MAX - 1);
        Place::At(Position {
            line: self.line,
            column: column + 1,
        })
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Passes blanks, line ends and comments. Gives whether a line ended.
    fn skip_space(&mut self) -> bool {
        let line = self.line;
        while let Some(byte) = self.peek() {
            match byte {
                b';' => self.at += self.bytes[self.at..].iter().take_while(|byte| **byte != b'\n').count(),
                b'\n' => {
                    self.at += 1;
                    self.line += 1;
                    self.line_start = self.at;
                }
                b' ' | b'\t' | b'\r' | 0 => self.at += 1,
                _ => break,
            }
        }
        self.line > line
    }

    /// What stands up to a character that ends a word.
    fn word(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let len = rest.iter().position(ends_word).unwrap_or(rest.len());
        self.at += len;
        &rest[..len]
    }

    /// A name, its colon and its values.
    async fn record(&mut self, slices: &Slices) -> Result<Record<'a>, Fault> {
        let place = self.place();
        let name = String::from_utf8_lossy(self.word());
        let has_blank = self.skip_space();
        if name.is_empty() || has_blank || self.peek() != Some(b':') {
            let found = match self.peek() {
                Some(byte) if name.is_empty() => char::from(byte).escape_default().to_string(),
                _ => name.into_owned(),
            };
            return Err(place.damaged(format!(
                "A record was expected, such as \"Objects:\", and {} stands here.",
                quoted(&found)
            )));
        }
        self.at += 1;
        let mut record = Record {
            values: Vec::new(),
            name,
            records: Vec::new(),
            place,
        };
        let values = self.values(slices).await;
        record.values = values.map_err(|fault| record.named(fault))?;
        Ok(record)
    }

    /// The values behind a colon. They go on in other lines where a comma stands between.
    async fn values(&mut self, slices: &Slices) -> Result<Vec<Value<'a>>, Fault> {
        // Some begin in the next line, where no record begins with such a character.
        let is_next_line = self.skip_space() && !matches!(self.peek(), Some(b'0'..=b'9' | b'-' | b'"' | b'*'));
        // `Content: ,` begins with one.
        let mut has_comma = self.pass_comma();
        let mut begins = !is_next_line;
        let mut values = Vec::new();
        // Numbers in a row, once they are too many for single ones.
        let mut row: Option<Content<'a>> = None;
        while has_comma || begins {
            begins = false;
            let value = match self.peek() {
                None | Some(b'{' | b'}') => break,
                Some(_) => match self.plain_number() {
                    Some(number) => number,
                    // One that has no values.
                    None if self.is_at_record() => break,
                    None if self.peek() == Some(b'*') => Box::pin(self.array(slices)).await?,
                    None => self.value()?,
                },
            };
            if !row.as_mut().is_some_and(|row| row.push(&value)) {
                values.extend(row.take().into_iter().flat_map(Content::into_values));
                values.push(value);
                if values.len() == MOST_SINGLE + 1 {
                    row = Some(numbers_of(&values)).filter(|row| row.len() == values.len());
                    values.truncate(if row.is_some() { 0 } else { values.len() });
                }
            }
            self.skip_space();
            has_comma = self.pass_comma();
            match row.as_mut().filter(|_| has_comma) {
                Some(row) => {
                    slices.pause().await;
                    has_comma = self.plain_numbers(row);
                }
                None => slices.pause_before(values.len()).await,
            }
        }
        Ok(match row {
            Some(row) => vec![Value::Array(Array(row))],
            None => values,
        })
    }

    /// Adds numbers to a row as long as they stand behind commas, a block of them at most. Whether a comma was the last.
    fn plain_numbers(&mut self, row: &mut Content<'a>) -> bool {
        /// Less than a millisecond of work.
        const BLOCK: usize = 4096;
        for _ in 0..BLOCK {
            let Some(number) = self.plain_number() else {
                return true;
            };
            row.push(&number);
            self.skip_space();
            if !self.pass_comma() {
                return false;
            }
        }
        true
    }

    /// Whether a name with its colon stands here.
    fn is_at_record(&self) -> bool {
        let rest = &self.bytes[self.at..];
        let len = rest
            .iter()
            .position(|byte| !byte.is_ascii_alphanumeric() && !matches!(byte, b'_' | b'-'))
            .unwrap_or(rest.len());
        len > 0 && rest.get(len) == Some(&b':')
    }

    fn pass_comma(&mut self) -> bool {
        let has_comma = self.peek() == Some(b',');
        if has_comma {
            self.at += 1;
            self.skip_space();
        }
        has_comma
    }

    /// A number as most are, if one stands here; passes it. All others are words first.
    fn plain_number(&mut self) -> Option<Value<'a>> {
        /// So many digits are always an `i64`.
        const MOST_DIGITS: usize = 18;
        let rest = &self.bytes[self.at..];
        let is_negative = rest.first() == Some(&b'-');
        let start = usize::from(is_negative);
        let mut end = start;
        let mut whole = 0i64;
        while let Some(digit @ b'0'..=b'9') = rest.get(end)
            && end - start < MOST_DIGITS
        {
            whole = whole * 10 + i64::from(digit - b'0');
            end += 1;
        }
        let value = match rest.get(end) {
            _ if end == start => return None,
            Some(b'.' | b'e' | b'E') => {
                let (number, len) = fast_float2::parse_partial(rest).ok()?;
                end = len;
                Value::Number(number)
            }
            _ => Value::Integer(if is_negative { -whole } else { whole }),
        };
        let is_whole = rest.get(end).is_none_or(|next| *next != b':' && ends_word(next));
        self.at += if is_whole { end } else { 0 };
        is_whole.then_some(value)
    }

    fn value(&mut self) -> Result<Value<'a>, Fault> {
        let place = self.place();
        match self.peek() {
            Some(b'"') => self.quoted(),
            _ => {
                let word = self.word();
                if word.is_empty() {
                    let found = self
                        .peek()
                        .map_or_else(String::new, |byte| char::from(byte).escape_default().to_string());
                    return Err(place.damaged(format!("A value was expected, and \"{found}\" stands here.")));
                }
                Ok(match number(word) {
                    Some(number) => number,
                    None if self.in_array => not_finite(word).map_or(Value::Text(Cow::Borrowed(word)), Value::Number),
                    None => Value::Text(Cow::Borrowed(word)),
                })
            }
        }
    }

    fn quoted(&mut self) -> Result<Value<'a>, Fault> {
        let place = self.place();
        let rest = &self.bytes[self.at + 1..];
        let Some(len) = memchr::memchr(b'"', rest) else {
            return Err(place.damaged("A text begins here and does not end."));
        };
        let text = &rest[..len];
        self.line += memchr::memchr_iter(b'\n', text).count() as u32;
        if let Some(last) = memchr::memrchr(b'\n', text) {
            self.line_start = self.at + 1 + last + 1;
        }
        self.at += len + 2;
        if memchr::memchr(b'&', text).is_none() {
            return Ok(Value::Text(Cow::Borrowed(text)));
        }
        let text = String::from_utf8_lossy(text);
        let plain = text.replace("&quot;", "\"").replace("&lf;", "\n").replace("&cr;", "\r");
        Ok(Value::Text(Cow::Owned(plain.into_bytes())))
    }

    /// `*3 { a: 1,2,3 }`.
    async fn array(&mut self, slices: &Slices) -> Result<Value<'a>, Fault> {
        let place = self.place();
        if std::mem::replace(&mut self.in_array, true) {
            return Err(place.damaged("An array lies in an array."));
        }
        self.at += 1;
        let count = self.word();
        self.skip_space();
        let opens = self.peek() == Some(b'{');
        self.at += usize::from(opens);
        self.skip_space();
        let is_named = opens && (self.peek() == Some(b'}') || (self.word() == b"a" && self.peek() == Some(b':')));
        if !is_named {
            return Err(place.damaged("Behind * and the count of an array \"{ a:\" was expected."));
        }
        let values = if self.peek() == Some(b':') {
            self.at += 1;
            self.values(slices).await?
        } else {
            Vec::new()
        };
        self.skip_space();
        if self.peek() != Some(b'}') {
            return Err(self.place().damaged("An array has more than numbers, or does not end."));
        }
        self.at += 1;
        self.in_array = false;
        let array = match <[Value<'a>; 1]>::try_from(values) {
            Ok([Value::Array(array)]) => array,
            Ok(single) => Array(numbers_of(&single)),
            Err(values) => Array(numbers_of(&values)),
        };
        let said = std::str::from_utf8(count)
            .ok()
            .and_then(|count| count.parse::<usize>().ok());
        if said != Some(array.len()) {
            let said = said.map_or_else(|| quoted(&String::from_utf8_lossy(count)), |said| said.to_string());
            return Err(place.damaged(format!(
                "An array says that it has {said} numbers, and has {}.",
                array.len()
            )));
        }
        Ok(Value::Array(array))
    }
}

/// Values as a row of numbers; those that are none are left out, so that their count tells of them.
fn numbers_of(values: &[Value<'_>]) -> Content<'static> {
    let mut row = Content::Integers(Vec::new());
    for value in values {
        row.push(value);
    }
    row
}

/// Whether a word ends before this character.
fn ends_word(byte: &u8) -> bool {
    matches!(
        byte,
        b' ' | b'\t' | b'\r' | b'\n' | b',' | b':' | b'{' | b'}' | b'"' | b';' | b'*'
    )
}

/// A number, whole or not; `None` for a word. Some writers have `1.#INF`.
fn number(word: &[u8]) -> Option<Value<'static>> {
    let is_number = matches!(word[0], b'0'..=b'9' | b'-' | b'+' | b'.');
    if !is_number {
        return None;
    }
    if word.len() <= 20
        && let Some(integer) = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok())
    {
        return Some(Value::Integer(integer));
    }
    if let Ok(number) = fast_float2::parse(word) {
        return Some(Value::Number(number));
    }
    not_finite(word).map(Value::Number)
}

/// What writers have for numbers that are none: `1.#INF`, `-inf`, `nan(ind)`, `snan`, …
fn not_finite(word: &[u8]) -> Option<f64> {
    let word = std::str::from_utf8(word).ok()?.to_ascii_lowercase();
    let plain = word
        .trim_start_matches(['-', '+'])
        .trim_start_matches(['0', '1', '.', '#']);
    let sign = if word.starts_with('-') { -1.0 } else { 1.0 };
    if plain.starts_with("inf") {
        return Some(sign * f64::INFINITY);
    }
    let is_nan = ["nan", "snan", "qnan", "ind"]
        .iter()
        .any(|start| plain.starts_with(start));
    is_nan.then_some(f64::NAN)
}

impl Content<'_> {
    /// Adds a number to those of text: they are whole ones as long as all are. Gives whether the value is one.
    fn push(&mut self, value: &Value<'_>) -> bool {
        match (&mut *self, value) {
            (Self::Integers(integers), Value::Integer(integer)) => integers.push(*integer),
            (Self::Integers(integers), Value::Number(number)) => {
                let numbers = integers.iter().map(|&integer| integer as f64);
                *self = Self::Numbers(numbers.chain([*number]).collect());
            }
            (Self::Numbers(numbers), Value::Integer(integer)) => numbers.push(*integer as f64),
            (Self::Numbers(numbers), Value::Number(number)) => numbers.push(*number),
            _ => return false,
        }
        true
    }

    /// The numbers of text as single ones.
    fn into_values<'v>(self) -> Vec<Value<'v>> {
        match self {
            Self::Packed { .. } => Vec::new(),
            Self::Integers(integers) => integers.into_iter().map(Value::Integer).collect(),
            Self::Numbers(numbers) => numbers.into_iter().map(Value::Number).collect(),
        }
    }
}
