//! The table of codes against the documents that give them.

use std::collections::BTreeSet;

use bindpose::diagnostic::{Diagnostic, Severity, codes};
use bindpose::format::{Document, LineMap, Subset};
use bindpose::import::m3d;

use crate::documents::{arm, is_sentence, key, material, offset, read, reordered, subset, track};

/// What turns a sound arm into one that a single code, or a few, are about: every way that the model has.
const CHANGES: &[fn(&mut Document)] = &[
    |arm| arm.bone_parents[2] = 3,
    |arm| arm.bone_parents = vec![-1, 1, 1],
    |arm| arm.bone_offsets.truncate(2),
    |arm| arm.triangles[3] = [0, 14, 1],
    |arm| arm.vertices[4].blend_indices[0] = 3,
    |arm| arm.materials.push(material("skin")),
    |arm| arm.subsets.clear(),
    |arm| arm.materials.clear(),
    |arm| arm.subsets = vec![subset(0, 13)],
    |arm| arm.subsets = vec![subset(0, 11)],
    |arm| arm.subsets = vec![subset(0, 12); 2],
    |arm| {
        arm.subsets[0] = Subset {
            vertex_start: 4,
            vertex_count: 4,
            ..subset(0, 2)
        }
    },
    |arm| *arm = reordered(arm, &[2, 1, 0]),
    |arm| {
        arm.clips.clear();
        arm.bone_offsets.resize(300, offset([0.0; 3]));
        arm.bone_parents.resize(300, 0);
        arm.vertices[0].blend_indices[0] = 299;
    },
    |arm| arm.bone_offsets[1][0] = f32::NAN,
    |arm| arm.bone_offsets[1][3] = 0.5,
    |arm| arm.bone_offsets[1][..11].fill(0.0),
    |arm| arm.vertices.resize(65_537, arm.vertices[0]),
    |arm| arm.vertices[0].position[0] = f32::INFINITY,
    |arm| arm.triangles[..6].iter_mut().for_each(|corners| corners.swap(1, 2)),
    |arm| arm.vertices[0].normal = [0.0; 3],
    |arm| arm.vertices[0].tangent = [0.0; 4],
    |arm| arm.vertices[0].tangent[3] = 0.5,
    |arm| arm.vertices[0].blend_weights = [1.0, -0.5, 0.0, 0.0],
    |arm| arm.vertices[0].blend_weights = [0.5, 0.0, 0.0, 0.0],
    |arm| arm.vertices[0].blend_weights = [0.0; 4],
    |arm| arm.clips.push(arm.clips[0].clone()),
    |arm| arm.clips[0].bones.truncate(2),
    |arm| arm.clips[0].bones.push(track([key(0.0, [0.0; 3])])),
    |arm| arm.clips[0].bones[2].keyframes.clear(),
    |arm| arm.clips[0].bones[1].keyframes[1].time_secs = f32::NAN,
    |arm| arm.clips[0].bones[1].keyframes.reverse(),
    |arm| arm.clips[0].bones[1].keyframes[1].time_secs = 0.0,
    |arm| arm.clips[0].bones[1].keyframes[1].rotation = [0.0, 0.0, 0.0, 2.0],
    |arm| arm.clips[0].bones[1].keyframes[1].rotation = [0.0; 4],
    |arm| arm.clips[0].bones[1].keyframes[1].rotation = arm.clips[0].bones[1].keyframes[1].rotation.map(|part| -part),
    |arm| arm.clips[0].bones[1].keyframes[0].translation = [20.0, 0.0, 0.0],
    |arm| arm.clips[0].name.clear(),
    |arm| {
        for bone in &mut arm.clips[0].bones {
            bone.keyframes[1].scale = [1e20; 3];
        }
    },
];

fn findings_of(document: &Document) -> Vec<Diagnostic> {
    match m3d::from_document(document, &LineMap::default()) {
        Ok(_) => read(document, &LineMap::default()).1,
        Err(fault) => vec![*fault],
    }
}

#[test]
fn every_message_is_a_sentence() {
    for change in CHANGES {
        let mut document = arm();
        change(&mut document);
        for finding in findings_of(&document) {
            assert!(is_sentence(&finding.message), "{}: {}", finding.code, finding.message);
        }
    }
}

#[test]
fn the_table_of_codes_is_that_of_the_documents() {
    assert_eq!(findings_of(&arm()), [], "nothing is wrong with the arm");
    let mut given: BTreeSet<(&str, Severity)> = BTreeSet::new();
    for (index, change) in CHANGES.iter().enumerate() {
        let mut document = arm();
        change(&mut document);
        let before = given.len();
        given.extend(
            findings_of(&document)
                .iter()
                .map(|finding| (finding.code, finding.severity)),
        );
        assert!(given.len() > before, "change {index} gives nothing new");
    }
    let table = codes::OF_MODEL.iter().chain(codes::OF_MOTION);
    let table: BTreeSet<_> = table.map(|code| (code.name, code.severity)).collect();
    assert_eq!(given, table);
}
