//! Materials and the ranges drawn with them.

use bindpose::format::{Document, Subset};
use bindpose::model::{Material, Reflectance, Submesh, roughness_from_power};

use crate::documents::{arm, assert_told, material, message_of, model_of, quad, subset};

fn submesh(triangle_start: u32, triangle_count: u32, material: u32) -> Submesh {
    Submesh {
        triangle_start,
        triangle_count,
        material,
    }
}

#[test]
fn names_to_show_are_never_empty_and_never_the_same() {
    let mut document = quad();
    document.materials = ["cloth", "cloth", "", "cloth (2)", "cloth", "", "material 2"]
        .map(material)
        .to_vec();
    let (model, codes) = model_of(&document);
    let names: Vec<&str> = model.materials.iter().map(|material| material.name.as_str()).collect();
    let shown = [
        "cloth",
        "cloth (3)",
        "material 2 (2)",
        "cloth (2)",
        "cloth (4)",
        "material 5",
        "material 2",
    ];
    assert_eq!(names, shown);
    assert_eq!(codes, ["duplicate-material-name"; 2]);

    document.materials.truncate(2);
    assert_eq!(
        message_of(&document, "duplicate-material-name"),
        "Another material has the same name; this one is shown as \"cloth (2)\"."
    );
}

#[test]
fn many_equal_names_are_told_apart_at_once() {
    let mut document = quad();
    document.materials = vec![material("same"); 50_000];
    let (model, _) = model_of(&document);
    assert_eq!(model.materials[49_999].name, "same (50000)");
}

#[test]
fn material_numbers_that_are_not_finite_add_nothing() {
    let mut document = quad();
    document.materials[0].diffuse = [0.5, f32::NAN, 1.0];
    document.materials[0].reflectance = bindpose::format::Reflectance::Phong {
        ambient: [f32::INFINITY; 3],
        specular: [0.25; 3],
        spec_power: f32::NAN,
        reflectivity: [0.0; 3],
    };
    let (model, _) = model_of(&document);
    assert_eq!(model.materials[0].diffuse, [0.5, 0.0, 1.0]);
    let expected = Reflectance::Phong {
        ambient: [0.0; 3],
        specular: [0.25; 3],
        spec_power: 0.0,
        reflectivity: [0.0; 3],
    };
    assert_eq!(model.materials[0].reflectance, expected);
}

#[test]
fn subset_i_is_drawn_with_material_i() {
    let mut document = quad();
    document.materials.push(material("second"));
    document.materials.push(material("not used"));
    document.subsets = vec![subset(1, 1), subset(0, 1)];
    let (model, codes) = model_of(&document);
    assert_eq!(model.mesh.submeshes, [submesh(1, 1, 0), submesh(0, 1, 1)]);
    assert_eq!(model.materials.len(), 3);
    assert_eq!(codes, Vec::<&str>::new());
}

#[test]
fn a_subset_without_material_gets_the_default_one() {
    let mut document = quad();
    document.subsets = vec![subset(0, 1), subset(1, 1)];
    let (model, _) = model_of(&document);
    assert_eq!(model.mesh.submeshes, [submesh(0, 1, 0), submesh(1, 1, 1)]);
    assert_eq!(model.materials[1].name, "default");
    let words = "1 subset has no material; drawn in a default grey.";
    assert_told(&document, "subset-without-material", words);
}

#[test]
fn without_subsets_all_triangles_are_drawn() {
    let mut document = quad();
    document.subsets.clear();
    let (model, _) = model_of(&document);
    assert_eq!(model.mesh.submeshes, [submesh(0, 2, 0)]);
    let words = "The file has no subset; all 2 triangles are drawn with the first material.";
    assert_told(&document, "no-subsets", words);
    document.materials.clear();
    assert_eq!(model_of(&document).0.materials.len(), 1);
}

#[test]
fn ranges_are_cut_to_the_triangles_there_are() {
    #[rustfmt::skip]
    let ranges = [
        (subset(0, 5), submesh(0, 2, 0),
         "Subset 0 asks for 5 triangles from 0 on, but the file has 2; 2 of them are drawn."),
        (subset(7, 1), submesh(2, 0, 0),
         "Subset 0 asks for 1 triangles from 7 on, but the file has 2; 0 of them are drawn."),
        (subset(1, u32::MAX), submesh(1, 1, 0),
         "Subset 0 asks for 4294967295 triangles from 1 on, but the file has 2; 1 of them are drawn."),
    ];
    for (stored, drawn, words) in ranges {
        let mut document = quad();
        document.subsets = vec![stored];
        assert_eq!(model_of(&document).0.mesh.submeshes, [drawn]);
        assert_eq!(message_of(&document, "subset-out-of-range"), words);
    }
}

#[test]
fn triangles_that_no_subset_or_several_draw_are_told() {
    let mut document = arm();
    document.materials = vec![material("a"), material("b")];
    document.subsets = vec![subset(8, 3), subset(1, 8)];
    let (_, codes) = model_of(&document);
    assert_eq!(codes, ["triangles-undrawn", "triangles-shared"]);
    assert_eq!(
        message_of(&document, "triangles-undrawn"),
        "2 triangles belong to no subset; not drawn."
    );
    assert_eq!(
        message_of(&document, "triangles-shared"),
        "1 triangle belongs to more than one subset."
    );
}

#[test]
fn indices_counted_from_vertex_start_are_told_and_kept() {
    // Two quads of four vertices each; the second one's indices begin at 0 again.
    let mut document = quad();
    document.vertices.extend(quad().vertices);
    document.triangles.extend(quad().triangles);
    document.materials.push(material("second"));
    let half = |id, vertex_start, face_start| Subset {
        id,
        vertex_start,
        vertex_count: 4,
        face_start,
        face_count: 2,
    };
    document.subsets = vec![half(0, 0, 0), half(1, 4, 2)];
    let (model, codes) = model_of(&document);
    assert_eq!(codes, ["indices-look-relative"]);
    assert_eq!(model.mesh.indices[6..], [0, 1, 2, 0, 2, 3]);
    assert_eq!(
        message_of(&document, "indices-look-relative"),
        "The triangles of subset 1 name only vertices before its VertexStart 4; they are taken as they stand, but look \
         counted from there."
    );
}

#[test]
fn an_empty_document_is_an_empty_model() {
    let (model, codes) = model_of(&Document::default());
    assert_eq!(
        (
            model.mesh.vertex_count(),
            model.mesh.submeshes.len(),
            model.materials.len()
        ),
        (0, 0, 0)
    );
    assert!(model.bind_bounds().is_empty());
    assert_eq!(codes, Vec::<&str>::new());
}

#[test]
fn a_higher_power_is_smoother() {
    assert_eq!(roughness_from_power(0.0), 1.0);
    assert!(roughness_from_power(8.0) > roughness_from_power(64.0));
    assert!(roughness_from_power(1e6) > 0.0);
}

#[test]
fn gold_is_a_metal_in_each_of_the_words() {
    let gold = [1.0, 0.77, 0.34];
    let material = Material {
        diffuse: gold,
        reflectance: Reflectance::MetallicRoughness {
            metallic: 1.0,
            roughness: 0.3,
        },
        ..Material::default()
    };
    let surface = material.fresnel_surface();
    assert_eq!((surface.diffuse, surface.fresnel0), ([0.0; 3], gold));
    let of_book = Material {
        diffuse: surface.diffuse,
        reflectance: Reflectance::Fresnel {
            fresnel0: surface.fresnel0,
            roughness: surface.roughness,
        },
        ..Material::default()
    };
    assert_eq!(of_book.metallic_surface(), material.metallic_surface());
}
