//! The table of all codes.

use std::collections::BTreeSet;

use bindpose::diagnostic::{Code, Severity, codes};

use crate::documents::is_sentence;

#[test]
fn every_code_stands_once_in_the_table() {
    let names: BTreeSet<&str> = codes::all().map(|code| code.name).collect();
    assert_eq!(names.len(), codes::all().count());
}

#[test]
fn names_are_kebab_case_and_texts_are_sentences() {
    for Code {
        name,
        sentence,
        explanation,
        handling,
        mending,
        ..
    } in codes::all()
    {
        let is_kebab = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
        assert!(name.bytes().all(is_kebab), "{name}");
        for text in [sentence, explanation, handling, mending] {
            assert!(is_sentence(text), "{name}: {text}");
        }
    }
}

/// The page writes this one itself, when the program cannot.
#[test]
fn the_page_knows_the_code_of_a_viewer_that_stopped() {
    let api = include_str!("../../web/api.js");
    let [code] = codes::OF_PAGE else { panic!("one code") };
    assert!(api.contains(&format!("severity: \"{}\", code: \"{}\"", Severity::Error, code.name)));
}
