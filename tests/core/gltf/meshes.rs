//! Meshes: primitives, what they lack, and where they stand.

use bindpose::model::{Front, Handedness, UpAxis};
use glam::{Vec3, Vec4};
use serde_json::{Value, json};

use super::{CORNERS, assert_at, bare, codes_of, posed, read, told_all, triangle};

#[test]
fn strips_fans_and_lists_wind_the_same_way_and_points_and_lines_are_left_out() {
    let mut file = bare(
        &json!({ "meshes": [{ "primitives": [{}, { "mode": 5 }, { "mode": 6 }, { "mode": 0 }, { "mode": 2 }] }] }),
    );
    let square = file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    let ring = file.shorts(&[[0], [1], [3], [2]]);
    for (primitive, indices) in [(1, None), (2, Some(ring))] {
        let primitive = &mut file.json["meshes"][0]["primitives"][primitive];
        primitive["attributes"] = json!({ "POSITION": square });
        if let Some(indices) = indices {
            primitive["indices"] = indices.into();
        }
    }
    let imported = read(&file);
    let mesh = &imported.model.mesh;
    assert_eq!(
        mesh.submeshes
            .iter()
            .map(|submesh| submesh.triangle_count)
            .collect::<Vec<_>>(),
        [1, 2, 2]
    );
    for corners in mesh.indices.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|corner| mesh.positions[corners[corner] as usize]);
        assert!(
            (b - a).cross(c - a).z < 0.0,
            "clockwise, as models have fronts: {corners:?}"
        );
    }
    // The strip and the fan share their vertices, since they share their attributes.
    assert_eq!(mesh.vertex_count(), 7);
    let left_out = told_all(&imported, "gltf-primitive-left-out");
    assert_eq!(
        left_out.map(|finding| finding.pointer.as_deref()).collect::<Vec<_>>(),
        [Some("/meshes/0/primitives/3"), Some("/meshes/0/primitives/4")]
    );
    let model = &imported.model;
    assert_eq!(
        (model.handedness, model.up_axis, model.front),
        (Handedness::Right, UpAxis::Y, Front::Positive)
    );
}

#[test]
fn absent_normals_are_computed_and_told_and_absent_tangents_are_no_flaw() {
    let imported = read(&bare(&json!({})));
    assert_eq!(imported.model.mesh.normals, [Vec3::Z; 3]);
    assert_eq!(codes_of(&imported), ["gltf-normals-absent"]);
    // No normal map asks for them.
    let mesh = &imported.model.mesh;
    assert_eq!(mesh.tangents, []);
    let computed = mesh.tangents_or_computed();
    assert_eq!(computed.len(), 3);
    assert!(
        computed
            .iter()
            .all(|tangent| tangent.truncate().is_normalized() && tangent.w.abs() == 1.0)
    );
}

#[test]
fn tangents_are_those_of_the_file_and_computed_for_a_normal_map() {
    let tex_coords = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let read = |document: &Value, tangents: &[[f32; 4]]| {
        let file = triangle(document, |file| {
            let mut attributes = json!({ "TEXCOORD_0": file.floats(&tex_coords) });
            if !tangents.is_empty() {
                attributes["TANGENT"] = file.floats(tangents).into();
            }
            attributes
        });
        read(&file).model
    };
    let of_file = [[0.0, 1.0, 0.0, -1.0]; 3];
    assert_eq!(read(&json!({}), &of_file).mesh.tangents, of_file.map(Vec4::from));
    let mapped = json!({
        "materials": [{ "normalTexture": { "index": 0 } }], "textures": [{ "source": 0 }], "images": [{ "uri": "n.png" }],
        "meshes": [{ "primitives": [{ "material": 0 }] }],
    });
    assert_eq!(read(&mapped, &of_file).mesh.tangents, of_file.map(Vec4::from));
    let model = read(&mapped, &[]);
    // Along u; green points up in glTF, against v.
    assert_eq!(model.mesh.tangents, [Vec4::new(1.0, 0.0, 0.0, -1.0); 3]);
    // As many as there are vertices where one primitive has some and another has none.
    let two = json!({ "meshes": [{ "primitives": [{}, {}] }] });
    let mut file = triangle(
        &two,
        |file| json!({ "TANGENT": file.floats(&of_file), "TEXCOORD_0": file.floats(&tex_coords) }),
    );
    let bare = file.json["meshes"][0]["primitives"][1]["attributes"]
        .as_object_mut()
        .unwrap();
    bare.remove("TANGENT");
    let tangents = super::read(&file).model.mesh.tangents;
    assert_eq!(tangents[..3], of_file.map(Vec4::from));
    assert_eq!(tangents[3..], [Vec4::new(1.0, 0.0, 0.0, -1.0); 3]);
}

