//! `bindpose convert`: what it writes, what it tells, what it refuses.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde_json::Value;

use crate::program::{
    FIGURE, Run, bindpose, fixture, fixture_text, run, scratch, scratch_file, scratch_folder, shared, words,
};

/// A path in a folder of one test.
fn out(test: &str, name: &str) -> String {
    let folder = scratch_folder(&format!("convert_{test}_{name}.d"));
    folder.join(name).to_str().expect("UTF-8").to_owned()
}

/// Converts, and gives what it tells.
fn convert(input: &str, output: &str, options: &[&str]) -> Value {
    let fine = run([&["convert", input, output, "--json"], options].concat()).fine();
    serde_json::from_str(&fine).expect("JSON")
}

fn codes(list: &Value) -> Vec<&str> {
    let list = list.as_array().expect("a list").iter();
    list.map(|one| one["code"].as_str().expect("a code")).collect()
}

fn info(file: &str) -> Value {
    run(["info", file, "--json"]).json()
}

fn clip_names(file: &str) -> Vec<String> {
    let info = info(file);
    let clips = info["clips"].as_array().expect("clips").iter();
    clips
        .map(|clip| clip["name"].as_str().expect("a name").to_owned())
        .collect()
}

/// The positions of all vertices.
fn positions(file: &str, clip: &str, secs: f64) -> Vec<[f64; 3]> {
    let secs = secs.to_string();
    let posed = run(["pose", file, "--clip", clip, "--time", &secs, "--json", "--positions"]).json();
    serde_json::from_value(posed["positions"].clone()).expect("positions")
}

