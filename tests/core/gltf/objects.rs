//! Objects that are apart in a file come through to a `.glb`: nodes, meshes, names and `extras`.

use bindpose::diagnostic::{Diagnostic, Entry};
use bindpose::export::{MapImages, glb, m3d_losses};
use bindpose::format::Dialect;
use bindpose::import::import;
use bindpose::model::{JointNames, Model};
use glam::{Quat, Vec3};
use serde_json::{Value, json};

use super::posed;
use crate::gltf_files::Gltf;

/// Of the model's size: what f32 loses.
const MOST_APART: f32 = 1e-6;

/// An accessor of positions with their bounds, which they must say.
fn positions(file: &mut Gltf, corners: &[[f32; 3]]) -> usize {
    let index = file.floats(corners);
    for (bound, better) in [("min", f32::min as fn(f32, f32) -> f32), ("max", f32::max)] {
        let of_axis = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(corners[0][axis], better);
        file.json["accessors"][index][bound] = json!([0, 1, 2].map(of_axis));
    }
    index
}

/// Two triangles in a square of a size.
fn square(file: &mut Gltf, size: f32) -> Value {
    let corners = [[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.0, size, 0.0], [size, size, 0.0]];
    json!({ "POSITION": positions(file, &corners), "NORMAL": file.floats(&[[0.0, 0.0, 1.0]; 4]) })
}

fn skinned(file: &mut Gltf, size: f32) -> Value {
    let mut attributes = square(file, size);
    attributes["JOINTS_0"] = file
        .shorts(&[[0, 0, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0], [0, 1, 0, 0]])
        .into();
    let halves = [0.5, 0.5, 0.0, 0.0];
    let whole = [1.0, 0.0, 0.0, 0.0];
    attributes["WEIGHTS_0"] = file.floats(&[whole, whole, whole, halves]).into();
    attributes
}

/// Under an armature that is turned and small, two bones; a body of two materials and hair on a skin, and two swords of one mesh, the one in
/// the hand and the other mirrored and lying beside. A clip moves the hand.
pub(crate) fn four_objects() -> Gltf {
    let turn = Quat::from_rotation_x(0.7).to_array();
    let mut file = Gltf::new(&json!({
        "scenes": [{ "nodes": [0, 3, 4] }],
        "nodes": [
            { "name": "Armature", "rotation": turn, "scale": [0.5, 0.5, 0.5], "children": [1, 6] },
            { "name": "Root", "children": [2] },
            { "name": "Hand", "translation": [0.0, 1.5, 0.25], "children": [5] },
            { "name": "Body", "mesh": 0, "skin": 0, "extras": { "gameplay": { "class": "hero", "lives": [3, 0.25, null] } } },
            { "name": "Hair", "mesh": 1, "skin": 0 },
            { "name": "Sword", "mesh": 2, "translation": [0.25, 0.0, 0.0], "rotation": turn, "extras": { "damage": 7 } },
            { "name": "Spare", "mesh": 2, "translation": [3.0, 0.0, 0.0], "scale": [-1.0, 2.0, 1.0] },
        ],
        "skins": [{ "joints": [1, 2] }],
        "materials": [{ "name": "Skin" }, { "name": "Cloth" }, { "name": "Steel" }],
    }));
    let body = skinned(&mut file, 1.0);
    let (upper, lower) = (file.shorts(&[[0_u16], [1], [2]]), file.shorts(&[[1_u16], [3], [2]]));
    let hair = skinned(&mut file, 0.5);
    let sword = square(&mut file, 0.75);
    let both = file.shorts(&[[0_u16], [1], [2], [1], [3], [2]]);
    file.json["meshes"] = json!([
        { "name": "BodyMesh", "extras": { "lod": 0 }, "primitives": [
            { "attributes": body, "indices": upper, "material": 0 }, { "attributes": body, "indices": lower, "material": 1 } ] },
        { "primitives": [{ "attributes": hair, "indices": both, "material": 1 }] },
        { "name": "SwordMesh", "primitives": [{ "attributes": sword, "indices": both, "material": 2 }], "extras": "sharp" },
    ]);
    let times = file.floats(&[[0.0], [1.0]]);
    (
        file.json["accessors"][times]["min"],
        file.json["accessors"][times]["max"],
    ) = (json!([0.0]), json!([1.0]));
    let turns = [Quat::IDENTITY, Quat::from_rotation_z(1.0)].map(|turn| turn.to_array());
    let turns = file.floats(&turns);
    file.json["animations"] = json!([{ "name": "Swing", "samplers": [{ "input": times, "output": turns }],
        "channels": [{ "sampler": 0, "target": { "node": 2, "path": "rotation" } }] }]);
    file
}

