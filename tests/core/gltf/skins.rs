//! Skeletons out of nodes and skins. The expected places are computed by hand.

use bindpose::import;
use proptest::prelude::*;
use serde_json::{Value, json};

use super::{assert_at, codes_of, posed, read, refused, told, triangle};
use crate::gltf_files::Gltf;

/// A matrix that moves, as glTF stores it.
fn moved(x: f32, y: f32, z: f32) -> [f32; 16] {
    [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x, y, z, 1.0]
}

/// The corners of the triangle follow joints 0, 1 and half of both.
fn weights(file: &mut Gltf) -> Value {
    json!({
        "JOINTS_0": file.shorts(&[[0, 0, 0, 0], [1, 0, 0, 0], [0, 1, 0, 0]]),
        "WEIGHTS_0": file.floats(&[[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0]]),
    })
}

/// A hip with a knee above it, under a node that scales, and the mesh.
pub(super) fn rig() -> Value {
    json!([
        { "name": "Armature", "scale": [2.0, 2.0, 2.0], "children": [2] },
        { "mesh": 0, "skin": 0, "translation": [100.0, 0.0, 0.0] },
        { "name": "Hip", "children": [3], "translation": [1.0, 0.0, 0.0] },
        { "name": "Knee", "translation": [0.0, 1.0, 0.0] },
    ])
}

/// These nodes, the first two of them roots, with a triangle whose corners follow the hip and the knee.
pub(super) fn skinned(nodes: &Value) -> Gltf {
    triangle(
        &json!({ "scenes": [{ "nodes": [0, 1] }], "nodes": nodes, "skins": [{ "joints": [2, 3] }] }),
        weights,
    )
}

#[test]
fn a_skin_hangs_on_its_joints_and_not_on_the_node_of_its_mesh() {
    let mut file = skinned(&rig());
    let matrices = file.floats(&[moved(0.0, 0.0, 0.0), moved(0.0, -1.0, 0.0)]);
    file.json["skins"][0]["inverseBindMatrices"] = matrices.into();
    let imported = read(&file);
    let skeleton = &imported.model.skeleton;
    assert_eq!(skeleton.joint_count(), 3, "the node above is a joint too");
    let names: Vec<_> = skeleton
        .joint_of_bone()
        .iter()
        .map(|&joint| skeleton.name(joint))
        .collect();
    assert_eq!(names, [Some("Armature"), Some("Hip"), Some("Knee")]);
    // Corner 1 is bound to the knee, which is 1 above: 2 · ((1, 0) − (0, 1) + (0, 1) + (1, 0)).
    assert_at(
        &posed(&imported.model, 0.0),
        &[[2.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 4.0, 0.0]],
    );
    // All joints move it alike at rest, so that is where it is bound.
    assert_at(
        &imported.model.mesh.positions,
        &[[2.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 4.0, 0.0]],
    );
    assert_eq!(codes_of(&imported), ["gltf-normals-absent"]);
}

#[test]
fn without_inverse_bind_matrices_the_mesh_is_in_the_space_of_its_joints() {
    let file = skinned(&rig());
    assert_at(
        &posed(&read(&file).model, 0.0),
        &[[2.0, 0.0, 0.0], [4.0, 2.0, 0.0], [2.0, 5.0, 0.0]],
    );
}

#[test]
fn two_skins_on_the_same_joints_make_one_skeleton() {
    let nodes = json!([
        { "mesh": 0, "skin": 0 }, { "mesh": 0, "skin": 1 }, { "children": [3], "translation": [0.0, 0.0, 1.0] },
        { "translation": [0.0, 1.0, 0.0] },
    ]);
    let skins = json!([{ "joints": [2, 3] }, { "joints": [3, 2] }]);
    let mut file = triangle(
        &json!({ "scenes": [{ "nodes": [0, 1, 2] }], "nodes": nodes, "skins": skins }),
        weights,
    );
    // The second mesh was modelled 5 to the right of the first, and its joints stand in the other order.
    let first = file.floats(&[moved(0.0, 0.0, -1.0), moved(0.0, -1.0, -1.0)]);
    let second = file.floats(&[moved(-5.0, -1.0, -1.0), moved(-5.0, 0.0, -1.0)]);
    file.json["skins"][0]["inverseBindMatrices"] = first.into();
    file.json["skins"][1]["inverseBindMatrices"] = second.into();
    let imported = read(&file);
    assert_eq!(imported.model.skeleton.joint_count(), 2);
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let left = corners.map(|[x, y, z]| [x - 5.0, y, z]);
    assert_at(&posed(&imported.model, 0.0), &[corners, left].concat());

    // Matrices that no one transform explains: joints of their own stand in.
    let second = file.floats(&[moved(-5.0, -1.0, -1.0), moved(0.0, 0.0, 7.0)]);
    file.json["skins"][1]["inverseBindMatrices"] = second.into();
    let imported = read(&file);
    assert_eq!(imported.model.skeleton.joint_count(), 4);
    let posed = posed(&imported.model, 0.0);
    // Slot 0 is the upper joint, slot 1 the lower one: (x − 5), (x, y, z + 8), and half of both.
    assert_at(&posed[3..], &[[-5.0, 0.0, 0.0], [1.0, 0.0, 8.0], [-2.5, 2.0, 4.0]]);
}

