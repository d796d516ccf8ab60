//! Folders with pictures that cannot be read.

use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt, symlink};

use serde_json::{Value, json};

use crate::program::{Run, fixture, run, scratch};

/// `check` of a model that names `skin_diff.dds` and `skin_norm.dds`.
fn check(folder: &str) -> Run {
    run([
        "check",
        "--json",
        "--textures",
        folder,
        &fixture("good/d3d12_skinned.m3d"),
    ])
}

fn codes(run: Run) -> Vec<Value> {
    let found = run.json();
    let findings = found[0]["findings"].as_array().expect("a list");
    findings.iter().map(|finding| finding["code"].clone()).collect()
}

#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn skipped(why: &str) {
    eprintln!("skipped: {why}");
}

#[test]
fn a_map_that_the_system_does_not_let_us_read_is_a_finding() {
    // A file that can be opened, by anybody, and not be read.
    let unreadable = "/proc/self/mem";
    if !fs::metadata(unreadable).is_ok_and(|file| file.is_file()) {
        return skipped("there is no /proc/self/mem");
    }
    let folder = scratch("unreadable");
    fs::create_dir_all(&folder).expect("can be made");
    symlink(unreadable, folder.join("skin_diff.dds")).expect("links");
    let found = codes(check(folder.to_str().expect("UTF-8")));
    assert_eq!(found, [json!("file-unreadable"), json!("map-missing")]);
}

#[test]
fn what_is_no_file_and_what_leads_nowhere_is_told() {
    let folder = scratch("odd");
    fs::create_dir_all(&folder).expect("can be made");
    let made = std::process::Command::new("mkfifo")
        .arg(folder.join("skin_diff.dds"))
        .status();
    assert!(made.expect("coreutils are there").success());
    symlink("nowhere", folder.join("skin_norm.dds")).expect("links");
    let run = check(folder.to_str().expect("UTF-8"));
    assert!(
        run.err.contains("warning[link-broken]: ") && run.err.lines().count() == 1,
        "{run:?}"
    );
    assert_eq!(
        codes(run),
        [json!("map-missing"), json!("map-missing"), json!("not-a-file")]
    );
}

#[test]
fn a_folder_inside_that_cannot_be_listed_is_skipped() {
    let folder = scratch("closed");
    let inner = folder.join("inner");
    fs::create_dir_all(&inner).expect("can be made");
    fs::set_permissions(&inner, Permissions::from_mode(0o000)).expect("is ours");
    let is_listed = fs::read_dir(&inner).is_ok();
    let run = check(folder.to_str().expect("UTF-8"));
    fs::set_permissions(&inner, Permissions::from_mode(0o700)).expect("is ours");
    if is_listed {
        return skipped("this user may list every folder");
    }
    assert!(
        run.err
            .contains("warning[folder-unreadable]: The folder cannot be read: "),
        "{run:?}"
    );
}