/// Lengths from each vertex to the next, which no turn of space changes.
fn lengths(positions: &[[f64; 3]]) -> Vec<f64> {
    let length = |pair: &[[f64; 3]]| {
        (0..3)
            .map(|axis| (pair[0][axis] - pair[1][axis]).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    positions.windows(2).map(length).collect()
}

fn assert_alike(old: &[f64], new: &[f64], factor: f64, tolerance: f64) {
    assert_eq!(old.len(), new.len());
    for (old, new) in old.iter().zip(new) {
        assert!((old * factor - new).abs() <= tolerance, "{old} × {factor} became {new}");
    }
}

/// That a book's program reads a file and shows it.
fn assert_book_shows(file: &str, clip_is_shown: bool) {
    let checked = run(["check", file, "--book", "all", "--json"]).json();
    for book in ["d3d11", "d3d12"] {
        let verdict = &checked[0]["book"][book];
        let own = info(file)["dialect"] == book;
        if own {
            assert_eq!(verdict["reads"], true, "{file}: {verdict}");
            assert_eq!(verdict["ends"], false, "{file}: {verdict}");
            let shows = if clip_is_shown {
                "The model in \"Take1\"."
            } else {
                "The model."
            };
            assert_eq!(verdict["shows"], shows, "{file}: {verdict}");
        }
    }
}

#[test]
fn a_model_that_needs_no_change_is_the_same_after_it() {
    let output = out("same", "figure.m3d");
    let told = convert(FIGURE, &output, &["--hand", "right"]);
    assert_eq!(codes(&told["changes"]), [""; 0]);
    assert_eq!(codes(&told["losses"]), [""; 0]);
    for clip in clip_names(FIGURE) {
        let (old, new) = (positions(FIGURE, &clip, 0.3), positions(&output, &clip, 0.3));
        assert_eq!(old, new, "{clip}");
    }
    let again = out("same", "again.m3d");
    convert(&output, &again, &["--hand", "right"]);
    let read = |path: &str| std::fs::read(path).expect("was written");
    assert_eq!(read(&output), read(&again));
    assert_eq!(read(&output).len() as u64, told["bytes"].as_u64().expect("a size"));
}

#[test]
fn json_has_its_keys_and_no_others() {
    let output = out("json", "figure.glb");
    let told = convert(FIGURE, &output, &["--clips", "Walk", "--scale", "2"]);
    let mut keys: Vec<_> = told
        .as_object()
        .expect("an object")
        .keys()
        .map(String::as_str)
        .collect();
    keys.sort_unstable();
    assert_eq!(
        keys,
        [
            "bytes",
            "changes",
            "dialect",
            "format",
            "input",
            "losses",
            "output",
            "schemaVersion"
        ]
    );
    assert_eq!(
        (&told["input"], &told["output"]),
        (&Value::from(FIGURE), &Value::from(output.as_str()))
    );
    assert_eq!((&told["format"], &told["dialect"]), (&Value::from("glb"), &Value::Null));
    for change in told["changes"].as_array().expect("a list") {
        assert_eq!(change.as_object().expect("an object").len(), 2, "{change}");
        assert!(change["code"].is_string() && change["message"].is_string());
    }
    let losses = told["losses"].as_array().expect("a list");
    assert!(!losses.is_empty(), "maps have no pictures here");
    for loss in losses {
        assert_eq!(loss.as_object().expect("an object").len(), 3, "{loss}");
        assert!(loss["count"].as_u64().is_some_and(|count| count > 0), "{loss}");
    }
    let m3d = convert(FIGURE, &out("json", "figure.m3d"), &["--dialect", "d3d11"]);
    assert_eq!(
        (&m3d["format"], &m3d["dialect"]),
        (&Value::from("m3d"), &Value::from("d3d11"))
    );
}

#[test]
fn a_glb_is_read_again_with_the_same_lengths() {
    let output = out("glb", "figure.glb");
    convert(FIGURE, &output, &[]);
    assert_eq!(info(&output)["counts"], info(FIGURE)["counts"]);
    let back = out("glb", "back.m3d");
    convert(&output, &back, &[]);
    for file in [&output, &back] {
        assert_eq!(info(file)["handedness"], "right", "{file}");
    }
    for clip in ["Take1", "Walk", "Run", "Wave"] {
        let old = lengths(&positions(FIGURE, clip, 0.4));
        for file in [&output, &back] {
            assert_alike(&old, &lengths(&positions(file, clip, 0.4)), 1.0, 1e-3);
        }
    }
}

#[test]
fn text_tells_changes_losses_and_bytes() {
    let output = out("text", "figure.glb");
    let options = words("--clips Walk,Run --rename Run=Dash");
    let printed = run(["convert", FIGURE, &output].iter().chain(&options)).fine();
    let lines: Vec<_> = printed.lines().collect();
    assert_eq!(lines[0], "change[clips-chosen]: 2 clips are left out.");
    assert_eq!(lines[1], "change[clip-renamed]: Clip \"Run\" is named \"Dash\".");
    assert!(
        lines.iter().any(|line| line.starts_with("loss[maps-missing]: ")),
        "{printed}"
    );
    let last = lines.last().expect("lines");
    assert!(
        last.starts_with(&format!("{output}: ")) && last.ends_with(" bytes"),
        "{last}"
    );
}

#[test]
fn clips_are_chosen_cut_and_renamed() {
    let output = out("clips", "walk.m3d");
    let options = words("--clips Walk --range 0.25..0.75 --rename Walk=Step --hand right");
    let told = convert(FIGURE, &output, &options);
    assert_eq!(codes(&told["changes"]), ["clips-chosen", "range-cut", "clip-renamed"]);
    let clip = &info(&output)["clips"][0];
    assert_eq!(
        (clip["start_secs"].as_f64(), clip["end_secs"].as_f64()),
        (Some(0.0), Some(0.5))
    );
    for secs in [0.25, 0.4, 0.75] {
        let (old, new) = (positions(FIGURE, "Walk", secs), positions(&output, "Step", secs - 0.25));
        for (old, new) in old.iter().zip(&new) {
            assert!(
                (0..3).all(|axis| (old[axis] - new[axis]).abs() < 1e-3),
                "{old:?} became {new:?} at {secs} s"
            );
        }
    }
}

#[test]
fn a_loop_is_closed() {
    let file = fixture("good/bones_child_first.m3d");
    let output = out("loop", "wave.m3d");
    let told = convert(&file, &output, &["--close-loop", "0.25", "--hand", "left"]);
    assert!(codes(&told["changes"]).contains(&"loop-closed"), "{told}");
    let (first, last) = (positions(&output, "Wave", 0.0), positions(&output, "Wave", 0.5));
    for (first, last) in first.iter().zip(&last) {
        assert!((0..3).all(|axis| (first[axis] - last[axis]).abs() < 1e-5));
    }
}

#[test]
fn keys_are_reduced_and_the_error_told() {
    let output = out("reduce", "figure.m3d");
    let told = convert(FIGURE, &output, &["--reduce", "0.001", "--hand", "right"]);
    let changes = told["changes"].as_array().expect("a list");
    assert_eq!(changes.len(), 4);
    for change in changes {
        assert_eq!(change["code"], "keys-reduced");
        let message = change["message"].as_str().expect("a message");
        let error = message
            .split("more than ")
            .nth(1)
            .and_then(|rest| rest.split(' ').next());
        let error: f64 = error.expect("an error").parse().expect("a number");
        assert!(error <= 0.001, "{message}");
    }
    let whole = out("reduce-not", "figure.m3d");
    convert(FIGURE, &whole, &["--hand", "right"]);
    let size = |file: &str| std::fs::metadata(file).expect("is there").len();
    assert!(size(&output) < size(&whole));
}

#[test]
fn spaces_turn_and_lengths_grow() {
    let old = lengths(&positions(FIGURE, "Walk", 0.4));
    let turns: [(&[&str], f64, &str, &str); 4] = [
        (&["--hand", "left"], 1.0, "left", "handedness"),
        (&["--hand", "right"], 1.0, "right", "handedness"),
        (&["--scale", "3"], 3.0, "y", "up_axis"),
        (&["--up", "y", "--scale", "0.5"], 0.5, "y", "up_axis"),
    ];
    for (number, (options, factor, value, key)) in turns.into_iter().enumerate() {
        let output = out("space", &format!("{number}.m3d"));
        convert(FIGURE, &output, options);
        assert_eq!(info(&output)[key], value, "{options:?}");
        assert_alike(&old, &lengths(&positions(&output, "Walk", 0.4)), factor, 1e-3 * factor);
    }
    let output = out("space", "up.m3d");
    let told = convert(FIGURE, &output, &["--up", "z"]);
    assert!(
        codes(&told["losses"]).contains(&"up-axis"),
        "the books read it with y up: {told}"
    );
}

#[test]
fn bones_are_named_in_glb_and_not_in_m3d() {
    let glb = out("bones", "figure.glb");
    let told = convert(FIGURE, &glb, &["--rename-bone", "0=Hips", "--rename-bone", "1=Spine"]);
    assert_eq!(codes(&told["changes"]), ["bone-renamed"; 2]);
    let bytes = std::fs::read(&glb).expect("was written");
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("\"Hips\"") && text.contains("\"Spine\""));
    let m3d = convert(FIGURE, &out("bones", "figure.m3d"), &["--rename-bone", "0=Hips"]);
    assert_eq!(m3d["losses"].as_array().expect("a list").len(), 1, "{m3d}");
}

#[test]
fn what_was_mended_is_a_change() {
    let told = convert(&fixture("good/keys_unsorted.m3d"), &out("mended", "keys.m3d"), &[]);
    assert!(codes(&told["changes"]).contains(&"keys-not-sorted"), "{told}");
    let fixed = out("mended", "fixed.m3d");
    let flat = fixture("check/triangles-without-area.m3d");
    let told = convert(&flat, &fixed, &["--fix"]);
    assert!(codes(&told["changes"]).contains(&"triangles-without-area"), "{told}");
    assert!(!run(["check", &fixed]).fine().contains("triangles-without-area"));
}

#[test]
fn a_bone_without_keys_gets_one_unless_it_is_to_stay_so() {
    let empty = fixture("check/track-empty.m3d");
    let told = convert(&empty, &out("empty", "kept.m3d"), &["--keep-empty"]);
    assert!(codes(&told["losses"]).contains(&"track-empty"), "{told}");
    let text = run(["convert", &empty, &out("empty", "text.m3d"), "--keep-empty"]).fine();
    assert!(
        text.contains("track-empty") && text.contains("`--keep-empty`"),
        "{text}"
    );
    let filled = out("empty", "filled.m3d");
    let told = convert(&empty, &filled, &[]);
    assert!(!codes(&told["losses"]).contains(&"track-empty"), "{told}");
    assert!(codes(&told["changes"]).contains(&"track-empty"), "{told}");
    let found = run(["check", &filled, "--json"]).json();
    assert!(!found.to_string().contains("track-empty"), "{found}");
    let told = convert(&empty, &out("empty", "for_book.m3d"), &["--for-book"]);
    assert!(!codes(&told["losses"]).contains(&"track-empty"), "{told}");
    assert!(codes(&told["changes"]).contains(&"track-empty"), "{told}");
}

#[test]
fn losses_that_are_denied_write_nothing() {
    let output = out("deny", "figure.glb");
    let denied = run(["convert", FIGURE, &output, "--deny", "losses", "--json"]);
    assert_eq!(denied.code, Some(1));
    assert_eq!(denied.err, "error: nothing was written; denied: maps-missing\n");
    assert_eq!(denied.json()["bytes"], 0);
    let folder = Path::new(&output).parent().expect("a folder");
    assert_eq!(std::fs::read_dir(folder).expect("is there").count(), 0);
    let output = out("deny", "figure.m3d");
    let fine = run(["convert", FIGURE, &output, "--deny", "losses"]);
    assert_eq!(fine.code, Some(0), "{fine:?}");
}

/// Each character of Blender loses the names of its bones, so what is denied is chosen by code.
#[test]
fn what_is_denied_is_named_by_codes_and_what_is_allowed_too() {
    let banner = fixture("gltf/banner.glb");
    let losses = codes(&convert(&banner, &out("codes", "all.m3d"), &[])["losses"]).join(",");
    assert!(losses.contains("joint-names") && losses.contains(','), "{losses}");
    let others = losses.replace("joint-names,", "");
    for (number, (options, code)) in [
        (vec!["--deny", "losses"], 1),
        (vec!["--deny", "losses", "--allow", &losses], 0),
        (vec!["--deny", "losses", "--allow", &others], 1),
        (vec!["--deny", "joint-names,opacity"], 1),
        (vec!["--deny", "joint-names", "--allow", "joint-names"], 0),
        (vec!["--deny", "opacity"], 0),
        // Changes have codes too.
        (vec!["--deny", "scaled", "--scale", "2"], 1),
        (vec!["--deny", "losses,scaled", "--allow", &losses, "--scale", "2"], 1),
    ]
    .into_iter()
    .enumerate()
    {
        let output = out("codes", &format!("{number}.m3d"));
        let told = run([&["convert", &banner, &output], &options[..]].concat());
        assert_eq!(told.code, Some(code), "{options:?}: {told:?}");
        assert_eq!(Path::new(&output).exists(), code == 0, "{options:?}");
        assert_eq!(
            told.err.starts_with("error: nothing was written; denied: "),
            code == 1,
            "{told:?}"
        );
    }
}

#[test]
fn losses_name_materials_and_say_what_one_sees() {
    let file = fixture("gltf/leaf-and-glass.gltf");
    let told = convert(&file, &out("words", "leaf.m3d"), &[]);
    let losses = told["losses"].as_array().expect("a list");
    let message = |code: &str| {
        let loss = losses.iter().find(|loss| loss["code"] == code);
        loss.unwrap_or_else(|| panic!("{code} is not in {told}"))["message"]
            .as_str()
            .expect("a message")
    };
    assert_eq!(
        message("alpha-blend"),
        "1 material is transparent by blending and drawn opaque: \"Glass\"."
    );
    assert!(
        message("metallic-roughness").starts_with("1 material is metal, ")
            && message("metallic-roughness").contains("\"Leaf\"")
    );
    for code in [
        "double-sided",
        "metallic-roughness",
        "map-sampling",
        "gltf-morph-animation-left-out",
    ] {
        let explained = run(["check", "--explain", code]).fine();
        let searched: &[&str] = match code {
            "double-sided" => &["two-sided", "Backface Culling", "back faces"],
            "metallic-roughness" => &["metal", "darker"],
            "map-sampling" => &["UV"],
            _ => &["shape keys", "morph targets"],
        };
        for words in searched {
            assert!(explained.contains(words), "{words} is not in {explained}");
        }
    }
}

#[cfg(unix)]
#[test]
fn a_read_only_output_is_refused_unless_it_is_forced() {
    use std::os::unix::fs::PermissionsExt as _;
    let output = out("read_only", "figure.m3d");
    std::fs::write(&output, "kept").expect("can be written");
    std::fs::set_permissions(&output, std::fs::Permissions::from_mode(0o444)).expect("is ours");
    let refused = run(["convert", FIGURE, &output]);
    refused.refused(2);
    let expected = format!("error: {output} is marked as read-only; --force writes over it\n");
    assert_eq!(refused.err, expected);
    assert_eq!(std::fs::read(&output).expect("is there"), b"kept");
    run(["convert", FIGURE, &output, "--force"]).fine();
    assert!(std::fs::metadata(&output).expect("is there").len() > 1000);
    // So are the maps beside it.
    let sample = Path::new(FIGURE).parent().expect("a folder").to_str().expect("UTF-8");
    let maps = scratch("convert_read_only_maps");
    let folders = ["--textures", sample, "--textures-out", maps.to_str().expect("UTF-8")];
    let arguments = [&["convert", FIGURE, &output], &folders[..]].concat();
    run(&arguments).fine();
    let map = std::fs::read_dir(&maps)
        .expect("was made")
        .next()
        .expect("a map")
        .expect("can be listed")
        .path();
    std::fs::set_permissions(&map, std::fs::Permissions::from_mode(0o444)).expect("is ours");
    let refused = run(&arguments);
    assert!(
        refused.code == Some(2) && refused.err.contains("is marked as read-only"),
        "{refused:?}"
    );
}

/// A model so large that writing it takes a while.
#[cfg(target_os = "linux")]
fn large_model() -> PathBuf {
    let text = fixture_text("good/d3d11_static.m3d");
    let (before, rest) = text.split_once("Position:").expect("has vertices");
    let (vertices, after) = rest.split_at(rest.find("***").expect("goes on"));
    let first = format!("Position:{vertices}");
    let count = before
        .split("#Vertices ")
        .nth(1)
        .and_then(|rest| rest.split_whitespace().next());
    let count: usize = count.expect("a count").parse().expect("a number");
    let times = 200_000 / count;
    let before = before.replace(&format!("#Vertices {count}"), &format!("#Vertices {}", count * times));
    scratch_file("interrupted_input.m3d", before + &first.repeat(times) + after).into()
}

/// The signal comes while the file beside the output is there. It may come too late, so that is tried more than once. Where the tests were
/// told to ignore a hangup, as by nohup, the command is not: it would leave signals alone.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupt_leaves_nothing_half_written() {
    let input = large_model();
    let output = out("interrupt", "large.m3d");
    let folder = Path::new(&output).parent().expect("a folder");
    let parts = || -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).expect("is there");
        let paths = entries.map(|entry| entry.expect("can be listed").path());
        paths
            .filter(|path| path.extension().is_some_and(|extension| extension == "part"))
            .collect()
    };
    let mut interrupted = 0;
    for _ in 0..30 {
        std::fs::write(&output, "kept").expect("can be written");
        let mut command = Command::new("env");
        command.args([
            "--default-signal=HUP,INT,TERM",
            env!("CARGO_BIN_EXE_bindpose"),
            "convert",
        ]);
        command.arg(&input).arg(&output).stdout(Stdio::null());
        let mut child = command.spawn().expect("the binary was built for this test");
        let status = loop {
            if !parts().is_empty() {
                let kill = Command::new("kill").args(["-TERM", &child.id().to_string()]).status();
                kill.expect("coreutils are there");
                break child.wait().expect("it ends");
            }
            if let Some(status) = child.try_wait().expect("it ends") {
                break status;
            }
        };
        assert_eq!(parts(), [""; 0].map(PathBuf::from), "something is left");
        if status.code() == Some(130) {
            let bytes = std::fs::read(&output).expect("is there");
            if bytes == b"kept" {
                interrupted += 1;
                break;
            }
            assert!(
                bytes.ends_with(b"\n2 1 0\n"),
                "it came after the last step, and the file is whole"
            );
            continue;
        }
        assert!(status.success(), "{status}");
    }
    assert_eq!(interrupted, 1, "no signal came in time");
}

