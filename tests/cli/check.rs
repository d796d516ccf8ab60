//! `bindpose check`.

use bindpose::session::{File, FileCommand, Session};
use serde_json::{Value, json};

use crate::program::{
    bindpose, fixture, fixture_text, fixtures, run, run_command, run_with_input, scratch, scratch_file, scratch_folder,
    shared, words,
};

#[test]
fn a_finding_is_a_line_and_its_excerpt() {
    let file = fixture("bad/blend_index_out_of_range.m3d");
    let run = run(["check", &file]);
    assert_eq!((run.code, run.err.as_str()), (Some(1), ""));
    let expected = format!(
        "{file}:34:17: error[not-in-range]: A blend index must be a whole number from 0 to 1, but \"2\" was found.\n\
         33 | BlendWeights: 0.75 0.25 0 0\n\
         34 | BlendIndices: 0 2 0 0\n   |                 ^\n"
    );
    assert_eq!(run.out, expected);
}

#[test]
fn bytes_of_a_file_that_is_no_text_are_printed_in_hex() {
    let file = fixture("bad/png.m3d");
    let run = run(["check", &file]);
    let expected = format!(
        "{file}:1:1: error[other-format]: This is a PNG image, not an .m3d file.\n\
         00 | 89 50 4e 47 0d 0a 1a 0a 00 00 00 0d 49 48 44 52  .PNG........IHDR\n   | ^^\n"
    );
    assert_eq!((run.code, run.out), (Some(1), expected));
}

#[test]
fn a_file_without_findings_prints_nothing() {
    let run = run(["check", &fixture("good/d3d12_skinned.m3d")]);
    assert_eq!((run.code, run.out.as_str(), run.err.as_str()), (Some(0), "", ""));
}

#[test]
fn notes_and_warnings_are_no_errors() {
    let run = run(["check", &fixture("good/subset_typos.m3d")]);
    assert_eq!(run.code, Some(0));
    assert!(run.out.contains(":30:26: note[subset-vertex-range]: "), "{}", run.out);
    assert!(run.out.contains(":30:29: note[subset-label]: "), "{}", run.out);
}

/// The whole answer, so that no key can come or go unseen.
#[test]
fn json_has_an_object_for_each_file() {
    let (good, bad) = (
        fixture("good/d3d12_skinned.m3d"),
        fixture("bad/blend_index_out_of_range.m3d"),
    );
    let run = run(["check", "--json", &good, &bad]);
    assert_eq!(run.code, Some(1));
    let expected = json!([
        {"schemaVersion": 1, "file": good, "findings": [], "book": null, "error": null},
        {"schemaVersion": 1, "file": bad, "findings": [{
            "severity": "error",
            "code": "not-in-range",
            "message": "A blend index must be a whole number from 0 to 1, but \"2\" was found.",
            "line": 34,
            "column": 17,
            "json_pointer": null,
            "byte_offset": null,
            "expected": "a bone index",
            "found": "2",
            "subject": null,
            "time_secs": null,
            "bone": null,
            "count": 1,
            "places": [{"line": 34, "column": 17}],
            "help": "An index must name a row that is there; a count must not be negative. Count from 0, and write counts and \
                     indices of the same list as whole numbers.",
            "permanent": null,
        }], "book": null, "error": null},
    ]);
    assert_eq!(run.json(), expected);
}

#[test]
fn what_convert_tells_of_is_explained_too() {
    let run_of = |code: &str| run(["check", "--explain", code]).fine();
    assert!(run_of("scaled").starts_with("change[scaled]: All lengths are multiplied by a factor.\nWhat to do: "));
    assert!(run_of("alpha-blend").starts_with("loss[alpha-blend]: "));
    for code in bindpose::diagnostic::of_export::ALL {
        let kind = if code.is_loss { "loss" } else { "change" };
        assert!(run_of(code.name).starts_with(&format!("{kind}[{}]: ", code.name)));
    }
}

#[test]
fn a_code_is_explained() {
    let run = run(["check", "--explain", "weights-not-normalized"]);
    let expected = "warning[weights-not-normalized]: The blend weights of a vertex do not sum to 1; normalised.\n\
                    The books' shaders give the fourth bone whatever is left to 1, so the vertex may stand elsewhere there.\n\
                    Here: The weights are normalised.\n\
                    To mend it: Keep the four greatest weights, and divide them by their sum.\n\
                    The file itself is unchanged. Export, or `bindpose convert IN OUT`, writes it mended.\n";
    assert_eq!((run.code, run.out.as_str(), run.err.as_str()), (Some(0), expected, ""));
}

#[test]
fn an_unknown_code_is_wrong_use_and_the_nearest_is_named() {
    for (asked, nearest) in [
        ("weights-not-normalised", "weights-not-normalized"),
        ("Empty-File", "empty-file"),
    ] {
        let run = run(["check", "--explain", asked]);
        let expected = format!("error: there is no code \"{asked}\"; the nearest is \"{nearest}\"\n");
        assert_eq!((run.code, run.out.as_str(), run.err), (Some(2), "", expected));
    }
    assert_eq!(
        run(["check", "--explain", "comment", "a.m3d"]).code,
        Some(2),
        "a code or files"
    );
    assert_eq!(run(["check"]).code, Some(2), "neither");
}

