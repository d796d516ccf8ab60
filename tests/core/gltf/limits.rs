//! Little files that ask for much, and large ones that are sound: what reading takes grows with the file, and what is kept has a bound.
//! Work is counted by the reader's own account. What it does not count is held by size: these files took minutes when each part was
//! compared with all before.

use std::cell::Cell;

use bindpose::export::{ExportError, MapImages, glb};
use bindpose::gltf::{self, Buffers, Effort};
use bindpose::import::{Imported, import, import_beside};
use bindpose::model::{Influences, JointIndex, JointNames, Mesh, Model, Skeleton};
use glam::{Affine3A, Vec2, Vec3};
use serde_json::{Value, json};

use super::{bare, refused, triangle};
use crate::gltf_files::Gltf;

/// Bytes of all streams of a vertex: position, normal, two texture coordinates, tangent, colour and influences.
const BYTES_PER_VERTEX: usize = 12 + 12 + 2 * 8 + 16 + 16 + 32;

fn opened(file: &Gltf) -> Imported {
    import(&file.glb()).unwrap_or_else(|refused| panic!("{}", refused.error.message))
}

/// One mesh of so many vertices on so many nodes, which a skin may move.
fn fence(vertices: usize, nodes: usize, is_skinned: bool) -> Gltf {
    let mut file = Gltf::new(&json!({}));
    let position = file.floats(&vec![[1.0, 2.0, 3.0]; vertices]);
    let mut attributes = json!({ "POSITION": position });
    let mut node = json!({ "mesh": 0 });
    if is_skinned {
        attributes["JOINTS_0"] = file.shorts(&vec![[0_u16; 4]; vertices]).into();
        attributes["WEIGHTS_0"] = file.floats(&vec![[1.0, 0.0, 0.0, 0.0]; vertices]).into();
        node["skin"] = json!(0);
        file.json["skins"] = json!([{ "joints": [0] }]);
    }
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": attributes }] }]);
    file.json["nodes"] = vec![node; nodes].into();
    file.json["scenes"] = json!([{ "nodes": (0..nodes).collect::<Vec<_>>() }]);
    file
}

#[test]
fn a_mesh_on_many_nodes_is_read_once_and_kept_for_each() {
    for is_skinned in [false, true] {
        let (vertices, nodes) = (9_000, 300);
        let Imported { model, source, .. } = opened(&fence(vertices, nodes, is_skinned));
        assert_eq!(model.mesh.vertex_count(), vertices * nodes);
        assert_eq!(model.mesh.submeshes.len(), nodes);
        let streams = if is_skinned { 3 } else { 1 };
        // Once each, and the order of the vertices.
        assert_eq!(source.effort().elements, ((streams + 1) * vertices) as u64);
        let kept = nodes * (vertices * BYTES_PER_VERTEX + vertices / 3 * 12 + 64);
        assert_eq!(source.effort().bytes_kept, kept as u64);
        let mesh = &model.mesh;
        let streams = size_of_val(&*mesh.positions) + size_of_val(&*mesh.normals) + size_of_val(&*mesh.tex_coords);
        let rest = size_of_val(&*mesh.influences) + size_of_val(&*mesh.indices);
        assert!(streams + rest <= kept, "the account is no lower than what is there");
    }
}

#[test]
fn copies_beyond_what_memory_has_are_refused_before_they_are_made() {
    let told = refused(&fence(30_000, 2_000, false).glb());
    assert_eq!(
        (told.code, told.pointer.as_deref()),
        ("gltf-too-large", Some("/meshes/0"))
    );
    assert!(
        told.message.contains(" MB or more, and the file holds "),
        "{}",
        told.message
    );
}

#[test]
fn a_shape_that_many_nodes_share_is_made_once() {
    let mut file = fence(1_000, 50, false);
    let steps = file.floats(&vec![[0.0, 0.0, 1.0]; 1_000]);
    let mesh = &mut file.json["meshes"][0];
    mesh["primitives"][0]["targets"] = json!([{ "POSITION": steps }]);
    mesh["weights"] = json!([0.5]);
    file.json["nodes"][49]["weights"] = json!([0.0]);
    let Imported { model, source, .. } = opened(&file);
    assert_eq!(source.effort().elements, 3_000);
    assert_eq!(model.mesh.positions[0].z, 3.5);
    assert_eq!(model.mesh.positions[49_000].z, 3.0);
}

