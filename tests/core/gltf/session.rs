//! glTF in a session: drops of several files, pictures, names, and a model without a clip.

use bindpose::model::{JointIndex, MapSlot};
use bindpose::session::{File, FileCommand, FileFormat, FileSet, Session};
use glam::Affine3A;
use serde_json::json;

use super::banner::banner;
use super::triangle;
use crate::gltf_files::Gltf;

/// A PNG of one pixel.
const PIXEL: &[u8] = include_bytes!("../../../web/sample/visor_norm.png");

fn textured(image: &serde_json::Value) -> Gltf {
    let material = json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } });
    triangle(
        &json!({ "materials": [material], "meshes": [{ "primitives": [{ "material": 0 }] }], "textures": [{ "source": 0 }], "images": [image] }),
        |file| json!({ "TEXCOORD_0": file.floats(&[[0.0; 2]; 3]) }),
    )
}

fn opened(files: Vec<File>) -> Session {
    let mut session = Session::new(false);
    session.apply(FileCommand::Add(files));
    assert_eq!(session.error(), None);
    session
}

#[test]
fn a_drop_of_text_data_and_picture_opens_as_one_model() {
    let file = textured(&json!({ "uri": "maps/skin.png" }));
    let session = opened(vec![
        File::new("fox/data.bin", file.bin.clone()),
        File::new("fox/maps/skin.png", PIXEL),
        File::new("fox/fox.gltf", file.text_beside("data.bin")),
    ]);
    let open = session.open_model().expect("it is open");
    assert_eq!((open.file.base_name(), open.format), ("fox.gltf", FileFormat::Gltf));
    assert!(session.maps().image(0, MapSlot::Diffuse).is_some());
    // The data lie elsewhere: the base name is enough.
    let session = opened(vec![
        File::new("elsewhere/DATA.bin", file.bin.clone()),
        File::new("fox.gltf", file.text_beside("data.bin")),
    ]);
    assert!(session.open_model().is_some());
    let files = FileSet::new([
        File::new("a.bin", [1]),
        File::new("readme.txt", [2; 9]),
        File::new("b.glb", [3]),
    ]);
    assert_eq!(
        files.models().iter().map(|file| file.base_name()).collect::<Vec<_>>(),
        ["b.glb"]
    );
}

#[test]
fn a_missing_file_is_told_with_its_name_and_place() {
    let file = triangle(&json!({}), |_| json!({}));
    let mut session = Session::new(false);
    session.apply(FileCommand::Add(vec![File::new(
        "fox.gltf",
        file.text_beside("data.bin"),
    )]));
    let error = session.error().expect("it cannot be opened");
    assert_eq!(error.diagnostic.code, "gltf-buffer-missing");
    assert!(error.excerpt.is_some(), "the line that names it");
    assert!(error.to_text().starts_with("fox.gltf:"), "{}", error.to_text());
    assert!(error.to_text().contains("data.bin"));
}

#[test]
fn pictures_inside_a_file_are_maps_and_a_dropped_one_of_that_name_takes_over() {
    let mut file = textured(&json!({}));
    let view = file.view(PIXEL, None);
    file.json["images"] = json!([{ "name": "skin", "bufferView": view, "mimeType": "image/png" }]);
    let mut session = opened(vec![File::new("fox.glb", file.glb())]);
    assert_eq!(
        session.maps().file(0, MapSlot::Diffuse).map(File::base_name),
        Some("skin.png")
    );
    assert!(session.maps().image(0, MapSlot::Diffuse).is_some());
    session.apply(FileCommand::Add(vec![File::new("new/skin.png", PIXEL)]));
    assert_eq!(
        session.maps().file(0, MapSlot::Diffuse).map(|file| file.path.as_str()),
        Some("new/skin.png")
    );
}

#[test]
fn without_a_clip_joints_are_at_rest_and_have_the_files_names() {
    let nodes = json!([{ "mesh": 0, "skin": 0 }, { "name": "Spine", "translation": [0.0, 3.0, 0.0], "children": [2] },
        { "name": "Head", "rotation": [0.0, 0.0, 1.0, 0.0] }]);
    let mut file = triangle(
        &json!({ "scenes": [{ "nodes": [0, 1] }], "nodes": nodes, "skins": [{ "joints": [1, 2] }] }),
        |file| json!({ "JOINTS_0": file.shorts(&[[1, 0, 0, 0]; 3]), "WEIGHTS_0": file.floats(&[[1.0, 0.0, 0.0, 0.0]; 3]) }),
    );
    let matrices = file.floats(&[Affine3A::IDENTITY; 2].map(|matrix| glam::Mat4::from(matrix).to_cols_array()));
    file.json["skins"][0]["inverseBindMatrices"] = matrices.into();
    let mut session = opened(vec![File::new("fox.glb", file.glb())]);
    assert_eq!(session.joint_label(JointIndex(1)), "Head");
    let frame = session.frame();
    let palette = frame.palette.0.to_vec();
    // The head is turned by half a turn, and 3 above.
    let posed = palette[1].transform_point3(glam::Vec3::new(1.0, 2.0, 0.0));
    assert!(posed.abs_diff_eq(glam::Vec3::new(-1.0, 1.0, 0.0), 1e-5), "{posed}");
    let (bounds, _) = session.open_model().expect("it is open").extent(None);
    assert!(bounds.max.y < 3.1 && bounds.min.y > 0.9, "{bounds:?}");
}

#[test]
fn clips_of_a_text_with_its_data_join_and_join_again() {
    let file = banner();
    let beside = |name: &str| {
        vec![
            File::new(&format!("in/{name}.gltf"), file.text_beside(&format!("{name}.bin"))),
            File::new(&format!("in/{name}.bin"), file.bin.clone()),
        ]
    };
    let mut session = opened(beside("banner"));
    let clips = |session: &Session| {
        let open = session.open_model().expect("it is open");
        open.clip_list()
            .map(|clip| clip.file_name.to_owned())
            .collect::<Vec<_>>()
    };
    let joined = ["banner.gltf", "banner.gltf", "walk.gltf", "walk.gltf"];
    for _ in 0..2 {
        session.apply(FileCommand::AddClips(beside("walk")));
        assert_eq!(
            (session.error(), clips(&session)),
            (None, joined.map(str::to_owned).to_vec())
        );
    }
    for again in [
        FileCommand::Add(beside("banner")),
        FileCommand::Open("in/banner.gltf".to_owned()),
    ] {
        session.apply(again);
        assert_eq!(
            (session.error(), clips(&session)),
            (None, joined.map(str::to_owned).to_vec())
        );
    }
    assert!(session.diagnostics().all(|notice| notice.code != "gltf-buffer-missing"));

    session.apply(FileCommand::AddClips(beside("run")[..1].to_vec()));
    let error = session.error().expect("its data are not there");
    assert_eq!(
        (error.diagnostic.code, &*error.file_name),
        ("gltf-buffer-missing", "run.gltf")
    );
}