#[test]
fn its_input_is_never_overwritten() {
    let input = out("own", "figure.m3d");
    std::fs::copy(FIGURE, &input).expect("can be copied");
    let before = std::fs::read(&input).expect("is there");
    let folder = Path::new(&input).parent().expect("a folder");
    let roundabout = folder
        .join("..")
        .join(folder.file_name().expect("a name"))
        .join("figure.m3d");
    let mut names = vec![PathBuf::from(&input), roundabout];
    #[cfg(unix)]
    {
        let link = folder.join("link.m3d");
        std::os::unix::fs::symlink(&input, &link).expect("can be linked");
        names.push(link);
    }
    for name in names {
        let refused = run(["convert", &input, name.to_str().expect("UTF-8"), "--scale", "2"]);
        refused.refused_with(2, "is read; name another file to write");
        assert_eq!(std::fs::read(&input).expect("is there"), before);
    }
}

#[test]
fn standard_input_is_read() {
    let output = out("stdin", "figure.m3d");
    let mut command = bindpose();
    command
        .args(["convert", "-", &output])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped());
    let mut child = command.spawn().expect("the binary was built for this test");
    let bytes = std::fs::read(FIGURE).expect("is there");
    let mut stdin = child.stdin.take().expect("was asked for");
    stdin.write_all(&bytes).expect("it reads");
    drop(stdin);
    assert!(child.wait().expect("it ends").success());
    assert_eq!(info(&output)["counts"], info(FIGURE)["counts"]);
}

