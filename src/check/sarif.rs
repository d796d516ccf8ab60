//! Findings in the form that code hosts and editors read: SARIF 2.1.0, <https://docs.oasis-open.org/sarif/sarif/v2.1.0/>.

use std::collections::HashMap;

use serde::Serialize;

use super::book::Verdict;
use super::report::CheckedFile;
use crate::diagnostic::{Diagnostic, Position, Severity, Subject, codes};
use crate::format::LineIndex;

/// The results of one file. They need nothing of its bytes any more.
#[derive(Clone, Debug)]
pub struct Results {
    all: Vec<Result>,
}

impl Results {
    /// Brings findings into SARIF's form, those of books among them: columns count UTF-16 code units.
    pub fn of(file: &CheckedFile<'_>) -> Self {
        let lines = LineIndex::new(file.bytes);
        let uri = uri(file.path);
        let of_books: Vec<_> = file.verdicts.iter().flat_map(Verdict::diagnostics).collect();
        let all = file.diagnostics.iter().chain(&of_books);
        let result = |diagnostic: &Diagnostic| Result {
            rule_id: diagnostic.code,
            rule_index: 0,
            level: level(diagnostic.severity),
            message: Text {
                text: diagnostic.message.clone(),
            },
            locations: vec![Location {
                physical_location: PhysicalLocation {
                    artifact_location: ArtifactLocation { uri: uri.clone() },
                    region: diagnostic.position.map(|at| region(&lines, at, diagnostic.length)),
                },
                logical_locations: diagnostic.subject.map(logical_location).into_iter().collect(),
            }],
            related_locations: diagnostic
                .places
                .iter()
                .skip(1)
                .map(|&at| Location {
                    physical_location: PhysicalLocation {
                        artifact_location: ArtifactLocation { uri: uri.clone() },
                        region: Some(region(&lines, at, 0)),
                    },
                    logical_locations: Vec::new(),
                })
                .collect(),
            occurrence_count: diagnostic.count,
        };
        Self {
            all: all.map(result).collect(),
        }
    }
}

/// The document of some files. Its rules are the codes that occur.
pub fn log(files: impl IntoIterator<Item = Results>) -> Log {
    let mut rules = Vec::new();
    let mut places = HashMap::new();
    let mut results: Vec<Result> = files.into_iter().flat_map(|file| file.all).collect();
    for result in &mut results {
        result.rule_index = *places.entry(result.rule_id).or_insert_with(|| {
            rules.push(rule(result.rule_id));
            rules.len() - 1
        });
    }
    Log {
        schema: "https://json.schemastore.org/sarif-2.1.0.json",
        version: "2.1.0",
        runs: [Run {
            tool: Tool {
                driver: Driver {
                    name: "bindpose",
                    semantic_version: env!("CARGO_PKG_VERSION"),
                    rules,
                },
            },
            column_kind: "utf16CodeUnits",
            results,
        }],
    }
}

