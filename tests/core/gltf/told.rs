//! What reading leaves out, and rules of glTF that change the picture: each is told with its place.

use bindpose::diagnostic::Severity;
use bindpose::import::Imported;
use bindpose::import::import;
use bindpose::model::AlphaMode;
use glam::{Quat, Vec4};
use serde_json::{Value, json};

use super::clips::moving;
use super::{CORNERS, assert_at, bare, posed, read, refused, told, told_all, triangle};
use crate::gltf_files::Gltf;

fn is_silent(imported: &Imported, code: &str) -> bool {
    imported.diagnostics.iter().all(|finding| finding.code != code)
}

#[test]
fn other_scenes_and_objects_outside_of_the_one_that_is_shown_are_counted() {
    let scenes = json!([{ "nodes": [0] }, { "nodes": [1, 2] }, { "nodes": [] }]);
    let nodes = json!([{ "mesh": 0 }, { "mesh": 0 }, { "mesh": 0 }]);
    let imported = read(&bare(&json!({ "scenes": scenes, "nodes": nodes })));
    let finding = told(&imported, "gltf-scene-left-out");
    assert_eq!(finding.message, "2 other scenes are left out: node 1, node 2.");
    assert_eq!((finding.severity, finding.count), (Severity::Note, 2));
    assert!(is_silent(&read(&bare(&json!({}))), "gltf-scene-left-out"));
}

#[test]
fn objects_that_become_one_mesh_are_named() {
    let nodes = json!([{ "mesh": 0, "name": "Body" }, { "mesh": 0 }, { "mesh": 0, "name": "Sword" }]);
    let imported = read(&bare(&json!({ "nodes": nodes, "scenes": [{ "nodes": [0, 1, 2] }] })));
    let finding = told(&imported, "gltf-objects-merged");
    assert_eq!(finding.message, "3 objects become one mesh: Body, node 1, Sword.");
    assert_eq!(finding.count, 3);
    let many: Vec<Value> = (0..12).map(|_| json!({ "mesh": 0 })).collect();
    let file = bare(&json!({ "nodes": many, "scenes": [{ "nodes": (0..12).collect::<Vec<_>>() }] }));
    let message = &told(&read(&file), "gltf-objects-merged").message.clone();
    assert!(message.ends_with("node 1, node 2 and 9 more."), "{message}");
    assert!(is_silent(&read(&bare(&json!({}))), "gltf-objects-merged"));
}

#[test]
fn shape_keys_are_told_whether_a_clip_moves_them_or_not() {
    let mut file = bare(&json!({}));
    let target = file.floats(&[[0.0, 0.0, 2.0]; 3]);
    let mesh = &mut file.json["meshes"][0];
    mesh["primitives"][0]["targets"] = json!([{ "POSITION": target }, { "POSITION": target }]);
    mesh["extras"] = json!({ "targetNames": ["Smile", "Frown"] });
    let imported = read(&file);
    let finding = told(&imported, "gltf-morph-targets-left-out");
    assert_eq!(
        finding.message,
        "2 shape keys (morph targets) stand still: Smile, Frown."
    );
    assert_eq!(finding.count, 2);
    assert!(
        is_silent(&imported, "gltf-extras-left-out"),
        "the names are told with them"
    );
}