/// The same without skin and clip: nothing moves, and there is no bone.
pub(crate) fn four_still_objects() -> Gltf {
    let mut file = four_objects();
    for key in ["skins", "animations"] {
        file.json.as_object_mut().expect("an object").remove(key);
    }
    for node in [3, 4] {
        let node = file.json["nodes"][node].as_object_mut().expect("an object");
        node.remove("skin");
        node.insert("translation".to_owned(), json!([0.0, 5.0, 0.125]));
    }
    for mesh in [0, 1] {
        for part in file.json["meshes"][mesh]["primitives"].as_array_mut().expect("a list") {
            let attributes = part["attributes"].as_object_mut().expect("an object");
            attributes.retain(|key, _| key == "POSITION" || key == "NORMAL");
        }
    }
    file
}

fn read(bytes: &[u8]) -> (Model, Vec<Diagnostic>) {
    let imported = import(bytes).unwrap_or_else(|refused| panic!("{}", refused.error.message));
    (imported.model, imported.diagnostics)
}

fn written(model: &Model) -> Vec<u8> {
    let written = glb(model, &JointNames::default(), &MapImages::new()).expect("it can be written");
    assert_eq!(written.losses, []);
    written.bytes
}

fn json_of(glb: &[u8]) -> Value {
    let length = u32::from_le_bytes([glb[12], glb[13], glb[14], glb[15]]) as usize;
    serde_json::from_slice(&glb[20..20 + length]).expect("it is JSON")
}

/// Of each node with a mesh: its name and `extras`, and those of the mesh, with the number of primitives.
fn objects(root: &Value) -> Vec<Value> {
    let nodes = root["nodes"].as_array().expect("a list").iter();
    let with_mesh = nodes.filter(|node| node.get("mesh").is_some());
    let objects = with_mesh.map(|node| {
        let mesh = &root["meshes"][node["mesh"].as_u64().expect("an index") as usize];
        let parts = mesh["primitives"].as_array().expect("a list").len();
        json!([node["name"], node["extras"], mesh["name"], mesh["extras"], parts])
    });
    objects.collect()
}

#[test]
fn four_objects_and_an_armature_come_through() {
    for (file, is_skinned) in [(four_objects(), true), (four_still_objects(), false)] {
        let (model, _) = read(&file.glb());
        let bytes = written(&model);
        let root = json_of(&bytes);
        let gameplay = json!({ "gameplay": { "class": "hero", "lives": [3, 0.25, null] } });
        assert_eq!(
            objects(&root),
            [
                json!(["Body", gameplay, "BodyMesh", { "lod": 0 }, 2]),
                json!(["Hair", null, null, null, 1]),
                json!(["Sword", { "damage": 7 }, "SwordMesh", "sharp", 1]),
                json!(["Spare", null, "SwordMesh", "sharp", 1]),
            ]
        );
        let (again, findings) = read(&bytes);
        let told = findings.iter().map(|finding| finding.code);
        assert_eq!(told.collect::<Vec<_>>(), ["gltf-objects-merged"]);
        assert_eq!(again.objects.len(), 4);
        assert_eq!(model.skeleton.joint_count(), if is_skinned { 5 } else { 0 });
        assert_eq!(again.skeleton.joint_count(), model.skeleton.joint_count());
        // Each has its own vertices: as many as before, and where they were.
        let size = model.bind_bounds().size().length();
        let apart = |(one, other): (&Vec3, &Vec3)| one.distance(*other) <= MOST_APART * size;
        assert_eq!(again.mesh.vertex_count(), model.mesh.vertex_count());
        assert_eq!(again.mesh.indices, model.mesh.indices);
        assert_eq!(again.mesh.normals, model.mesh.normals);
        for time_secs in [0.0, 0.25, 1.0] {
            let [before, after] = [&model, &again].map(|model| posed(model, time_secs));
            assert!(before.iter().zip(&after).all(apart), "{before:?} and {after:?}");
        }
        assert_eq!(written(&again), bytes, "a second time changes nothing");
    }
}