/// What serde writes as a SARIF document.
#[derive(Debug, Serialize)]
pub struct Log {
    #[serde(rename = "$schema")]
    schema: &'static str,
    version: &'static str,
    runs: [Run; 1],
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Run {
    tool: Tool,
    column_kind: &'static str,
    results: Vec<Result>,
}

#[derive(Debug, Serialize)]
struct Tool {
    driver: Driver,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Driver {
    name: &'static str,
    semantic_version: &'static str,
    rules: Vec<Rule>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Rule {
    id: &'static str,
    short_description: Text,
    help: Text,
    default_configuration: Configuration,
}

#[derive(Debug, Serialize)]
struct Configuration {
    level: &'static str,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Result {
    rule_id: &'static str,
    rule_index: usize,
    level: &'static str,
    message: Text,
    locations: Vec<Location>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    related_locations: Vec<Location>,
    occurrence_count: u32,
}

#[derive(Clone, Debug, Serialize)]
struct Text {
    text: String,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Location {
    physical_location: PhysicalLocation,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    logical_locations: Vec<LogicalLocation>,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct PhysicalLocation {
    artifact_location: ArtifactLocation,
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<Region>,
}

#[derive(Clone, Debug, Serialize)]
struct ArtifactLocation {
    uri: String,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Region {
    start_line: u32,
    start_column: u32,
    end_column: u32,
}

#[derive(Clone, Debug, Serialize)]
struct LogicalLocation {
    name: String,
    kind: &'static str,
}

fn rule(code: &'static str) -> Rule {
    let row = codes::named(code);
    let text = |text: Option<String>| Text {
        text: text.unwrap_or_else(|| code.to_owned()),
    };
    Rule {
        id: code,
        short_description: text(row.map(|row| row.sentence.to_owned())),
        help: text(row.map(|row| {
            let parts = [Some(row.help()), row.permanent().map(str::to_owned)];
            parts.into_iter().flatten().collect::<Vec<_>>().join(" ")
        })),
        default_configuration: Configuration {
            level: level(row.map_or(Severity::Note, |row| row.severity)),
        },
    }
}

fn level(severity: Severity) -> &'static str {
    // SARIF's three levels have the same words.
    severity.as_str()
}

fn logical_location(subject: Subject) -> LogicalLocation {
    let (kind, index) = subject.kind_and_index();
    LogicalLocation {
        name: format!("{kind} {index}"),
        kind,
    }
}

/// A place and what is marked from it on, within its line.
fn region(lines: &LineIndex<'_>, at: Position, length: u32) -> Region {
    let line = lines.line(at.line);
    let start = (at.column.saturating_sub(1) as usize).min(line.len());
    let end = start.saturating_add(length as usize).min(line.len());
    let start_column = utf16_units(&line[..start]) + 1;
    Region {
        start_line: at.line,
        start_column,
        end_column: start_column + utf16_units(&line[start..end]),
    }
}

/// How many UTF-16 code units text has; bytes that are no UTF-8 count as the character that stands for them.
fn utf16_units(text: &[u8]) -> u32 {
    let units = String::from_utf8_lossy(text).encode_utf16().count();
    u32::try_from(units).unwrap_or(u32::MAX - 1)
}

/// A path as a reference to a file: absolute ones with their scheme, and what has a meaning in references, or no ASCII, escaped.
fn uri(path: &str) -> String {
    let path = path.replace('\\', "/");
    let drive = path.as_bytes().get(1) == Some(&b':');
    let prefix = match path.strip_prefix('/') {
        Some(_) => "file://",
        None if drive => "file:///",
        None => "",
    };
    let escaped: String = path
        .bytes()
        .map(|byte| match byte {
            b'/' | b'-' | b'.' | b'_' | b'~' => char::from(byte).to_string(),
            b':' if drive => ":".to_owned(),
            _ if byte.is_ascii_alphanumeric() => char::from(byte).to_string(),
            _ => format!("%{byte:02X}"),
        })
        .collect();
    format!("{prefix}{escaped}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_utf16_code_units() {
        let bytes = "a\n😀é\u{FF} x\n".as_bytes();
        let lines = LineIndex::new(bytes);
        // Four bytes and two units, two bytes and one unit, two and one, a blank.
        let at = Position { line: 2, column: 10 };
        let Region {
            start_line,
            start_column,
            end_column,
        } = region(&lines, at, 1);
        assert_eq!((start_line, start_column, end_column), (2, 6, 7));
        let beyond = region(&lines, Position { line: 9, column: 9 }, 5);
        assert_eq!((beyond.start_column, beyond.end_column), (1, 1));
    }

    #[test]
    fn paths_become_references() {
        for (path, expected) in [
            ("a b/ä.m3d", "a%20b/%C3%A4.m3d"),
            ("/tmp/x.m3d", "file:///tmp/x.m3d"),
            ("C:\\models\\x#1.m3d", "file:///C:/models/x%231.m3d"),
        ] {
            assert_eq!(uri(path), expected);
        }
    }
}