#[test]
fn cameras_lights_and_nodes_without_anything_are_counted() {
    let nodes = json!([
        { "mesh": 0, "children": [4] }, { "camera": 0 }, { "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        { "name": "Socket", "children": [5] }, { "name": "Below the mesh" }, { "name": "Below the socket" },
    ]);
    let file = bare(&json!({ "nodes": nodes, "scenes": [{ "nodes": [0, 1, 2, 3] }],
            "cameras": [{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }] }));
    let imported = read(&file);
    let finding = told(&imported, "gltf-nodes-left-out");
    assert_eq!(
        finding.message,
        "5 nodes are left out: 1 camera, 1 light, 3 without anything on them."
    );
    assert_eq!(finding.count, 5);
}

#[test]
fn extras_are_told_but_for_those_that_are_read() {
    let nodes = json!([{ "mesh": 0, "extras": { "gameplay": "hero" } }]);
    let document = json!({ "nodes": nodes, "extras": [1], "scenes": [{ "nodes": [0], "extras": { "bindpose": { "up": "y" } } }],
        "materials": [{ "extras": 7 }], "asset": { "version": "2.0", "extras": null } });
    let imported = read(&bare(&document));
    let finding = told(&imported, "gltf-extras-left-out");
    assert_eq!(
        finding.message,
        "2 parts of the file have extras (custom properties), which are left out: /extras, /materials/0/extras.",
        "those of an object come through"
    );
    assert_eq!((finding.pointer.as_deref(), finding.count), (Some("/extras"), 2));
}

#[test]
fn attributes_that_nothing_takes_are_named() {
    let file = triangle(
        &json!({}),
        |file| json!({ "TEXCOORD_0": file.floats(&[[0.0; 2]; 3]), "TEXCOORD_1": file.floats(&[[0.0; 2]; 3]), "_HEAT": file.floats(&[[0.0]; 3]) }),
    );
    assert_eq!(
        told(&read(&file), "gltf-attribute-left-out").message,
        "2 attributes of vertices are not read: TEXCOORD_1, _HEAT."
    );
}

#[test]
fn whose_work_it_is_comes_along() {
    let document = json!({ "asset": { "version": "2.0", "copyright": "(c) Me" } });
    assert_eq!(read(&bare(&document)).model.copyright.as_deref(), Some("(c) Me"));
}

#[test]
fn glass_is_blended_and_told() {
    let extension = |values: Value| json!({ "extensions": { "KHR_materials_transmission": values } });
    let mut mask = extension(json!({ "transmissionFactor": 0.5 }));
    mask["alphaMode"] = json!("MASK");
    let materials = json!([
        extension(json!({ "transmissionFactor": 0.5 })),
        extension(json!({})),
        extension(json!({ "transmissionFactor": 1.0, "transmissionTexture": { "index": 0 } })),
        extension(json!({ "transmissionFactor": 1.0 })),
        mask,
    ]);
    let primitives: Vec<Value> = (0..5).map(|material| json!({ "material": material })).collect();
    let file = bare(
        &json!({ "materials": materials, "meshes": [{ "primitives": primitives }], "extensionsUsed": ["KHR_materials_transmission"] }),
    );
    let imported = read(&file);
    let drawn: Vec<_> = imported
        .model
        .materials
        .iter()
        .map(|material| (material.alpha, material.layers.transmission))
        .collect();
    let cut = AlphaMode::Mask { cutoff: 0.5 };
    assert_eq!(
        drawn,
        [
            (AlphaMode::Opaque, 0.5),
            (AlphaMode::Opaque, 0.0),
            (AlphaMode::Opaque, 0.0),
            (AlphaMode::Opaque, 1.0),
            (cut, 0.5)
        ]
    );
    let findings = told_all(&imported, "gltf-transmission");
    let pointers: Vec<_> = findings
        .map(|finding| finding.pointer.clone().unwrap_or_default())
        .collect();
    let pointer = |index: usize| format!("/materials/{index}/extensions/KHR_materials_transmission");
    assert_eq!(pointers, [0, 3, 4].map(pointer));
    let left_out = told(&imported, "gltf-map-left-out");
    assert!(
        left_out
            .message
            .ends_with(": transmissionTexture (and the transmission with it)."),
        "{}",
        left_out.message
    );
    assert!(is_silent(&imported, "gltf-extension-unknown"));
}

#[test]
fn colours_are_clamped_and_told() {
    let file = triangle(
        &json!({}),
        |file| json!({ "COLOR_0": file.floats(&[[2.0, 0.5, -1.0, 1.0], [1.0, 0.5, 0.0, 1.0], [0.0, f32::NAN, f32::INFINITY, 1.0]]) }),
    );
    let imported = read(&file);
    assert_eq!(
        imported.model.mesh.colors,
        [
            Vec4::new(1.0, 0.5, 0.0, 1.0),
            Vec4::new(1.0, 0.5, 0.0, 1.0),
            Vec4::new(0.0, 1.0, 1.0, 1.0)
        ]
    );
    assert_eq!(
        told(&imported, "gltf-rule-broken").message,
        "2 vertices have a colour with a number below 0, above 1 or not finite; clamped to 0…1."
    );
}

/// The same file with the accessor of these numbers instead of floats.
fn with_numbers(mut file: Gltf, accessor: usize, component: u64, normalized: bool) -> Gltf {
    let (size, signed) = match component {
        5120 => (1, true),
        5121 => (1, false),
        5122 => (2, true),
        5123 => (2, false),
        _ => (4, false),
    };
    let kind = file.json["accessors"][accessor]["type"]
        .as_str()
        .expect("a type")
        .to_owned();
    let numbers = match kind.as_str() {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        _ => 16,
    };
    let count = file.json["accessors"][accessor]["count"].as_u64().expect("a count") as usize;
    // The greatest number of the kind last in each element, which is a quaternion of no rotation and a weight of 1.
    let greatest: i64 = (1 << (8 * size - u32::from(signed))) - 1;
    let mut bytes = Vec::new();
    for _ in 0..count {
        for number in 0..numbers {
            let value = if number + 1 == numbers { greatest } else { 0 };
            bytes.extend(&value.to_le_bytes()[..size as usize]);
        }
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    let stride = (numbers * size as usize).next_multiple_of(4);
    let view = file.view(&bytes, Some(stride));
    let of_file = &mut file.json["accessors"][accessor];
    (of_file["bufferView"], of_file["componentType"]) = (view.into(), component.into());
    of_file["normalized"] = normalized.into();
    file
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Becomes {
    Read,
    Told,
    Refused,
}

#[test]
fn whole_numbers_are_read_where_they_belong_told_where_they_make_sense_and_refused_elsewhere() {
    use Becomes::{Read, Refused, Told};
    let skinned = |required: bool| {
        let extensions = if required {
            vec!["KHR_mesh_quantization"]
        } else {
            Vec::new()
        };
        let mut file = triangle(
            &json!({ "extensionsRequired": extensions, "extensionsUsed": extensions,
                "nodes": [{ "mesh": 0, "skin": 0, "children": [1] }, {}], "skins": [{ "joints": [1] }] }),
            |file| {
                json!({ "NORMAL": file.floats(&[[0.0, 0.0, 1.0]; 3]), "TANGENT": file.floats(&[[0.0, 0.0, 0.0, 1.0]; 3]),
                    "TEXCOORD_0": file.floats(&[[0.0; 2]; 3]), "COLOR_0": file.floats(&[[1.0; 4]; 3]),
                    "JOINTS_0": file.shorts(&[[0_u16; 4]; 3]), "WEIGHTS_0": file.floats(&[[1.0, 0.0, 0.0, 0.0]; 3]) })
            },
        );
        let matrices = file.floats(&[glam::Mat4::IDENTITY.to_cols_array()]);
        file.json["skins"][0]["inverseBindMatrices"] = matrices.into();
        let times = file.floats(&[[0.0]]);
        let outputs = [
            file.floats(&[[0.0; 3]]),
            file.floats(&[[0.0, 0.0, 0.0, 1.0]]),
            file.floats(&[[1.0; 3]]),
        ];
        let paths = ["translation", "rotation", "scale"].into_iter().enumerate();
        let channels: Vec<Value> = paths
            .map(|(index, path)| json!({ "sampler": index, "target": { "node": 1, "path": path } }))
            .collect();
        let samplers = outputs.map(|output| json!({ "input": times, "output": output }));
        file.json["animations"] = json!([{ "channels": channels, "samplers": samplers }]);
        file
    };
    // Of each place: signed and unsigned numbers of 8 bits as they are and normalised, and of 32 bits; then the same where quantized meshes
    // are required. 16 bits are as 8.
    #[rustfmt::skip]
    let places: [(&str, [Becomes; 5], [Becomes; 5]); 12] = [
        ("/meshes/0/primitives/0/attributes/POSITION", [Told, Told, Told, Told, Refused],
         [Read, Read, Read, Read, Refused]),
        ("/meshes/0/primitives/0/attributes/NORMAL", [Told, Told, Refused, Refused, Refused],
         [Told, Read, Refused, Refused, Refused]),
        ("/meshes/0/primitives/0/attributes/TANGENT", [Told, Told, Refused, Refused, Refused],
         [Told, Read, Refused, Refused, Refused]),
        ("/meshes/0/primitives/0/attributes/TEXCOORD_0", [Told, Told, Told, Read, Refused],
         [Read, Read, Read, Read, Refused]),
        ("/meshes/0/primitives/0/attributes/COLOR_0", [Refused, Refused, Told, Read, Refused],
         [Refused, Refused, Told, Read, Refused]),
        ("/meshes/0/primitives/0/attributes/WEIGHTS_0", [Refused, Refused, Told, Read, Refused],
         [Refused, Refused, Told, Read, Refused]),
        ("/skins/0/inverseBindMatrices", [Refused; 5], [Refused; 5]),
        ("/animations/0/samplers/0/input", [Refused; 5], [Refused; 5]),
        ("/animations/0/samplers/0/output", [Refused; 5], [Refused; 5]),
        ("/animations/0/samplers/1/output", [Told, Read, Told, Read, Refused], [Told, Read, Told, Read, Refused]),
        ("/animations/0/samplers/2/output", [Refused; 5], [Refused; 5]),
        ("/meshes/0/primitives/0/attributes/JOINTS_0", [Refused, Refused, Read, Read, Read],
         [Refused, Refused, Read, Read, Read]),
    ];
    for (pointer, plain, quantized) in places {
        for (required, expected) in [(false, plain), (true, quantized)] {
            let kinds = [(5120, false), (5120, true), (5121, false), (5121, true), (5125, false)];
            let wide = [(5122, false), (5122, true), (5123, false), (5123, true)];
            let all = kinds.into_iter().zip(expected).chain(wide.into_iter().zip(expected));
            for ((component, normalized), becomes) in all {
                if pointer.ends_with("JOINTS_0") && (component == 5125 || normalized || becomes == Read) {
                    // Which whole numbers those may be is another rule.
                    continue;
                }
                let file = skinned(required);
                let accessor = file.json.pointer(pointer).and_then(Value::as_u64).expect("an index") as usize;
                let file = with_numbers(file, accessor, component, normalized);
                let case = format!("{pointer} of {component}, normalized {normalized}, required {required}");
                let (found, at) = match bindpose::import::import(&file.glb()) {
                    Err(refused) => {
                        assert_eq!(refused.error.code, "gltf-accessor-format", "{case}");
                        (Refused, refused.error.pointer)
                    }
                    Ok(imported) => {
                        let rules = told_all(&imported, "gltf-rule-broken");
                        let mut at = rules
                            .filter_map(|finding| finding.pointer.clone())
                            .filter(|at| at == pointer);
                        at.next().map_or((Read, None), |at| (Told, Some(at)))
                    }
                };
                assert_eq!(found, becomes, "{case}");
                assert!(found == Read || at.as_deref() == Some(pointer), "{case}: {at:?}");
            }
        }
    }
    let file = with_numbers(skinned(false), 0, 5125, false);
    assert_eq!(
        refused(&file.glb()).message,
        "Accessor 0 has unsigned whole numbers of 32 bits, where floats belong."
    );
}

#[test]
fn rotations_have_unit_length_whatever_is_between_them() {
    let sound = |way: &'static str, length: f32| {
        moving(move |file| {
            let times = file.floats(&[[0.0], [1.0], [2.0]]);
            let turn = |angle: f32| Quat::from_rotation_z(angle).to_array();
            let slope = [0.0, 0.0, 0.3, -0.1];
            let keys = [turn(0.0), turn(0.8).map(|part| part * length), turn(-0.5)];
            let rows: Vec<[f32; 4]> = match way {
                "CUBICSPLINE" => keys.into_iter().flat_map(|key| [slope, key, slope]).collect(),
                _ => keys.to_vec(),
            };
            let values = file.floats(&rows);
            vec![(0, "rotation", times, values, way)]
        })
    };
    for way in ["STEP", "LINEAR", "CUBICSPLINE"] {
        let [plain, long, zero] = [1.0, 4.0, 0.0].map(|length| read(&sound(way, length)));
        for time_secs in [0.0, 0.3, 0.7, 1.0, 1.6] {
            let expected = posed(&plain.model, time_secs)
                .iter()
                .map(|at| at.to_array())
                .collect::<Vec<_>>();
            assert_at(&posed(&long.model, time_secs), &expected);
        }
        assert!(is_silent(&plain, "rotation-not-unit"), "{way}");
        assert_eq!(
            told(&long, "rotation-not-unit").moments[0].time_secs,
            Some(1.0),
            "{way}"
        );
        told(&zero, "rotation-zero");
        for imported in [&plain, &long, &zero] {
            let track = &imported.model.clips[0].tracks[0];
            let values = track.rotation().values();
            assert!(
                values.iter().all(|value| (value.length() - 1.0).abs() < 1e-6),
                "{way}: {values:?}"
            );
        }
    }
}

#[test]
fn times_below_0_are_told_and_kept() {
    let file = moving(|file| {
        let times = file.floats(&[[-1.0], [1.0]]);
        let values = file.floats(&[[0.0; 3], [1.0; 3]]);
        vec![(1, "translation", times, values, "LINEAR")]
    });
    let imported = read(&file);
    let finding = told(&imported, "gltf-rule-broken");
    assert_eq!(
        finding.message,
        "1 key has a time below 0, which glTF does not have (bone 1 at -1 s); kept where they are."
    );
    assert_eq!(finding.pointer.as_deref(), Some("/animations/0"));
    assert_eq!(imported.model.clips[0].start_secs, -1.0);
}

#[test]
fn a_spline_that_overflows_is_straight_and_told() {
    let spline = |slope: f32| {
        moving(|file| {
            let times = file.floats(&[[0.0], [100.0]]);
            let values = file.floats(&[[0.0; 3], CORNERS[0], [slope; 3], [slope; 3], CORNERS[1], [0.0; 3]]);
            vec![(1, "translation", times, values, "CUBICSPLINE")]
        })
    };
    let imported = read(&spline(3e38));
    assert_eq!(
        told(&imported, "gltf-rule-broken").message,
        "1 channel follows a spline whose numbers overflow between its keys; taken as straight."
    );
    assert!(!imported.model.clips[0].tracks[1].bends());
    assert_eq!(imported.model.clips[0].tracks[1].at(50.0).translation.x, 0.5);
    let imported = read(&spline(1e3));
    assert!(is_silent(&imported, "gltf-rule-broken"));
    assert!(imported.model.clips[0].tracks[1].bends());
}

#[test]
fn a_key_that_stands_just_behind_a_jump_stays() {
    let jump = 1.0_f32.next_up();
    let file = moving(|file| {
        let times = file.floats(&[[0.0], [1.0], [1.0], [jump], [2.0]]);
        let values = file.floats(&[[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3], [4.0; 3]]);
        vec![(1, "translation", times, values, "LINEAR")]
    });
    let track = &read(&file).model.clips[0].tracks[1];
    assert_eq!(track.times_secs(), [0.0, 1.0, jump, jump.next_up(), 2.0]);
    let x: Vec<f32> = track.translation().values().iter().map(|at| at.x).collect();
    assert_eq!(x, [0.0, 1.0, 2.0, 3.0, 4.0]);
}

#[test]
fn what_is_of_a_wrong_kind_has_its_pointer_wherever_serde_tells_it() {
    let document = |rest: &str| format!("{{\n \"asset\": {{ \"version\": \"2.0\" }},\n {rest}\n}}");
    for (rest, pointer) in [
        // Values that serde has read when it tells of them.
        (r#""nodes": [{}, { "mesh": "a" }]"#, "/nodes/1/mesh"),
        (r#""nodes": [{ "children": [1, 2, -3, 4] }]"#, "/nodes/0/children/2"),
        (r#""nodes": [{ "name": "a\"]" }, 7]"#, "/nodes/1"),
        (r#""nodes": [null]"#, "/nodes/0"),
        (r#""nodes": 5"#, "/nodes"),
        // Lists and objects of which it has read the bracket, and some of which it has read nothing.
        (r#""nodes": [{ "mesh": [1] }]"#, "/nodes/0/mesh"),
        (r#""nodes": [{ "mesh": { "a/b~": [] } }]"#, "/nodes/0/mesh"),
        (r#""nodes": [{ "name": [1] }]"#, "/nodes/0/name"),
        (r#""nodes": [{ "children": {} }]"#, "/nodes/0/children"),
        (r#""extensionsUsed": [[1]]"#, "/extensionsUsed/0"),
        // Keys that need other letters in a pointer.
        (
            r#""meshes": [{ "primitives": [{ "attributes": { "a/b~": "x" } }] }]"#,
            "/meshes/0/primitives/0/attributes/a~1b~0",
        ),
        // Objects that lack something, or have it twice.
        (r#""skins": [{ "joints": [0] }, { "name": "b" }]"#, "/skins/1"),
        (r#""skins": [{ "joints": [0], "joints": [0] }]"#, "/skins/0"),
        // What follows is no JSON any more.
        (r#""nodes": [{ "mesh": "a", "#, "/nodes/0/mesh"),
    ] {
        let told = refused(document(rest).as_bytes());
        assert_eq!(
            (told.code, told.pointer.as_deref()),
            ("gltf-wrong-type", Some(pointer)),
            "{rest}"
        );
    }
}

#[test]
fn a_key_of_the_json_that_stands_twice_is_named() {
    let told = refused(br#"{ "asset": { "version": "2.0" }, "nodes": [], "nodes": [] }"#);
    assert_eq!(
        (told.code, told.message.as_str()),
        ("gltf-wrong-type", "The key `nodes` stands twice.")
    );
    assert_eq!(told.pointer.as_deref(), Some(""));
}

#[test]
fn what_is_packed_is_refused_with_the_tool_that_unpacks_it() {
    for (name, tool) in [
        ("KHR_draco_mesh_compression", "`gltf-transform copy IN.glb OUT.glb`"),
        ("EXT_meshopt_compression", "`gltf-transform copy IN.glb OUT.glb`"),
        ("KHR_texture_basisu", "`gltf-transform ktxdecompress IN.glb OUT.glb`"),
        ("EXT_texture_avif", "`gltf-transform png IN.glb OUT.glb`"),
    ] {
        let file = bare(&json!({ "extensionsUsed": [name], "extensionsRequired": [name] }));
        let told = refused(&file.glb());
        assert_eq!(told.code, "gltf-extension-required");
        assert!(
            told.message.ends_with(&format!(
                "unpack {} with {tool}.",
                if name.starts_with("KHR_texture") || name.ends_with("avif") {
                    "them"
                } else {
                    "it"
                }
            )),
            "{}",
            told.message
        );
    }
}

#[test]
fn a_broken_index_is_told_with_what_it_belongs_to() {
    let view = json!({ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" });
    let beyond = json!({ "bufferView": 9, "componentType": 5126, "count": 3, "type": "VEC3" });
    let primitive = |accessor: usize| json!({ "attributes": { "POSITION": accessor } });
    for (pointer, value, expected) in [
        (
            "accessors",
            json!([view, view, view, view, beyond]),
            "Accessor 4 names buffer view 9, but",
        ),
        ("scenes", json!([{ "nodes": [0, 7] }]), "Scene 0 names node 7, but"),
        (
            "meshes",
            json!([
                { "primitives": [primitive(0)] },
                { "primitives": [primitive(0)] },
                { "primitives": [primitive(0), primitive(0), primitive(0), primitive(9)] },
            ]),
            "Primitive 3 of mesh 2 names accessor 9, but",
        ),
        ("scene", json!(7), "The file names scene 7, but"),
    ] {
        let mut file = bare(&json!({ "nodes": [{ "mesh": 0 }] }));
        file.json[pointer] = value;
        if pointer == "meshes" {
            file.json["nodes"][0]["mesh"] = json!(2);
        }
        if pointer == "accessors" {
            file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(4);
        }
        let messages: Vec<String> = match import(&file.glb()) {
            Ok(imported) => imported
                .diagnostics
                .into_iter()
                .map(|finding| finding.message)
                .collect(),
            Err(refused) => vec![refused.error.message],
        };
        assert!(
            messages.iter().any(|message| message.starts_with(expected)),
            "{messages:?}"
        );
    }
}