/// `severity[code] line:column: message` stands beside each file: of those that begin like glTF what the reader of `.m3d` says, which
/// `check` does not ask for them.
#[test]
fn every_bad_fixture_gives_the_error_that_stands_beside_it() {
    let is_gltf = |file: &std::path::PathBuf| ["glb.m3d", "gltf.m3d"].iter().any(|name| file.ends_with(name));
    let mut files = fixtures("bad");
    files.retain(|file| !is_gltf(file));
    let arguments = ["check", "--json"]
        .map(Into::into)
        .into_iter()
        .chain(files.iter().cloned());
    let run = run(arguments);
    assert_eq!(run.code, Some(1));
    let found = run.json();
    let found = found.as_array().expect("a list");
    assert_eq!(found.len(), files.len());
    for (file, found) in files.iter().zip(found) {
        let expected = std::fs::read_to_string(file.with_extension("txt")).expect("every fixture has its text");
        let findings = found["findings"].as_array().expect("a list");
        let texts: Vec<String> = findings.iter().map(one_line).collect();
        assert_eq!(texts, [expected.trim_end()], "{}", file.display());
    }
}

fn one_line(finding: &Value) -> String {
    let text = |key: &str| finding[key].as_str().expect("a text").to_owned();
    let (line, column) = (&finding["line"], &finding["column"]);
    format!(
        "{}[{}] {line}:{column}: {}",
        text("severity"),
        text("code"),
        text("message")
    )
}

#[test]
fn findings_come_in_the_order_of_the_file() {
    let files = fixtures("good");
    let arguments = ["check", "--json"]
        .map(Into::into)
        .into_iter()
        .chain(files.iter().cloned());
    let found = run(arguments).json();
    let mut several = 0;
    for file in found.as_array().expect("a list") {
        let findings = file["findings"].as_array().expect("a list");
        let places: Vec<_> = findings
            .iter()
            .map(|finding| (finding["line"].as_u64(), finding["column"].as_u64()))
            .collect();
        assert!(places.is_sorted(), "{file}");
        several += usize::from(places.len() > 1);
    }
    assert!(several > 3, "files with several findings are among them");
}

#[test]
fn the_worst_of_several_files_counts_and_every_file_is_told() {
    let (good, bad) = (fixture("good/d3d12_skinned.m3d"), fixture("bad/empty.m3d"));
    let missing = "no/such/model.m3d";
    for (files, code) in [
        (vec![&*good], 0),
        (vec![&*bad, &*good], 1),
        (vec![missing, &*bad, &*good], 2),
        (vec![&*good, &*bad, missing], 2),
        (vec![&*good, missing], 2),
    ] {
        for json in [false, true] {
            let run = run(["check"].iter().chain(json.then_some(&"--json")).chain(&files));
            assert_eq!(run.code, Some(code), "{files:?}");
            assert_eq!(run.out.contains("empty-file"), files.contains(&&*bad), "{files:?}");
            assert_eq!(
                run.err.contains("no/such/model.m3d cannot be read"),
                files.contains(&missing)
            );
        }
    }
}

#[test]
fn the_real_files_are_fine_and_strangers_are_named() {
    for name in words("d3d11/base d3d11/rock d3d11/stairs d3d11/tree d3d12/soldier imm/column") {
        let Some(file) = shared(&format!("models/{name}.m3d")) else {
            continue;
        };
        assert_eq!(run(["check", &file]).code, Some(0), "{name}");
    }
    for (path, kind) in [
        ("reject/WusonBlitz0.m3d", "binary"),
        ("reject/cube_with_vertexcolors.a3d", "ASCII"),
    ] {
        let Some(file) = shared(path) else { continue };
        let run = run(["check", &file]);
        assert_eq!(run.code, Some(1), "{path}");
        assert!(run.out.contains(":1:1: error[other-format]: "), "{}", run.out);
        assert!(
            run.out.contains(kind) && run.out.contains("\"Model 3D\""),
            "{}",
            run.out
        );
    }
}

/// The codes of a file's findings, by `check --json`.
fn codes(file: &str) -> Vec<String> {
    let found = run(["check", "--json", file]).json();
    let findings = found[0]["findings"].as_array().expect("a list").iter();
    findings
        .map(|finding| finding["code"].as_str().expect("a text").to_owned())
        .collect()
}

#[test]
fn what_is_left_out_or_empty_is_told() {
    for (file, code) in [
        ("comment_above_header", "comment"),
        ("counts_all_zero", "counts-all-zero"),
        ("clip_unnamed", "clip-unnamed"),
        ("key_times_not_finite", "keys-not-finite"),
        ("pose_overflows", "pose-overflows"),
        ("zeros_behind_the_end", "zeros-surplus"),
    ] {
        assert_eq!(codes(&fixture(&format!("good/{file}.m3d"))), [code], "{file}");
    }
}