#[test]
fn a_text_model_goes_to_m3d_and_back_and_says_what_it_cannot_hold() {
    let [txt, m3d, back, again] = ["still.txt", "still.m3d", "back.txt", "again.txt"].map(|name| out("text", name));
    let told = convert(FIGURE, &txt, &[]);
    assert_eq!((&told["format"], &told["dialect"]), (&"txt".into(), &"txt".into()));
    let losses = codes(&told["losses"]);
    for code in [
        "materials-left-out",
        "tex-coords-left-out",
        "bones-left-out",
        "clips-left-out",
    ] {
        assert!(losses.contains(&code), "{code}: {losses:?}");
    }
    assert_eq!(info(&txt)["counts"]["bones"], 0);
    assert_eq!(info(&txt)["counts"]["triangles"], info(FIGURE)["counts"]["triangles"]);
    // The figure is right-handed, which the books' programs are not.
    assert_eq!(codes(&convert(&txt, &m3d, &[])["changes"]), ["handedness-changed"]);
    assert_eq!(codes(&convert(&m3d, &back, &[])["losses"]), [""; 0]);
    assert_eq!(codes(&convert(&back, &again, &[])["changes"]), [""; 0]);
    let [first, second] = [&back, &again].map(|path| std::fs::read_to_string(path).expect("it is written"));
    assert!(first == second, "the same to the byte");
}

