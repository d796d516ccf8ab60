//! All that a fuzzer found worth keeping, and the fixtures that it began with, without a fuzzer.

use std::fs;
use std::path::{Path, PathBuf};

use fuzz::{TARGETS, corpus};

#[test]
fn every_target_comes_back_from_what_was_kept_for_it() {
    for target in TARGETS {
        let inputs = corpus::inputs(target.name).unwrap_or_else(|error| panic!("{}: {error}", target.name));
        assert!(!inputs.is_empty(), "{} has inputs", target.name);
        for (name, bytes) in inputs {
            eprintln!("{}: {name}", target.name);
            (target.run)(&bytes);
        }
    }
}

#[test]
fn every_target_comes_back_from_every_fixture() {
    let fixtures = files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/fixtures"));
    assert!(fixtures.len() > 100, "{} fixtures", fixtures.len());
    for path in fixtures {
        let mut bytes = fs::read(&path).expect("a readable file");
        for target in TARGETS {
            eprintln!("{}: {}", target.name, path.display());
            (target.run)(&bytes);
        }
        // Each format, with no edit and with all of them, with pictures beside it and without.
        for how in (0..3).flat_map(|format| [0, 126, 128, 252].map(|edits| edits + format)) {
            eprintln!("the whole way by {how}: {}", path.display());
            bytes.push(how);
            (TARGETS[4].run)(&bytes);
            bytes.pop();
        }
    }
}

/// All files below a folder, in the order of their names.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let (folders, mut found): (Vec<_>, Vec<_>) = paths.partition(|path| path.is_dir());
    found.extend(folders.iter().flat_map(|folder| files(folder)));
    found.sort();
    found
}