#[test]
fn a_circle_of_bones_is_told_in_a_sentence() {
    let text = fixture_text("good/d3d12_skinned.m3d");
    let circle = text.replace("ParentIndexOfBone0: -1", "ParentIndexOfBone0: 1");
    let file = &scratch_file("circle.m3d", circle);
    let run = run(["check", file]);
    assert_eq!(run.code, Some(1));
    let message = "error[parent-cycle]: Bones form a circle: 0 → 1 → 0; each lists the next as its parent.\n";
    assert!(run.out.contains(message), "{}", run.out);
}

#[cfg(unix)]
#[test]
fn a_name_with_a_line_end_stays_on_one_line() {
    let file = scratch("two\nlines.m3d");
    std::fs::copy(fixture("bad/empty.m3d"), &file).expect("can be written");
    let checked = run(["check", file.to_str().expect("UTF-8")]);
    assert!(
        checked
            .out
            .lines()
            .next()
            .is_some_and(|line| line.ends_with("two\\nlines.m3d:1:1: error[empty-file]: The file is empty.")),
        "{}",
        checked.out
    );
    // Said of a file that is refused, and of one that is not there, too.
    let refused = run(["info", file.to_str().expect("UTF-8")]);
    assert!(
        refused.err.contains("two\\nlines.m3d:1:1: error[empty-file]"),
        "{}",
        refused.err
    );
    std::fs::remove_file(&file).expect("was written");
    let missing = run(["check", file.to_str().expect("UTF-8")]);
    assert!(
        missing.err.contains("two\\nlines.m3d cannot be read"),
        "{}",
        missing.err
    );
}

/// A copy that was not finished, or a disk that lost power, leaves zeros.
#[test]
fn a_file_of_mostly_zeros_is_an_error_however_good_its_beginning() {
    let file = scratch("zeros.m3d");
    let mut bytes = std::fs::read(fixture("good/d3d12_skinned.m3d")).expect("can be read");
    bytes.resize(bytes.len() + 20_000_000, 0);
    std::fs::write(&file, bytes).expect("can be written");
    let run = run(["check", file.to_str().expect("UTF-8")]);
    assert_eq!(run.code, Some(1));
    let message = "error[mostly-zeros]: The file ends in 20000000 bytes of value 0, more than stand before them: it was not \
                   written or copied whole.\n";
    assert!(run.out.contains(message), "{}", run.out);
    assert!(run.out.len() < 1_000, "{}", run.out);
}

/// A file of many clips, or materials, of one name. With a finding for each, and its lines looked for from the start of the
/// file, 200 000 would take hours.
#[test]
fn many_findings_alike_are_one_with_the_first_places() {
    let text = fixture_text("good/d3d12_skinned.m3d");
    let (start, clip) = text.split_at(text.find("AnimationClip Wave").expect("is there"));
    let count = 50_000;
    let clips = start.replace("#AnimationClips 1", &format!("#AnimationClips {count}")) + &clip.repeat(count);
    let material_at = text.find("Name: skin").expect("is there");
    let (material, rest) = text[material_at..].split_at(text[material_at..].find("***").expect("is there"));
    let materials = text[..material_at].replace("#Materials 1", &format!("#Materials {count}\n#Subsets 1"));
    let materials = materials + &material.repeat(count) + rest;
    #[rustfmt::skip]
    let cases = [
        ("clips.m3d", clips, "duplicate-clip-name", "\"Wave (2)\". The same holds for 49998 more clips."),
        ("materials.m3d", materials, "duplicate-material-name",
         "\"skin (2)\". The same holds for 49998 more materials."),
    ];
    for (name, text, code, said) in cases {
        let file = scratch(name);
        std::fs::write(&file, text).expect("can be written");
        let file = file.to_str().expect("UTF-8");
        let text = run(["check", file]).fine();
        assert!(text.contains(code) && text.contains(said), "{text}");
        let [.., others, permanent] = *text.lines().collect::<Vec<_>>() else {
            panic!("{text}")
        };
        assert!(
            others.starts_with("   = also on lines ") && others.ends_with(" and 49989 more places"),
            "{others}"
        );
        assert!(permanent.contains("`bindpose convert IN OUT`"), "{permanent}");
        assert_eq!(text.lines().count(), 6, "{text}");
        let found = run(["check", "--json", file]).json();
        let [finding] = found[0]["findings"].as_array().expect("a list").as_slice() else {
            panic!("{found}")
        };
        assert_eq!(finding["count"], count - 1);
        let places = finding["places"].as_array().expect("a list");
        assert_eq!((places.len(), &places[0]["line"]), (4, &finding["line"]));
    }
}