#[test]
fn primitives_are_not_compared_with_all_before() {
    let count = 100_000;
    let mut file = bare(&json!({}));
    let corners = file.json["accessors"][0].clone();
    file.json["accessors"] = vec![corners; count].into();
    let primitives: Vec<Value> = (0..count)
        .map(|index| json!({ "attributes": { "POSITION": index } }))
        .collect();
    file.json["meshes"] = json!([{ "primitives": primitives }]);
    let Imported { model, source, .. } = opened(&file);
    assert_eq!(model.mesh.submeshes.len(), count);
    assert_eq!(source.effort().elements, 6 * count as u64);
}

#[test]
fn a_deep_tree_is_not_climbed_from_each_mesh() {
    let count = 100_000;
    let mut nodes: Vec<Value> = (1..count)
        .map(|child| json!({ "mesh": 0, "children": [child] }))
        .collect();
    nodes.push(json!({ "mesh": 0, "translation": [1.0, 0.0, 0.0] }));
    let Imported { model, source, .. } = opened(&bare(&json!({ "nodes": nodes })));
    assert_eq!(model.mesh.vertex_count(), 3 * count);
    assert_eq!(source.effort().elements, 6);
    // A clip moves the deepest of a shorter one: all above it are joints, as they are when it is the first.
    for moved in [0, 999] {
        let mut nodes: Vec<Value> = (1..1_000).map(|child| json!({ "children": [child] })).collect();
        nodes.push(json!({ "mesh": 0 }));
        let mut file = bare(&json!({ "nodes": nodes }));
        let (times, values) = (file.floats(&[[0.0]]), file.floats(&[[0.0, 1.0, 0.0]]));
        file.json["animations"] = json!([{ "samplers": [{ "input": times, "output": values }],
            "channels": [{ "sampler": 0, "target": { "node": moved, "path": "translation" } }] }]);
        assert_eq!(opened(&file).model.skeleton.joint_count(), 1_000);
    }
}

/// A triangle with a texture for each of these ranges of the buffer, all of which begin as a PNG file.
fn pictured(bytes: &[u8], ranges: &[(usize, usize)]) -> Gltf {
    let indices = 0..ranges.len();
    let material = |index: usize| json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": index } } });
    let mut file = bare(&json!({
        "materials": indices.clone().map(material).collect::<Vec<_>>(),
        "textures": indices.map(|source| json!({ "source": source })).collect::<Vec<_>>(),
    }));
    let whole = file.view(bytes, None);
    let start = file.json["bufferViews"][whole]["byteOffset"]
        .as_u64()
        .expect("a number") as usize;
    let views = file.json["bufferViews"].as_array_mut().expect("a list");
    let mut images = Vec::new();
    for (offset, length) in ranges {
        images.push(json!({ "bufferView": views.len(), "mimeType": "image/png" }));
        views.push(json!({ "buffer": 0, "byteOffset": start + offset, "byteLength": length }));
    }
    file.json["images"] = images.into();
    file
}

#[test]
fn pictures_are_kept_once_and_within_a_bound() {
    const MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n";
    let mut bytes = vec![0; 4_200_000];
    for at in 0..300 {
        bytes[16 * at..16 * at + MAGIC.len()].copy_from_slice(MAGIC);
    }
    let whole = bytes.len();
    // Each reaches from its own beginning to the end: 300 times the buffer.
    let overlapping: Vec<_> = (0..300).map(|at| (16 * at, whole - 16 * at)).collect();
    let told = refused(&pictured(&bytes, &overlapping).glb());
    assert_eq!(told.code, "gltf-too-large");
    assert!(told.pointer.is_some_and(|pointer| pointer.starts_with("/images/")));

    // Ten images of one view are one picture, and one that no texture uses is none.
    let mut file = pictured(&bytes, &[(0, whole)]);
    let image = file.json["images"][0].clone();
    file.json["images"] = vec![image; 10].into();
    file.json["images"]
        .as_array_mut()
        .expect("a list")
        .push(json!({ "uri": "http://elsewhere/a.png" }));
    file.json["textures"] = (0..10).map(|source| json!({ "source": source })).collect();
    let imported = opened(&file);
    assert_eq!(imported.pictures.len(), 1);
    assert!((whole as u64..whole as u64 + 1_000).contains(&imported.source.effort().bytes_kept));
    assert!(
        imported
            .diagnostics
            .iter()
            .all(|finding| finding.code != "gltf-image-not-read")
    );
}

