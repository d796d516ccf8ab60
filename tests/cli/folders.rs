//! Folders with pictures that cannot be read.

use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt, symlink};

use serde_json::{Value, json};

use crate::program::{Run, fixture, run, scratch, scratch_folder};

/// `check` of a model that names `skin_diff.dds` and `skin_norm.dds`.
fn check(folder: &str) -> Run {
    let file = fixture("good/d3d12_skinned.m3d");
    run(["check", "--json", "--textures", folder, &file])
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
    let folder = scratch_folder("unreadable");
    symlink(unreadable, folder.join("skin_diff.dds")).expect("links");
    let found = codes(check(folder.to_str().expect("UTF-8")));
    assert_eq!(found, [json!("file-unreadable"), json!("map-missing")]);
}

#[test]
fn what_is_no_file_and_what_leads_nowhere_is_told() {
    let folder = scratch_folder("odd");
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

fn make_fifo(path: &std::path::Path) {
    let made = std::process::Command::new("mkfifo").arg(path).status();
    assert!(made.expect("coreutils are there").success());
}

#[test]
fn pipes_and_devices_with_the_name_of_a_model_are_skipped_with_a_word() {
    let folder = scratch_folder("odd_models");
    make_fifo(&folder.join("a.m3d"));
    symlink("/dev/zero", folder.join("b.m3d")).expect("links");
    fs::create_dir_all(folder.join("c.m3d")).expect("can be made");
    symlink("c.m3d", folder.join("d.m3d")).expect("links");
    fs::copy(fixture("good/d3d12_skinned.m3d"), folder.join("e.m3d")).expect("can be copied");
    symlink("nowhere", folder.join("f.m3d")).expect("links");
    let folder = folder.to_str().expect("UTF-8");
    let told = run(["check", folder]);
    assert_eq!(told.code, Some(2), "the link leads nowhere: {told:?}");
    let lines: Vec<_> = told.err.lines().collect();
    let skipped = |name: &str| format!("{folder}/{name}: warning[not-a-file]: This is no regular file; skipped.");
    assert_eq!(lines[..2], [skipped("a.m3d"), skipped("b.m3d")]);
    assert!(lines[2].starts_with(&format!("error: {folder}/f.m3d cannot be read: ")) && lines.len() == 3);
    assert_eq!(told.out, "1 file: 0 errors, 0 warnings, 0 notes\n");
}

#[test]
fn a_pipe_that_is_named_is_read() {
    let pipe = scratch("named_pipe.m3d");
    make_fifo(&pipe);
    let bytes = fs::read(fixture("good/comment_above_header.m3d")).expect("is there");
    let to = pipe.clone();
    let writer = std::thread::spawn(move || fs::write(to, bytes));
    let told = run(["check", pipe.to_str().expect("UTF-8")]).fine();
    assert!(told.contains("note[comment]"), "{told}");
    writer.join().expect("ends").expect("was read");
}

/// A sparse file takes no room, and would take as much memory as it claims; a device never ends.
#[test]
fn a_file_that_is_too_large_is_refused() {
    let file = scratch("large.m3d");
    let made = fs::File::create(&file).and_then(|file| file.set_len(5_000_000_000));
    made.expect("can be written");
    let (file, out) = (file.to_str().expect("UTF-8"), scratch("large_out.m3d"));
    for arguments in [
        vec!["check", file],
        vec!["info", file],
        vec!["pose", file],
        vec!["convert", file, out.to_str().expect("UTF-8")],
        vec!["info", "/dev/zero"],
    ] {
        let told = run(&arguments);
        let expected = format!("error: {} cannot be read: it is larger than 1 GB\n", arguments[1]);
        assert_eq!((told.code, told.err), (Some(2), expected), "{arguments:?}");
    }
    fs::remove_file(file).expect("was made");
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
