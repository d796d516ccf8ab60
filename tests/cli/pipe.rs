//! A reader that leaves, and a disk that is full.

use std::process::Stdio;

use crate::program::{FIGURE, Run, bindpose, fixture, run_command};

/// Starts the program, closes its output before it has written, and gives its exit code and what it said.
fn with_a_closed_pipe(arguments: &[&str]) -> (Option<i32>, String) {
    let mut child = bindpose()
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary was built for this test");
    drop(child.stdout.take());
    let run = Run::of(child.wait_with_output().expect("ends"));
    (run.code, run.err)
}

#[test]
fn a_reader_that_leaves_ends_the_output_and_not_the_work() {
    let bad = fixture("bad/empty.m3d");
    for (line, code) in [
        // Hundreds of kilobytes: more than any buffer between the two.
        ("pose FIGURE --clip Walk --time 0 --json --positions", 0),
        ("pose FIGURE --clip Walk --time 0 --positions", 0),
        ("info FIGURE --json", 0),
        ("check BAD FIGURE", 1),
        ("--help", 0),
    ] {
        let arguments = line.split(' ').map(|word| match word {
            "FIGURE" => FIGURE,
            "BAD" => &bad,
            word => word,
        });
        let ended = with_a_closed_pipe(&arguments.collect::<Vec<_>>());
        assert_eq!(ended, (Some(code), String::new()), "{line}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    for arguments in [vec!["info", FIGURE, "--json"], vec!["info", FIGURE]] {
        let full = std::fs::File::options()
            .write(true)
            .open("/dev/full")
            .expect("Linux has it");
        let run = run_command(bindpose().args(&arguments).stdout(Stdio::from(full)));
        let told = "error: the result cannot be written: ";
        assert!(run.refused(2).starts_with(told), "{}", run.err);
    }
}
