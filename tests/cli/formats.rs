//! FBX, with pictures beside it, and the books' `.txt` wherever a model is taken: info, check, pose, render. convert.rs converts them.

use std::fs;

use bindpose::image::encode_png;
use glam::Vec3;
use serde_json::{Value, json};

use crate::program::{fixture, fixture_text, run, scratch_file, scratch_folder};
use crate::render::{draw, extent};

/// What f32 may lose in a turn.
const ROUNDING: f32 = 1e-6;

fn arm() -> String {
    fixture("fbx/arm.fbx")
}

/// A triangle as the books' `car.txt` has them.
fn triangle(name: &str, corners: &str) -> String {
    let text = format!(
        "VertexCount: 3\nTriangleCount: 1\nVertexList (pos, normal)\n{{\n\t0 0 0 0 0 -1\n\t0 1 0 0 0 -1\n\t1 0 0 0 0 -1\n}}\n\
         TriangleList\n{{\n\t{corners}\n}}\n"
    );
    scratch_file(name, text)
}

#[test]
fn info_says_what_is_in_them() {
    let found = run(["info", "--json", &arm()]).json();
    let expected = json!({
        "dialect": "fbx-text",
        "handedness": "right",
        "up_axis": "y",
        "counts": {"materials": 1, "vertices": 4, "triangles": 2, "bones": 2, "clips": 1},
        "bones": [{"name": "Lower", "parent": null}, {"name": "Upper", "parent": 0}],
        "materials": ["Paint"],
        "bind_bounds": {"min": [-0.25, 0.0, 0.0], "max": [0.25, 2.0, 0.0]},
        "notices": [],
    });
    assert_has(&found, &expected);
    let clip = json!({"name": "Swing", "start_secs": 0.0, "end_secs": 1.0});
    assert_has(&found["clips"][0], &clip);
    assert!(
        run(["info", &arm()])
            .fine()
            .contains("FBX as text, right-handed, y up\n")
    );

    let file = triangle("info.txt", "0 1 2");
    let found = run(["info", "--json", &file]).json();
    let expected = json!({
        "dialect": "txt",
        "handedness": "left",
        "counts": {"materials": 1, "vertices": 3, "triangles": 1, "bones": 0, "clips": 0},
        "clips": [],
        "bind_bounds": {"min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 0.0]},
        "notices": [],
    });
    assert_has(&found, &expected);
}

/// All that is expected is there, whatever else is.
fn assert_has(found: &Value, expected: &Value) {
    for (key, value) in expected.as_object().expect("an object") {
        assert_eq!(found[key], *value, "{key}");
    }
}

#[test]
fn check_names_the_line_of_what_is_wrong() {
    for file in [&arm(), &triangle("sound.txt", "0 1 2")] {
        let run = run(["check", file]);
        assert_eq!((run.code, run.out.as_str(), run.err.as_str()), (Some(0), "", ""));
    }
    let file = scratch_file("wrong.fbx", fixture_text("fbx/arm.fbx").replace("0,1,2,-4", "0,1,2,-9"));
    let checked = run(["check", &file]);
    let expected = format!(
        "{file}:22:3: error[vertex-out-of-range]: In \"Strip\": PolygonVertexIndex: A polygon names control point 8, but there are 4.\n"
    );
    assert_eq!(checked.code, Some(1));
    assert!(checked.out.starts_with(&expected), "{}", checked.out);

    let file = triangle("wrong.txt", "0 1 3");
    let checked = run(["check", &file]);
    let expected = format!(
        "{file}:11:6: error[not-in-range]: A vertex index must be a whole number from 0 to 2, but \"3\" was found.\n"
    );
    assert_eq!(checked.code, Some(1));
    assert!(checked.out.starts_with(&expected), "{}", checked.out);
}

fn positions(posed: &Value) -> Vec<Vec3> {
    let positions: Vec<[f32; 3]> = serde_json::from_value(posed["positions"].clone()).expect("positions");
    positions.into_iter().map(Vec3::from).collect()
}

#[test]
fn pose_has_vertices_where_their_bones_bring_them() {
    for (secs, degrees) in [("0", 0.0f32), ("0.5", 45.0), ("0.9", 81.0), ("7", 90.0)] {
        let posed = run([
            "pose",
            &arm(),
            "--clip",
            "Swing",
            "--time",
            secs,
            "--json",
            "--positions",
        ])
        .json();
        let found = positions(&posed);
        // The upper end turns about the elbow, 1 above the ground.
        let (sin, cos) = degrees.to_radians().sin_cos();
        let turned = |x: f32| Vec3::new(x * cos - sin, 1.0 + x * sin + cos, 0.0);
        let expected = [
            Vec3::new(-0.25, 0.0, 0.0),
            Vec3::new(0.25, 0.0, 0.0),
            turned(0.25),
            turned(-0.25),
        ];
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                found.distance(expected) < ROUNDING,
                "{secs} s: {found} is not {expected}"
            );
        }
        assert_eq!(posed["palette"].as_array().map(Vec::len), Some(2));
    }
    let posed = run(["pose", &triangle("pose.txt", "0 1 2"), "--json", "--positions"]).json();
    assert_eq!((&posed["clip"], &posed["palette"]), (&Value::Null, &json!([])));
    assert_eq!(positions(&posed), [Vec3::ZERO, Vec3::Y, Vec3::X]);
}