#[test]
fn the_books_have_one_mesh_and_the_extras_are_told_as_lost() {
    let (model, findings) = read(&four_objects().glb());
    assert!(findings.iter().all(|finding| finding.code != "gltf-extras-left-out"));
    let losses = m3d_losses(&model, &JointNames::default(), Dialect::D3d12);
    let loss = losses.iter().find(|loss| loss.code == "gltf-extras-left-out");
    let told = loss.map(|loss| (loss.message.as_str(), loss.count));
    let message = "3 objects have extras (custom properties), which are left out: Body, Sword, Spare.";
    assert_eq!(told, Some((message, 3)));
}

#[test]
fn what_is_told_of_a_mesh_is_not_copied_without_end() {
    let mut file = four_still_objects();
    let many: Vec<Value> = (0..20_000).map(|_| json!({ "mesh": 2 })).collect();
    file.json["scenes"] = json!([{ "nodes": (0..many.len()).collect::<Vec<_>>() }]);
    file.json["nodes"] = json!(many);
    file.json["meshes"][2]["extras"] = json!("x".repeat(1 << 20));
    let refused = import(&file.glb()).expect_err("20 GB of a file of one");
    assert_eq!(refused.error.code, "gltf-too-large");
}

#[test]
fn every_part_has_its_pointer_and_every_pointer_its_part() {
    let bytes = four_objects().glb();
    let places = import(&bytes).expect("a model").source.places(&bytes);
    for (row, pointer) in [
        (Entry::Bone(2), "/nodes/2"),
        (Entry::Bone(3), "/nodes/5"),
        (Entry::Subset(1), "/meshes/0/primitives/1"),
        (Entry::Material(2), "/materials/2"),
    ] {
        assert_eq!(places.pointer(row).as_deref(), Some(pointer));
        assert_eq!(places.entry_at(pointer), Some(row));
    }
    assert_eq!(places.entry_at("/nodes/5/extras"), Some(Entry::Bone(3)));
    for nothing in [
        "",
        "/nodes/3",
        "/nodes/x",
        "/meshes/9/primitives/0",
        "/meshes/0",
        "/materials/3",
    ] {
        assert_eq!(places.entry_at(nothing), None, "{nothing}");
    }
    assert_eq!(places.line(Entry::Bone(2)), None, "a binary file has no lines");
}

#[test]
fn an_object_without_triangles_is_none() {
    let mut file = four_still_objects();
    file.json["meshes"][1]["primitives"][0]["mode"] = json!(0);
    file.json["nodes"][4]["extras"] = json!({ "wig": true });
    let (model, findings) = read(&file.glb());
    assert_eq!(model.objects.len(), 3);
    let told = findings.iter().find(|finding| finding.code == "gltf-extras-left-out");
    assert_eq!(told.and_then(|told| told.pointer.as_deref()), Some("/nodes/4/extras"));
    assert_eq!(objects(&json_of(&written(&model))).len(), 3);
}