#[test]
fn a_mesh_on_a_joint_follows_it_beside_a_skin() {
    let mut nodes = rig();
    nodes[3]["children"] = json!([4]);
    nodes
        .as_array_mut()
        .expect("a list")
        .push(json!({ "name": "Hat", "mesh": 1, "scale": [-1.0, 1.0, 1.0] }));
    let mut file = triangle(
        &json!({ "scenes": [{ "nodes": [0, 1] }], "nodes": nodes, "skins": [{ "joints": [2, 3] }], "meshes": [{ "primitives": [{}] }] }),
        weights,
    );
    let hat = file.floats(&super::CORNERS);
    file.json["meshes"]
        .as_array_mut()
        .expect("a list")
        .push(json!({ "primitives": [{ "attributes": { "POSITION": hat } }] }));
    let imported = read(&file);
    let skeleton = &imported.model.skeleton;
    assert_eq!(skeleton.name(skeleton.joint_of_bone()[3]), Some("Hat"));
    // 2 · (Hip (1, 0) + Knee (0, 1) + mirrored corner).
    assert_at(
        &posed(&imported.model, 0.0)[3..],
        &[[2.0, 2.0, 0.0], [0.0, 2.0, 0.0], [2.0, 6.0, 0.0]],
    );
    let mesh = &imported.model.mesh;
    let second = &mesh.indices[3..];
    assert_eq!(second, [3, 4, 5], "mirrored, and against the clock in the file");
}

#[test]
fn a_joint_that_flattens_space_is_no_reason_to_fail() {
    let mut nodes = rig();
    nodes[3]["scale"] = json!([0.0, 0.0, 0.0]);
    nodes[3]["mesh"] = json!(0);
    let file = skinned(&nodes);
    assert_at(&posed(&read(&file).model, 0.0)[3..], &[[2.0, 2.0, 0.0]; 3]);
}

#[test]
fn the_four_greatest_weights_are_kept_and_the_loss_is_told() {
    let nodes = json!([{ "mesh": 0, "skin": 0 }, {}, {}, {}, {}, {}, {}]);
    let skins = json!([{ "joints": [1, 2, 3, 4, 5, 6] }]);
    let file = triangle(
        &json!({ "scenes": [{ "nodes": [0, 1, 2, 3, 4, 5, 6] }], "nodes": nodes, "skins": skins }),
        |file| {
            json!({
                "JOINTS_0": file.shorts(&[[0, 1, 2, 3]; 3]),
                "WEIGHTS_0": file.floats(&[[0.1, 0.2, 0.05, 0.3], [1.0, 0.0, 0.0, 0.0], [0.0; 4]]),
                "JOINTS_1": file.shorts(&[[4, 5, 0, 0]; 3]),
                "WEIGHTS_1": file.floats(&[[0.25, 0.1, 0.0, 0.0], [0.0; 4], [0.0; 4]]),
            })
        },
    );
    let imported = read(&file);
    let influences = &imported.model.mesh.influences;
    assert_eq!(influences[0].joints, [3, 4, 1, 0]);
    let kept = [0.3, 0.25, 0.2, 0.1].map(|weight: f32| weight / 0.85);
    for (found, expected) in influences[0].weights.iter().zip(kept) {
        assert!((found - expected).abs() < 1e-6);
    }
    assert_eq!(influences[1].weights, [1.0, 0.0, 0.0, 0.0]);
    let cut = told(&imported, "weights-cut");
    assert!(cut.message.contains("15.00 %"), "{}", cut.message);
    assert_eq!(
        codes_of(&imported),
        ["gltf-normals-absent", "weights-all-zero", "weights-cut"]
    );
}

/// What reading a triangle with these influences comes to: those of the model to the bit, or the code of the error; and the findings.
fn influences_read(joints: [[u16; 4]; 3], weights: [[f32; 4]; 3], has_second_set: bool) -> String {
    let nodes = json!([{ "mesh": 0, "skin": 0 }, {}, {}, {}, {}]);
    let file = triangle(
        &json!({ "scenes": [{ "nodes": [0, 1, 2, 3, 4] }], "nodes": nodes, "skins": [{ "joints": [1, 2, 3, 4] }] }),
        |file| {
            let mut attributes = json!({ "JOINTS_0": file.shorts(&joints), "WEIGHTS_0": file.floats(&weights) });
            if has_second_set {
                attributes["JOINTS_1"] = file.shorts(&[[0; 4]; 3]).into();
                attributes["WEIGHTS_1"] = file.floats(&[[0.0; 4]; 3]).into();
            }
            attributes
        },
    );
    match import::import(&file.glb()) {
        Ok(imported) => {
            let influences = imported.model.mesh.influences.iter();
            let bits = influences.map(|influences| (influences.joints, influences.weights.map(f32::to_bits)));
            let findings = imported.diagnostics.iter().map(|finding| &finding.message);
            format!("{:?} {:?}", bits.collect::<Vec<_>>(), findings.collect::<Vec<_>>())
        }
        Err(error) => format!("{error:?}"),
    }
}

