//! Files that want to do harm: each ends in an error, soon and with little memory.

use bindpose::anim::CompiledClip;
use bindpose::check;
use bindpose::export::{MapImages, glb as glb_of, m3d};
use bindpose::format::Dialect;
use bindpose::import::import;
use bindpose::model::JointNames;
use proptest::prelude::*;
use serde_json::{Value, json};

use super::{banner, bare, read, refused};
use crate::gltf_files::glb;

fn code(file: &crate::gltf_files::Gltf) -> &'static str {
    let [binary, text] = [refused(&file.glb()), refused(&file.text())];
    assert_eq!(binary.code, text.code);
    binary.code
}

#[test]
fn the_first_missing_file_is_named_and_the_others_are_counted() {
    let mut file = bare(&json!({}));
    file.json["buffers"] = json!([
        { "byteLength": 36, "uri": "first.bin" },
        { "byteLength": 36, "uri": "second.bin" },
        { "byteLength": 36, "uri": "third.bin" },
    ]);
    for view in file.json["bufferViews"].as_array_mut().expect("views") {
        view["buffer"] = json!(2);
    }
    let text = serde_json::to_vec(&file.json).expect("JSON");
    let told = refused(&text);
    assert_eq!(told.code, "gltf-buffer-missing");
    assert_eq!(
        told.message,
        "The file \"first.bin\", which has the data of buffer 0, is not there. 2 more buffers are missing too. Drop the .gltf together with its \
         .bin files."
    );
}

#[test]
fn accessors_that_reach_beyond_their_data_are_refused_before_anything_is_allocated() {
    for (key, value) in [
        ("count", json!(4)),
        ("count", json!(4_294_967_295_u64)),
        ("count", json!(u64::MAX)),
        ("byteOffset", json!(4)),
        ("byteOffset", json!(u64::MAX)),
    ] {
        let mut file = bare(&json!({}));
        file.json["accessors"][0][key] = value;
        assert!(
            ["gltf-accessor-out-of-range", "gltf-too-large"].contains(&code(&file)),
            "{key}"
        );
    }
    // Without data nothing bounds a count but what the file holds.
    let mut file = bare(&json!({}));
    file.json["accessors"][0] = json!({ "componentType": 5126, "count": 4_294_967_295_u64, "type": "VEC3" });
    assert_eq!(code(&file), "gltf-too-large");
    for (key, value) in [
        ("byteLength", json!(37)),
        ("byteLength", json!(u64::MAX)),
        ("byteOffset", json!(u64::MAX)),
        ("buffer", json!(9)),
    ] {
        let mut file = bare(&json!({}));
        file.json["bufferViews"][0][key] = value;
        assert!(
            ["gltf-buffer-short", "gltf-index-out-of-range"].contains(&code(&file)),
            "{key}"
        );
    }
    for stride in [0, 1, u64::MAX] {
        let mut file = bare(&json!({}));
        file.json["bufferViews"][0]["byteStride"] = json!(stride);
        assert_eq!(code(&file), "gltf-accessor-out-of-range", "{stride}");
    }
    let mut file = bare(&json!({}));
    let wrong = file.view(&[3], None);
    file.json["accessors"][0]["sparse"] =
        json!({ "count": 1, "indices": { "bufferView": wrong, "componentType": 5121 }, "values": { "bufferView": 0 } });
    assert_eq!(code(&file), "gltf-accessor-out-of-range");
}

#[test]
fn nodes_in_circles_and_with_two_parents_are_refused() {
    for nodes in [
        json!([{ "mesh": 0, "children": [0] }]),
        json!([{ "mesh": 0 }, { "children": [2] }, { "children": [1] }]),
        json!([{ "mesh": 0, "children": [1] }, {}, { "children": [1] }]),
    ] {
        let file = bare(&json!({ "nodes": nodes }));
        assert_eq!(code(&file), "gltf-nodes-tangled", "{nodes}");
    }
}

#[test]
fn a_long_chain_of_nodes_is_no_deep_recursion() {
    let mut nodes: Vec<_> = (1..50_000).map(|child| json!({ "children": [child] })).collect();
    nodes.push(json!({ "mesh": 0, "translation": [1.0, 0.0, 0.0] }));
    let file = bare(&json!({ "nodes": nodes }));
    assert_eq!(read(&file).model.mesh.positions[0].x, 1.0);
}

