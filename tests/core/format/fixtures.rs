//! Every fixture says exactly what the text beside it says. `BLESS=1 cargo test` writes those texts anew.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use bindpose::diagnostic::codes;
use bindpose::format::{Parsed, parse};

use super::{Fixture, fixtures, one_line};
use crate::documents::is_sentence;

#[test]
fn bad_files_are_refused_in_these_words() {
    compare_all("bad", |fixture| match parse(&fixture.bytes) {
        Ok(_) => panic!("{} was read", fixture.path.display()),
        Err(error) => one_line(&error) + "\n",
    });
}

#[test]
fn good_files_are_read_with_these_notices() {
    compare_all("good", |fixture| match parse(&fixture.bytes) {
        Ok(parsed) => summary(&parsed),
        Err(error) => panic!("{}: {error}", fixture.path.display()),
    });
}

/// Every code of the table is given by some fixture, with the severity of the table, and no other code is.
#[test]
fn the_table_of_codes_is_that_of_the_fixtures() {
    let mut emitted = BTreeSet::new();
    for fixture in fixtures("bad").iter().chain(&fixtures("good")) {
        match parse(&fixture.bytes) {
            Ok(parsed) => emitted.extend(parsed.diagnostics.iter().map(|notice| (notice.code, notice.severity))),
            Err(error) => {
                emitted.insert((error.code, error.severity));
            }
        }
    }
    let table: BTreeSet<_> = codes::OF_PARSER.iter().map(|code| (code.name, code.severity)).collect();
    assert_eq!(emitted, table);
}

#[test]
fn every_message_is_a_sentence() {
    for fixture in fixtures("bad").iter().chain(&fixtures("good")) {
        let findings = match parse(&fixture.bytes) {
            Ok(parsed) => parsed.diagnostics,
            Err(error) => vec![*error],
        };
        for finding in findings {
            assert!(is_sentence(&finding.message), "{}: {}", finding.code, finding.message);
        }
    }
}

/// One line for what was read, then one for each notice.
fn summary(parsed: &Parsed) -> String {
    let document = &parsed.document;
    let keys: usize = document
        .clips
        .iter()
        .flat_map(|clip| &clip.bones)
        .map(|bone| bone.keyframes.len())
        .sum();
    let mut text = format!(
        "{:?}: materials {}, subsets {}, vertices {}, triangles {}, bones {}, clips {}, keys {keys}\n",
        document.dialect,
        document.materials.len(),
        document.subsets.len(),
        document.vertices.len(),
        document.triangles.len(),
        document.bone_offsets.len(),
        document.clips.len(),
    );
    for notice in &parsed.diagnostics {
        writeln!(text, "{}", one_line(notice)).expect("a string can be written to");
    }
    text
}

fn compare_all(folder: &str, tell: impl Fn(&Fixture) -> String) {
    let bless = std::env::var_os("BLESS").is_some();
    let mut differences = String::new();
    for fixture in fixtures(folder) {
        let told = tell(&fixture);
        let beside = fixture.path.with_extension("txt");
        if bless {
            std::fs::write(&beside, told).expect("the text can be written");
            continue;
        }
        let expected = std::fs::read_to_string(&beside).unwrap_or_default();
        if told != expected {
            write!(differences, "{}:\n  is     {told}  should {expected}", fixture.name)
                .expect("a string can be written to");
        }
    }
    assert!(differences.is_empty(), "{differences}");
}
