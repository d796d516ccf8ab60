//! Findings as text and for code hosts.

use bindpose::check::report::{CheckedFile, OneLine};
use bindpose::check::sarif::{Results, log};
use bindpose::diagnostic::{Diagnostic, Position};
use bindpose::format::LineMap;
use serde_json::{Value, json};

use crate::documents::{checked, quad};

#[test]
fn a_line_stays_one_line() {
    let name = "a\nb\r\u{85}\u{1b}[31m\u{202e}ä";
    assert_eq!(OneLine(name).to_string(), "a\\nb\\r\\u{85}\\u{1b}[31m\\u{202e}ä");
}

/// The place of a finding in a file of this path and these bytes, as SARIF has it.
fn physical_place(path: &str, bytes: &[u8], position: Position, length: u32) -> Value {
    let mut document = quad();
    document.vertices[0].normal = [0.0; 3];
    let (_, findings) = checked(&document, &LineMap::default());
    let finding = Diagnostic {
        position: Some(position),
        length,
        ..findings[0].clone()
    };
    let file = CheckedFile {
        path,
        bytes,
        diagnostics: &[finding],
        verdicts: &[],
        converted: None,
    };
    log([Results::of(&file)], &[])["runs"][0]["results"][0]["locations"][0]["physicalLocation"].clone()
}

#[test]
fn columns_count_utf16_code_units() {
    let bytes = "a\n😀é\u{FF} x\n".as_bytes();
    let region =
        |line, column, length| physical_place("a.m3d", bytes, Position { line, column }, length)["region"].clone();
    // Four bytes and two units, two bytes and one unit, two and one, a blank.
    let expected = json!({ "startLine": 2, "startColumn": 6, "endColumn": 7 });
    assert_eq!(region(2, 10, 1), expected);
    let beyond = region(9, 9, 5);
    assert_eq!((&beyond["startColumn"], &beyond["endColumn"]), (&json!(1), &json!(1)));
}

#[test]
fn paths_become_references() {
    for (path, expected) in [
        ("a b/ä.m3d", "a%20b/%C3%A4.m3d"),
        ("/tmp/x.m3d", "file:///tmp/x.m3d"),
        ("C:\\models\\x#1.m3d", "file:///C:/models/x%231.m3d"),
    ] {
        let place = physical_place(path, b"", Position { line: 1, column: 1 }, 0);
        assert_eq!(place["artifactLocation"]["uri"], expected);
    }
}
