//! Where a JSON pointer's value stands in the text, and which value stands at a place.

use crate::diagnostic::Position;

/// Where that begins of which [`position_of`] has line and column. The pointer is one of RFC 6901.
pub(super) fn offset_of(json: &[u8], pointer: &str) -> Option<usize> {
    let mut scanner = Scanner { json, at: 0 };
    scanner.skip_blanks();
    let mut found = scanner.at;
    for part in pointer.split('/').skip(1) {
        let key = part.replace("~1", "/").replace("~0", "~");
        if scanner.enter(Target::Key(&key))?.is_none() {
            break;
        }
        found = scanner.at;
    }
    Some(found)
}

/// Line and column of the value that a pointer names, or of the last thing on the way that is there. `None` for text that is no JSON that far.
pub fn position_of(json: &[u8], pointer: &str) -> Option<Position> {
    let found = offset_of(json, pointer)?;
    let before = json.get(..found)?;
    let line_start = memchr::memrchr(b'\n', before).map_or(0, |end| end + 1);
    let line = memchr::memchr_iter(b'\n', before).count() + 1;
    Some(Position {
        line: u32::try_from(line).ok()?,
        column: u32::try_from(found - line_start + 1).ok()?,
    })
}

/// The pointer of the value that serde_json was at when it had read `offset` bytes: the innermost that ends there or goes on, or the list or
/// object that begins there. Of other values it reads at least a byte before it complains.
pub(super) fn pointer_at(json: &[u8], offset: usize) -> String {
    let mut scanner = Scanner { json, at: 0 };
    scanner.skip_blanks();
    let mut pointer = String::new();
    while let Some(Some(key)) = scanner.enter(Target::Offset(offset)) {
        pointer.push('/');
        pointer.push_str(&escaped(&key));
    }
    pointer
}

/// A key as a JSON pointer has it.
pub(super) fn escaped(key: &str) -> String {
    key.replace('~', "~0").replace('/', "~1")
}

/// Which value of an object or a list is looked for.
#[derive(Clone, Copy)]
enum Target<'a> {
    /// The one of a key, or with a number in a list.
    Key(&'a str),
    /// The one at an offset; see [`pointer_at`].
    Offset(usize),
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

    /// Goes from the start of an object or a list to the start of one of its values, and gives its key; stays where it is and gives no key
    /// when that value is not there. `None` for text that is no JSON that far.
    fn enter(&mut self, target: Target<'_>) -> Option<Option<String>> {
        let is_object = match self.peek()? {
            b'{' => true,
            b'[' => false,
            _ => return Some(None),
        };
        let start = self.at;
        self.at += 1;
        for index in 0_usize.. {
            self.skip_blanks();
            if matches!(self.peek()?, b'}' | b']') {
                break;
            }
            let key = if is_object {
                let name = serde_json::from_slice::<String>(self.string()?).ok();
                self.skip_blanks();
                self.at += 1;
                self.skip_blanks();
                name
            } else {
                None
            };
            let value = self.at;
            let skipped = self.skip_value();
            let is_found = match (target, &key) {
                (Target::Key(wanted), Some(key)) => wanted == key,
                (Target::Key(wanted), None) => !is_object && wanted.parse() == Ok(index),
                (Target::Offset(offset), _) => {
                    let is_list_or_object = matches!(self.json.get(value), Some(b'[' | b'{'));
                    let begins_in_time = value < offset || (value == offset && is_list_or_object);
                    // A value that is cut off goes on to the end of the text.
                    begins_in_time && skipped.is_none_or(|()| offset <= self.at)
                }
            };
            if is_found {
                self.at = value;
                return Some(Some(key.unwrap_or_else(|| index.to_string())));
            }
            skipped?;
            self.skip_blanks();
            if self.peek()? == b',' {
                self.at += 1;
            }
        }
        self.at = start;
        Some(None)
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
