//! A banner on a pole, made to have much of what glTF has: `tests/fixtures/gltf/banner.glb`, which tests in the browser open.

use std::fs;
use std::path::Path;

use bindpose::image::encode_png;
use glam::{Affine3A, Mat4, Quat, Vec3};
use serde_json::{Value, json};

use super::{codes_of, read};
use crate::gltf_files::Gltf;

/// Rows of the cloth; each is 0.25 above the one before.
const ROWS: usize = 9;

/// The joints: below an armature that lies on its back and is half as large, three in a chain, and on the last a mirrored finial.
fn nodes() -> Value {
    let lying = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2).to_array();
    json!([
        { "name": "Armature", "rotation": lying, "scale": [0.5, 0.5, 0.5], "children": [1] },
        { "name": "Root", "children": [2] },
        { "name": "Middle", "translation": [0.0, 0.0, 0.75], "children": [3] },
        { "name": "Tip", "translation": [0.0, 0.0, 0.75], "children": [5] },
        { "name": "Cloth", "mesh": 0, "skin": 0 },
        { "name": "Finial", "mesh": 1, "translation": [0.0, 0.0, 0.5], "scale": [-1.0, 1.0, 1.0] },
    ])
}

/// A checker of two colours, with a hole in one corner.
fn picture(colors: [[u8; 4]; 2]) -> Vec<u8> {
    let texel = |index: usize| colors[(index % 8 / 2 + index / 16) % 2];
    let texels: Vec<[u8; 4]> = (0..64).map(texel).collect();
    encode_png(texels.as_flattened(), 8, 8).expect("it can be written")
}

