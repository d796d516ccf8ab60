//! Documents survive being written and read, in each dialect and in several layouts.

use bindpose::format::{
    AnimationClip, BoneAnimation, Dialect, Document, Keyframe, Material, Reflectance, Subset, Vertex, parse, write,
};
use proptest::prelude::*;

use super::{fixtures, one_line};

proptest! {
    #![proptest_config(crate::properties::cases(200))]

    #[test]
    fn a_written_document_reads_back(document in document()) {
        let text = write(&document);
        for (layout, text) in layouts(&text) {
            let parsed = parse(text.as_bytes()).map_err(|error| TestCaseError::fail(format!("{layout}: {error}\n{text}")))?;
            let notices: Vec<String> = parsed.diagnostics.iter().map(one_line).collect();
            prop_assert!(notices.is_empty(), "{layout}: {notices:?}\n{text}");
            prop_assert!(parsed.document == document, "{layout}:\n{text}\n{:?}\n{document:?}", parsed.document);
        }
    }
}

#[test]
fn what_was_read_from_a_fixture_reads_back() {
    for fixture in fixtures("good") {
        let document = parse(&fixture.bytes).expect("good fixtures can be read").document;
        let again = parse(write(&document).as_bytes());
        assert_eq!(again.map(|parsed| parsed.document), Ok(document), "{}", fixture.name);
    }
}

/// The same text as other exporters would lay it out.
fn layouts(text: &str) -> Vec<(&'static str, String)> {
    let mut layouts = vec![
        ("as written", text.to_owned()),
        (
            "CRLF with a byte order mark",
            format!("\u{FEFF}{}", text.replace('\n', "\r\n")),
        ),
        ("CR", text.replace('\n', "\r")),
        (
            "tabs",
            text.lines()
                .map(|line| format!("\t{}  \n", line.replacen(' ', " \t", 1)))
                .collect(),
        ),
        ("no last line end", text.trim_end().to_owned()),
        (
            "long rulers",
            text.replace("***************", "*******************************************"),
        ),
        (
            "short rulers",
            text.replace("***************", "***").replace("------", "-"),
        ),
        ("lower-case rulers", text.lines().map(lower_case_ruler).collect()),
    ];
    // With rows, so that the file does not just end after a blank line less.
    layouts.push((
        "blank lines",
        text.lines()
            .map(|line| format!("{line}\n{}", if line.contains("Position") { "\n" } else { "" }))
            .collect(),
    ));
    layouts
}

fn lower_case_ruler(line: &str) -> String {
    if line.starts_with("***") || line.starts_with("---") {
        line.to_lowercase() + "\n"
    } else {
        format!("{line}\n")
    }
}

pub(crate) fn document() -> impl Strategy<Value = Document> {
    let dialect = prop::sample::select(vec![Dialect::D3d12, Dialect::D3d11, Dialect::Imm]);
    (dialect, 1..4_usize, 1..6_u32, 0..4_u32, 0..3_usize).prop_flat_map(
        |(dialect, materials, vertices, bones, clips)| {
            let parents = prop::collection::vec(-1..bones.max(1).cast_signed(), bones as usize);
            let animation = prop::collection::vec(keyframe(), 0..4).prop_map(|keyframes| BoneAnimation { keyframes });
            let clip = (name(), prop::collection::vec(animation, bones as usize));
            (
                prop::collection::vec(material(dialect), materials),
                prop::collection::vec(subset(), 0..4),
                prop::collection::vec(vertex(bones), vertices as usize),
                prop::collection::vec([0..vertices, 0..vertices, 0..vertices], 0..6),
                prop::collection::vec(prop::array::uniform16(number()), bones as usize),
                parents,
                prop::collection::vec(clip, clips),
            )
                .prop_map(
                    move |(materials, subsets, vertices, triangles, bone_offsets, bone_parents, clips)| Document {
                        dialect,
                        materials,
                        subsets,
                        vertices,
                        triangles,
                        bone_offsets,
                        bone_parents,
                        clips: clips
                            .into_iter()
                            .map(|(name, bones)| AnimationClip { name, bones })
                            .collect(),
                    },
                )
        },
    )
}

fn material(dialect: Dialect) -> impl Strategy<Value = Material> {
    let colour = || prop::array::uniform3(number());
    let map = || prop::option::of("[a-zA-Z]{3}[a-z0-9_ \\\\/:.ä-]{0,12}[a-z]\\.dds");
    (
        name(),
        colour(),
        (colour(), colour(), colour(), number()),
        any::<bool>(),
        "[A-Za-z]{0,8}",
        map(),
        map(),
    )
        .prop_map(
            move |(name, diffuse, (a, b, c, number), alpha_clip, type_name, diffuse_map, normal_map)| Material {
                name,
                diffuse,
                reflectance: if dialect == Dialect::D3d12 {
                    Reflectance::Fresnel {
                        fresnel0: a,
                        roughness: number,
                    }
                } else {
                    Reflectance::Phong {
                        ambient: a,
                        specular: b,
                        spec_power: number,
                        reflectivity: c,
                    }
                },
                alpha_clip,
                type_name,
                diffuse_map,
                normal_map,
            },
        )
}

fn vertex(bones: u32) -> impl Strategy<Value = Vertex> {
    let index = 0..bones.max(1);
    let blend = (
        prop::array::uniform4(number()),
        [index.clone(), index.clone(), index.clone(), index],
    );
    let lines = (
        prop::array::uniform3(number()),
        prop::array::uniform4(number()),
        prop::array::uniform3(number()),
    );
    (lines, prop::array::uniform2(number()), blend).prop_map(
        move |((position, tangent, normal), tex_coords, (weights, indices))| Vertex {
            position,
            tangent,
            normal,
            tex_coords,
            blend_weights: if bones > 0 { weights } else { [0.0; 4] },
            blend_indices: if bones > 0 { indices } else { [0; 4] },
        },
    )
}

fn subset() -> impl Strategy<Value = Subset> {
    prop::array::uniform5(any::<u32>()).prop_map(|[id, vertex_start, vertex_count, face_start, face_count]| Subset {
        id,
        vertex_start,
        vertex_count,
        face_start,
        face_count,
    })
}

fn keyframe() -> impl Strategy<Value = Keyframe> {
    let numbers = (
        number(),
        prop::array::uniform3(number()),
        prop::array::uniform3(number()),
        prop::array::uniform4(number()),
    );
    numbers.prop_map(|(time_secs, translation, scale, rotation)| Keyframe {
        time_secs,
        translation,
        scale,
        rotation,
    })
}

/// Any finite number, and those that exporters write.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        any::<f32>().prop_filter("finite", |number| number.is_finite()),
        prop::sample::select(vec![
            0.0,
            -0.0,
            1.0,
            -1.0,
            0.5,
            f32::MIN_POSITIVE,
            f32::MAX,
            f32::from_bits(1)
        ]),
        -100.0..100.0_f32,
    ]
}

/// Names as people give them; without line ends, blanks around them, or a brace at the end.
fn name() -> impl Strategy<Value = String> {
    prop::string::string_regex("([a-zA-Z0-9_|.:#*ä-]([ a-zA-Z0-9_|.:{#*ä-]{0,10}[a-zA-Z0-9_|.:#*ä-])?)?")
        .expect("a sound expression")
}
