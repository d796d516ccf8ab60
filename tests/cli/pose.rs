//! `bindpose pose`, against the books' animation in f64.

use bindpose::format::{self, Document};
use serde_json::Value;

use crate::program::{FIGURE, fixture, run, scratch_file, shared};
use crate::textbook;

/// What f32 may lose over a chain of joints, at the size of the models.
const TOLERANCE: f64 = 1e-4;

/// Before, inside and after every clip, on keys and between them.
const TIMES_SECS: [f32; 5] = [-1.0, 0.0, 0.371, 0.5, 99.0];

fn document(file: &str) -> Document {
    format::parse(&std::fs::read(file).expect("is there"))
        .expect("is sound")
        .document
}

fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().expect("a list").iter();
    list.map(|number| number.as_f64().expect("a number")).collect()
}

fn assert_close(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (found_number, expected_number) in found.iter().zip(expected) {
        let tolerance = TOLERANCE * expected_number.abs().max(1.0);
        assert!(
            (found_number - expected_number).abs() <= tolerance,
            "{what}: {found:?}, not {expected:?}"
        );
    }
}

/// Every bone of every clip of a file, and every vertex that weighs 1 in all.
fn assert_as_in_the_books(file: &str) {
    let document = document(file);
    for (index, clip) in document.clips.iter().enumerate() {
        for time_secs in TIMES_SECS {
            let time = time_secs.to_string();
            let at = ["--clip", &clip.name, "--time", &time];
            let found = run(["pose", file, "--json", "--positions"].iter().chain(&at)).json();
            let keys: Vec<&String> = found.as_object().expect("an object").keys().collect();
            assert_eq!(keys, ["clip", "palette", "positions", "schemaVersion", "time_secs"]);
            assert_eq!(found["clip"], clip.name.as_str());
            assert_eq!(found["time_secs"].as_f64().map(|secs| secs as f32), Some(time_secs));

            let palette = textbook::palette(&document, index, f64::from(time_secs));
            let matrices = found["palette"].as_array().expect("a list");
            assert_eq!(matrices.len(), palette.len());
            for (bone, (matrix, expected)) in matrices.iter().zip(&palette).enumerate() {
                let what = format!("bone {bone} of {} at {time} s", clip.name);
                assert_close(&numbers(matrix), expected.as_flattened(), &what);
            }
            let positions = found["positions"].as_array().expect("a list");
            assert_eq!(positions.len(), document.vertices.len());
            for (number, (position, vertex)) in positions.iter().zip(&document.vertices).enumerate() {
                let weights = normalised(vertex.blend_weights.map(f64::from));
                let expected = textbook::skinned(vertex.position, weights, vertex.blend_indices, &palette);
                assert_close(&numbers(position), &expected, &format!("vertex {number} at {time} s"));
            }
        }
    }
}

/// The books leave out the fourth weight and give it what the others leave; that is the same for weights that sum to 1.
fn normalised(weights: [f64; 4]) -> [f64; 4] {
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

/// The child stands before its parent in the file: what comes out is in the file's order all the same.
#[test]
fn bones_and_vertices_come_in_the_order_of_the_file() {
    assert_as_in_the_books(&fixture("good/bones_child_first.m3d"));
}

/// Three bones of which each stands at another place when sorted, so that an order cannot be taken for its inverse.
#[test]
fn an_order_is_not_its_inverse() {
    let mut document = document(&fixture("good/bones_child_first.m3d"));
    document.bone_parents = vec![2, -1, 1];
    let offset = document.bone_offsets[1];
    document.bone_offsets.push(offset.map(|number| number * 2.0));
    document.bone_offsets[2][15] = 1.0;
    for clip in &mut document.clips {
        let mut third = clip.bones[1].clone();
        for key in &mut third.keyframes {
            key.translation = [0.25, 0.5, -3.0];
        }
        clip.bones.push(third);
    }
    let file = &scratch_file("three_bones.m3d", format::write(&document));
    assert_as_in_the_books(file);
}

#[test]
fn every_clip_of_the_figure_is_as_in_the_books() {
    assert_as_in_the_books(FIGURE);
}

#[test]
fn the_real_soldier_is_as_in_the_books() {
    if let Some(file) = shared("models/d3d12/soldier.m3d") {
        assert_as_in_the_books(&file);
    }
}

#[test]
fn positions_come_only_when_asked_for_and_the_only_clip_needs_no_name() {
    let file = fixture("good/bones_child_first.m3d");
    let found = run(["pose", &file, "--time", "0.25", "--json"]).json();
    let keys: Vec<&String> = found.as_object().expect("an object").keys().collect();
    assert_eq!(keys, ["clip", "palette", "schemaVersion", "time_secs"]);
    assert_eq!(found["clip"], "Wave");
}

#[test]
fn a_model_without_clips_is_as_it_was_bound() {
    let file = fixture("good/bones_without_clips.m3d");
    let document = document(&file);
    let found = run(["pose", &file, "--json", "--positions"]).json();
    assert_eq!(found["clip"], Value::Null);
    let matrices = found["palette"].as_array().expect("a list");
    assert_eq!(matrices.len(), document.bone_offsets.len());
    for matrix in matrices {
        assert_eq!(numbers(matrix), textbook::IDENTITY.as_flattened());
    }
    for (position, vertex) in found["positions"]
        .as_array()
        .expect("a list")
        .iter()
        .zip(&document.vertices)
    {
        assert_close(&numbers(position), &vertex.position.map(f64::from), "a vertex");
    }
}

#[test]
fn the_text_has_four_rows_for_each_bone() {
    let file = fixture("good/bones_child_first.m3d");
    let text = run(["pose", &file, "--time", "0", "--positions"]).fine();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines[0], lines[1], lines[6]), ("Wave at 0 s", "bone 0", "bone 1"));
    let row: Vec<f32> = lines[5]
        .split_whitespace()
        .map(|word| word.parse().expect("a number"))
        .collect();
    assert_eq!(row, [0.0, 1.0, 0.0, 1.0], "bone 0 hangs at the place of bone 1");
    assert_eq!(lines.len(), 1 + 2 * 5 + 3);
}