/// The whole answer about a small file, so that no key can come or go unseen.
#[test]
fn json_tells_what_each_book_makes_of_a_file() {
    let file = fixture("good/d3d12_skinned.m3d");
    let run = run(["check", "--json", "--book", "all", &file]);
    assert_eq!(run.code, Some(0), "--book alone denies nothing");
    let limits = json!([
        {"code": "book-clip-name", "message": "The demo plays the clip \"Take1\"; the file has \"Wave\"."},
        {"code": "book-handedness",
         "message": "The demo mirrors z, for right-handed models; this one is left-handed and is shown inside out."},
        {"code": "book-size",
         "message": "The demo scales by 0.05: the model is 2.00 high in its file and 0.100 there, beside a soldier of 3.6."},
    ]);
    let expected = json!([{"schemaVersion": 1, "file": file, "findings": [], "error": null, "book": {
        "converted": null,
        "d3d11": {
            "reads": false,
            "line": 9,
            "column": 1,
            "why": "It takes \"Name:\" for the label Ambient of material 0. In line 9 it reads Ambient of material 0 and finds \
                    \"skin\", which is no number.",
            "shows": "It ends with an error: it looks for a map without a name.",
            "ends": true,
            "limits": limits,
        },
        "d3d12": {
            "reads": true,
            "line": null,
            "column": null,
            "why": null,
            "shows": "It crashes at its first frame: there is no clip \"Take1\".",
            "ends": true,
            "limits": limits,
        },
    }}]);
    assert_eq!(run.json(), expected);
    let one = crate::program::run(["check", "--json", "--book", "d3d11", &file]).json();
    assert!(one[0]["book"]["d3d12"].is_null() && one[0]["book"]["d3d11"].is_object());
}

#[test]
fn a_book_is_told_with_the_line_at_which_it_goes_wrong() {
    let file = fixture("good/clip_names.m3d");
    let text = run(["check", "--book", "d3d12", &file]).fine();
    let line = text
        .lines()
        .find(|line| line.contains(": D3D12 demo: "))
        .expect("there is a verdict");
    assert!(
        line.starts_with(&format!(
            "{file}:56:8: D3D12 demo: cannot read it. It reads the number of keys"
        )),
        "{text}"
    );
    assert!(
        text.contains("   = one sees: It crashes at its first frame: there is no clip \"Take1\".\n"),
        "{text}"
    );
    assert!(text.contains("   = book-clip-name: "), "{text}");
}

/// What the page copies, beside what the table of codes says of it, and what it saves.
#[test]
fn the_report_of_a_session_is_that_of_the_command_line() {
    for name in ["subset_typos", "clip_names", "pose_overflows", "d3d12_skinned"] {
        let path = fixture(&format!("good/{name}.m3d"));
        let mut session = Session::new(true);
        let bytes = std::fs::read(&path).expect("a fixture");
        session.apply(FileCommand::Add(vec![File::new(&format!("{name}.m3d"), bytes)]));
        let text = run(["check", "--book", "all", &path]).out;
        let folder = path.strip_suffix(&format!("{name}.m3d")).expect("it ends so");
        let report = session.report();
        let mut lines = report.lines();
        for line in text.replace(folder, "").lines() {
            assert!(lines.any(|reported| reported.starts_with(line)), "{line}\n{report}");
        }
        let of_file = run(["check", "--book", "all", "--format", "sarif", &path]).json();
        let of_session = serde_json::to_value(session.sarif().expect("open")).expect("it can be written");
        for (pointer, count) in [("/runs/0/tool", None), ("/runs/0/results", Some(2))] {
            assert!(of_file.pointer(pointer).is_some(), "{pointer}");
            let without_path = |value: &Value| {
                let value = value.pointer(pointer).expect("it has one").to_string();
                value.replace(&path.replace(' ', "%20"), "").replace("file://", "")
            };
            assert_eq!(
                without_path(&of_session).replace(&format!("{name}.m3d"), ""),
                without_path(&of_file).replace(&format!("{name}.m3d"), "")
            );
            let results = of_session
                .pointer(pointer)
                .and_then(Value::as_array)
                .map_or(0, Vec::len);
            assert!(count.is_none_or(|least| results >= least), "{results}");
        }
    }
}

