//! The forms of a file, and how numbers are stored.

use bindpose::import::{FileFormat, files_beside, import, import_beside};
use serde_json::json;

use super::{CORNERS, assert_at, bare, codes_of, posed, read, refused, told, told_all, triangle};
use crate::gltf_files::glb;

#[test]
fn binary_text_and_text_with_its_data_beside_are_one_model() {
    let file = bare(&json!({}));
    let beside = file.text_beside("some%20folder/data.bin");
    assert_eq!(files_beside(&beside), ["some folder/data.bin"]);
    assert_eq!(refused(&beside).code, "gltf-buffer-missing");
    let bin = bytes::Bytes::from(file.bin.clone());
    let find = |path: &str| (path == "some folder/data.bin").then(|| bin.clone());
    let beside = import_beside(&beside, &find).expect("its data are there");
    let read = read(&file);
    assert_eq!(
        (read.source.format, beside.source.format),
        (FileFormat::Glb, FileFormat::Gltf)
    );
    assert_eq!(read.model.mesh.positions, beside.model.mesh.positions);
    assert_at(&read.model.mesh.positions, &CORNERS);
}

#[test]
fn a_finding_has_its_pointer_and_in_text_its_line_and_in_a_container_its_offset() {
    let mut file = bare(&json!({}));
    file.json["meshes"][0]["primitives"][0]["indices"] = json!(7);
    let (text, binary) = (refused(&file.text()), refused(&file.glb()));
    for refused in [&text, &binary] {
        assert_eq!(refused.code, "gltf-index-out-of-range");
        assert_eq!(refused.pointer.as_deref(), Some("/meshes/0/primitives/0/indices"));
    }
    let source = file.text();
    let at = text.position.expect("text has lines");
    let line = source
        .split(|&byte| byte == b'\n')
        .nth(at.line as usize - 1)
        .expect("it is there");
    assert_eq!(&line[at.column as usize - 1..], b"7");
    assert_eq!(binary.position, None);

    let cut = &file.glb()[..60];
    let cut = refused(cut);
    assert_eq!((cut.code, cut.byte_offset), ("glb-damaged", Some(60)));
    let syntax = refused(b"{\n  \"asset\": }");
    let at = syntax.position.expect("text has lines");
    assert_eq!((syntax.code, at.line, at.column), ("gltf-not-json", 2, 12));
    let kind = refused(b"{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{}, {\"mesh\": \"a\"}]}");
    assert_eq!(
        (kind.code, kind.pointer.as_deref()),
        ("gltf-wrong-type", Some("/nodes/1/mesh"))
    );
}

#[test]
fn a_value_of_a_wrong_kind_is_marked_where_it_begins() {
    let json = br#"{"asset":{"version":"2.0"},"nodes":[{"name":"a"},{"mesh":"body"}],"skins":[{"name":"b"}]}"#;
    let place = |value: &str| {
        std::str::from_utf8(json)
            .ok()
            .and_then(|text| text.find(value))
            .expect("it is there")
    };
    let column = |text: &[u8]| refused(text).position.map(|at| (at.line, at.column as usize));
    assert_eq!(column(json), Some((1, place("\"body\"") + 1)));
    let marked = [b"\xEF\xBB\xBF".as_slice(), json].concat();
    assert_eq!(
        column(&marked),
        Some((1, place("\"body\"") + 4)),
        "behind a mark of the encoding"
    );
    let lacks = String::from_utf8_lossy(json).replace("\"body\"", "0");
    let object = lacks.find("{\"name\":\"b\"}").expect("it is there");
    assert_eq!(
        column(lacks.as_bytes()),
        Some((1, object + 1)),
        "an object that lacks something"
    );
    let binary = refused(&glb(&[(b"JSON", json)]));
    assert_eq!(
        (binary.position, binary.byte_offset),
        (None, Some(20 + place("\"body\"") as u64))
    );
}

#[test]
fn what_a_container_has_too_much_is_left_out() {
    let json = br#"{"asset":{"version":"2.0"}}  "#;
    let spaced = [json.as_slice(), b"   "].concat();
    let mut bytes = glb(&[
        (b"JSON", &spaced),
        (b"what", b"1234"),
        (b"BIN\0", b"abcd"),
        (b"JSON", b"{}  "),
    ]);
    bytes.extend(b"more");
    let imported = import(&bytes).expect("it can be read");
    let offsets: Vec<_> = told_all(&imported, "glb-surplus")
        .map(|finding| finding.byte_offset.is_some())
        .collect();
    assert_eq!(offsets, [true; 4]);
    assert!(codes_of(&imported).contains(&"gltf-empty"));
}

