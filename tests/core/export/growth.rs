//! What small files ask for when they are written: sizes and counts, which grow with what a file holds and not with its square.

use std::collections::HashSet;

use bindpose::edit::{Edits, apply};
use bindpose::export::{MapImages, glb, m3d};
use bindpose::format::{Dialect, Document, parse};
use bindpose::import::import;
use bindpose::model::{JointNames, Model};
use serde_json::Value;

use crate::documents::{material, model_of, quad, subset, vertex};

/// So many triangles on a strip, drawn by these subsets, each with a material of its own.
fn strip(triangles: u32, subsets: impl Iterator<Item = (u32, u32)>) -> Model {
    let mut document = Document {
        vertices: (0..triangles + 2)
            .map(|at| vertex(at as f32, (at % 2) as f32))
            .collect(),
        triangles: (0..triangles).map(|at| [at, at + 1, at + 2]).collect(),
        subsets: subsets.map(|(start, count)| subset(start, count)).collect(),
        ..quad()
    };
    for (id, subset) in (0..).zip(&mut document.subsets) {
        subset.id = id;
    }
    document.materials = document
        .subsets
        .iter()
        .map(|subset| material(&format!("m{}", subset.id)))
        .collect();
    model_of(&document).0
}

fn glb_of(model: &Model) -> (Value, Vec<u8>) {
    let bytes = glb(model, &JointNames::default(), &MapImages::new())
        .expect("it can be written")
        .bytes;
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    (serde_json::from_slice(&bytes[20..20 + length]).expect("JSON"), bytes)
}

/// The vertices that each primitive names.
fn named(root: &Value) -> Vec<u64> {
    let primitives = root["meshes"][0]["primitives"].as_array().expect("primitives");
    let of = |primitive: &Value| {
        let accessor = primitive["attributes"]["POSITION"].as_u64().expect("an accessor") as usize;
        root["accessors"][accessor]["count"].as_u64().expect("a count")
    };
    primitives.iter().map(of).collect()
}

#[test]
fn primitives_name_the_vertices_that_they_use() {
    let model = strip(6000, (0..60).map(|part| (100 * part, 100)));
    let (root, bytes) = glb_of(&model);
    let counts = named(&root);
    assert_eq!((counts.len(), counts.iter().max()), (60, Some(&102)));
    let back = import(&bytes).expect("it is sound").model;
    let corner = |model: &Model, corner: usize| model.mesh.positions[model.mesh.indices[corner] as usize];
    for at in 0..model.mesh.indices.len() {
        // Against the clock, and mirrored into the other hand.
        let [ours, theirs] = [corner(&model, at), corner(&back, 3 * (at / 3) + [0, 2, 1][at % 3])];
        let theirs_as_ours = corner(&back, at);
        let is_same = |other: glam::Vec3| (other.abs() - ours.abs()).length() == 0.0;
        assert!(
            is_same(theirs) || is_same(theirs_as_ours),
            "corner {at}: {ours} became {theirs}"
        );
    }
}

#[test]
fn vertices_of_their_own_stay_in_their_order() {
    let mut document = quad();
    let (first, count) = (document.vertices.clone(), document.vertices.len() as u32);
    for part in 1..40 {
        document.vertices.extend(first.iter().copied());
        document
            .triangles
            .extend([[0, 1, 2], [0, 2, 3]].map(|corners| corners.map(|corner| corner + part * count)));
    }
    document.subsets = (0..40).map(|part| subset(2 * part, 2)).collect();
    for (id, subset) in (0..).zip(&mut document.subsets) {
        subset.id = id;
    }
    document.materials = (0..40).map(|part| material(&format!("m{part}"))).collect();
    let model = model_of(&document).0;
    let (root, bytes) = glb_of(&model);
    assert_eq!(named(&root), [4; 40]);
    let back = import(&bytes).expect("it is sound").model;
    assert_eq!(
        (back.mesh.vertex_count(), &back.mesh.submeshes),
        (160, &model.mesh.submeshes)
    );
    assert_eq!(back.mesh.tex_coords, model.mesh.tex_coords);
    for name in ["POSITION", "NORMAL"] {
        let accessor = root["meshes"][0]["primitives"][1]["attributes"][name]
            .as_u64()
            .expect("an accessor");
        let view = root["accessors"][accessor as usize]["bufferView"]
            .as_u64()
            .expect("a view");
        assert_eq!(
            root["bufferViews"][view as usize]["byteStride"], 12,
            "a view of several accessors says its stride"
        );
    }
}