proptest! {
    #![proptest_config(crate::properties::cases(400))]

    /// One set of four has a quicker way of its own. A second set without any weight says the same, and goes the way of all others.
    #[test]
    fn one_set_of_influences_is_read_as_one_of_several(
        joints in prop::array::uniform3(prop::array::uniform4(prop_oneof![20 => 0_u16..4, 1 => Just(4)])),
        weights in prop::array::uniform3(prop::array::uniform4(prop_oneof![
            4 => Just(0.0_f32),
            4 => prop::sample::select(vec![0.25, 0.5, 0.75, 1.0, 0.3, 0.7, 0.1, 1.0 / 3.0, 0.333]),
            1 => prop::sample::select(vec![-0.0, -0.25, 1e-30, f32::NAN, f32::INFINITY, f32::MAX]),
        ])),
        to_one in any::<bool>(),
    ) {
        let mut weights = weights;
        if to_one {
            for weights in &mut weights {
                let sum: f32 = weights.iter().sum();
                *weights = weights.map(|weight| weight / sum);
            }
        }
        prop_assert_eq!(influences_read(joints, weights, false), influences_read(joints, weights, true));
    }
}

#[test]
fn bone_numbers_of_the_file_are_taken_where_all_joints_have_them() {
    let mut nodes = rig();
    nodes[0] = json!({ "children": [2], "extras": { "bindpose": { "bone": 2 } } });
    nodes[2]["extras"] = json!({ "bindpose": { "bone": 0 } });
    nodes[3]["extras"] = json!({ "bindpose": { "bone": 1 } });
    let mut file = skinned(&nodes);
    let name = |file: &Gltf| {
        let skeleton = read(file).model.skeleton;
        skeleton.name(skeleton.joint_of_bone()[0]).map(str::to_owned)
    };
    assert_eq!(name(&file).as_deref(), Some("Hip"));
    file.json["nodes"][3]["extras"]["bindpose"]["bone"] = json!(0);
    assert_eq!(name(&file), None);
}

#[test]
fn weights_for_joints_that_a_skin_lacks_are_refused_with_the_vertex() {
    let nodes = json!([{ "mesh": 0, "skin": 0 }, {}]);
    let file = triangle(
        &json!({ "scenes": [{ "nodes": [0, 1] }], "nodes": nodes, "skins": [{ "joints": [1] }] }),
        weights,
    );
    let refused = refused(&file.glb());
    assert_eq!(refused.code, "influence-out-of-range");
    assert_eq!(refused.found.as_deref(), Some("1"));
}

#[test]
fn joints_and_weights_of_8_and_16_bits_say_the_same() {
    let nodes = json!([{ "mesh": 0, "skin": 0 }, {}, { "translation": [0.0, 0.0, 3.0] }]);
    let read = |attributes: &dyn Fn(&mut Gltf) -> Value| {
        let file = triangle(
            &json!({ "scenes": [{ "nodes": [0, 1, 2] }], "nodes": nodes, "skins": [{ "joints": [1, 2] }] }),
            attributes,
        );
        read(&file).model
    };
    let whole = |file: &mut Gltf, component: u32, bytes: &[u8], normalized: bool| {
        let view = file.view(bytes, Some(bytes.len() / 3));
        file.accessor(
            json!({ "bufferView": view, "componentType": component, "normalized": normalized, "count": 3, "type": "VEC4" }),
        )
    };
    let joints = [0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
    let shorts = |numbers: [u16; 12]| numbers.map(u16::to_le_bytes).as_flattened().to_vec();
    let bytes = read(&|file| {
        json!({ "JOINTS_0": whole(file, 5121, &joints, false),
            "WEIGHTS_0": whole(file, 5121, &[204, 51, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0], true) })
    });
    let wider = read(&|file| {
        json!({ "JOINTS_0": whole(file, 5123, &shorts(joints.map(u16::from)), false),
            "WEIGHTS_0": whole(file, 5123, &shorts([52428, 13107, 0, 0, 65535, 0, 0, 0, 13107, 52428, 0, 0]), true) })
    });
    let floats = read(&|file| {
        json!({ "JOINTS_0": whole(file, 5121, &joints, false),
            "WEIGHTS_0": file.floats(&[[0.8, 0.2, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.2, 0.8, 0.0, 0.0]]) })
    });
    for model in [&bytes, &wider, &floats] {
        // By the second joint's part 3 further on.
        assert_at(&posed(model, 0.0), &[[0.0, 0.0, 0.6], [1.0, 0.0, 3.0], [0.0, 2.0, 0.6]]);
    }
}
