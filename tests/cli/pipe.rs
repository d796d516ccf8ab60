//! A reader that leaves, and a disk that is full.

use std::process::Stdio;

use crate::program::{FIGURE, bindpose, fixture, run_command};

/// Starts the program, closes its output before it has written, and gives its exit code and what it said.
fn with_a_closed_pipe(arguments: &[&str]) -> (Option<i32>, String) {
    let mut child = bindpose()
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary was built for this test");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("ends");
    (
        output.status.code(),
        String::from_utf8_lossy(&output.stderr).into_owned(),
    )
}

#[test]
fn a_reader_that_leaves_ends_the_output_and_not_the_work() {
    let bad = fixture("bad/empty.m3d");
    for (arguments, code) in [
        // Hundreds of kilobytes: more than any buffer between the two.
        (
            vec![
                "pose",
                FIGURE,
                "--clip",
                "Take1",
                "--time",
                "0",
                "--json",
                "--positions",
            ],
            0,
        ),
        (vec!["pose", FIGURE, "--clip", "Take1", "--time", "0", "--positions"], 0),
        (vec!["info", FIGURE, "--json"], 0),
        (vec!["check", &bad, FIGURE], 1),
        (vec!["--help"], 0),
    ] {
        assert_eq!(
            with_a_closed_pipe(&arguments),
            (Some(code), String::new()),
            "{arguments:?}"
        );
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
        assert_eq!(run.code, Some(2));
        assert!(
            run.err.starts_with("error: the result cannot be written: "),
            "{}",
            run.err
        );
    }
}
