//! Reads Rust source just far enough to see which paths a file names: tokens, `use` trees, paths.

/// A word or a sign, with its line from 1. `::` is one sign; comments are left out, a string or character is `"`.
struct Token {
    text: String,
    line: usize,
}

/// A path as the source writes it, from `crate`, `super`, `self`, a child module or a name that is imported.
#[derive(Clone)]
pub(super) struct Path {
    pub(super) segments: Vec<String>,
    pub(super) line: usize,
}

/// One name that a `use` brings in.
pub(super) struct Import {
    pub(super) path: Path,
    /// The name in this file; `_` where none is wanted, `*` for a glob.
    pub(super) name: String,
    /// `pub` or `pub(…)`: others may take it from here.
    pub(super) public: bool,
}

/// What one file names.
#[derive(Default)]
pub(super) struct Source {
    pub(super) imports: Vec<Import>,
    /// Paths of at least one segment outside `use`, without those that follow a dot.
    pub(super) paths: Vec<Path>,
}

impl Source {
    pub(super) fn read(text: &str) -> Self {
        let tokens = tokens(text);
        let mut source = Self::default();
        let (mut at, mut public) = (0, false);
        let text_at = |index: usize| tokens.get(index).map_or("", |token| token.text.as_str());
        while at < tokens.len() {
            match text_at(at) {
                "pub" => {
                    public = true;
                    at += 1;
                    if text_at(at) == "(" {
                        at = after_group(&tokens, at);
                    }
                }
                "use" => {
                    at = source.read_tree(&tokens, at + 1, &[], public);
                    public = false;
                }
                _ if is_word(text_at(at)) && (at == 0 || text_at(at - 1) != ".") => {
                    let mut path = Path {
                        segments: vec![text_at(at).to_owned()],
                        line: tokens[at].line,
                    };
                    at += 1;
                    while text_at(at) == "::" && is_word(text_at(at + 1)) {
                        path.segments.push(text_at(at + 1).to_owned());
                        at += 2;
                    }
                    source.paths.push(path);
                    public = false;
                }
                _ => {
                    public = false;
                    at += 1;
                }
            }
        }
        source
    }

    /// Reads one tree of a `use` from `at`; gives the index behind it.
    fn read_tree(&mut self, tokens: &[Token], mut at: usize, prefix: &[String], public: bool) -> usize {
        let mut segments = prefix.to_vec();
        let line = tokens[at].line;
        loop {
            match tokens[at].text.as_str() {
                "{" => {
                    at += 1;
                    while tokens[at].text != "}" {
                        at = self.read_tree(tokens, at, &segments, public);
                        at += usize::from(tokens[at].text == ",");
                    }
                    return at + 1;
                }
                "::" => at += 1,
                word if is_word(word) || word == "*" => {
                    // `{self}` is the module itself.
                    if word != "self" || segments.is_empty() {
                        segments.push(word.to_owned());
                    }
                    at += 1;
                    if tokens[at].text != "::" {
                        break;
                    }
                }
                other => panic!("line {line}: `{other}` in a use"),
            }
        }
        let mut name = segments.last().expect("a use names something").clone();
        if tokens[at].text == "as" {
            name = tokens[at + 1].text.clone();
            at += 2;
        }
        self.imports.push(Import {
            path: Path { segments, line },
            name,
            public,
        });
        at
    }
}

fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Index behind the group that opens at `at`.
fn after_group(tokens: &[Token], mut at: usize) -> usize {
    let mut depth = 0;
    loop {
        match tokens[at].text.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        at += 1;
        if depth == 0 {
            return at;
        }
    }
}

fn tokens(text: &str) -> Vec<Token> {
    let chars: Vec<char> = text.chars().collect();
    let next = |at: usize| chars.get(at).copied().unwrap_or('\0');
    let (mut tokens, mut at, mut line) = (Vec::new(), 0, 1);
    while at < chars.len() {
        let start = at;
        let mut sign = None;
        if next(at) == '/' && next(at + 1) == '/' {
            while at < chars.len() && next(at) != '\n' {
                at += 1;
            }
        } else if next(at) == '/' && next(at + 1) == '*' {
            let mut depth = 0;
            loop {
                match (next(at), next(at + 1)) {
                    ('/', '*') => (depth, at) = (depth + 1, at + 2),
                    ('*', '/') => (depth, at) = (depth - 1, at + 2),
                    _ => at += 1,
                }
                if depth == 0 || at >= chars.len() {
                    break;
                }
            }
        } else if let Some(end) = string_end(&chars, at) {
            (at, sign) = (end, Some("\"".to_owned()));
        } else if next(at) == '\'' {
            // A character, unless it is a lifetime: `'a` is not followed by a second quote.
            at += match (next(at + 1), next(at + 2)) {
                ('\\', _) => 3 + (at + 3..).take_while(|index| next(*index) != '\'').count(),
                (_, '\'') => 2,
                _ => 0,
            } + 1;
        } else if next(at).is_alphabetic() || next(at) == '_' {
            while next(at).is_alphanumeric() || next(at) == '_' {
                at += 1;
            }
            sign = Some(chars[start..at].iter().collect());
        } else if next(at) == ':' && next(at + 1) == ':' {
            at += 2;
            sign = Some("::".to_owned());
        } else {
            at += 1;
            if next(start).is_numeric() {
                // Suffixes and exponents are no words.
                while next(at).is_alphanumeric() || next(at) == '_' {
                    at += 1;
                }
            } else if !next(start).is_whitespace() {
                sign = Some(next(start).to_string());
            }
        }
        tokens.extend(sign.map(|text| Token { text, line }));
        line += chars[start..at].iter().filter(|c| **c == '\n').count();
    }
    tokens
}

/// Behind the string that begins at `at`, with `b`, `c`, `r` and `#` before its quote; `None` where none begins.
fn string_end(chars: &[char], mut at: usize) -> Option<usize> {
    let next = |at: usize| chars.get(at).copied().unwrap_or('\0');
    at += usize::from(matches!(next(at), 'b' | 'c'));
    let raw = next(at) == 'r';
    at += usize::from(raw);
    let hashes = if raw {
        (at..).take_while(|index| next(*index) == '#').count()
    } else {
        0
    };
    at += hashes;
    if next(at) != '"' {
        return None;
    }
    at += 1;
    while at < chars.len() {
        match next(at) {
            '\\' if !raw => at += 2,
            '"' if (1..=hashes).all(|step| next(at + step) == '#') => return Some(at + 1 + hashes),
            _ => at += 1,
        }
    }
    Some(at)
}
