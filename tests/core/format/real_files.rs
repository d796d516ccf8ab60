//! Facts of real files, and files of another format with the same extension.

use bindpose::format::{Dialect, Vertex, parse, write};

use super::real_file;
use crate::documents::soldier_bytes;

#[test]
fn the_soldier_is_read_whole() {
    let Some(bytes) = soldier_bytes() else { return };
    let parsed = parse(&bytes).expect("it is sound");
    let document = &parsed.document;
    assert_eq!(parsed.diagnostics, []);
    assert_eq!(document.dialect, Dialect::D3d12);
    let counts = [
        document.materials.len(),
        document.vertices.len(),
        document.triangles.len(),
        document.bone_offsets.len(),
    ];
    assert_eq!(counts, [5, 13_748, 22_507, 58]);

    let [clip] = &document.clips[..] else {
        panic!("one clip")
    };
    assert_eq!(clip.name, "Take1");
    let keys: Vec<usize> = clip.bones.iter().map(|bone| bone.keyframes.len()).collect();
    assert_eq!(keys.iter().sum::<usize>(), 4_400);
    assert_eq!((keys.iter().min(), keys.iter().max()), (Some(&73), Some(&76)));
    let times = || {
        clip.bones
            .iter()
            .flat_map(|bone| &bone.keyframes)
            .map(|key| key.time_secs)
    };
    assert_eq!(
        (times().fold(f32::MAX, f32::min), times().fold(f32::MIN, f32::max)),
        (0.0, 1.25)
    );

    let mut influences = [0; 5];
    for vertex in &document.vertices {
        influences[vertex.blend_weights.iter().filter(|&&weight| weight > 0.0).count()] += 1;
    }
    assert_eq!(influences, [0, 3_794, 1_862, 3_863, 4_229]);

    let (min, max) = bounds(&document.vertices);
    assert_near(min, [-29.3, -1.9, -7.7]);
    assert_near(max, [28.7, 72.5, 9.8]);

    let lines = &parsed.lines;
    assert_eq!((lines.materials[0], lines.materials[1], lines.subsets[0]), (9, 18, 55));
    assert_eq!(
        (lines.vertices[0], lines.vertices[1], lines.triangles[0]),
        (62, 69, 96_299)
    );
    assert_eq!((lines.bone_offsets[1], lines.bone_parents[57]), (118_809, 118_925));
    assert_eq!((lines.clips[0].clip, lines.clips[0].bones[0]), (118_928, 118_930));
}

#[test]
fn the_other_files_are_read_whole() {
    let facts = [
        ("models/d3d11/base.m3d", Dialect::D3d11, [673, 632, 3]),
        ("models/d3d11/stairs.m3d", Dialect::D3d11, [86, 58, 1]),
        ("models/d3d11/rock.m3d", Dialect::D3d11, [42, 64, 1]),
        ("models/d3d11/tree.m3d", Dialect::D3d11, [2_258, 1_674, 2]),
        ("models/imm/column.m3d", Dialect::Imm, [100, 74, 1]),
    ];
    for (path, dialect, counts) in facts {
        let Some(bytes) = real_file(path) else { continue };
        let parsed = parse(&bytes).expect("it is sound");
        let document = parsed.document;
        assert_eq!(parsed.diagnostics, [], "{path}");
        assert_eq!(document.dialect, dialect, "{path}");
        assert_eq!(
            [
                document.vertices.len(),
                document.triangles.len(),
                document.materials.len()
            ],
            counts,
            "{path}"
        );
        assert_eq!(document.clips, [], "{path}");
    }
}

#[test]
fn real_files_survive_writing() {
    for path in ["d3d12/soldier", "d3d11/base", "d3d11/tree", "imm/column"] {
        let Some(bytes) = real_file(&format!("models/{path}.m3d")) else {
            continue;
        };
        let document = parse(&bytes).expect("it is sound").document;
        let written = write(&document);
        assert_eq!(
            parse(written.as_bytes()).map(|parsed| parsed.document).as_ref(),
            Ok(&document),
            "{path}"
        );
        // The layout is the exporter's, so lines stand where they stood.
        let lines = |text: &[u8]| text.trim_ascii().split(|&byte| byte == b'\n').count();
        assert_eq!(lines(written.as_bytes()), lines(&bytes), "{path}");
    }
}

#[test]
fn files_of_another_format_are_named() {
    for (path, kind) in [
        ("reject/WusonBlitz0.m3d", "binary"),
        ("reject/cube_with_vertexcolors.a3d", "ASCII"),
    ] {
        let Some(bytes) = real_file(path) else { continue };
        let error = parse(&bytes).expect_err("it is another format");
        assert_eq!(error.code, "other-format");
        let sentence = error.message;
        assert!(
            sentence.contains(kind) && sentence.contains("\"Model 3D\""),
            "{sentence}"
        );
    }
}

fn bounds(vertices: &[Vertex]) -> ([f32; 3], [f32; 3]) {
    let by = |pick: fn(f32, f32) -> f32, start: f32| {
        vertices.iter().fold([start; 3], |all, vertex| {
            std::array::from_fn(|axis| pick(all[axis], vertex.position[axis]))
        })
    };
    (by(f32::min, f32::MAX), by(f32::max, f32::MIN))
}

/// The facts are given to one digit.
fn assert_near(found: [f32; 3], expected: [f32; 3]) {
    let near = found
        .iter()
        .zip(expected)
        .all(|(found, expected)| (found - expected).abs() <= 0.051);
    assert!(near, "{found:?} is not {expected:?}");
}