fn materials() -> Value {
    json!([
        { "name": "Cloth", "doubleSided": true, "alphaMode": "MASK",
          "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "metallicFactor": 0.0, "roughnessFactor": 0.75 } },
        { "name": "Brass", "emissiveFactor": [0.05, 0.02, 0.0],
          "pbrMetallicRoughness": { "baseColorFactor": [0.9, 0.7, 0.3, 1.0], "metallicFactor": 0.5, "roughnessFactor": 0.25 } },
    ])
}

/// An accessor of floats with their bounds, which places and times must say.
fn bounded<const N: usize>(file: &mut Gltf, rows: &[[f32; N]]) -> usize {
    let index = file.floats(rows);
    let bound = |better: fn(f32, f32) -> f32| -> Vec<f32> {
        let column = |axis: usize| rows.iter().map(|row| row[axis]).fold(rows[0][axis], better);
        (0..N).map(column).collect()
    };
    let accessor = &mut file.json["accessors"][index];
    (accessor["min"], accessor["max"]) = (json!(bound(f32::min)), json!(bound(f32::max)));
    index
}

/// Two columns of the cloth as one strip, with joints and weights of 8 bits.
fn cloth(file: &mut Gltf) -> Value {
    let corners: Vec<(f32, f32)> = (0..ROWS)
        .flat_map(|row| [(-0.5, row), (0.5, row)])
        .map(|(x, row)| (x, row as f32 * 0.25))
        .collect();
    let rows = |value: &dyn Fn(f32, f32) -> [f32; 3]| corners.iter().map(|&(x, z)| value(x, z)).collect::<Vec<_>>();
    let position = bounded(file, &rows(&|x, z| [x, 0.1 * x * x, z]));
    let normal = file.floats(&rows(&|_, _| [0.0, -1.0, 0.0]));
    let tex_coord: Vec<[f32; 2]> = corners.iter().map(|&(x, z)| [x + 0.5, 1.0 - z * 0.5]).collect();
    let tex_coord = file.floats(&tex_coord);
    let (mut joints, mut weights) = (Vec::new(), Vec::new());
    for (_, z) in corners {
        let part = (z / 0.75).min(2.0);
        let above = (part.fract() * 255.0).round() as u8;
        joints.extend([part as u8, (part as u8 + 1).min(2), 0, 0]);
        weights.extend([255 - above, above, 0, 0]);
    }
    // Slots of no weight name joint 0.
    for (joints, weights) in joints.chunks_exact_mut(4).zip(weights.chunks_exact(4)) {
        if weights[1] == 0 {
            joints[1] = 0;
        }
    }
    let count = 2 * ROWS;
    let view = file.view(&joints, Some(4));
    let joints = file.accessor(json!({ "bufferView": view, "componentType": 5121, "count": count, "type": "VEC4" }));
    let view = file.view(&weights, Some(4));
    let weights = file.accessor(
        json!({ "bufferView": view, "componentType": 5121, "normalized": true, "count": count, "type": "VEC4" }),
    );
    json!({ "attributes": { "POSITION": position, "NORMAL": normal, "TEXCOORD_0": tex_coord, "JOINTS_0": joints, "WEIGHTS_0": weights },
        "material": 0, "mode": 5 })
}

/// A pyramid on its tip, without normals.
fn finial(file: &mut Gltf) -> Value {
    let position = bounded(
        file,
        &[[0.0, 0.0, 0.0], [0.2, 0.1, 0.3], [-0.2, 0.1, 0.3], [0.0, -0.2, 0.3]],
    );
    let indices = file.shorts(&[[0_u16], [1], [2], [0], [2], [3], [0], [3], [1], [1], [3], [2]]);
    json!({ "attributes": { "POSITION": position }, "indices": indices, "material": 1 })
}

/// One clip with all three ways between keys, and one of straight ways with times of their own.
fn animations(file: &mut Gltf) -> Value {
    let turn = |axis: Vec3, angle: f32| Quat::from_axis_angle(axis, angle).to_array();
    let times = bounded(file, &[[0.0], [0.5], [1.0], [2.0]]);
    let sway = file.floats(&[
        [0.0; 4],
        turn(Vec3::Z, 0.0),
        [0.0, 0.0, 0.8, 0.0],
        [0.0, 0.0, 0.1, 0.0],
        turn(Vec3::Z, 0.6),
        [0.0, 0.0, 0.1, 0.0],
        [0.0, 0.2, -0.6, 0.0],
        turn(Vec3::Z, -0.4),
        [0.0, 0.2, -0.6, 0.0],
        [0.0, 0.0, 0.8, 0.0],
        turn(Vec3::Z, 0.0),
        [0.0; 4],
    ]);
    let bend = file.floats(&[
        turn(Vec3::X, 0.0),
        turn(Vec3::X, 0.5),
        turn(Vec3::X, -0.3),
        turn(Vec3::X, 0.0),
    ]);
    let step = file.floats(&[[0.0, 0.0, 0.75], [0.0, 0.0, 0.8], [0.0, 0.0, 0.7], [0.0, 0.0, 0.75]]);
    let later = bounded(file, &[[0.25], [0.75], [1.25]]);
    let nod = file.floats(&[turn(Vec3::Y, 0.0), turn(Vec3::Y, 0.8), turn(Vec3::Y, 0.0)]);
    let spin = file.floats(&[turn(Vec3::Z, 0.0), turn(Vec3::Z, 1.5), turn(Vec3::Z, 3.0)]);
    let channel =
        |sampler: usize, node: u32, path: &str| json!({ "sampler": sampler, "target": { "node": node, "path": path } });
    json!([
        { "name": "Wave",
          "samplers": [{ "input": times, "output": sway, "interpolation": "CUBICSPLINE" }, { "input": times, "output": bend },
            { "input": times, "output": step, "interpolation": "STEP" }],
          "channels": [channel(0, 1, "rotation"), channel(1, 2, "rotation"), channel(2, 3, "translation")] },
        { "name": "Nod and spin",
          "samplers": [{ "input": later, "output": nod }, { "input": later, "output": spin }],
          "channels": [channel(0, 2, "rotation"), channel(1, 5, "rotation")] },
    ])
}

pub(crate) fn banner() -> Gltf {
    let mut file = Gltf::new(&json!({ "scenes": [{ "nodes": [0, 4] }], "nodes": nodes(), "materials": materials() }));
    let (cloth, finial) = (cloth(&mut file), finial(&mut file));
    file.json["meshes"] =
        json!([{ "name": "Cloth", "primitives": [cloth] }, { "name": "Finial", "primitives": [finial] }]);
    let above = |height: f32| Mat4::from(Affine3A::from_translation(Vec3::NEG_Z * height)).to_cols_array();
    let matrices = file.floats(&[above(0.0), above(0.75), above(1.5)]);
    file.json["skins"] = json!([{ "joints": [1, 2, 3], "inverseBindMatrices": matrices }]);
    file.json["animations"] = animations(&mut file);
    let view = file.view(&picture([[200, 40, 40, 255], [240, 220, 180, 255]]), None);
    file.json["images"] = json!([{ "name": "checker", "bufferView": view, "mimeType": "image/png" }]);
    file.json["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    file.json["samplers"] = json!([{ "magFilter": 9728, "wrapS": 33071 }]);
    file
}

/// `BLESS=1 cargo test` writes the file anew.
#[test]
fn the_file_is_as_it_is_made_here() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/gltf/banner.glb");
    let made = banner().glb();
    if std::env::var_os("BLESS").is_some() {
        fs::write(&path, &made).expect("the file can be written");
    }
    assert!(
        fs::read(&path).expect("the file is there") == made,
        "BLESS=1 cargo test writes {} anew",
        path.display()
    );
}

#[test]
fn it_is_read_with_its_joints_clips_and_picture() {
    let imported = read(&banner());
    let skeleton = &imported.model.skeleton;
    let names: Vec<_> = skeleton
        .joint_of_bone()
        .iter()
        .filter_map(|&joint| skeleton.name(joint))
        .collect();
    assert_eq!(names, ["Armature", "Root", "Middle", "Tip", "Finial"]);
    let clips: Vec<_> = imported
        .model
        .clips
        .iter()
        .map(|clip| (clip.name.as_str(), clip.start_secs, clip.end_secs))
        .collect();
    assert_eq!(clips, [("Wave", 0.0, 2.0), ("Nod and spin", 0.25, 1.25)]);
    assert_eq!(
        (imported.model.mesh.vertex_count(), imported.model.mesh.triangle_count()),
        (22, 20)
    );
    assert_eq!(imported.pictures.len(), 1);
    assert_eq!(codes_of(&imported), ["gltf-normals-absent", "gltf-objects-merged"]);
}
