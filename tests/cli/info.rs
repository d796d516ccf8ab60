//! `bindpose info`.

use serde_json::{Value, json};

use crate::program::{
    FIGURE, bindpose, fixture, fixture_text, run, run_with_input, scratch, scratch_file, scratch_folder, shared,
};

/// f32 arithmetic of a turn by 90°.
const ROUNDING: f64 = 1e-6;

/// The whole object, so that no key can come or go unseen.
#[test]
fn json_says_all_of_a_skinned_file() {
    let file = fixture("good/bones_child_first.m3d");
    let mut found = run(["info", &file, "--json"]).json();
    // Bone 1 stands at (0, 1, 0) and turns by 90° about z; bone 0 hangs on it, at its place. So the three vertices go from
    // (0, 1), (1, 1), (0, 2) to (0, 1), (0, 2), (−1, 1).
    let z = -4.884_964e-7;
    assert_close(&found["animated_bounds"].take(), [[-1.0, 1.0, z], [1.0, 2.0, 0.0]]);
    assert_close(&found["bind_bounds"].take(), [[0.0, 0.0, z], [1.0, 2.0, 0.0]]);
    let expected = json!({
        "schemaVersion": 1,
        "file": file,
        "dialect": "d3d12",
        "handedness": "left",
        "up_axis": "y",
        "counts": {"materials": 1, "vertices": 3, "triangles": 1, "bones": 2, "clips": 1},
        "materials": ["skin"],
        "maps": [
            {"material": "skin", "slot": "diffuse", "name": "skin_diff.dds", "state": null, "path": null, "problem": null},
            {"material": "skin", "slot": "normal", "name": "skin_norm.dds", "state": null, "path": null, "problem": null},
        ],
        "clips": [{"name": "Wave", "start_secs": 0.0, "end_secs": 0.5, "keys_per_sec": 2.0, "keys": 3}],
        "bind_bounds": null,
        "animated_bounds": null,
        "bones": [{"name": null, "parent": 1}, {"name": null, "parent": null}],
        "notices": [note(json!({
            "code": "bones-reordered",
            "message": "1 bone stands before the parent; the joints are sorted and keep the file's numbers for display.",
            "line": 51,
            "column": 1,
            "subject": {"kind": "bone", "index": 0},
            "places": [{"line": 51, "column": 1}],
        }))],
    });
    assert_eq!(found, expected);
}

/// All keys of a note: those that are given, and the others as they are where there is nothing to say.
fn note(given: Value) -> Value {
    let mut note = json!({
        "severity": "note", "code": null, "message": null, "line": null, "column": null, "json_pointer": null,
        "byte_offset": null, "expected": null, "found": null, "subject": null, "time_secs": null, "bone": null,
        "count": 1, "places": [],
    });
    let Value::Object(given) = given else { panic!("{given}") };
    note.as_object_mut().expect("an object").extend(given);
    note
}

fn assert_close(bounds: &Value, expected: [[f64; 3]; 2]) {
    let keys: Vec<&String> = bounds.as_object().expect("an object").keys().collect();
    assert_eq!(keys, ["max", "min"]);
    for (end, expected) in ["min", "max"].into_iter().zip(expected) {
        let corner = bounds[end].as_array().expect("three numbers");
        assert_eq!(corner.len(), 3);
        for (number, expected) in corner.iter().zip(expected) {
            let number = number.as_f64().expect("a number");
            assert!((number - expected).abs() <= ROUNDING, "{end}: {number}, not {expected}");
        }
    }
}

/// Of the parser, the model and its checks. Findings about the whole file come first, then those with a place.
#[test]
fn notices_come_from_all_stages_in_the_order_of_the_file() {
    let found = run(["info", "--json", &fixture("good/subset_typos.m3d")]).json();
    let expected = json!([
        note(json!({
            "code": "handedness-unclear",
            "message": "1 of 2 triangles wind as in a left-handed file, the rest as in a right-handed one.",
        })),
        note(json!({
            "code": "subset-vertex-range",
            "message": "2 values of vertex ranges of the subset table are unreadable; they are not used.",
            "line": 30,
            "column": 26,
            "count": 2,
            "places": [{"line": 30, "column": 26}, {"line": 30, "column": 41}],
        })),
        note(json!({
            "code": "subset-label",
            "message": "A label of the subset table is spelt \"VetexCount:\"; it was read by its place.",
            "line": 30,
            "column": 29,
            "found": "VetexCount:",
            "places": [{"line": 30, "column": 29}],
        })),
        note(json!({
            "code": "triangles-repeated",
            "message": "1 triangle has the same three vertices as another one before.",
            "line": 51,
            "column": 1,
            "subject": {"kind": "triangle", "index": 1},
            "places": [{"line": 51, "column": 1}],
        })),
    ]);
    assert_eq!(found["notices"], expected);
}

