//! Where the reader stands in the bytes: tokens, lines and positions.
//!
//! Lines are counted where a line end is passed and columns are worked out only when somebody asks, so that the common
//! case pays for neither.

use crate::diagnostic::Position;

/// A place in the bytes. Copying it is how a reader looks ahead.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cursor<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) at: usize,
    pub(crate) line: u32,
    pub(crate) line_start: usize,
}

/// A run of bytes without blanks or braces (or one brace), and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub(super) text: &'a [u8],
    pub(super) position: Position,
}

impl Token<'_> {
    /// Bytes of the token, as errors carry it.
    pub(super) fn length(&self) -> u32 {
        length_of(self.text)
    }
}

/// Length of `text` as errors and diagnostics carry it.
pub(super) fn length_of(text: &[u8]) -> u32 {
    u32::try_from(text.len()).unwrap_or(u32::MAX)
}

/// True for bytes that part tokens.
pub(super) fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | b'\n' | 0x0B | 0x0C)
}

impl<'a> Cursor<'a> {
    /// At the start of `bytes`, behind a UTF-8 byte order mark. Columns of the first line count from behind the mark.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        Self {
            bytes,
            at,
            line: 1,
            line_start: at,
        }
    }

    /// What has not been read yet.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// The next byte, `None` at the end.
    pub(super) fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Bytes that have not been read yet.
    pub(super) fn bytes_left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    /// Line and column of the next byte.
    pub(crate) fn position(&self) -> Position {
        Position {
            line: self.line,
            column: column(self.at - self.line_start),
        }
    }

    /// Passes blanks and line ends. A carriage return without a line feed ends a line too.
    pub(crate) fn skip_space(&mut self) {
        while let Some(byte) = self.peek() {
            match byte {
                b'\n' => self.end_line(1),
                b'\r' => self.end_carriage_return(),
                _ if is_space(byte) => self.at += 1,
                _ => return,
            }
        }
    }

    /// Passes blanks, but no line end.
    pub(super) fn skip_blanks(&mut self) {
        while let Some(b' ' | b'\t' | 0x0B | 0x0C) = self.peek() {
            self.at += 1;
        }
    }

    /// True at a line end and at the end of the file.
    pub(super) fn at_line_end(&self) -> bool {
        matches!(self.peek(), None | Some(b'\n' | b'\r'))
    }

    /// Reads up to the line end, and passes it. Blanks at both ends are left out.
    pub(super) fn rest_of_line(&mut self) -> Token<'a> {
        self.skip_blanks();
        let position = self.position();
        let rest = self.rest();
        let length = memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        self.at += length;
        match self.peek() {
            Some(b'\n') => self.end_line(1),
            Some(_) => self.end_carriage_return(),
            None => {}
        }
        Token {
            text: rest.get(..length).unwrap_or_default().trim_ascii(),
            position,
        }
    }

    /// The next token, across line ends, without reading it. `None` at the end of the file.
    pub(super) fn peek_token(&self) -> Option<Token<'a>> {
        let mut ahead = *self;
        ahead.token()
    }

    /// Reads the next token, across line ends. `None` at the end of the file.
    pub(super) fn token(&mut self) -> Option<Token<'a>> {
        self.skip_space();
        let position = self.position();
        let rest = self.rest();
        let length = match rest.first()? {
            b'{' | b'}' => 1,
            _ => rest
                .iter()
                .position(|&byte| is_space(byte) || byte == b'{' || byte == b'}')
                .unwrap_or(rest.len()),
        };
        self.at += length;
        Some(Token {
            text: rest.get(..length).unwrap_or_default(),
            position,
        })
    }

    /// Just behind the last byte of the file that is not blank: where a file that ends too early does so.
    pub(super) fn end_position(&self) -> Position {
        let end = self.bytes.trim_ascii_end().len();
        let mut cursor = *self;
        // The cursor stands behind that place only by blanks; count again from the start when it does.
        if cursor.at > end {
            cursor = Cursor::new(self.bytes);
        }
        while cursor.at < end {
            match cursor.peek() {
                Some(b'\n') => cursor.end_line(1),
                Some(b'\r') => cursor.end_carriage_return(),
                _ => cursor.at += 1,
            }
        }
        cursor.position()
    }

    fn end_line(&mut self, bytes: usize) {
        self.at += bytes;
        self.line = self.line.saturating_add(1);
        self.line_start = self.at;
    }

    fn end_carriage_return(&mut self) {
        let line_feed = self.bytes.get(self.at + 1) == Some(&b'\n');
        self.end_line(if line_feed { 2 } else { 1 });
    }
}

fn column(bytes_before: usize) -> u32 {
    u32::try_from(bytes_before).map_or(u32::MAX, |before| before.saturating_add(1))
}
