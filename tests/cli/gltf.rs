//! glTF wherever a model is taken: info, check, pose, render, convert.

use glam::{Affine3A, Quat, Vec3};
use serde_json::{Value, json};

use crate::program::{fixture, run, scratch, shared};

/// All on whom real files are tried, with the clip that is posed.
const REAL: [(&str, &str); 5] = [
    ("CesiumMan.glb", "Anim_0"),
    ("Fox.glb", "Run"),
    ("RiggedSimple.glb", "Anim_0_Armature"),
    ("RobotExpressive.glb", "Dance"),
    ("SimpleSkin.gltf", "clip 0"),
];

fn banner() -> String {
    fixture("gltf/banner.glb")
}

fn out(name: &str) -> String {
    scratch(&format!("gltf_{name}")).to_str().expect("UTF-8").to_owned()
}

fn positions(file: &str, clip: &str, secs: &str) -> Vec<Vec3> {
    let posed = run(["pose", file, "--clip", clip, "--time", secs, "--json", "--positions"]).json();
    let positions: Vec<[f32; 3]> = serde_json::from_value(posed["positions"].clone()).expect("positions");
    positions.into_iter().map(Vec3::from).collect()
}

/// Distances from each vertex to the next, which no space changes.
fn lengths(positions: &[Vec3]) -> Vec<f32> {
    positions.windows(2).map(|pair| pair[0].distance(pair[1])).collect()
}

#[test]
fn info_has_the_files_bones_with_names_and_parents() {
    let info = run(["info", &banner(), "--json"]).json();
    let bone = |name: &str, parent: Option<u32>| json!({ "name": name, "parent": parent });
    assert_eq!(
        info["bones"],
        json!([
            bone("Armature", None),
            bone("Root", Some(0)),
            bone("Middle", Some(1)),
            bone("Tip", Some(2)),
            bone("Finial", Some(3)),
        ])
    );
    assert_eq!(
        (&info["dialect"], &info["handedness"]),
        (&Value::from("glb"), &Value::from("right"))
    );
}

/// What is posed is computed here from the nodes of the file.
#[test]
fn pose_has_bones_in_that_order_and_vertices_in_the_files() {
    let file = banner();
    let moved = Affine3A::from_translation;
    let armature = Affine3A::from_quat(Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2))
        * Affine3A::from_scale(Vec3::splat(0.5));
    // The middle one has half of the time to 0.8 behind it, the finial half of that to 1.5.
    let middle = armature * moved(Vec3::Z * 0.75) * Affine3A::from_rotation_y(0.4);
    let tip = middle * moved(Vec3::Z * 0.75);
    let finial =
        tip * moved(Vec3::Z * 0.5) * Affine3A::from_rotation_z(0.75) * Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let found = positions(&file, "Nod and spin", "0.5");
    assert_eq!(found.len(), 22);
    for (vertex, corner) in [[0.0, 0.0, 0.0], [0.2, 0.1, 0.3], [-0.2, 0.1, 0.3], [0.0, -0.2, 0.3]]
        .into_iter()
        .enumerate()
    {
        let expected = finial.transform_point3(Vec3::from(corner));
        assert!(
            found[18 + vertex].distance(expected) < 1e-5,
            "{} is not {expected}",
            found[18 + vertex]
        );
    }
    // The last row of the cloth hangs on the tip, which was bound at 1.5.
    for (vertex, x) in [(16, -0.5), (17, 0.5)] {
        let expected = tip.transform_point3(Vec3::new(x, 0.025, 2.0 - 1.5));
        assert!(
            found[vertex].distance(expected) < 1e-5,
            "{} is not {expected}",
            found[vertex]
        );
    }
    let posed = run(["pose", &file, "--clip", "Nod and spin", "--time", "0.5", "--json"]).json();
    let palette: Vec<Vec<f32>> = serde_json::from_value(posed["palette"].clone()).expect("matrices");
    assert_eq!(palette.len(), 5);
    // Row vectors: the place is in the last row. The tip's matrix brings what stood there at rest to where the tip is now.
    let row = |at: usize| Vec3::from_slice(&palette[3][4 * at..]);
    let at_rest = armature.transform_point3(Vec3::Z * 1.5);
    let bound = at_rest.x * row(0) + at_rest.y * row(1) + at_rest.z * row(2) + row(3);
    let expected = Vec3::from(tip.translation);
    assert!(bound.distance(expected) < 1e-5, "{bound} is not {expected}");
}

#[test]
fn check_finds_no_error_and_render_draws_it() {
    let file = banner();
    let checked = run(["check", &file, "--json"]).json();
    let findings = checked[0]["findings"].as_array().expect("a list");
    assert!(
        findings.iter().all(|finding| finding["severity"] != "error"),
        "{checked}"
    );
    let picture = out("banner.png");
    run([
        "render", &file, "-o", &picture, "--size", "96x96", "--clip", "Wave", "--time", "0.75",
    ])
    .fine();
    let bytes = std::fs::read(&picture).expect("was written");
    let image = bindpose::image::decode(&bytes, "banner.png").expect("a picture");
    let texels = image.to_rgba8(0, 0).expect("texels");
    let is_cloth = |texel: &&[u8; 4]| texel[0] > 90 && u16::from(texel[0]) > 2 * u16::from(texel[1]);
    let red = texels.as_chunks::<4>().0.iter().filter(is_cloth).count();
    assert!(red > 50, "{red} texels of the checker's red");
}