/// A mesh of so many vertices on each of so many nodes, one of them unused, as glTF.
fn gltf_with(vertices: usize, joints: usize) -> String {
    let mut bytes = Vec::new();
    for vertex in 0..vertices {
        let place = [[0.0_f32, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]][vertex % 3];
        bytes.extend(place.iter().flat_map(|number| number.to_le_bytes()));
    }
    let weights_at = bytes.len();
    bytes.extend(
        (0..vertices)
            .flat_map(|_| [1.0_f32, 0.0, 0.0, 0.0].map(f32::to_le_bytes))
            .flatten(),
    );
    let joints_at = bytes.len();
    bytes.extend((0..vertices).flat_map(|_| [0_u8; 4]));
    let view = |from: usize, to: usize| json!({"buffer": 0, "byteOffset": from, "byteLength": to - from});
    let accessor = |view: usize, kind: &str, component: u32| json!({"bufferView": view, "componentType": component, "count": vertices, "type": kind});
    let file = scratch(&format!("many_{vertices}_{joints}.gltf"));
    let data = file.with_extension("bin");
    std::fs::write(&data, &bytes).expect("can be written");
    let name = data.file_name().and_then(|name| name.to_str()).expect("UTF-8");
    let mut nodes = vec![
        json!({"mesh": 0, "skin": 0}),
        json!({"children": (2..=joints).collect::<Vec<_>>()}),
    ];
    nodes.extend((2..=joints).map(|_| json!({})));
    let text = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": nodes,
        "skins": [{"joints": (1..=joints).collect::<Vec<_>>()}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "WEIGHTS_0": 1, "JOINTS_0": 2}}]}],
        "buffers": [{"uri": name, "byteLength": bytes.len()}],
        "bufferViews": [view(0, weights_at), view(weights_at, joints_at), view(joints_at, bytes.len())],
        "accessors": [accessor(0, "VEC3", 5126), accessor(1, "VEC4", 5126), accessor(2, "VEC4", 5121)],
    });
    std::fs::write(&file, text.to_string()).expect("can be written");
    file.to_str().expect("UTF-8").to_owned()
}

#[test]
fn of_gltf_it_is_said_whether_it_fits_once_it_is_converted() {
    let fits = fixture("gltf/banner.glb");
    let told = run(["check", "--book", "all", "--deny", "book", &fits]);
    assert_eq!(told.code, Some(0), "{told:?}");
    let line = format!("{fits}: Book demos: converted for the book: fits\n");
    assert_eq!(told.out.matches("Book demos").count(), 1);
    assert!(
        told.out.contains(&line) && !told.out.contains("It skips"),
        "{}",
        told.out
    );

    let large = gltf_with(65_538, 120);
    let arguments = ["check", "--book", "d3d12", &large];
    let told = run(arguments);
    assert_eq!(told.code, Some(0), "{told:?}");
    for words in [
        "does not fit. The model has 120 bones; ",
        "The model has 65538 vertices; ",
    ] {
        assert!(told.out.contains(words), "{words} is not in {}", told.out);
    }
    assert_eq!(run([&arguments[..], &["--deny", "book"]].concat()).code, Some(1));
    let allowed = [
        &arguments[..],
        &["--deny", "book", "--allow", "many-bones,many-vertices"],
    ]
    .concat();
    assert_eq!(run(allowed).code, Some(0));
    let found = run([&arguments[..], &["--json"]].concat()).json();
    let converted = &found[0]["book"]["converted"];
    assert_eq!(
        (&converted["fits"], &found[0]["book"]["d3d12"]),
        (&json!(false), &Value::Null)
    );
    assert_eq!(converted["limits"].as_array().map(Vec::len), Some(2), "{found}");
    // The export says the same.
    let out = scratch("too_large.m3d");
    let refused = run(["convert", &large, out.to_str().expect("UTF-8"), "--for-book"]);
    assert_eq!(refused.code, Some(1), "{refused:?}");
    let log = run([&arguments[..], &["--format", "sarif"]].concat()).json();
    let results = log["runs"][0]["results"].as_array().expect("a list");
    assert!(results.iter().any(|result| result["ruleId"] == "many-bones"), "{log}");
    // A damaged one has its error and nothing of books.
    let damaged = run(["check", "--book", "all", &fixture("check/glb-damaged.glb")]);
    assert!(damaged.code == Some(1) && !damaged.out.contains("demo"), "{damaged:?}");
}

#[test]
fn what_is_denied_decides_the_exit_code() {
    let files = [
        ("NOTED", fixture("good/subset_typos.m3d")),
        ("WARNING", fixture("good/pose_overflows.m3d")),
        ("CHILD_FIRST", fixture("good/bones_child_first.m3d")),
        ("STATIC", fixture("good/d3d11_static.m3d")),
        ("EMPTY", fixture("bad/empty.m3d")),
    ];
    for (line, code) in [
        ("--deny warnings NOTED", 0),
        ("--deny warnings WARNING", 1),
        ("WARNING", 0),
        ("--deny subset-label NOTED", 1),
        ("--deny subset-label --allow subset-label NOTED", 0),
        ("--deny comment NOTED", 0),
        ("--deny warnings --allow pose-overflows WARNING", 0),
        ("--deny warnings --allow comment WARNING", 1),
        ("--deny book-size NOTED", 0),
        ("--deny book-clip-name --book d3d12 CHILD_FIRST", 1),
        // Errors cannot be allowed.
        ("--deny warnings --allow empty-file EMPTY", 1),
        // Without --book there is nothing of a book to deny.
        ("--deny book NOTED", 0),
        ("--deny book --book d3d12 NOTED", 1),
        ("--deny book --book d3d11 NOTED", 1),
        ("--deny book --book d3d11 STATIC", 0),
        ("--deny warnings,book --book d3d12 WARNING no/such.m3d", 2),
    ] {
        let file = |word: &str| {
            files
                .iter()
                .find(|(name, _)| *name == word)
                .map(|(_, file)| file.clone())
        };
        let arguments = line
            .split(' ')
            .map(|word| file(word).unwrap_or_else(|| word.to_owned()));
        let run = run(["check".to_owned()].into_iter().chain(arguments));
        assert_eq!(run.code, Some(code), "{line}\n{run:?}");
    }
}