#[test]
fn wrong_use_says_what_is_wrong_and_writes_nothing() {
    let m3d = out("wrong", "out.m3d");
    let glb = out("wrong", "out.glb");
    let txt = out("wrong", "out.txt");
    let none = out("wrong", "out.obj");
    let lost = format!("{m3d}/no/such/out.m3d");
    #[rustfmt::skip]
    let cases = [
        (&none, "", "OUT ends in .m3d, .glb or .txt"),
        (&txt, "--for-book", "--for-book is for .m3d"),
        (&glb, "--dialect d3d11", "--dialect is for .m3d"),
        (&glb, "--for-book", "--for-book is for .m3d"),
        (&glb, "--textures-out x", "--textures-out is for .m3d"),
        (&glb, "--keep-empty", "--keep-empty is for .m3d"),
        (&m3d, "--reduce 2", "at most 0.1"),
        (&glb, "--hand left", "--hand left is for .m3d"),
        (&m3d, "--for-book --hand left", "--hand left does not go with --for-book"),
        (&m3d, "--range 2", "such as 0.5..2"),
        (&m3d, "--range 2..1", "such as 0.5..2"),
        (&m3d, "--range 0..0.5", "A range is of one clip, and there are 4; choose one."),
        (&m3d, "--clips Walk --range 0..9", "is not inside \"Walk\""),
        (&m3d, "--clips Swim", "there is no clip \"Swim\""),
        (&m3d, "--clips Run --close-loop 5", "its end cannot be eased over 5 s"),
        (&m3d, "--reduce 0", "a number above 0"),
        (&m3d, "--scale -1", "a number above 0"),
        (&m3d, "--rename Walk", "OLD=NEW"),
        (&m3d, "--rename Walk=Run", "A clip cannot be named \"Run\": another one is."),
        (&m3d, "--rename-bone 900=Tail", "There is no bone 900"),
        (&m3d, "--rename-bone 0=", "it is N=NAME"),
        (&m3d, "--deny loses", "there is no code \"loses\"; the nearest is \"losses\""),
        (&m3d, "--dialect imm", "d3d11, d3d12"),
        (&lost, "", "cannot be written"),
    ];
    for (output, options, told) in cases {
        let run = run(["convert", FIGURE, output]
            .into_iter()
            .chain(options.split_whitespace()));
        assert!(run.refused(2).contains(told), "{options:?}: {}", run.err);
        assert!(!Path::new(output).exists(), "{options:?}");
    }
    let nameless = run(["convert", FIGURE, &m3d, "--rename-bone", "0= "]);
    nameless.refused_with(2, "it is N=NAME");
    let unread = run(["convert", "no/such/model.m3d", &m3d]);
    unread.refused(2);
    let refused = run(["convert", &fixture("bad/count_not_a_number.m3d"), &m3d]);
    refused.refused(1);
    assert!(!Path::new(&m3d).exists());
}