#[test]
fn a_static_mesh_stands_where_its_nodes_put_it_and_a_mirror_turns_its_winding() {
    let nodes = json!([
        { "scale": [1.0, 2.0, 1.0], "children": [1, 2] },
        { "mesh": 0, "translation": [10.0, 0.0, 0.0], "scale": [-1.0, 1.0, 1.0] },
        { "mesh": 0, "matrix": [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 3, 0, 1] },
    ]);
    let file = triangle(
        &json!({ "nodes": nodes }),
        |file| json!({ "NORMAL": file.floats(&[[0.0, 0.0, 1.0]; 3]) }),
    );
    let imported = read(&file);
    let (model, mesh) = (&imported.model, &imported.model.mesh);
    assert_eq!(model.skeleton.joint_count(), 0, "nothing moves it");
    assert_at(
        &posed(model, 0.0),
        &[
            [10.0, 0.0, 0.0],
            [9.0, 0.0, 0.0],
            [10.0, 4.0, 0.0],
            [0.0, 6.0, 0.0],
            [1.0, 6.0, 0.0],
            [0.0, 6.0, 2.0],
        ],
    );
    assert_eq!(mesh.indices, [0, 1, 2, 3, 5, 4]);
    assert_at(
        &mesh.normals,
        &[
            [0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0],
            [0.0, -1.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, -1.0, 0.0],
        ],
    );
    assert_eq!(codes_of(&imported), ["gltf-objects-merged"]);
}

#[test]
fn morph_targets_are_shown_with_the_weights_of_node_or_mesh() {
    let mut file = bare(&json!({ "meshes": [{ "primitives": [{}], "weights": [0.5, 0.0] }] }));
    let target = file.floats(&[[0.0, 0.0, 2.0]; 3]);
    let other = file.floats(&[[9.0, 9.0, 9.0]; 3]);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": target }, { "POSITION": other }]);
    assert_at(
        &read(&file).model.mesh.positions,
        &CORNERS.map(|[x, y, z]| [x, y, z + 1.0]),
    );
    file.json["nodes"][0]["weights"] = json!([-1.0, 0.0]);
    assert_at(
        &read(&file).model.mesh.positions,
        &CORNERS.map(|[x, y, z]| [x, y, z - 2.0]),
    );
}

#[test]
fn numbers_that_are_none_and_lists_that_do_not_fit_are_mended_and_told() {
    let file = triangle(&json!({}), |file| {
        json!({
            "NORMAL": file.floats(&[[0.0, 0.0, 1.0]; 3]),
            "TEXCOORD_0": file.floats(&[[f32::NAN, 0.0], [0.0, 1.0], [1.0, 1.0]]),
            "COLOR_0": file.floats(&[[1.0, 0.0, 0.0]; 2]),
            "SHINE": file.floats(&[[1.0]; 3]),
        })
    });
    let imported = read(&file);
    assert!(imported.model.mesh.colors.is_empty());
    assert_eq!(imported.model.mesh.tex_coords[0].to_array(), [0.0, 0.0]);
    let mut codes = codes_of(&imported);
    codes.sort_unstable();
    assert_eq!(codes, ["gltf-rule-broken", "gltf-rule-broken", "vertex-not-finite"]);
}

#[test]
fn normals_stay_square_to_a_surface_that_is_stretched_or_mirrored() {
    let normal = Vec3::new(1.0, 1.0, 0.0).normalize();
    let corners = [Vec3::ZERO, Vec3::new(1.0, -1.0, 0.0), Vec3::Z];
    for scale in [Vec3::new(2.0, 1.0, 1.0), Vec3::new(-2.0, 1.0, 3.0)] {
        let nodes = json!([{ "mesh": 0, "scale": scale.to_array() }]);
        let file = triangle(&json!({ "nodes": nodes }), |file| {
            json!({
                "POSITION": file.floats(&corners.map(|corner| corner.to_array())),
                "NORMAL": file.floats(&[normal.to_array(); 3]),
            })
        });
        for moved in read(&file).model.mesh.normals {
            for axis in &corners[1..] {
                assert!((scale * axis).dot(moved).abs() < 1e-6, "{scale}");
            }
            assert!(
                moved.dot(scale * normal) > 0.0,
                "it points to the side to which it pointed: {scale}"
            );
        }
    }
}