#[test]
fn a_folder_is_every_model_below_it_in_order_with_counts_at_the_end() {
    let folder = scratch("tree");
    let inner = folder.join("b");
    std::fs::create_dir_all(&inner).expect("can be made");
    for (name, fixture_name) in [
        ("c.M3D", "good/d3d12_skinned.m3d"),
        ("a.m3d", "bad/empty.m3d"),
        ("b/x.m3d", "good/comment_above_header.m3d"),
        ("b/readme.txt", "bad/empty.m3d"),
    ] {
        std::fs::copy(fixture(fixture_name), folder.join(name)).expect("can be written");
    }
    let text = "VertexCount: 0\nTriangleCount: 0\nVertexList (pos, normal)\n{\n}\nTriangleList\n{\n}\n";
    std::fs::write(inner.join("skull.txt"), text).expect("can be written");
    let folder = folder.to_str().expect("UTF-8");
    let found = run(["check", "--json", folder]).json();
    let files: Vec<_> = found
        .as_array()
        .expect("a list")
        .iter()
        .map(|file| &file["file"])
        .collect();
    assert_eq!(
        files,
        [
            &format!("{folder}/a.m3d"),
            &format!("{folder}/b/skull.txt"),
            &format!("{folder}/b/x.m3d"),
            &format!("{folder}/c.M3D")
        ]
    );
    let text = run(["check", folder]);
    assert_eq!((text.code, text.err.as_str()), (Some(1), ""));
    assert_eq!(text.out.lines().last(), Some("4 files: 1 error, 0 warnings, 1 note"));
}

#[test]
fn standard_input_is_a_file_called_by_a_dash() {
    let bytes = std::fs::read(fixture("bad/blend_index_out_of_range.m3d")).expect("can be read");
    let told = run_with_input(bindpose().args(["check", "-"]), &bytes);
    assert_eq!(told.code, Some(1));
    assert!(told.out.starts_with("-:34:17: error[not-in-range]: "), "{}", told.out);
}

#[test]
fn a_folder_without_a_model_says_so_and_is_no_success_where_warnings_are_denied() {
    let folder = scratch_folder("no_models");
    let folder = folder.to_str().expect("UTF-8");
    let told = run(["check", folder]);
    assert_eq!(
        (told.code, told.out.as_str()),
        (Some(0), "0 files: 0 errors, 0 warnings, 0 notes\n")
    );
    assert_eq!(run(["check", folder, "--deny", "warnings"]).code, Some(1));
    assert_eq!(run(["check", folder, "--deny", "warnings", "--json"]).code, Some(1));
}

#[test]
fn an_unknown_code_is_refused_with_the_nearest() {
    let file = fixture("good/d3d12_skinned.m3d");
    for (option, asked, nearest) in [
        ("--deny", "warning", "warnings"),
        ("--deny", "weights-kut", "weights-cut"),
        ("--allow", "book-sise", "book-size"),
    ] {
        let deny: &[&str] = if option == "--allow" { &["--deny", "book"] } else { &[] };
        let told = run([&["check", &file], deny, &[option, asked]].concat());
        told.refused(2);
        let words = format!("there is no code \"{asked}\"; the nearest is \"{nearest}\"");
        assert!(told.err.contains(&words), "{}", told.err);
    }
}

#[test]
fn what_could_not_be_read_is_in_the_outputs_for_programs() {
    let good = fixture("good/d3d12_skinned.m3d");
    let arguments = ["check", "no/such model.m3d", &good];
    let told = run([&arguments[..], &["--json"]].concat());
    assert_eq!(told.code, Some(2));
    let found: Value = serde_json::from_str(&told.out).expect("is JSON");
    let error = "no/such model.m3d cannot be read: No such file or directory (os error 2)";
    let unread = json!({"schemaVersion": 1, "file": "no/such model.m3d", "findings": [], "book": null, "error": error});
    assert_eq!((&found[0], &found[1]["error"]), (&unread, &Value::Null));

    let told = run([&arguments[..], &["--format", "sarif"]].concat());
    assert_eq!(told.code, Some(2));
    let log: Value = serde_json::from_str(&told.out).expect("is JSON");
    assert_is_sarif(&log);
    let invocation = &log["runs"][0]["invocations"][0];
    assert_eq!(invocation["executionSuccessful"], false);
    let notification = &invocation["toolExecutionNotifications"][0];
    assert_eq!(
        (&notification["level"], &notification["message"]["text"]),
        (&json!("error"), &json!(error))
    );
    let uri = notification.pointer("/locations/0/physicalLocation/artifactLocation/uri");
    assert_eq!(uri, Some(&json!("no/such%20model.m3d")));
    let fine = run(["check", "--format", "sarif", &good]).json();
    let invocation = &fine["runs"][0]["invocations"][0];
    assert_eq!(invocation["executionSuccessful"], true);
    assert_eq!(invocation["toolExecutionNotifications"], json!([]));
}

