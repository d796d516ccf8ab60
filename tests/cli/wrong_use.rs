//! Exit code 2 and a word that helps; and the help itself.

use serde_json::Value;

use crate::program::{FIGURE, fixture, run, scratch, scratch_file, words};

#[test]
fn wrong_use_is_told_apart_from_bad_files() {
    let file = fixture("good/bones_child_first.m3d");
    let still = fixture("good/d3d11_static.m3d");
    #[rustfmt::skip]
    let cases = [
        ("", "Usage: bindpose <COMMAND>"),
        ("animate FILE", "unrecognized subcommand 'animate'"),
        ("info", "<FILE>"),
        ("check", "<PATH>..."),
        ("render FILE", "--output <PATH>"),
        ("info FILE --yaml", "unexpected argument '--yaml'"),
        ("pose FILE --time soon", "a time is a number of seconds"),
        ("pose FILE --time inf", "a time is a number of seconds"),
        ("render FILE -o x.png --size big", "such as 1280x720"),
        ("render FILE -o x.png --size 0x9", "such as 1280x720"),
        ("render FILE -o x.jpg", "-o x.jpg is no name of a picture: PNG is written, so it ends in .png"),
        ("render FILE -o -", "-o - is no name of a picture"),
        ("render FILE -o x.png --samples 0", "1..=4096"),
        ("render FILE -o x.png --samples 4097", "1..=4096"),
        ("render FILE -o x.png --aperture 0.6", "an aperture is a number from 0 to 0.5"),
        ("render FILE -o x.png --aperture wide", "an aperture is a number from 0 to 0.5"),
        ("render FILE -o x.png --crowd 1001", "1..=1000"),
        ("render FILE -o x.png --crowd 0", "1..=1000"),
        ("render FILE -o x.png --seed 3", "--crowd <N>"),
        ("render FILE -o dir --frames 0", "1..=100000"),
        ("render FILE -o dir --turntable 0", "1..=100000"),
        ("render FILE -o dir --frames 2 --fps 3", "'--frames <N>' cannot be used with '--fps <F>'"),
        ("render FILE -o dir --frames 2 --time 0", "'--frames <N>' cannot be used with '--time <SECS>'"),
        ("render FILE -o dir --fps 2 --time 0", "'--fps <F>' cannot be used with '--time <SECS>'"),
        ("render FILE -o dir --fps 0", "a number of pictures a second above 0"),
        ("render FILE -o dir --fps 1e9", "--fps makes "),
        ("render FILE -o x.png --frames 2",
         "error: several pictures need a folder, and -o x.png names a picture; --sheet puts them on one"),
        ("render FILE -o x.png --sheet 4", "columns and rows of pictures, such as 4x3"),
        ("render FILE -o x.png --sheet 2x2 --time 0",
         "error: --sheet shows the whole clip, and --time one moment of it; together they need --turntable"),
        ("render FILE -o x.png --sheet 2x2 --frames 5", "error: 5 pictures have no room on a sheet of 2x2"),
        ("render FILE -o x.png --sheet 2x2 --turntable 5", "error: 5 pictures have no room on a sheet of 2x2"),
        ("render FILE -o x.png --sheet 9x9 --size 90x90",
         "error: a sheet of 90 × 90 pixels has no room for 9 × 9 pictures of 8 × 8 pixels"),
        ("render FILE -o x.png --sheet 2x2 --size 99999x99999",
         "error: a sheet of 99999 × 99999 pixels is too large: at most 268435456 pixels in all"),
        ("render FILE -o x.png --ghosts 33", "1..=32"),
        ("render FILE -o x.png --ghost-step 3", "--ghosts <N>"),
        ("render STILL -o dir --frames 2", "error: --frames needs a clip, and "),
        ("render STILL -o dir --fps 2", "error: --fps needs a clip, and "),
        ("render STILL -o x.png --sheet 2x2", "error: --sheet without --turntable needs a clip, and "),
        ("render STILL -o x.png --ghosts 2", "error: --ghosts needs a clip, and "),
        ("render FILE -o x.png --view inside", "three-quarter"),
        ("render FILE -o x.png --backend glide", "vulkan, gl"),
        ("render FILE -o x.png --clip Swim", "it has \"Wave\""),
    ];
    for (line, told) in cases {
        let arguments = line.split_whitespace().map(|word| match word {
            "FILE" => &file,
            "STILL" => &still,
            word => word,
        });
        let run = run(arguments);
        assert!(run.refused(2).contains(told), "{line}: {}", run.err);
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
            // Of a folder `check` reads the models in it.
            let told = format!("error: {} cannot be read: ", arguments[1]);
            assert!(run.refused(2).starts_with(&told), "{arguments:?}: {}", run.err);
        }
    }
    assert!(!out.exists());
}

#[test]
fn what_cannot_be_written_is_named() {
    let run = run(["render", FIGURE, "-o", "no/such/folder/x.png", "--size", "16x16"]);
    let told = "error: no/such/folder/x.png cannot be written: ";
    run.refused_with(2, told);
}

/// Also for a file whose name is that of a picture: it is its content that is refused.
#[test]
fn a_file_with_errors_is_refused_by_every_command() {
    let bad = std::fs::read(fixture("bad/png.m3d")).expect("is there");
    let file = &scratch_file("really.png", bad);
    let told = format!("{file}:1:1: error[other-format]: ");
    let out = scratch("refused.png");
    let out_argument = out.to_str().expect("UTF-8");
    for arguments in [
        vec!["info", file],
        vec!["pose", file, "--time", "0"],
        vec!["render", file, "-o", out_argument],
    ] {
        let run = run(&arguments);
        assert!(run.refused(1).starts_with(&told), "{arguments:?}: {}", run.err);
    }
    assert!(!out.exists());
}

#[test]
fn help_is_a_result() {
    for line in ["--help", "help check", "pose -h", "--version"] {
        let run = run(words(line));
        assert_eq!((run.code, run.err.as_str()), (Some(0), ""), "{line}");
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
    #[rustfmt::skip]
    let cases = [
        ("--sheet", &["4", "0x3", "4x", "400x400", "70000x70000"], "columns and rows of pictures, such as 4x3"),
        ("--fps", &["0", "-1", "inf", "NaN", "fast"], "a number of pictures a second above 0"),
        ("--split", &["-0.1", "1.1", "NaN", "half", ""], "a fraction from 0 to 1"),
    ];
    for (key, wrong, told) in cases {
        for wrong in wrong {
            let refused = run(["render", FIGURE, "-o", "dir", &format!("{key}={wrong}")]);
            assert_eq!(refused.code, Some(2), "{key}={wrong}");
            assert!(refused.err.contains(told), "{key}={wrong}: {}", refused.err);
        }
    }
}
