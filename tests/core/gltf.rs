//! Reading glTF.

mod banner;
mod clips;
mod forms;
mod hostile;
mod limits;
mod materials;
mod meshes;
mod objects;
mod real_files;
mod session;
mod skins;
mod text;
mod told;
mod validator;

use bindpose::anim::{CompiledClip, PoseBuffers, skin_positions};
use bindpose::diagnostic::Diagnostic;
use bindpose::import::{Imported, import};
use bindpose::model::Model;
use glam::Vec3;
use serde_json::{Value, json};

use crate::gltf_files::Gltf;

pub(crate) use banner::banner;
pub(crate) use clips::moving;
pub(crate) use objects::{four_objects, four_still_objects};

/// The one triangle of most files here.
const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]];

/// A triangle, on a node of its own; `attributes` are added to its position.
fn triangle(document: &Value, attributes: impl FnOnce(&mut Gltf) -> Value) -> Gltf {
    let mut file = Gltf::new(&json!({ "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }] }));
    for (key, value) in document.as_object().expect("an object") {
        file.json[key] = value.clone();
    }
    let position = file.floats(&CORNERS);
    let mut all = json!({ "POSITION": position });
    let more = attributes(&mut file);
    for (key, value) in more.as_object().expect("an object") {
        all[key] = value.clone();
    }
    if file.json.get("meshes").is_none() {
        file.json["meshes"] = json!([{ "primitives": [{}] }]);
    }
    let primitives = file.json["meshes"][0]["primitives"].as_array_mut().expect("a list");
    for primitive in primitives {
        primitive["attributes"] = all.clone();
    }
    file
}

/// A triangle of nothing but positions.
fn bare(document: &Value) -> Gltf {
    triangle(document, |_| json!({}))
}

fn read(file: &Gltf) -> Imported {
    let [binary, text] = [file.glb(), file.text()].map(|bytes| import(&bytes));
    let text = text.unwrap_or_else(|refused| panic!("{}", refused.error.message));
    let binary = binary.unwrap_or_else(|refused| panic!("{}", refused.error.message));
    assert_eq!(
        text.model.mesh.positions, binary.model.mesh.positions,
        "both forms say the same"
    );
    binary
}

fn refused(bytes: &[u8]) -> Diagnostic {
    import(bytes).expect_err("a refusal").error
}

fn codes_of(imported: &Imported) -> Vec<&'static str> {
    imported.diagnostics.iter().map(|finding| finding.code).collect()
}

/// The finding of a code that stands there once.
#[track_caller]
fn told<'a>(imported: &'a Imported, code: &str) -> &'a Diagnostic {
    let found: Vec<_> = told_all(imported, code).collect();
    assert_eq!(found.len(), 1, "{code} among {:?}", imported.diagnostics);
    found[0]
}

fn told_all<'a>(imported: &'a Imported, code: &str) -> impl Iterator<Item = &'a Diagnostic> {
    imported.diagnostics.iter().filter(move |finding| finding.code == code)
}

/// All vertices of the first clip at a time, or at rest without one.
fn posed(model: &Model, time_secs: f32) -> Vec<Vec3> {
    let mut pose = PoseBuffers::for_skeleton(&model.skeleton);
    if let Some(clip) = model.clips.first() {
        pose.evaluate(&model.skeleton, &CompiledClip::new(clip), time_secs);
    }
    let mut positions = Vec::new();
    if model.mesh.influences.is_empty() {
        return model.mesh.positions.clone();
    }
    skin_positions(&model.mesh, &pose.palette, &mut positions);
    positions
}

#[track_caller]
fn assert_at(found: &[Vec3], expected: &[[f32; 3]]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            found.abs_diff_eq(Vec3::from_array(*expected), 1e-5),
            "{found} is not {expected:?}"
        );
    }
}
