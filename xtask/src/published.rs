//! What the library's package holds when cargo makes it for a registry: all that the library is built of, and little else.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::compress::{Coding, Effort};
use crate::process::Line;

/// The most bytes that it may have compressed: it was 1 470 000.
const MOST: usize = 2_000_000;

/// Folders that are in it whole; files beside them.
const FOLDERS: [&str; 5] = ["src", "shaders", "assets/fonts", "benches", "web/sample"];
const FILES: [&str; 4] = ["Cargo.toml", "LICENSE-APACHE", "LICENSE-MIT", "README.md"];

/// Cargo makes these itself.
const MADE: [&str; 3] = [".cargo_vcs_info.json", "Cargo.lock", "Cargo.toml.orig"];

#[test]
fn the_package_is_whole_and_small() {
    let root = crate::root();
    let list = Line::cargo()
        .args(["package", "--quiet", "--list", "--allow-dirty"])
        .args(["--package", "bindpose"])
        .read()
        .expect("cargo lists it");
    let list = list.replace('\\', "/");
    let listed: BTreeSet<&str> = list.lines().filter(|path| !MADE.contains(path)).collect();
    let mut wanted = FILES.map(str::to_owned).to_vec();
    FOLDERS.iter().for_each(|folder| add(&root, folder, &mut wanted));
    let wanted: BTreeSet<&str> = wanted.iter().map(String::as_str).collect();
    let odd: Vec<&&str> = listed.symmetric_difference(&wanted).collect();
    assert!(
        odd.is_empty(),
        "these are in one of the package and what it should hold: {odd:?}"
    );

    let read = |path: &&str| fs::read(root.join(path)).expect("a listed file");
    let bytes: Vec<u8> = listed.iter().chain(&["Cargo.lock"]).flat_map(read).collect();
    let size = Coding::Gzip.encode(&bytes, Effort::Best).len();
    assert!(size <= MOST, "{size} bytes: `include` in Cargo.toml says what is in it");
}

/// What the library takes in when it is compiled must be in the package, or it could not be built there.
#[test]
fn no_source_takes_in_a_file_that_is_not_packed() {
    let root = crate::root();
    let mut sources = Vec::new();
    add(&root, "src", &mut sources);
    for source in sources {
        let text = fs::read_to_string(root.join(&source)).expect("a source");
        let calls = ["include_str!(", "include_bytes!("].map(|call| text.split(call).skip(1));
        for call in calls.into_iter().flatten() {
            let path = call.split('"').nth(1).expect("a path");
            let outside = Path::new(path.trim_start_matches("../"));
            let is_packed = FOLDERS.iter().any(|folder| outside.starts_with(folder));
            assert!(is_packed, "{source} takes in {path}");
        }
    }
}

/// The files below a folder, as paths in the repository.
fn add(root: &Path, folder: &str, files: &mut Vec<String>) {
    for entry in fs::read_dir(root.join(folder)).expect("a folder") {
        let entry = entry.expect("an entry");
        let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            add(root, &path, files);
        } else {
            files.push(path);
        }
    }
}
