//! Great numbers of each kind. With a look at each thing for each other thing these would take minutes.

use bindpose::diagnostic::Subject;
use bindpose::format::{Document, Keyframe, LineMap, Subset, Vertex};

use super::{codes_of, only};
use crate::documents::{arm, checked, key, material, offset, quad, subset, track, turned, vertex};

#[test]
fn a_million_triangles_all_the_same_are_one_finding() {
    let mut document = quad();
    document.triangles = [[0, 1, 2], [2, 3, 0]].repeat(500_000);
    document.subsets = vec![subset(0, 1_000_000)];
    let finding = only(&document, &LineMap::default());
    assert_eq!((finding.code, finding.count), ("triangles-repeated", 999_998));
    assert_eq!(finding.subjects.len(), 20);
    document.triangles = vec![[1, 1, 1]; 1_000_000];
    let codes = codes_of(&document);
    assert_eq!(codes, ["triangles-without-area", "vertices-unused"]);
}

#[test]
fn a_vertex_and_an_edge_may_have_a_million_triangles() {
    let count = 1_000_000_u32;
    let around = |index: u32| {
        let angle = index as f32 / count as f32 * 6.0;
        vertex(angle.cos(), angle.sin())
    };
    // Corners in the books' direction, which is clockwise.
    let mut document = Document {
        materials: vec![material("plain")],
        subsets: vec![subset(0, count)],
        vertices: [vertex(0.0, 0.0)].into_iter().chain((0..=count).map(around)).collect(),
        triangles: (1..=count).map(|index| [0, index + 1, index]).collect(),
        ..Document::default()
    };
    assert_eq!(codes_of(&document), ["many-vertices"]);
    document.triangles = (2..=count + 1).map(|index| [0, index, 1]).collect();
    let (_, findings) = checked(&document, &LineMap::default());
    let crowded = findings.iter().find(|finding| finding.code == "edges-crowded");
    assert_eq!(crowded.map(|finding| finding.count), Some(1));
}

#[test]
fn a_hundred_thousand_bones_hang_in_a_chain() {
    let count = 100_000;
    let mut document = quad();
    document
        .vertices
        .iter_mut()
        .for_each(|vertex| vertex.blend_weights[0] = 1.0);
    document.bone_offsets = vec![offset([0.0; 3]); count];
    document.bone_parents = (-1..count as i32 - 1).collect();
    let scaled = Keyframe {
        scale: [1.0, 2.0, 1.0],
        ..key(0.0, [0.0; 3])
    };
    let mut bones = vec![track([key(0.0, [0.0; 3])]); count];
    bones[0] = track([scaled]);
    bones[count - 1] = track([turned(key(0.0, [0.0; 3]), 0.5)]);
    document.clips = vec![bindpose::format::AnimationClip {
        name: "still".to_owned(),
        bones,
    }];
    let (_, findings) = checked(&document, &LineMap::default());
    let told: Vec<_> = findings.iter().map(|finding| (finding.code, finding.count)).collect();
    assert_eq!(told, [("many-bones", 1), ("bones-idle", 99_999), ("scale-shears", 1)]);
    assert!(findings[2].message.contains("bone 99999 "), "{}", findings[2].message);
}

/// Each clip of one name shears, jumps and has keys that say nothing.
#[test]
fn twenty_thousand_clips_are_a_finding_of_each_kind() {
    let mut document = arm();
    let still = |secs: u8, scale| Keyframe {
        scale,
        ..key(f32::from(secs), [0.0; 3])
    };
    let swing = [0.0_f32, 60.0, 120.0, 60.0, 8.0];
    let swing = (0_u8..).zip(swing);
    let swing = swing.map(|(secs, degrees)| turned(key(f32::from(secs), [0.0, 1.0, 0.0]), degrees.to_radians()));
    document.clips[0].bones = vec![
        track((0..5).map(|secs| still(secs, [1.0, 1.5, 1.0])).collect::<Vec<_>>()),
        track(swing.collect::<Vec<_>>()),
        track([key(0.0, [0.0, 1.0, 0.0])]),
    ];
    document.clips = vec![document.clips[0].clone(); 20_000];
    let (_, findings) = checked(&document, &LineMap::default());
    let told: Vec<_> = findings.iter().map(|finding| (finding.code, finding.count)).collect();
    assert_eq!(
        told,
        [
            ("duplicate-clip-name", 19_999),
            ("scale-shears", 20_000),
            ("keys-all-equal", 20_000),
            ("loop-jumps", 20_000),
        ]
    );
    assert_eq!(findings[2].subjects.len(), 20);
    assert_eq!(findings[2].subject, Some(Subject::Clip(0)));
}

/// Each subset asks for all triangles, and none of them is looked at for each.
#[test]
fn twenty_thousand_subsets_over_the_same_triangles_are_a_finding() {
    let mut document = quad();
    let (vertices, subsets) = (60_000, 20_000);
    document.vertices = (0..vertices)
        .map(|index: u32| Vertex {
            tex_coords: [0.0; 2],
            ..vertex((index / 2) as f32, if index.is_multiple_of(2) { 0.0 } else { 1.0 })
        })
        .collect();
    document.triangles = (0..vertices - 3)
        .step_by(2)
        .flat_map(|at| [[at, at + 1, at + 3], [at, at + 3, at + 2]])
        .collect();
    let all = Subset {
        face_count: document.triangles.len() as u32,
        ..Subset::default()
    };
    document.subsets = vec![all; subsets];
    let mut mapped = material("skin");
    mapped.normal_map = Some("norm.dds".to_owned());
    document.materials = vec![mapped; subsets];
    let (_, findings) = checked(&document, &LineMap::default());
    let told: Vec<_> = findings.iter().map(|finding| (finding.code, finding.count)).collect();
    assert_eq!(
        told,
        [
            ("duplicate-material-name", 19_999),
            ("triangles-shared", 59_998),
            ("tex-coords-equal", 20_000)
        ]
    );
}
