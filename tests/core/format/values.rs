//! What the fixtures' values become.

use bindpose::diagnostic::Entry;
use bindpose::format::{Dialect, Document, Reflectance, Subset, Vertex, parse};
use bindpose::import::import;

use super::good;

fn document(name: &str) -> Document {
    parse(&good(name))
        .unwrap_or_else(|error| panic!("{name}: {error}"))
        .document
}

#[test]
#[expect(
    clippy::approx_constant,
    reason = "the file says so, and is one unit off the constant"
)]
fn a_skinned_file_of_the_second_book() {
    let parsed = parse(&good("d3d12_skinned")).expect("it is sound");
    assert_eq!(parsed.diagnostics, []);
    let document = parsed.document;
    let material = &document.materials[0];
    assert_eq!(
        (material.name.as_str(), material.type_name.as_str()),
        ("skin", "Skinned")
    );
    assert_eq!(material.diffuse, [1.0, 0.5, 0.25]);
    assert_eq!(
        material.reflectance,
        Reflectance::Fresnel {
            fresnel0: [0.05; 3],
            roughness: 0.5
        }
    );
    assert_eq!(
        (material.diffuse_map.as_deref(), material.alpha_clip),
        (Some("skin_diff.dds"), false)
    );
    assert_eq!(
        document.subsets,
        [Subset {
            id: 0,
            vertex_start: 0,
            vertex_count: 3,
            face_start: 0,
            face_count: 1
        }]
    );
    let expected = Vertex {
        position: [1.0, 0.25, -4.884964e-7],
        tangent: [1.0, 0.0, 0.0, -1.0],
        normal: [0.0, 0.0, 1.0],
        tex_coords: [1.0, 0.0],
        blend_weights: [0.75, 0.25, 0.0, 0.0],
        blend_indices: [0, 1, 0, 0],
    };
    assert_eq!(document.vertices[1], expected);
    assert_eq!(document.triangles, [[0, 1, 2]]);
    assert_eq!(document.bone_offsets[1][12..], [0.0, -1.0, 0.0, 1.0]);
    assert_eq!(document.bone_parents, [-1, 0]);
    let key = document.clips[0].bones[1].keyframes[1];
    assert_eq!(
        (key.time_secs, key.translation, key.scale),
        (0.5, [0.0, 1.0, 0.0], [1.0; 3])
    );
    assert_eq!(key.rotation, [0.0, 0.0, 0.7071068, 0.7071068]);
    assert_eq!(
        (parsed.lines.vertices, parsed.lines.clips[0].bones.clone()),
        (vec![22, 29, 36], vec![57, 62])
    );
}

#[test]
fn every_row_has_its_line_and_every_line_its_row() {
    let source = import(&good("d3d12_skinned")).expect("a model").source;
    let places = source.places(&good("d3d12_skinned"));
    let key = |key| Entry::Key { clip: 0, bone: 1, key };
    for (row, line) in [
        (Entry::Vertex(1), 29),
        (Entry::Track { clip: 0, bone: 1 }, 62),
        (key(0), 64),
        (key(1), 65),
    ] {
        assert_eq!((places.line(row), places.entry_on(line)), (Some(line), Some(row)));
    }
    assert_eq!(places.line(Entry::Tangent(2)), Some(37));
    assert_eq!(
        places.entry_on(37),
        Some(Entry::Vertex(2)),
        "the line is one of the vertex's"
    );
    let rows = [
        Entry::Material(0),
        Entry::Subset(0),
        Entry::Triangle(0),
        Entry::Offset(1),
        Entry::Bone(1),
        Entry::Clip(0),
    ];
    for row in rows {
        let line = places.line(row).expect("it stands there");
        assert_eq!(places.entry_on(line), Some(row));
    }
    assert_eq!((places.line(Entry::Vertex(3)), places.entry_on(1)), (None, None));
    assert_eq!(places.pointer(Entry::Bone(0)), None, "a text has no pointers");
}

#[test]
fn a_file_of_the_first_book() {
    let document = document("d3d11_static");
    assert_eq!(document.dialect, Dialect::D3d11);
    let phong = Reflectance::Phong {
        ambient: [0.5; 3],
        specular: [0.7; 3],
        spec_power: 32.0,
        reflectivity: [0.0; 3],
    };
    assert_eq!(document.materials[0].reflectance, phong);
    assert!(document.materials[0].alpha_clip && !document.materials[1].alpha_clip);
    assert_eq!(document.materials[1].normal_map.as_deref(), Some("bark_norm.dds"));
    assert_eq!(document.vertices[1].tex_coords, [24.36448, -15.355]);
    assert_eq!((document.triangles[1], document.bone_offsets.len()), ([2, 1, 0], 0));
}