#[test]
fn maps_are_written_as_png_and_named() {
    let output = out("png", "figure.m3d");
    let folder = scratch("convert_png_maps");
    let sample = Path::new(FIGURE).parent().expect("a folder").to_str().expect("UTF-8");
    let folder_name = folder.to_str().expect("UTF-8");
    let told = convert(FIGURE, &output, &["--textures", sample, "--textures-out", folder_name]);
    assert!(codes(&told["changes"]).contains(&"maps-written"), "{told}");
    let found = run(["info", &output, "--textures", folder_name, "--json"]).json();
    let maps = found["maps"].as_array().expect("maps");
    assert!(!maps.is_empty());
    for map in maps {
        assert_eq!(map["state"], "found", "{map}");
        assert!(map["name"].as_str().expect("a name").ends_with(".png"), "{map}");
    }
    let folders = ["--textures", folder_name, "--textures-out", folder_name];
    let twice = run(["convert", FIGURE, &output].iter().chain(&folders));
    assert_eq!(twice.code, Some(2), "maps that are read are not overwritten: {twice:?}");
}

/// The maps are written first, and nothing stays of them where the rest cannot be.
#[test]
fn maps_go_again_where_the_file_cannot_be_written() {
    let sample = Path::new(FIGURE).parent().expect("a folder").to_str().expect("UTF-8");
    let beside = scratch("convert_half");
    let (new, old) = (beside.join("new"), beside.join("old"));
    std::fs::create_dir_all(&old).expect("can be made");
    let _ = std::fs::remove_dir_all(&new);
    let output = beside.join("missing/o.m3d");
    for folder in [&new, &old] {
        let [folder_name, output] = [folder, &output].map(|path| path.to_str().expect("UTF-8"));
        let folders = ["--textures", sample, "--textures-out", folder_name];
        let failed = run(["convert", FIGURE, output].iter().chain(&folders));
        assert_eq!(failed.code, Some(2), "{failed:?}");
    }
    assert!(!new.exists(), "it was made for the maps");
    assert_eq!(std::fs::read_dir(&old).expect("it was there").count(), 0);
}

