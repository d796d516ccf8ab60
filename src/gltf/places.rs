//! Where a JSON pointer's value stands in the text.

use crate::diagnostic::Position;

/// Line and column of the value that a pointer (RFC 6901) names, or of the last thing on the way that is there. `None` for text
/// that is no JSON that far.
pub fn position_of(json: &[u8], pointer: &str) -> Option<Position> {
    let mut scanner = Scanner { json, at: 0 };
    scanner.skip_blanks();
    let mut found = scanner.at;
    for part in pointer.split('/').skip(1) {
        let key = part.replace("~1", "/").replace("~0", "~");
        if !scanner.enter(&key)? {
            break;
        }
        found = scanner.at;
    }
    let before = json.get(..found)?;
    let line_start = memchr::memrchr(b'\n', before).map_or(0, |end| end + 1);
    let line = memchr::memchr_iter(b'\n', before).count() + 1;
    Some(Position {
        line: u32::try_from(line).ok()?,
        column: u32::try_from(found - line_start + 1).ok()?,
    })
}

struct Scanner<'a> {
    json: &'a [u8],
    at: usize,
}

impl Scanner<'_> {
    fn peek(&self) -> Option<u8> {
        self.json.get(self.at).copied()
    }

    fn skip_blanks(&mut self) {
        while self.peek().is_some_and(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    /// Goes from the start of an object or a list to the start of one of its values. Whether it is there.
    fn enter(&mut self, key: &str) -> Option<bool> {
        let is_object = match self.peek()? {
            b'{' => true,
            b'[' => false,
            _ => return Some(false),
        };
        let start = self.at;
        self.at += 1;
        for index in 0_usize.. {
            self.skip_blanks();
            if matches!(self.peek()?, b'}' | b']') {
                break;
            }
            let is_wanted = if is_object {
                let name = self.string()?;
                let is_wanted = serde_json::from_slice::<String>(name).is_ok_and(|name| name == key);
                self.skip_blanks();
                self.at += 1;
                self.skip_blanks();
                is_wanted
            } else {
                key.parse() == Ok(index)
            };
            if is_wanted {
                return Some(true);
            }
            self.skip_value()?;
            self.skip_blanks();
            if self.peek()? == b',' {
                self.at += 1;
            }
        }
        self.at = start;
        Some(false)
    }

    /// The text of a string with its quotes.
    fn string(&mut self) -> Option<&[u8]> {
        let start = self.at;
        self.at += 1;
        loop {
            let rest = self.json.get(self.at..)?;
            self.at += memchr::memchr2(b'"', b'\\', rest)?;
            if self.json[self.at] == b'"' {
                self.at += 1;
                return self.json.get(start..self.at);
            }
            self.at += 2;
        }
    }

    fn skip_value(&mut self) -> Option<()> {
        let mut depth = 0_usize;
        loop {
            match self.peek()? {
                b'"' => {
                    self.string()?;
                }
                b'{' | b'[' => {
                    depth += 1;
                    self.at += 1;
                }
                b'}' | b']' => {
                    depth = depth.checked_sub(1)?;
                    self.at += 1;
                }
                b',' | b':' if depth > 0 => self.at += 1,
                byte if byte.is_ascii_whitespace() => {
                    self.at += 1;
                    continue;
                }
                _ => {
                    let is_end = |byte: u8| byte.is_ascii_whitespace() || b",]}".contains(&byte);
                    while self.peek().is_some_and(|byte| !is_end(byte)) {
                        self.at += 1;
                    }
                }
            }
            if depth == 0 {
                return Some(());
            }
        }
    }
}