#[test]
fn a_static_model_is_as_large_in_its_clips_as_it_is() {
    let found = run(["info", "--json", &fixture("good/d3d11_static.m3d")]).json();
    assert_eq!((&found["dialect"], &found["clips"]), (&json!("d3d11"), &json!([])));
    assert!(found["bind_bounds"]["max"].is_array());
    assert_eq!(found["bind_bounds"], found["animated_bounds"]);
}

#[test]
fn the_text_names_and_counts_what_is_there() {
    let text = run(["info", FIGURE]).fine();
    let found = run(["info", "--json", FIGURE]).json();
    for list in [&found["materials"], &found["clips"]] {
        for entry in list.as_array().expect("a list") {
            let name = entry.as_str().or_else(|| entry["name"].as_str()).expect("a name");
            assert!(text.contains(name), "{name} is not in\n{text}");
        }
    }
    let vertices = found["counts"]["vertices"].as_u64().expect("a count");
    assert!((1_000..1_000_000).contains(&vertices), "the figure has thousands");
    let grouped = format!("{},{:03}", vertices / 1000, vertices % 1000);
    assert!(
        text.contains(&format!("Vertices{grouped:>14}\n")),
        "{grouped} is not in\n{text}"
    );
}

/// A name from a file cannot steer the terminal; in JSON it stays as it is.
#[test]
fn control_characters_are_not_printed() {
    let text = fixture_text("good/bones_child_first.m3d");
    let text = text.replace("AnimationClip Wave", "AnimationClip Wa\u{1b}[31mve");
    let file = &scratch_file("control.m3d", text);
    let printed = run(["info", file]).fine();
    assert!(
        printed.contains("Wa\u{fffd}[31mve") && !printed.contains('\u{1b}'),
        "{printed}"
    );
    let found = run(["info", "--json", file]).json();
    assert_eq!(found["clips"][0]["name"], "Wa\u{1b}[31mve");
}

/// A line end in a name is no line end of the output, and large numbers stay apart.
#[test]
fn names_stay_on_their_lines_and_numbers_in_their_columns() {
    let text = fixture_text("gltf/leaf-and-glass.gltf");
    let name = "\"name\": \"Leaf\"";
    assert!(text.contains(name), "{text}");
    let text = text.replace(name, "\"name\": \"Leaf\\n0 errors\"");
    let file = &scratch_file("forged.gltf", text);
    let printed = run(["info", file]).fine();
    assert!(printed.contains("Leaf\u{fffd}0 errors"), "{printed}");

    let text = fixture_text("good/bones_child_first.m3d");
    let line = text
        .lines()
        .find(|line| line.starts_with("Position: "))
        .expect("a vertex");
    let far = text.replacen(line, "Position: -3617036800 -3208518912 -3000000000", 1);
    let file = &scratch_file("far.m3d", far);
    let printed = run(["info", file]).fine();
    let row = printed
        .lines()
        .find(|line| line.starts_with("  bind min"))
        .expect("a row");
    assert_eq!(row.split_whitespace().count(), 5, "{printed}");
}

#[test]
fn standard_input_is_read() {
    let bytes = std::fs::read(fixture("good/bones_child_first.m3d")).expect("is there");
    for command in ["info", "pose"] {
        let told = run_with_input(bindpose().args([command, "-", "--json"]), &bytes).json();
        assert_eq!(told["schemaVersion"], 1, "{told}");
    }
}