#[test]
fn maps_are_looked_for_where_a_folder_is_given() {
    let folder = scratch_folder("maps");
    std::fs::write(folder.join("skin_norm.dds"), b"DDS no more").expect("can be written");
    std::fs::write(folder.join("holiday.png"), b"").expect("can be written");
    let (file, folder) = (fixture("good/d3d12_skinned.m3d"), folder.to_str().expect("UTF-8"));
    let found = run(["check", "--json", "--book", "d3d12", "--textures", folder, &file]).json();
    let findings = found[0]["findings"].as_array().expect("a list");
    let told: Vec<_> = findings
        .iter()
        .map(|finding| (&finding["code"], &finding["subject"]))
        .collect();
    let [map, other] = [0, 1].map(|index| json!({"kind": "map", "index": index}));
    let [missing, cut, unused] = ["map-missing", "dds-header-cut", "map-unused"].map(|code| json!(code));
    assert_eq!(told, [(&missing, &map), (&cut, &other), (&unused, &Value::Null)]);
    assert!(
        findings[2]["message"]
            .as_str()
            .is_some_and(|message| message.contains("holiday.png"))
    );
    let limits = found[0]["book"]["d3d12"]["limits"].as_array().expect("a list");
    assert!(limits.iter().any(|limit| limit["code"] == "map-missing"), "{limits:?}");
    // Folders are walked once, however many files are read.
    let absent = run(["check", "--textures", "no/such/folder", &file, &file]);
    let line = "error: no/such/folder cannot be read: ";
    assert!(
        absent.err.starts_with(line) && absent.err.lines().count() == 1,
        "{absent:?}"
    );
    absent.refused(2);
}

#[test]
fn a_map_that_three_materials_name_is_missing_once() {
    let folder = scratch_folder("map_of_three");
    let text = fixture_text("good/d3d12_skinned.m3d");
    let (before, rest) = text.split_once("Name:").expect("has a material");
    let (material, after) = rest.split_once("\n\n").expect("ends with an empty line");
    let others: String = ["Second", "Third"]
        .into_iter()
        .map(|name| {
            let lines = material.split_once('\n').expect("has lines").1;
            format!("Name: {name}\n{lines}\n\n")
        })
        .collect();
    let before = before.replacen("#Materials 1", "#Materials 3", 1);
    let after = after.replacen(
        "\n\n",
        "\nSubsetID: 1 VertexStart: 0 VertexCount: 0 FaceStart: 1 FaceCount: 0\n\
         SubsetID: 2 VertexStart: 0 VertexCount: 0 FaceStart: 1 FaceCount: 0\n\n",
        1,
    );
    let file = folder.join("three.m3d");
    std::fs::write(&file, format!("{before}Name:{material}\n\n{others}{after}")).expect("can be written");
    let (file, folder) = (file.to_str().expect("UTF-8"), folder.to_str().expect("UTF-8"));
    std::fs::write(format!("{folder}/skin_norm.dds"), b"DDS no more").expect("can be written");
    let found = run(["check", "--json", "--book", "d3d12", "--textures", folder, file]).json();
    let limits = found[0]["book"]["d3d12"]["limits"].as_array().expect("a list");
    let missing = limits.iter().find(|limit| limit["code"] == "map-missing");
    assert!(
        missing
            .and_then(|limit| limit["message"].as_str())
            .is_some_and(|message| message.starts_with("1 map is missing")),
        "{found}"
    );
}

#[test]
fn variables_of_the_environment_say_whether_there_are_colours() {
    let file = fixture("bad/empty.m3d");
    for (variables, is_colored) in [
        (&[("CLICOLOR_FORCE", "1")][..], true),
        (&[("CLICOLOR_FORCE", "0")], false),
        (&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")], false),
        (&[], false),
    ] {
        let mut command = bindpose();
        command
            .args(["check", &file])
            .env_remove("NO_COLOR")
            .env_remove("CLICOLOR_FORCE");
        let told = run_command(command.envs(variables.iter().copied()));
        assert_eq!(told.out.contains('\u{1b}'), is_colored, "{variables:?}: {told:?}");
    }
}

/// In a terminal of `script`, which the base system of Linux has.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_without_colours_gets_none() {
    let command = format!(
        "'{}' check '{}'",
        env!("CARGO_BIN_EXE_bindpose"),
        fixture("bad/empty.m3d")
    );
    for (terminal, is_colored) in [("xterm", true), ("dumb", false)] {
        let mut script = std::process::Command::new("script");
        script.args(["-qec", &command, "/dev/null"]).env("TERM", terminal);
        script.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
        let told = run_command(&mut script);
        assert!(told.out.contains("empty-file"), "{told:?}");
        assert_eq!(told.out.contains('\u{1b}'), is_colored, "{terminal}: {told:?}");
    }
}