#[test]
fn numbers_are_read_sparse_interleaved_normalised_and_of_8_and_16_bits() {
    // Two attributes in one view, step 20 bytes: three floats, then normalised bytes and shorts.
    let mut file = bare(&json!({ "extensionsUsed": ["KHR_mesh_quantization"] }));
    let mut bytes = Vec::new();
    for (index, corner) in CORNERS.iter().enumerate() {
        bytes.extend(corner.iter().flat_map(|number| number.to_le_bytes()));
        bytes.extend([255, 51 * index as u8, 0, 255]);
        bytes.extend([32767_i16, -32768].iter().flat_map(|number| number.to_le_bytes()));
    }
    let view = file.view(&bytes, Some(20));
    let position = file.accessor(json!({ "bufferView": view, "componentType": 5126, "count": 3, "type": "VEC3" }));
    let color = file.accessor(
        json!({ "bufferView": view, "byteOffset": 12, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC4" }),
    );
    let tex_coord = file.accessor(
        json!({ "bufferView": view, "byteOffset": 16, "componentType": 5122, "normalized": true, "count": 3, "type": "VEC2" }),
    );
    let places = file.view(&[2], None);
    let values: Vec<u8> = [0.0_f32, 5.0, 1.0]
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    let values = file.view(&values, None);
    file.json["accessors"][position]["sparse"] = json!({
        "count": 1, "indices": { "bufferView": places, "componentType": 5121 }, "values": { "bufferView": values }
    });
    file.json["meshes"][0]["primitives"][0]["attributes"] =
        json!({ "POSITION": position, "COLOR_0": color, "TEXCOORD_0": tex_coord });
    let mesh = read(&file).model.mesh;
    assert_at(&mesh.positions, &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 5.0, 1.0]]);
    assert_eq!(mesh.colors[2].to_array(), [1.0, 0.4, 0.0, 1.0]);
    assert_eq!(mesh.tex_coords[0].to_array(), [1.0, -1.0]);

    // Positions as whole bytes, which KHR_mesh_quantization allows, and an accessor without a view, which is of zeros.
    let mut file = bare(&json!({ "extensionsRequired": ["KHR_mesh_quantization"] }));
    let view = file.view(&[0, 0, 0, 0, 255, 3, 0, 0, 7, 0, 128, 0], Some(4));
    let position = file.accessor(json!({ "bufferView": view, "componentType": 5120, "count": 3, "type": "VEC3" }));
    let tex_coord = file.accessor(json!({ "componentType": 5126, "count": 3.0, "type": "VEC2" }));
    file.json["meshes"][0]["primitives"][0]["attributes"] = json!({ "POSITION": position, "TEXCOORD_0": tex_coord });
    let model = read(&file).model;
    assert_at(
        &posed(&model, 0.0),
        &[[0.0, 0.0, 0.0], [-1.0, 3.0, 0.0], [7.0, 0.0, -128.0]],
    );
}

#[test]
fn extensions_that_a_model_needs_are_named_and_others_noted() {
    for name in "KHR_draco_mesh_compression EXT_meshopt_compression KHR_texture_basisu ACME_teapots".split(' ') {
        let file = bare(&json!({ "extensionsUsed": [name], "extensionsRequired": [name] }));
        let refused = refused(&file.glb());
        assert_eq!(refused.code, "gltf-extension-required");
        assert!(refused.message.contains(name), "{}", refused.message);
        assert_eq!(refused.pointer.as_deref(), Some("/extensionsRequired/0"));
        let file = bare(&json!({ "extensionsUsed": [name] }));
        assert!(told(&read(&file), "gltf-extension-unknown").message.contains(name));
    }
    for version in ["1.0", "3.0"] {
        let file = bare(&json!({ "asset": { "version": version } }));
        assert_eq!(refused(&file.text()).code, "gltf-version");
    }
}

#[test]
fn the_scene_that_the_file_shows_first_is_read_and_else_the_first() {
    let scenes = json!([{ "nodes": [0] }, { "nodes": [1] }]);
    let nodes = json!([{ "mesh": 0 }, { "mesh": 0, "translation": [7.0, 0.0, 0.0] }]);
    let mut file = bare(&json!({ "scenes": scenes, "nodes": nodes, "scene": 1 }));
    assert_at(
        &read(&file).model.mesh.positions,
        &CORNERS.map(|[x, y, z]| [x + 7.0, y, z]),
    );
    file.json.as_object_mut().expect("an object").remove("scene");
    assert_at(&read(&file).model.mesh.positions, &CORNERS);
    // Without scenes there is all.
    file.json.as_object_mut().expect("an object").remove("scenes");
    assert_eq!(read(&file).model.mesh.vertex_count(), 6);
    file.json["scene"] = json!(5);
    assert_eq!(refused(&file.glb()).code, "gltf-index-out-of-range");
}

#[test]
fn indices_of_8_16_and_32_bits_and_colours_without_alpha_are_read() {
    for (component, bytes) in [
        (5121, vec![2, 0, 1]),
        (5123, vec![2, 0, 0, 0, 1, 0]),
        (5125, vec![2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]),
    ] {
        let mut file = triangle(
            &json!({}),
            |file| json!({ "COLOR_0": file.shorts(&[[65535, 0, 13107]; 3]) }),
        );
        let color = file.json["accessors"]
            .as_array_mut()
            .expect("a list")
            .last_mut()
            .expect("a color");
        color["normalized"] = json!(true);
        let view = file.view(&bytes, None);
        let indices =
            file.accessor(json!({ "bufferView": view, "componentType": component, "count": 3, "type": "SCALAR" }));
        file.json["meshes"][0]["primitives"][0]["indices"] = indices.into();
        let mesh = read(&file).model.mesh;
        // Clockwise, as models have it.
        assert_eq!(mesh.indices, [2, 1, 0], "{component}");
        assert_eq!(mesh.colors[0].to_array(), [1.0, 0.0, 0.2, 1.0]);
    }
}