#[test]
fn a_file_beside_is_asked_for_once_and_counts_once() {
    let mut file = bare(&json!({}));
    let length = file.bin.len();
    file.json["buffers"] = vec![json!({ "byteLength": length, "uri": "data.bin" }); 500].into();
    for view in file.json["bufferViews"].as_array_mut().expect("views") {
        view["buffer"] = json!(499);
    }
    file.json["images"] = vec![json!({ "uri": "skin.png" }); 20].into();
    file.json["textures"] = (0..20).map(|source| json!({ "source": source })).collect();
    let text = serde_json::to_vec(&file.json).expect("JSON");
    let (asked, bin) = (Cell::new(0), bytes::Bytes::from(file.bin.clone()));
    let find = |_: &str| {
        asked.set(asked.get() + 1);
        Some(bin.clone())
    };
    let imported = import_beside(&text, &find).expect("its data are there");
    assert_eq!(imported.pictures.len(), 1);
    assert_eq!(asked.get(), 2, "the data and the picture");
    let container = gltf::open(&text, &mut Vec::new()).expect("JSON");
    let root = gltf::parse(&container).expect("glTF");
    assert_eq!(Buffers::new(&root, &container, &find).byte_count(), length as u64);
}

/// A chain of so many joints with one vertex on the last.
fn chain(joints: usize) -> Model {
    let parents = (0..joints as u32).map(|joint| joint.checked_sub(1).map(JointIndex));
    let skeleton = Skeleton::new(
        parents.collect(),
        vec![Affine3A::IDENTITY; joints],
        (0..joints as u32).collect(),
    );
    let influences = Influences {
        joints: [joints as u32 - 1, 0, 0, 0],
        weights: [1.0, 0.0, 0.0, 0.0],
    };
    Model {
        mesh: Mesh {
            positions: vec![Vec3::ZERO],
            normals: vec![Vec3::Z],
            tex_coords: vec![Vec2::ZERO],
            influences: vec![influences],
            ..Mesh::default()
        },
        skeleton: skeleton.expect("parents come first"),
        ..Model::default()
    }
}

#[test]
fn more_joints_than_a_vertex_can_name_are_refused_on_reading_and_on_writing() {
    let most = Skeleton::MOST_NAMED;
    let mut nodes: Vec<Value> = (1..=most).map(|child| json!({ "children": [child] })).collect();
    nodes.push(json!({ "mesh": 0, "skin": 0 }));
    let file = triangle(
        &json!({ "nodes": nodes, "skins": [{ "joints": [most] }] }),
        |file| json!({ "JOINTS_0": file.shorts(&[[0_u16; 4]; 3]), "WEIGHTS_0": file.floats(&[[1.0, 0.0, 0.0, 0.0]; 3]) }),
    );
    let told = refused(&file.glb());
    assert_eq!(told.code, "gltf-too-large");
    assert_eq!(
        told.message,
        "The skeleton has 65537 joints; vertices of glTF can name 65536 at most."
    );
    let written = |joints| glb(&chain(joints), &JointNames::default(), &MapImages::new());
    assert!(written(most).is_ok());
    let error = written(most + 1).expect_err("one too many");
    assert!(matches!(error, ExportError::TooManyJoints(65_537)));
    assert_eq!(
        error.to_string(),
        "The model has 65537 joints; vertices of a .glb can name 65536 at most."
    );
}

#[test]
fn other_formats_keep_no_account() {
    let text = include_bytes!("../../../web/sample/figure.m3d");
    assert_eq!(import(text).expect("a model").source.effort(), Effort::default());
}
