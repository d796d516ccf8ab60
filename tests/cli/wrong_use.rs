//! Exit code 2 and a word that helps; and the help itself.

use serde_json::Value;

use crate::program::{FIGURE, fixture, run, scratch};

#[test]
fn wrong_use_is_told_apart_from_bad_files() {
    let file = fixture("good/bones_child_first.m3d");
    let still = fixture("good/d3d11_static.m3d");
    for (arguments, told) in [
        (vec![], "Usage: bindpose <COMMAND>"),
        (vec!["animate", &file], "unrecognized subcommand 'animate'"),
        (vec!["info"], "<FILE>"),
        (vec!["check"], "<PATH>..."),
        (vec!["render", &file], "--output <PATH>"),
        (vec!["info", &file, "--yaml"], "unexpected argument '--yaml'"),
        (vec!["pose", &file, "--time", "soon"], "a time is a number of seconds"),
        (vec!["pose", &file, "--time", "inf"], "a time is a number of seconds"),
        (
            vec!["render", &file, "-o", "x.png", "--size", "big"],
            "such as 1280x720",
        ),
        (
            vec!["render", &file, "-o", "x.png", "--size", "0x9"],
            "such as 1280x720",
        ),
        (
            vec!["render", &file, "-o", "x.jpg"],
            "-o x.jpg is no name of a picture: PNG is written, so it ends in .png",
        ),
        (vec!["render", &file, "-o", "-"], "-o - is no name of a picture"),
        (vec!["render", &file, "-o", "x.png", "--crowd", "1001"], "1..=1000"),
        (vec!["render", &file, "-o", "x.png", "--crowd", "0"], "1..=1000"),
        (vec!["render", &file, "-o", "x.png", "--seed", "3"], "--crowd <N>"),
        (vec!["render", &file, "-o", "dir", "--frames", "0"], "1..=100000"),
        (vec!["render", &file, "-o", "dir", "--turntable", "0"], "1..=100000"),
        (
            vec!["render", &file, "-o", "dir", "--frames", "2", "--fps", "3"],
            "'--frames <N>' cannot be used with '--fps <F>'",
        ),
        (
            vec!["render", &file, "-o", "dir", "--frames", "2", "--time", "0"],
            "'--frames <N>' cannot be used with '--time <SECS>'",
        ),
        (
            vec!["render", &file, "-o", "dir", "--fps", "2", "--time", "0"],
            "'--fps <F>' cannot be used with '--time <SECS>'",
        ),
        (
            vec!["render", &file, "-o", "dir", "--fps", "0"],
            "a number of pictures a second above 0",
        ),
        (vec!["render", &file, "-o", "dir", "--fps", "1e9"], "--fps makes "),
        (
            vec!["render", &file, "-o", "x.png", "--frames", "2"],
            "error: several pictures need a folder, and -o x.png names a picture; --sheet puts them on one",
        ),
        (
            vec!["render", &file, "-o", "x.png", "--sheet", "4"],
            "columns and rows of pictures, such as 4x3",
        ),
        (
            vec!["render", &file, "-o", "x.png", "--sheet", "2x2", "--time", "0"],
            "error: --sheet shows the whole clip, and --time one moment of it; together they need --turntable",
        ),
        (
            vec!["render", &file, "-o", "x.png", "--sheet", "2x2", "--frames", "5"],
            "error: 5 pictures have no room on a sheet of 2x2",
        ),
        (
            vec!["render", &file, "-o", "x.png", "--sheet", "2x2", "--turntable", "5"],
            "error: 5 pictures have no room on a sheet of 2x2",
        ),
        (
            vec!["render", &file, "-o", "x.png", "--sheet", "9x9", "--size", "90x90"],
            "error: a sheet of 90 × 90 pixels has no room for 9 × 9 pictures of 8 × 8 pixels",
        ),
        (
            vec![
                "render",
                &file,
                "-o",
                "x.png",
                "--sheet",
                "2x2",
                "--size",
                "99999x99999",
            ],
            "error: a sheet of 99999 × 99999 pixels is too large: at most 268435456 pixels in all",
        ),
        (vec!["render", &file, "-o", "x.png", "--ghosts", "33"], "1..=32"),
        (
            vec!["render", &file, "-o", "x.png", "--ghost-step", "3"],
            "--ghosts <N>",
        ),
        (
            vec!["render", &still, "-o", "dir", "--frames", "2"],
            "error: --frames needs a clip, and ",
        ),
        (
            vec!["render", &still, "-o", "dir", "--fps", "2"],
            "error: --fps needs a clip, and ",
        ),
        (
            vec!["render", &still, "-o", "x.png", "--sheet", "2x2"],
            "error: --sheet without --turntable needs a clip, and ",
        ),
        (
            vec!["render", &still, "-o", "x.png", "--ghosts", "2"],
            "error: --ghosts needs a clip, and ",
        ),
        (
            vec!["render", &file, "-o", "x.png", "--view", "inside"],
            "three-quarter",
        ),
        (vec!["render", &file, "-o", "x.png", "--backend", "glide"], "vulkan, gl"),
        (
            vec!["render", &file, "-o", "x.png", "--clip", "Swim"],
            "it has \"Wave\"",
        ),
    ] {
        let run = run(&arguments);
        assert_eq!((run.code, run.out.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(run.err.contains(told), "{arguments:?}: {}", run.err);
    }
}

#[test]
fn what_cannot_be_read_is_named() {
    let folder = env!("CARGO_MANIFEST_DIR");
    let out = scratch("unread.png");
    let out_argument = out.to_str().expect("UTF-8");
    for file in ["no/such/model.m3d", folder] {
        for arguments in [
            vec!["info", file],
            vec!["check", "no/such/model.m3d"],
            vec!["pose", file, "--time", "0", "--json"],
            vec!["render", file, "-o", out_argument],
        ] {
            let run = run(&arguments);
            assert_eq!((run.code, run.out.as_str()), (Some(2), ""), "{arguments:?}");
            // Of a folder `check` reads the models in it.
            let told = format!("error: {} cannot be read: ", arguments[1]);
            assert!(run.err.starts_with(&told), "{arguments:?}: {}", run.err);
        }
    }
    assert!(!out.exists());
}

#[test]
fn what_cannot_be_written_is_named() {
    let run = run(["render", FIGURE, "-o", "no/such/folder/x.png", "--size", "16x16"]);
    assert_eq!((run.code, run.out.as_str()), (Some(2), ""));
    assert!(
        run.err.contains("error: no/such/folder/x.png cannot be written: "),
        "{}",
        run.err
    );
}

/// Also for a file whose name is that of a picture: it is its content that is refused.
#[test]
fn a_file_with_errors_is_refused_by_every_command() {
    let bad = std::fs::read(fixture("bad/png.m3d")).expect("is there");
    let file = scratch("really.png");
    std::fs::write(&file, bad).expect("can be written");
    let file = file.to_str().expect("UTF-8");
    let out = scratch("refused.png");
    let out_argument = out.to_str().expect("UTF-8");
    for arguments in [
        vec!["info", file],
        vec!["pose", file, "--time", "0"],
        vec!["render", file, "-o", out_argument],
    ] {
        let run = run(&arguments);
        assert_eq!((run.code, run.out.as_str()), (Some(1), ""), "{arguments:?}");
        assert!(
            run.err.starts_with(&format!("{file}:1:1: error[other-format]: ")),
            "{}",
            run.err
        );
    }
    assert!(!out.exists());
}

#[test]
fn help_is_a_result() {
    for arguments in [
        vec!["--help"],
        vec!["help", "check"],
        vec!["pose", "-h"],
        vec!["--version"],
    ] {
        let run = run(&arguments);
        assert_eq!((run.code, run.err.as_str()), (Some(0), ""), "{arguments:?}");
        assert!(run.out.len() > 10);
    }
    let help = run(["--help"]).fine();
    for word in ["info", "check", "pose", "render", "Exit codes"] {
        assert!(help.contains(word), "{word} is not in\n{help}");
    }
}

/// Keys of an object and of all that is in it.
fn keys(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Object(fields) => {
            for (key, value) in fields {
                found.push(key.clone());
                keys(value, found);
            }
        }
        Value::Array(values) => values.iter().for_each(|value| keys(value, found)),
        _ => {}
    }
}

#[test]
fn every_key_is_explained_in_the_help() {
    let noted = fixture("good/subset_typos.m3d");
    let skinned = fixture("good/bones_child_first.m3d");
    let banner = fixture("gltf/banner.glb");
    for (command, arguments) in [
        ("info", vec!["info", "--json", &noted]),
        ("info", vec!["info", "--json", &skinned]),
        ("check", vec!["check", "--json", &noted]),
        ("check", vec!["check", "--json", "--book", "all", &banner]),
        ("pose", vec!["pose", "--json", "--positions", &skinned]),
    ] {
        let mut all = Vec::new();
        keys(&run(&arguments).json(), &mut all);
        assert!(all.len() > 3, "{arguments:?}");
        let help = run([command, "--help"]).fine();
        let words: Vec<&str> = help.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
        for key in all {
            assert!(words.contains(&&*key), "{key} is not in\n{help}");
        }
    }
}

#[test]
fn numbers_out_of_their_range_are_wrong_use() {
    for (key, wrong, told) in [
        (
            "--sheet",
            &["4", "0x3", "4x", "400x400", "70000x70000"],
            "columns and rows of pictures, such as 4x3",
        ),
        (
            "--fps",
            &["0", "-1", "inf", "NaN", "fast"],
            "a number of pictures a second above 0",
        ),
        ("--split", &["-0.1", "1.1", "NaN", "half", ""], "a fraction from 0 to 1"),
    ] {
        for wrong in wrong {
            let refused = run(["render", FIGURE, "-o", "dir", &format!("{key}={wrong}")]);
            assert_eq!(refused.code, Some(2), "{key}={wrong}");
            assert!(refused.err.contains(told), "{key}={wrong}: {}", refused.err);
        }
    }
}
