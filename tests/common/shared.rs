//! Real files of others, in `../shared` beside the checkout. Not every machine has them.

use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The path of a file or folder in `../shared`. Where it is not there the test that asks is told so, and so is
/// `cargo xtask test`, which lists at its end what was not looked at: it names a file for that in the environment.
#[expect(clippy::print_stderr, reason = "a check that did not run says so")]
pub(crate) fn shared(path: &str) -> Option<PathBuf> {
    let whole = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared")).join(path);
    if whole.exists() {
        return Some(whole);
    }
    eprintln!("skipped: {} is not there", whole.display());
    if let Some(list) = std::env::var_os("BINDPOSE_ABSENT") {
        let mut list = OpenOptions::new()
            .append(true)
            .create(true)
            .open(list)
            .expect("the list can be written");
        writeln!(list, "{path}").expect("the list can be written");
    }
    None
}