/// `T:` is the tangent, and then the texture coordinate.
#[test]
fn a_file_of_imm() {
    let document = document("imm_skinned");
    assert_eq!(document.dialect, Dialect::Imm);
    assert_eq!(document.vertices[0].tangent, [0.70706, 0.707154, 5.21229e-7, -1.0]);
    assert_eq!(document.vertices[0].tex_coords, [0.985059, 0.239204]);
    assert_eq!(
        (document.bone_parents[0], document.clips[0].name.as_str()),
        (-1, "Idle")
    );
    assert_eq!(document.clips[0].bones[0].keyframes[1].translation, [0.0, 0.0, 1.0]);
}

/// Spelling and layout change nothing: these fixtures say what their model says.
#[test]
fn variants_of_layout_give_the_same_document() {
    let skinned = "ruler_variants layout_crlf_bom layout_cr layout_blanks bone_offset_layouts bone_numbers \
        brace_missing brace_surplus";
    for name in skinned.split(' ') {
        assert_eq!(document(name), document("d3d12_skinned"), "{name}");
    }
    let fixed = "ruler_unknown ruler_missing header_spellings header_subsets header_count_assumed \
        header_count_repeated alpha_clip_words vertex_unknown_line vertex_row_split tangent_three_normal_four \
        blend_data_unused bones_none_sections_empty bones_none_section_missing text_behind_the_end";
    for name in fixed.split(' ') {
        assert_eq!(document(name), document("d3d11_static"), "{name}");
    }
}

#[test]
fn materials_are_read_by_label() {
    let mut shuffled = document("material_lines_shuffled").materials.remove(0);
    assert_eq!(shuffled.diffuse_map.take(), None);
    shuffled.diffuse_map = Some("skin_diff.dds".into());
    assert_eq!(shuffled, document("d3d12_skinned").materials[0]);

    let unparted = document("material_lines_unparted").materials;
    assert_eq!(
        (unparted[0].normal_map.as_deref(), unparted[1].diffuse_map.as_deref()),
        (None, None)
    );
    assert_eq!(
        unparted[1].reflectance,
        document("d3d11_static").materials[1].reflectance
    );

    let Reflectance::Fresnel { roughness, .. } = document("material_line_repeated").materials[0].reflectance else {
        panic!("the second book's")
    };
    assert_eq!(roughness, 0.75);
}

#[test]
fn texture_names_are_the_rest_of_the_line() {
    let material = document("texture_paths").materials.remove(0);
    assert_eq!(material.diffuse_map.as_deref(), Some("C:\\My Models\\Hero Skin.TGA"));
    assert_eq!(material.normal_map.as_deref(), Some("../maps/häut.png"));
    assert_eq!(document("name_not_utf8").materials[0].name, "sk\u{FFFD}in");
}

#[test]
fn alpha_clip_takes_words_and_numbers() {
    let clips = |name| {
        document(name)
            .materials
            .iter()
            .map(|material| material.alpha_clip)
            .collect::<Vec<_>>()
    };
    assert_eq!(clips("alpha_clip_words"), [true, false]);
    assert_eq!(clips("alpha_clip_two"), [true, true]);
    assert_eq!(clips("alpha_clip_unreadable"), [false, false]);
}

#[test]
fn foreign_numbers_are_read_by_their_sense() {
    let vertex = document("numbers_foreign").vertices[0];
    assert_eq!((vertex.position, vertex.tex_coords), ([1.5, 1.0, 2.5], [0.5, 1.0]));
}

#[test]
fn numbers_that_are_not_finite_are_replaced() {
    let document = document("numbers_not_finite");
    assert_eq!(
        (document.vertices[0].position, document.vertices[0].normal),
        ([0.0; 3], [0.0; 3])
    );
    let key = document.clips[0].bones[0].keyframes[0];
    assert_eq!((key.scale, key.rotation), ([1.0; 3], [0.0, 0.0, 0.0, 1.0]));
}

#[test]
fn clip_names_are_the_rest_of_the_line_without_its_brace() {
    assert_eq!(document("clip_names").clips[0].name, "Armature|Take 001.mixamo.com");
    let repeated = document("names_repeated").clips;
    assert_eq!(
        repeated.iter().map(|clip| clip.name.as_str()).collect::<Vec<_>>(),
        ["Wave", "Wave"]
    );
    assert!(repeated[1].bones.iter().all(|bone| bone.keyframes.is_empty()));
}

#[test]
fn what_the_model_settles_is_kept_as_it_stands() {
    assert_eq!(document("bones_child_first").bone_parents, [1, -1]);
    let times: Vec<f32> = document("keys_unsorted").clips[0].bones[1]
        .keyframes
        .iter()
        .map(|key| key.time_secs)
        .collect();
    assert_eq!(times, [0.5, -0.25]);
    assert_eq!(document("blend_index_unused").vertices[0].blend_indices, [0; 4]);
    assert_eq!(
        document("tangent_three_normal_four").vertices[0].tangent,
        [1.0, 0.0, 0.0, 1.0]
    );
    assert_eq!(
        document("subset_typos").subsets[0],
        Subset {
            face_count: 1,
            ..Subset::default()
        }
    );
}
