//! Looking for maps in folders.

use std::path::Path;

use bindpose::cli::for_tests::walk_warnings;
use bindpose::diagnostic::codes;

/// No test makes as many files as a real walk takes.
#[test]
fn a_walk_ends_at_its_limit_and_says_so() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let warnings = walk_warnings(&folder, 3);
    let [(path, warning)] = warnings.as_slice() else {
        panic!("{warnings:?}")
    };
    assert_eq!((path, warning.code), (&folder, codes::FOLDER_TOO_LARGE.name));
    assert!(warning.message.starts_with("More than 3 files and folders were met;"));
}