/// To .m3d, to .glb, and from there to .m3d: posed alike.
fn assert_goes_every_way(file: &str, name: &str, clip: &str) {
    let ends = [".m3d", ".glb", ".back.m3d", ".book.m3d"];
    let [m3d, glb, back, book] = ends.map(|end| out(&format!("{name}{end}")));
    run(["convert", file, &m3d]).fine();
    run(["convert", file, &glb]).fine();
    run(["convert", &glb, &back]).fine();
    let expected = lengths(&positions(file, clip, "0.5"));
    let size = expected.iter().fold(0.0_f32, |most, length| most.max(*length));
    let one_word = clip.replace(' ', "_");
    for (written, clip) in [(&m3d, one_word.as_str()), (&glb, clip), (&back, one_word.as_str())] {
        let found = lengths(&positions(written, clip, "0.5"));
        assert_eq!(found.len(), expected.len(), "{written}");
        for (found, expected) in found.iter().zip(&expected) {
            assert!(
                (found - expected).abs() <= 1e-4 * size,
                "{written}: {found} is not {expected}"
            );
        }
    }
    for dialect in ["d3d11", "d3d12"] {
        let maps = scratch(&format!("gltf_{name}_{dialect}"));
        let maps = maps.to_str().expect("UTF-8");
        let for_book = ["--for-book", "--dialect", dialect, "--textures-out", maps];
        run(["convert", file, &book].iter().chain(&for_book)).fine();
        let folder: &[&str] = if std::path::Path::new(maps).is_dir() {
            &["--textures", maps]
        } else {
            &[]
        };
        let checked = run([&["check", &book, "--book", dialect, "--deny", "book"], folder].concat());
        assert_eq!(checked.code, Some(0), "{name}: {checked:?}");
        let verdicts = run(["check", &book, "--book", "all", "--json"]).json();
        assert_eq!(
            verdicts[0]["book"][dialect]["shows"], "The model in \"Take1\".",
            "{name}: {verdicts}"
        );
    }
}

#[test]
fn a_banner_goes_every_way_and_to_the_books_demo() {
    assert_goes_every_way(&banner(), "banner", "Wave");
}

#[test]
fn real_files_go_every_way_and_to_the_books_demo() {
    for (name, clip) in REAL {
        if let Some(file) = shared(&format!("gltf/models/{name}")) {
            assert_goes_every_way(&file, name, clip);
        }
    }
}

/// What reading leaves out, by the codes of its fixtures.
const LEFT_OUT: &str = "gltf-attribute-left-out gltf-channel-left-out gltf-extension-unknown gltf-extras-left-out \
    gltf-morph-animation-left-out gltf-morph-targets-left-out gltf-nodes-left-out gltf-objects-merged \
    gltf-map-left-out gltf-primitive-left-out gltf-scene-left-out fbx-left-out fbx-objects-merged";

#[test]
fn what_reading_leaves_out_is_a_loss_whatever_is_written() {
    for code in LEFT_OUT.split(' ') {
        let (format, what) = code.split_once('-').expect("a format, and what");
        let file = fixture(&format!("check/{code}.{format}"));
        let [glb, m3d, twice] = ["glb", "m3d", "twice.glb"].map(|end| out(&format!("{code}.{end}")));
        for output in [&glb, &m3d] {
            if (what, output) == ("objects-merged", &glb) {
                // A .glb has them apart again.
                run(["convert", &file, output, "--deny", "losses"]).fine();
                continue;
            }
            let denied = run(["convert", &file, output, "--deny", "losses", "--json"]);
            assert_eq!(denied.code, Some(1), "{code}");
            assert!(!std::path::Path::new(output).exists(), "{code}");
            let told: Value = serde_json::from_str(&denied.out).expect("is JSON");
            let losses = told["losses"].as_array().expect("a list");
            assert!(losses.iter().any(|loss| loss["code"] == code), "{code}: {losses:?}");
            run(["convert", &file, output]).fine();
        }
        // What was written of it has nothing more to lose.
        run(["convert", &glb, &twice, "--deny", "losses"]).fine();
    }
}

#[test]
fn a_line_of_copyright_goes_into_a_glb_and_is_told_for_the_books() {
    let text = std::fs::read(fixture("check/gltf-extras-left-out.gltf")).expect("it is there");
    let mut file: Value = serde_json::from_slice(&text).expect("is JSON");
    file["asset"]["copyright"] = json!("(c) \"Me\"");
    let [input, glb, again, m3d] = ["gltf", "glb", "again.glb", "m3d"].map(|end| out(&format!("copyright.{end}")));
    std::fs::write(&input, file.to_string()).expect("can be written");
    run(["convert", &input, &glb]).fine();
    run(["convert", &glb, &again]).fine();
    for written in [glb, again] {
        let bytes = std::fs::read(written).expect("was written");
        let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
        let root: Value = serde_json::from_slice(&bytes[20..20 + length]).expect("is JSON");
        assert_eq!(root["asset"]["copyright"], "(c) \"Me\"");
    }
    let told = run(["convert", &input, &m3d, "--json"]).json();
    let losses = told["losses"].as_array().expect("a list");
    let loss = losses
        .iter()
        .find(|loss| loss["code"] == "copyright")
        .expect("it is told");
    assert_eq!(loss["message"], "The line of copyright is left out: \"(c) \"Me\"\".");
}