#[test]
fn a_figure_for_the_book_is_shown_by_its_demo() {
    let sample = Path::new(FIGURE).parent().expect("a folder").to_str().expect("UTF-8");
    let turned = out("book", "turned.m3d");
    convert(
        FIGURE,
        &turned,
        &["--hand", "left", "--scale", "0.01", "--rename", "Take1=Walk about"],
    );
    for (number, input) in [FIGURE, &turned].into_iter().enumerate() {
        for dialect in ["d3d11", "d3d12"] {
            let output = out("book", &format!("{number}_{dialect}.m3d"));
            let folder = scratch(&format!("convert_book_{number}_{dialect}"));
            let folder = folder.to_str().expect("UTF-8");
            let of_book = ["--for-book", "--dialect", dialect];
            let folders = ["--textures", sample, "--textures-out", folder];
            convert(input, &output, &[&of_book[..], &folders].concat());
            assert_book_shows(&output, true);
            let of_book = ["--book", dialect, "--textures", folder, "--deny", "book"];
            let checked = run(["check", &output].iter().chain(&of_book));
            assert_eq!(checked.code, Some(0), "{checked:?}");
            for entry in std::fs::read_dir(folder).expect("was made") {
                let bytes = std::fs::read(entry.expect("can be listed").path()).expect("can be read");
                assert!(bytes.starts_with(b"DDS "));
                assert!(bytes[28] > 1, "it has mips");
            }
        }
    }
}

#[test]
fn fixtures_for_the_book_are_shown_or_refused_with_a_reason() {
    for (number, input) in crate::program::fixtures("good").into_iter().enumerate() {
        let input = input.to_str().expect("UTF-8").to_owned();
        let counts = info(&input)["counts"].clone();
        if counts["materials"] == 0 || counts["triangles"] == 0 {
            continue;
        }
        let output = out("books", &format!("{number}.m3d"));
        let folder = scratch(&format!("convert_books_{number}"));
        let folder = folder.to_str().expect("UTF-8");
        let run: Run = run(["convert", &input, &output, "--for-book", "--textures-out", folder]);
        match run.code {
            Some(0) => assert_book_shows(&output, counts["bones"] != 0),
            code => assert!(code == Some(1) && run.err.contains("error"), "{input}: {run:?}"),
        }
    }
}

#[test]
fn real_files_go_every_way() {
    for name in words("d3d12/soldier d3d11/base d3d11/stairs d3d11/rock d3d11/tree imm/column") {
        let Some(input) = shared(&format!("models/{name}.m3d")) else {
            continue;
        };
        let stem = name.replace('/', "_");
        let [m3d, glb, back, book] =
            ["m3d", "glb", "back.m3d", "book.m3d"].map(|end| out("real", &format!("{stem}.{end}")));
        convert(&input, &m3d, &[]);
        convert(&input, &glb, &[]);
        convert(&glb, &back, &[]);
        let folder = scratch(&format!("convert_real_{stem}"));
        convert(
            &input,
            &book,
            &["--for-book", "--textures-out", folder.to_str().expect("UTF-8")],
        );
        let counts = info(&input)["counts"].clone();
        for file in [&m3d, &back] {
            assert_eq!(info(file)["counts"]["triangles"], counts["triangles"], "{file}");
        }
        assert_book_shows(&m3d, name == "d3d12/soldier");
        assert_book_shows(&book, counts["bones"] != 0);
    }
}

