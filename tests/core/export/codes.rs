//! The table of codes that changes and losses have holds those of the sources and no others.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use bindpose::diagnostic::{codes, of_export};

/// The sources that make changes and losses.
fn sources() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders = ["edit", "export", "session/write"].map(|name| root.join(name)).to_vec();
    let mut files: Vec<PathBuf> = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("can be listed").path();
            if path.is_dir() { &mut folders } else { &mut files }.push(path);
        }
    }
    let read = |path: PathBuf| fs::read_to_string(path).expect("a source");
    files.into_iter().map(read).collect()
}

/// Literals behind the words that make a change or a loss, and all with a hyphen inside.
fn written(sources: &str) -> BTreeSet<&str> {
    let makers = ["losses.add(", "losses.count(", "Change::new(", "code: ", "change("];
    let is_code = |text: &str| {
        text.starts_with(|letter: char| letter.is_ascii_lowercase())
            && !text.ends_with('-')
            && text.chars().all(|letter| letter.is_ascii_lowercase() || letter == '-')
    };
    let mut parts = sources.split('"');
    let mut before = parts.next().unwrap_or_default();
    let mut found = BTreeSet::new();
    while let (Some(text), Some(after)) = (parts.next(), parts.next()) {
        let is_made = makers.iter().any(|maker| before.trim_end().ends_with(maker.trim_end()));
        if is_code(text) && (is_made || text.contains('-')) {
            found.insert(text);
        }
        before = after;
    }
    found
}

#[test]
fn every_code_of_a_change_or_loss_is_in_one_table() {
    let sources = sources();
    let written = written(&sources);
    let unknown: Vec<_> = written
        .iter()
        .filter(|code| of_export::named(code).is_none() && codes::named(code).is_none())
        .collect();
    assert!(unknown.is_empty(), "add rows for {unknown:?}");
    for row in of_export::ALL {
        assert!(written.contains(row.name), "nothing gives {}", row.name);
        assert!(codes::named(row.name).is_none(), "{} is in both tables", row.name);
        for text in [row.sentence, row.advice] {
            assert!(text.ends_with('.'), "{}: {text}", row.name);
        }
    }
    let names: BTreeSet<_> = of_export::ALL.iter().map(|row| row.name).collect();
    assert_eq!(names.len(), of_export::ALL.len(), "no name twice");
}