/// No width is made of a name alone: the formatter takes none above 65 535.
#[test]
fn names_of_any_length_are_printed() {
    let long = "n".repeat(65_536);
    let text = fixture_text("good/bones_child_first.m3d");
    let text = text
        .replace("Name: skin\n", &format!("Name: {long}m\n"))
        .replace("AnimationClip Wave\n", &format!("AnimationClip {long}c\n"))
        .replace("skin_diff.dds", &format!("{long}d.dds"));
    let file = &scratch_file("long_names.m3d", text);
    let folder = scratch_folder("no_textures");
    let folder = folder.to_str().expect("UTF-8");
    let printed = run(["info", file, "--textures", folder]).fine();
    for row in ["m  ", "c  ", "d.dds  missing\n"] {
        assert!(printed.contains(&format!("  {long}{row}")), "{row} has no row");
    }
    assert!(
        printed.contains("  skin_norm.dds                   "),
        "columns stay narrow"
    );

    let nowhere = format!("{long}.m3d");
    let run = run(["info", &nowhere]);
    run.refused(2);
    assert!(run.err.starts_with(&format!("error: {nowhere} cannot be read: ")));
}

#[test]
fn maps_are_found_missing_or_unreadable() {
    let folder = scratch("info_art");
    std::fs::create_dir_all(folder.join("deep")).expect("makes a folder");
    let picture = folder.join("deep/SKIN_diff.png");
    image::RgbaImage::new(2, 2).save(&picture).expect("writes");
    let damaged = folder.join("skin_norm.dds");
    std::fs::write(&damaged, "DDS ").expect("writes");
    let file = fixture("good/bones_child_first.m3d");
    let arguments = ["info", &file, "--textures", folder.to_str().expect("UTF-8")];

    let told = run(arguments);
    assert_eq!(told.err, "");
    let printed = told.fine();
    let rows = format!(
        "2 maps\n  skin_diff.dds  found       {}\n  skin_norm.dds  unreadable  {}\n",
        picture.display(),
        damaged.display()
    );
    assert!(printed.contains(&rows), "{rows} is not in\n{printed}");

    let maps = || run([&arguments[..], &["--json"]].concat()).json()["maps"].take();
    assert_eq!(
        maps(),
        json!([
            {"material": "skin", "slot": "diffuse", "name": "skin_diff.dds", "state": "found", "path": picture, "problem": null},
            {
                "material": "skin", "slot": "normal", "name": "skin_norm.dds", "state": "unreadable", "path": damaged,
                "problem": "skin_norm.dds: the DDS header takes 128 bytes, and the file has 4",
            },
        ])
    );
    std::fs::remove_file(&damaged).expect("was written");
    let missing = json!({
        "material": "skin", "slot": "normal", "name": "skin_norm.dds", "state": "missing", "path": null, "problem": null,
    });
    assert_eq!(maps()[1], missing);
    let nowhere = run(["info", &file, "--textures", "/no/such/folder"]);
    assert_eq!(nowhere.code, Some(2));
}

#[test]
fn a_file_with_an_error_has_no_info() {
    let file = fixture("bad/blend_index_out_of_range.m3d");
    for arguments in [vec!["info", &file], vec!["info", &file, "--json"]] {
        let run = run(arguments);
        run.refused(1);
        let line = format!(
            "{file}:34:17: error[not-in-range]: A blend index must be a whole number from 0 to 1, but \"2\" was found.\n"
        );
        assert!(run.err.starts_with(&line), "{}", run.err);
    }
}

#[test]
fn the_real_soldier_is_counted() {
    let Some(file) = shared("models/d3d12/soldier.m3d") else {
        return;
    };
    let found = run(["info", "--json", &file]).json();
    assert_eq!(
        found["counts"],
        json!({"materials": 5, "vertices": 13_748, "triangles": 22_507, "bones": 58, "clips": 1})
    );
    assert_eq!(
        (&found["handedness"], &found["up_axis"]),
        (&json!("right"), &json!("y"))
    );
    assert_eq!(found["clips"][0]["name"], "Take1");
}

#[test]
fn the_real_dialects_are_told_apart() {
    for (path, dialect, up_axis) in [
        ("models/d3d11/tree.m3d", "d3d11", "y"),
        ("models/imm/column.m3d", "imm", "z"),
    ] {
        let Some(file) = shared(path) else { continue };
        let found = run(["info", "--json", &file]).json();
        assert_eq!(
            (&found["dialect"], &found["up_axis"]),
            (&json!(dialect), &json!(up_axis))
        );
    }
}