/// Each subset draws nearly all triangles.
#[test]
fn subsets_that_overlap_are_written_once() {
    let model = strip(100_000, (0..1000).map(|start| (start, 99_000)));
    let (root, bytes) = glb_of(&model);
    assert_eq!(named(&root).len(), 1000);
    assert!(bytes.len() < 8 << 20, "{} bytes", bytes.len());
    let text = m3d(&model, &JointNames::default(), Dialect::D3d12)
        .expect("it can be written")
        .bytes;
    let back = parse(&text).expect("it is sound").document;
    let ends: Vec<_> = back
        .subsets
        .iter()
        .map(|subset| (subset.vertex_start, subset.vertex_count))
        .collect();
    let wanted: Vec<_> = (0..1000).map(|start| (start, 99_002)).collect();
    assert_eq!(ends, wanted);
}

/// Triangles that are drawn by no subset, or by several, in any order.
#[test]
fn subsets_draw_the_same_triangles_afterwards() {
    for ranges in [
        vec![(0, 40), (20, 40), (200, 10)],
        vec![(300, 50), (0, 50), (0, 50), (49, 2)],
        vec![(10, 1), (1999, 1), (5, 0), (100, 60)],
    ] {
        let model = strip(2000, ranges.iter().copied());
        let (_, bytes) = glb_of(&model);
        let back = import(&bytes).expect("it is sound").model;
        let places = |model: &Model| -> Vec<Vec<[i64; 2]>> {
            let submeshes = model.mesh.submeshes.iter().filter(|submesh| submesh.triangle_count > 0);
            let of = |submesh: &bindpose::model::Submesh| {
                let start = 3 * submesh.triangle_start as usize;
                let corners = &model.mesh.indices[start..start + 3 * submesh.triangle_count as usize];
                let place = |corner: &u32| model.mesh.positions[*corner as usize].to_array();
                let mut places: Vec<[i64; 2]> = corners
                    .iter()
                    .map(place)
                    .map(|[x, y, _]| [x.abs() as i64, y as i64])
                    .collect();
                places.sort_unstable();
                places
            };
            submeshes.map(of).collect()
        };
        assert_eq!(places(&back), places(&model), "{ranges:?}");
    }
}

/// A material of glTF that many primitives share is written once for each.
#[test]
fn many_copies_of_a_material_get_names_of_their_own() {
    const COPIES: u32 = 40_000;
    let mut model = strip(COPIES, (0..COPIES).map(|at| (at, 1)));
    model.materials.truncate(1);
    model.mesh.submeshes.iter_mut().for_each(|submesh| submesh.material = 0);
    let names = |model: &Model| {
        let bytes = m3d(model, &JointNames::default(), Dialect::D3d12)
            .expect("it can be written")
            .bytes;
        let materials = parse(&bytes).expect("it is sound").document.materials;
        materials
            .into_iter()
            .map(|material| material.name)
            .collect::<HashSet<_>>()
    };
    let told = names(&model);
    assert_eq!(told.len(), COPIES as usize);
    assert!(told.contains("m0") && told.contains("m0_40000"));
    // Names that were free are taken by others.
    for (index, material) in model.materials.iter_mut().enumerate() {
        material.name = format!("a {index}");
    }
    let edits = Edits {
        for_book: true,
        ..Edits::default()
    };
    assert_eq!(
        apply(model, &JointNames::default(), &edits)
            .expect("it is small")
            .model
            .materials[0]
            .name,
        "a_0"
    );
}