#[test]
fn an_unknown_clip_is_answered_with_those_there_are() {
    let run_with = |arguments: &[&str]| run(["pose", FIGURE, "--json"].iter().chain(arguments));
    let unknown = run_with(&["--clip", "Swim", "--time", "0"]);
    unknown.refused_with(2, "there is no clip \"Swim\"");
    let unnamed = run_with(&["--time", "0"]);
    assert_eq!(unnamed.code, Some(2));
    for clip in document(FIGURE).clips {
        for run in [&unknown, &unnamed] {
            assert!(run.err.contains(&format!("\"{}\"", clip.name)), "{}", run.err);
        }
    }
}

#[test]
fn a_key_at_a_time_that_is_no_number_changes_nothing() {
    let (sound, odd) = (
        fixture("good/d3d12_skinned.m3d"),
        fixture("good/key_times_not_finite.m3d"),
    );
    for time_secs in TIMES_SECS {
        let pose = |file: &str| run(["pose", file, "--time", &time_secs.to_string(), "--json", "--positions"]).json();
        assert_eq!(pose(&odd), pose(&sound), "at {time_secs} s");
    }
}

/// JSON has no infinity: a number that overflowed would be null.
#[test]
fn a_pose_that_overflows_is_an_error_and_its_bounds_are_left_out_with_a_notice() {
    let file = fixture("good/pose_overflows.m3d");
    for arguments in [&["--json"][..], &[], &["--json", "--positions"]] {
        let at = |time_secs: &str| run(["pose", &file, "--time", time_secs].iter().chain(arguments));
        assert!(!at("0").fine().contains("null"));
        let overflowed = at("0.5");
        overflowed.refused(1);
        let words = "at 0.5 s of \"Wave\" bone 1 is taken beyond what numbers hold\n";
        assert!(overflowed.err.ends_with(words), "{}", overflowed.err);
    }
    let info = run(["info", "--json", &file]).json();
    assert_eq!(info["animated_bounds"], Value::Null);
    assert!(info["bind_bounds"]["max"].is_array());
    let [notice] = info["notices"].as_array().expect("a list").as_slice() else {
        panic!("{info}")
    };
    assert_eq!(notice["code"], "pose-overflows");
    assert_eq!(
        notice["message"],
        "At 0.5 s of \"Wave\" bone 1, or a vertex on it, is taken beyond 10³⁷: numbers overflow there."
    );
    let text = run(["info", &file]).fine();
    assert!(
        text.contains("beyond what numbers hold") && !text.contains("inf"),
        "{text}"
    );
}

/// The bones fit into numbers, a vertex does not.
#[test]
fn a_vertex_that_overflows_is_named() {
    let mut document = document(&fixture("good/d3d12_skinned.m3d"));
    document.vertices[2].position = [0.0, 1e20, 0.0];
    document.clips[0].bones[1].keyframes[1].scale = [1e20; 3];
    let file = &scratch_file("vertex_overflows.m3d", format::write(&document));
    let pose = |arguments: &[&str]| run(["pose", file, "--time", "0.5"].iter().chain(arguments));
    assert_eq!(pose(&["--json"]).code, Some(0));
    let overflowed = pose(&["--json", "--positions"]);
    overflowed.refused_with(1, "vertex 2 is taken beyond");
}