#[test]
fn colours_are_for_terminals_and_for_those_who_ask() {
    let file = fixture("bad/empty.m3d");
    let plain = run(["check", &file]).out;
    assert!(!plain.contains('\u{1b}'), "{plain:?}");
    let colored = run(["check", "--color", "always", &file]).out;
    assert!(colored.contains("\u{1b}[31merror[empty-file]"), "{colored:?}");
    let without: String = colored
        .split("\u{1b}[")
        .map(|part| part.split_once('m').map_or(part, |(_, rest)| rest))
        .collect();
    assert!(without.contains("error[empty-file]: The file is empty."), "{without}");
}

/// By the standard's own schema, which a crate of its types brings along.
#[test]
fn sarif_is_valid_and_has_rules_and_utf16_columns() {
    let files = [
        "bad/blend_index_out_of_range.m3d",
        "good/names_repeated.m3d",
        "good/clip_names.m3d",
    ]
    .map(fixture);
    let run = run(["check", "--format", "sarif", "--book", "all"]
        .iter()
        .copied()
        .chain(files.iter().map(String::as_str)));
    assert_eq!(run.code, Some(1));
    let log: Value = serde_json::from_str(&run.out).expect("is JSON");
    assert_is_sarif(&log);
    let results = log["runs"][0]["results"].as_array().expect("a list");
    let rules = log["runs"][0]["tool"]["driver"]["rules"].as_array().expect("a list");
    for result in results {
        let rule = &rules[result["ruleIndex"].as_u64().expect("an index") as usize];
        assert_eq!(rule["id"], result["ruleId"]);
        for part in ["help", "fullDescription"] {
            assert!(
                rule[part]["text"].as_str().is_some_and(|text| text.len() > 10),
                "{rule}"
            );
        }
        let region = result.pointer("/locations/0/physicalLocation/region/startLine");
        assert!(region.is_some_and(Value::is_u64), "{result}");
    }
    let first = &results[0];
    assert_eq!(
        (&first["ruleId"], &first["level"]),
        (&json!("not-in-range"), &json!("error"))
    );
    let region = &first["locations"][0]["physicalLocation"]["region"];
    assert_eq!(region, &json!({"startLine": 34, "startColumn": 17, "endColumn": 18}));
    assert!(results.iter().any(|result| result["ruleId"] == "book-stops"));
    let whole_file = results
        .iter()
        .find(|result| result["ruleId"] == "book-handedness")
        .expect("is there");
    let region = whole_file.pointer("/locations/0/physicalLocation/region");
    assert_eq!(region, Some(&json!({"startLine": 1})));
}

/// By the standard's own schema.
fn assert_is_sarif(log: &Value) {
    let mut schema: Value = serde_json::from_str(&sarif_schema()).expect("is JSON");
    // The standard's pattern for languages has a bracket too many, which is no regular expression.
    for part in ["run", "toolComponent"] {
        let language = schema["definitions"][part]["properties"]["language"].as_object_mut();
        language.expect("is there").remove("pattern");
    }
    let validator = jsonschema::validator_for(&schema).expect("is a schema");
    let errors: Vec<String> = validator
        .iter_errors(log)
        .map(|error| format!("{}: {error}", error.instance_path()))
        .collect();
    assert!(errors.is_empty(), "{errors:?}");
    // The validator can fail.
    let mut broken = log.clone();
    broken["runs"][0]["columnKind"] = json!("bad");
    assert!(!validator.is_valid(&broken));
}

/// The schema of SARIF 2.1.0 in the sources of the crate `serde-sarif`, which this crate's tests depend on.
fn sarif_schema() -> String {
    let target = std::process::Command::new("rustc")
        .arg("-vV")
        .output()
        .expect("rustc runs")
        .stdout;
    let target = String::from_utf8(target).expect("prints UTF-8");
    let target = target
        .lines()
        .find_map(|line| line.strip_prefix("host: "))
        .expect("it says for whom it builds");
    // What this machine builds is there; packages of other platforms need not be.
    let metadata = std::process::Command::new(env!("CARGO"))
        .args(words("metadata --format-version 1 --offline --filter-platform"))
        .arg(target)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs");
    let metadata: Value = serde_json::from_slice(&metadata.stdout).expect("is JSON");
    let packages = metadata["packages"].as_array().expect("a list");
    let package = packages
        .iter()
        .find(|package| package["name"] == "serde-sarif")
        .expect("is there");
    let manifest = package["manifest_path"].as_str().expect("a path");
    let path = std::path::Path::new(manifest).with_file_name("src").join("schema.json");
    std::fs::read_to_string(path).expect("can be read")
}