#[test]
fn one_mesh_or_clip_used_again_and_again_ends_in_an_error() {
    let corners = vec![[1.0, 2.0, 3.0]; 30_000];
    let mut file = bare(&json!({}));
    let position = file.floats(&corners);
    file.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": position } }] }]);
    file.json["nodes"] = vec![json!({ "mesh": 0 }); 2_000].into();
    file.json["scenes"] = json!([{ "nodes": (0..2_000).collect::<Vec<_>>() }]);
    assert_eq!(code(&file), "gltf-too-large");

    let mut file = bare(&json!({}));
    let times = file.floats(&[[0.0]]);
    let values = file.floats(&[[0.0; 3]]);
    let nodes: Vec<_> = (0..1_100).map(|_| json!({ "mesh": 0 })).collect();
    file.json["scenes"] = json!([{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }]);
    file.json["nodes"] = nodes.into();
    let animation = json!({ "samplers": [{ "input": times, "output": values }],
        "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }] });
    file.json["animations"] = vec![animation; 1_000].into();
    assert_eq!(code(&file), "gltf-too-large");
}

#[test]
fn a_long_data_uri_and_deep_nesting_are_met_without_trouble() {
    // 100 MB of letters behind the data of a triangle, sound and with one that is none.
    let text = String::from_utf8(bare(&json!({})).text()).expect("JSON is UTF-8");
    let end = text.find("base64,").expect("a data URI") + "base64,".len();
    let end = end + text[end..].find(['=', '"']).expect("it ends");
    let letters = end - (end - text.find("base64,").expect("a data URI") - "base64,".len()) % 4;
    for (last, is_sound) in [("AAAA", true), ("A*AA", false)] {
        let rest = text[end..].trim_start_matches('=');
        let long = [&text[..letters], &"A".repeat(100_000_000), last, rest].concat();
        assert_eq!(import(long.as_bytes()).is_ok(), is_sound, "{last}");
    }
    for (open, close) in [("[", "]"), ("{\"a\":", "}")] {
        let deep = format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{{\"extras\":{}1{}}}]}}",
            open.repeat(200_000),
            close.repeat(200_000)
        );
        assert_eq!(refused(deep.as_bytes()).code, "gltf-not-json");
    }
}

#[test]
fn containers_cut_anywhere_are_refused() {
    let whole = bare(&json!({})).glb();
    for length in 4..whole.len() {
        assert_eq!(refused(&whole[..length]).code, "glb-damaged", "{length}");
    }
    let mut claims = glb(&[(b"JSON", b"{}  ")]);
    claims[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(refused(&claims).code, "glb-damaged");
    assert_eq!(refused(&glb(&[(b"BIN\0", b"abcd")])).code, "glb-damaged");
    assert_eq!(refused(&glb(&[])).code, "glb-damaged");
}

/// All values in a document, by their pointers.
fn pointers(value: &Value, at: String, found: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            let items = list.iter().enumerate();
            items.for_each(|(index, item)| pointers(item, format!("{at}/{index}"), found));
        }
        Value::Object(object) => object
            .iter()
            .for_each(|(key, item)| pointers(item, format!("{at}/{key}"), found)),
        _ => {}
    }
    found.push(at);
}

/// What no exporter writes.
fn strange() -> impl Strategy<Value = Value> {
    prop::sample::select(vec![
        json!(-1),
        json!(0),
        json!(3),
        json!(0.5),
        json!(255),
        json!(1_u64 << 31),
        json!(1_u64 << 32),
        json!(u64::MAX),
        json!(1e300),
        json!(-1e38),
        json!(5126),
        json!("SCALAR"),
        json!("MAT4"),
        json!("CUBICSPLINE"),
        json!([]),
        json!({}),
        json!([0, 0]),
        Value::Null,
    ])
}

/// Whatever is read holds together: it is proved, checked, posed and written.
fn assert_total(bytes: &[u8]) {
    let Ok(imported) = import(bytes) else { return };
    let model = imported.model.checked().expect("what was read is sound");
    let compiled = CompiledClip::all(&model.clips);
    check::model(&model, &compiled, &*imported.source.places(bytes));
    super::posed(&model, 0.5);
    let names = JointNames::default();
    let written = glb_of(&model, &names, &MapImages::new()).expect("it can be written");
    assert!(import(&written.bytes).is_ok(), "what was written is read");
    m3d(&model, &names, Dialect::D3d12).expect("it can be written");
}

proptest! {
    #![proptest_config(crate::properties::cases(400))]

    #[test]
    fn changed_bytes_never_end_in_a_panic(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6), digits in any::<bool>()) {
        let mut bytes = banner().glb();
        let json_end = 20 + u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
        for (place, value) in changes {
            if digits {
                // Other numbers in the JSON, which stays JSON.
                let places: Vec<usize> = (20..json_end).filter(|&at| bytes[at].is_ascii_digit()).collect();
                bytes[places[place.index(places.len())]] = b'0' + value % 10;
            } else {
                let at = place.index(bytes.len());
                bytes[at] = value;
            }
        }
        assert_total(&bytes);
    }

    #[test]
    fn strange_values_anywhere_never_end_in_a_panic(changes in prop::collection::vec((any::<prop::sample::Index>(), strange()), 1..4)) {
        let mut file = banner();
        for (place, value) in changes {
            let mut found = Vec::new();
            pointers(&file.json, String::new(), &mut found);
            // The last one is the whole document.
            found.pop();
            if !found.is_empty() {
                *file.json.pointer_mut(&found[place.index(found.len())]).expect("it is there") = value;
            }
        }
        assert_total(&file.glb());
    }
}