#[test]
fn a_character_and_its_motions_of_fbx_become_the_books_demo() {
    let file = |name: &str| fixture(&format!("fbx/{name}.fbx"));
    let (walker, walking, waving) = (file("walker"), file("walking"), file("waving"));
    let motions = ["--add-clips", &*walking, "--add-clips", &*waving];
    let glb = out("fbx", "walker.glb");
    convert(&walker, &glb, &motions);
    assert_eq!(clip_names(&glb), ["Scene", "walking", "waving"]);
    let book = out("fbx", "walker.m3d");
    let told = convert(
        &walker,
        &book,
        &[
            &motions[..],
            &["--in-place", "walking", "--clips", "walking,waving", "--for-book"],
        ]
        .concat(),
    );
    for code in ["in-place", "book-clip-name"] {
        assert!(codes(&told["changes"]).contains(&code), "{told}");
    }
    assert!(codes(&told["losses"]).contains(&"joint-names"), "{told}");
    assert_eq!(clip_names(&book), ["Take1", "waving"]);
    let check = run(["check", &book, "--book", "d3d12"]);
    assert!(check.out.contains("shows it"), "{}", check.out);
    // What waves is posed alike, whatever its size.
    for secs in [0.0, 0.5, 1.3] {
        let [source, written] =
            [(&glb, "waving"), (&book, "waving")].map(|(file, clip)| lengths(&positions(file, clip, secs)));
        let factor = written.iter().sum::<f64>() / source.iter().sum::<f64>();
        assert_alike(&source, &written, factor, 1e-3);
    }
    let refused = run(["convert", &walker, &glb, "--add-clips", FIGURE]);
    assert_eq!(refused.code, Some(1), "{}", refused.err);
    assert!(refused.err.contains("clips-bones-differ"), "{}", refused.err);
}

/// A triangle whose material has a picture, which lies in the file.
fn painted_fbx() -> String {
    let picture = Path::new(FIGURE).with_file_name("figure_diff.png");
    let picture = BASE64_STANDARD.encode(std::fs::read(picture).expect("it is there"));
    format!(
        "; FBX 7.4.0 project file\nObjects:  {{
\tGeometry: 1, \"Geometry::\", \"Mesh\" {{
\t\tVertices: *9 {{\n\t\t\ta: 0,0,0,1,0,0,1,1,0\n\t\t}}
\t\tPolygonVertexIndex: *3 {{\n\t\t\ta: 0,1,-3\n\t\t}}
\t\tLayerElementUV: 0 {{
\t\t\tMappingInformationType: \"ByPolygonVertex\"
\t\t\tReferenceInformationType: \"Direct\"
\t\t\tUV: *6 {{\n\t\t\t\ta: 0,0,1,0,1,1\n\t\t\t}}
\t\t}}
\t}}
\tModel: 2, \"Model::Card\", \"Mesh\" {{\n\t}}
\tMaterial: 3, \"Material::Paint\", \"\" {{\n\t}}
\tTexture: 4, \"Texture::\", \"\" {{\n\t\tRelativeFilename: \"card.fbm/skin.png\"\n\t}}
\tVideo: 5, \"Video::\", \"Clip\" {{\n\t\tContent: ,\n\t\t\t\"{picture}\"\n\t}}
}}
Connections:  {{
\tC: \"OO\",1,2\n\tC: \"OO\",2,0\n\tC: \"OO\",3,2\n\tC: \"OP\",4,3,\"DiffuseColor\"\n\tC: \"OO\",5,4
}}
"
    )
}

#[test]
fn a_picture_inside_an_fbx_is_written_for_the_books_demo() {
    let input = scratch_file("convert_painted.fbx", painted_fbx().as_bytes());
    let output = out("painted", "card.m3d");
    let folder = scratch("convert_painted_maps");
    let folder_name = folder.to_str().expect("UTF-8");
    convert(&input, &output, &["--for-book", "--textures-out", folder_name]);
    let picture = std::fs::read(folder.join("skin.dds")).expect("it was written");
    assert!(picture.starts_with(b"DDS ") && picture[28] > 1, "with mips");
    let text = std::fs::read_to_string(&output).expect("it was written");
    assert!(text.lines().any(|line| line == "DiffuseMap: skin.dds"), "{text}");
    let found = run(["info", &output, "--textures", folder_name, "--json"]).json();
    let maps = found["maps"].as_array().expect("maps");
    let is_found = |map: &Value| map["name"] == "skin.dds" && map["state"] == "found";
    assert!(maps.iter().any(is_found), "{found}");
    run([
        "check",
        &output,
        "--book",
        "d3d12",
        "--textures",
        folder_name,
        "--deny",
        "book",
    ])
    .fine();
}
