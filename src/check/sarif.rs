//! Findings in the form that code hosts and editors read: SARIF 2.1.0, <https://docs.oasis-open.org/sarif/sarif/v2.1.0/>.

use std::collections::HashMap;

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use serde_json::{Value, json};

use super::book::Verdict;
use super::report::CheckedFile;
use crate::diagnostic::{Code, Diagnostic, Position, Severity, Subject, codes};
use crate::format::LineIndex;

/// The results of one file. They need nothing of its bytes any more.
#[derive(Clone, Debug)]
pub struct Results {
    /// Code and result of each.
    all: Vec<(&'static str, Value)>,
}

impl Results {
    /// Brings findings into SARIF's form, those of books among them: columns count UTF-16 code units.
    pub fn of(file: &CheckedFile<'_>) -> Self {
        let lines = LineIndex::new(file.bytes);
        let uri = uri(file.path);
        let converted = file.converted.unwrap_or_default().iter();
        let converted = converted.filter_map(|limit| limit.diagnostic("Converted for the book"));
        let of_books = file.verdicts.iter().flat_map(Verdict::diagnostics);
        let of_books: Vec<_> = of_books.chain(converted).collect();
        let place = |region: Value| json!({ "artifactLocation": { "uri": uri }, "region": region });
        let result = |diagnostic: &Diagnostic| {
            // What is about no line stands at the first one: code hosts show nothing without a place.
            let region_of_it = diagnostic.position.map(|at| region(&lines, at, diagnostic.length));
            let region_of_it = region_of_it.unwrap_or_else(|| json!({ "startLine": 1 }));
            let mut location = json!({ "physicalLocation": place(region_of_it) });
            if let Some((kind, index)) = diagnostic.subject.map(Subject::kind_and_index) {
                location["logicalLocations"] = json!([{ "name": format!("{kind} {index}"), "kind": kind }]);
            }
            let mut result = json!({
                "ruleId": diagnostic.code,
                "level": diagnostic.severity.as_str(),
                "message": { "text": diagnostic.message },
                "locations": [location],
                "occurrenceCount": diagnostic.count,
            });
            let others = diagnostic.places.iter().skip(1);
            let others = others.map(|&at| json!({ "physicalLocation": place(region(&lines, at, 0)) }));
            let others: Vec<Value> = others.collect();
            if !others.is_empty() {
                result["relatedLocations"] = others.into();
            }
            (diagnostic.code, result)
        };
        Self {
            all: file.diagnostics.iter().chain(&of_books).map(result).collect(),
        }
    }
}

/// The document of some files. Its rules are the codes that occur. `unread` are files that could not be read: path and reason of each.
pub fn log(files: impl IntoIterator<Item = Results>, unread: &[(String, String)]) -> Value {
    let mut rules = Vec::new();
    let mut places = HashMap::new();
    let numbered = files.into_iter().flat_map(|file| file.all).map(|(code, mut result)| {
        let index = *places.entry(code).or_insert_with(|| {
            rules.push(rule(code));
            rules.len() - 1
        });
        result["ruleIndex"] = index.into();
        result
    });
    let results: Vec<Value> = numbered.collect();
    let notification = |(path, reason): &(String, String)| {
        json!({
            "level": "error",
            "message": { "text": reason },
            "locations": [{ "physicalLocation": { "artifactLocation": { "uri": uri(path) } } }],
        })
    };
    json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": { "name": "bindpose", "semanticVersion": env!("CARGO_PKG_VERSION"), "rules": rules } },
            "invocations": [{
                "executionSuccessful": unread.is_empty(),
                "toolExecutionNotifications": unread.iter().map(notification).collect::<Vec<_>>(),
            }],
            "columnKind": "utf16CodeUnits",
            "results": results,
        }],
    })
}

fn rule(code: &'static str) -> Value {
    let row = codes::named(code);
    let text = |words: &dyn Fn(&Code) -> String| json!({ "text": row.map_or_else(|| code.to_owned(), words) });
    json!({
        "id": code,
        "shortDescription": text(&|row| row.sentence.to_owned()),
        "fullDescription": text(&|row| format!("{} {}", row.sentence, row.explanation)),
        "help": text(&|row| {
            let parts = [Some(row.help()), row.permanent().map(str::to_owned)];
            parts.into_iter().flatten().collect::<Vec<_>>().join(" ")
        }),
        "defaultConfiguration": { "level": row.map_or(Severity::Note, |row| row.severity).as_str() },
    })
}

/// A place and what is marked from it on, within its line.
fn region(lines: &LineIndex<'_>, at: Position, length: u32) -> Value {
    let line = lines.line(at.line);
    let start = (at.column.saturating_sub(1) as usize).min(line.len());
    let end = start.saturating_add(length as usize).min(line.len());
    let start_column = utf16_units(&line[..start]) + 1;
    json!({
        "startLine": at.line,
        "startColumn": start_column,
        "endColumn": start_column + utf16_units(&line[start..end]),
    })
}

/// How many UTF-16 code units text has; bytes that are no UTF-8 count as the character that stands for them.
fn utf16_units(text: &[u8]) -> u32 {
    let units = String::from_utf8_lossy(text).encode_utf16().count();
    u32::try_from(units).unwrap_or(u32::MAX - 1)
}

/// What is escaped in a reference to a file.
const ESCAPED: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'/')
    .remove(b'-')
    .remove(b'.')
    .remove(b'_')
    .remove(b'~');
const ESCAPED_BEHIND_DRIVE: &AsciiSet = &ESCAPED.remove(b':');

/// A path as a reference to a file: absolute ones with their scheme, and what has a meaning in references, or no ASCII, escaped.
fn uri(path: &str) -> String {
    let path = path.replace('\\', "/");
    let drive = path.as_bytes().get(1) == Some(&b':');
    let prefix = match path.strip_prefix('/') {
        Some(_) => "file://",
        None if drive => "file:///",
        None => "",
    };
    let escaped = if drive { ESCAPED_BEHIND_DRIVE } else { ESCAPED };
    format!("{prefix}{}", utf8_percent_encode(&path, escaped))
}