/// The strip stands, and at the end of its clip its upper half lies to the left.
#[test]
fn render_draws_them() {
    let drawn = |name: &str, file: &str, more: &[&str]| {
        let arguments = [&["--size", "96x96", "--view", "front", "--transparent"], more].concat();
        let (picture, _) = draw(name, file, &arguments);
        let [left, right, top, bottom] = extent(&picture).expect("something is drawn");
        (picture, right - left, bottom - top)
    };
    let (picture, width, height) = drawn("arm.png", &arm(), &["--clip", "Swing", "--time", "0"]);
    assert!(height > 2 * width && width > 8, "{width} × {height}");
    let is_red = |texel: &&image::Rgba<u8>| texel[3] > 127 && u16::from(texel[0]) > 2 * u16::from(texel[1]);
    let red = picture.pixels().filter(is_red).count();
    assert!(red > 400, "{red} texels of the file's red");
    let (_, turned_width, turned_height) = drawn("turned.png", &arm(), &["--clip", "Swing", "--time", "1"]);
    assert!(
        turned_width > 2 * width && turned_height < height,
        "{turned_width} × {turned_height}"
    );
    let (_, width, height) = drawn("triangle.png", &triangle("render.txt", "0 1 2"), &[]);
    assert!(width.abs_diff(height) <= 2 && width > 40, "{width} × {height}");
}

/// A triangle whose colour is a picture.
const CARD: &str = "; FBX 7.4.0 project file
Objects:  {
\tGeometry: 1, \"Geometry::\", \"Mesh\" {
\t\tVertices: *9 {
\t\t\ta: 0,0,0,1,0,0,1,1,0
\t\t}
\t\tPolygonVertexIndex: *3 {
\t\t\ta: 0,1,-3
\t\t}
\t}
\tModel: 2, \"Model::Card\", \"Mesh\" {
\t}
\tMaterial: 3, \"Material::Paint\", \"\" {
\t}
\tTexture: 4, \"Texture::\", \"\" {
\t\tRelativeFilename: \"PATH\"
\t}
}
Connections:  {
\tC: \"OO\",1,2
\tC: \"OO\",2,0
\tC: \"OO\",3,2
\tC: \"OP\",4,3,\"DiffuseColor\"
}
";

/// Programs unpack what lies in NAME.fbx into NAME.fbm, and the path in the file is often one of another machine.
#[test]
fn pictures_are_found_beside_the_file_and_in_its_folder_of_pictures() {
    let png = encode_png(&[10, 20, 30, 255], 1, 1).expect("one pixel");
    for (at, (path, place)) in [
        ("skin.png", "skin.png"),
        ("card.fbm\\skin.png", "card.fbm/skin.png"),
        ("C:\\work\\other.fbm\\skin.png", "card.fbm/skin.png"),
        ("maps\\skin.png", "card.fbm/skin.png"),
    ]
    .into_iter()
    .enumerate()
    {
        let folder = scratch_folder(&format!("fbm_{at}"));
        let file = folder.join("card.fbx");
        fs::write(&file, CARD.replace("PATH", path)).expect("can be written");
        let state = || {
            let found = run(["info", "--json", file.to_str().expect("UTF-8")]).json();
            assert_eq!(found["maps"][0]["name"], "skin.png");
            found["maps"][0]["state"].clone()
        };
        assert_eq!(state(), json!("missing"), "{path}");
        fs::create_dir_all(folder.join("card.fbm")).expect("can be made");
        fs::write(folder.join(place), &png).expect("can be written");
        assert_eq!(state(), json!("found"), "{path}");
    }
}
