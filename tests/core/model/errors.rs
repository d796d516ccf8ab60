//! What cannot become a model, in its exact words.

use bindpose::diagnostic::Fault;
use bindpose::format::{Document, LineMap};
use bindpose::import::m3d;
use bindpose::model::{JointIndex, LocalJoint, Model, Skeleton, Track};
use glam::{Affine3A, Quat, Vec3};

use crate::documents::{arm, quad};

fn error_of(change: impl FnOnce(&mut Document)) -> Fault {
    let mut document = arm();
    change(&mut document);
    let lines = LineMap {
        vertices: (100..).take(document.vertices.len()).collect(),
        triangles: (200..).take(document.triangles.len()).collect(),
        bone_offsets: vec![300, 301, 302],
        bone_parents: vec![400, 401, 402],
        ..LineMap::default()
    };
    m3d::from_document(&document, &lines).expect_err("the document is broken")
}

#[test]
fn words_code_and_place_of_each_broken_rule() {
    type Change = fn(&mut Document);
    #[rustfmt::skip]
    let cases: [(Change, &str, &str); 9] = [
        (|document| document.bone_parents[2] = 3, "parent-out-of-range",
         "line 402, column 1: Bone 2 lists 3 as its parent; a parent is −1 or a bone below 3."),
        (|document| document.bone_parents[1] = -2, "parent-out-of-range",
         "line 401, column 1: Bone 1 lists -2 as its parent; a parent is −1 or a bone below 3."),
        (|document| document.bone_parents = vec![-1, 1, 1], "parent-cycle",
         "line 401, column 1: Bones form a circle: 1 → 1; each lists the next as its parent."),
        (|document| document.bone_parents = vec![2, 0, 1], "parent-cycle",
         "line 400, column 1: Bones form a circle: 0 → 2 → 1 → 0; each lists the next as its parent."),
        (|document| document.bone_parents = vec![1, 2, 1], "parent-cycle",
         "line 401, column 1: Bones form a circle: 1 → 2 → 1; each lists the next as its parent."),
        (|document| document.bone_offsets.truncate(2), "bone-count-mismatch",
         "line 400, column 1: 2 bone offsets but 3 parents; every bone has one of each."),
        (|document| document.triangles[3] = [0, 14, 1], "vertex-out-of-range",
         "line 203, column 1: Triangle 3 names vertex 14, but there are 14 vertices."),
        (|document| document.vertices[5].blend_indices[1] = 3, "", ""),
        (|document| document.vertices[4].blend_indices[0] = u32::MAX, "influence-out-of-range",
         "line 109, column 1: Vertex 4 gives weight to bone 4294967295, but there are 3 bones."),
    ];
    for (change, code, words) in cases {
        if code.is_empty() {
            // Vertex 5 gives its second bone no weight: what stands there does not matter.
            let mut document = arm();
            change(&mut document);
            assert!(m3d::from_document(&document, &LineMap::default()).is_ok());
            continue;
        }
        let error = error_of(change);
        assert_eq!((error.code, error.to_string().as_str()), (code, words));
        assert!(words.ends_with(&error.message), "{} repeats the place", error.message);
    }
}

#[test]
fn a_document_without_lines_has_errors_without_a_place() {
    let mut document = quad();
    document.triangles[1] = [0, 1, 4];
    let error = m3d::from_document(&document, &LineMap::default()).expect_err("vertex 4 does not exist");
    assert_eq!(
        error.to_string(),
        "Triangle 1 names vertex 4, but there are 4 vertices."
    );
}

#[test]
fn a_long_circle_names_its_first_bones() {
    let mut document = arm();
    document.bone_offsets = vec![document.bone_offsets[0]; 20];
    document.bone_parents = (0..20).map(|bone| (bone + 1) % 20).collect();
    let error = m3d::from_document(&document, &LineMap::default()).expect_err("a circle");
    assert_eq!(
        error.to_string(),
        "Bones form a circle: 0 → 1 → 2 → 3 → 4 → 5 → 6 → 7 → … (12 more) → 0; each lists the next as its parent."
    );
}

#[test]
fn constructors_refuse_what_later_stages_rely_on() {
    let root = None;
    let child_of = |joint| Some(JointIndex(joint));
    let identity = Affine3A::IDENTITY;
    let flat = Affine3A::from_translation(Vec3::new(f32::NAN, 0.0, 0.0));
    #[rustfmt::skip]
    let skeletons = [
        (Skeleton::new(vec![child_of(1), root], vec![identity; 2], vec![0, 1]),
         "Joint 0 lists joint 1 as its parent; a parent must come before its children."),
        (Skeleton::new(vec![root, child_of(1)], vec![identity; 2], vec![0, 1]),
         "Joint 1 lists joint 1 as its parent; a parent must come before its children."),
        (Skeleton::new(vec![root], vec![identity; 2], vec![0]),
         "1 parents, 2 inverse bind matrices and 1 file bones; every joint has one of each."),
        (Skeleton::new(vec![root; 2], vec![identity; 2], vec![0, 0]),
         "File bone 0 of joint 1 is out of range or taken; the file bones are an order of all joints."),
        (Skeleton::new(vec![root; 2], vec![identity; 2], vec![0, 2]),
         "File bone 2 of joint 1 is out of range or taken; the file bones are an order of all joints."),
        (Skeleton::new(vec![root], vec![flat], vec![0]),
         "The inverse bind matrix of joint 0 holds a number that is not finite."),
    ];
    for (skeleton, words) in skeletons {
        assert_eq!(skeleton.expect_err("unsound").to_string(), words);
    }

    let joint = LocalJoint::IDENTITY;
    let broken = LocalJoint {
        rotation: Quat::from_xyzw(0.0, 0.0, 0.0, 0.0),
        ..joint
    };
    #[rustfmt::skip]
    let tracks = [
        (Track::new([]), "A track needs at least one key."),
        (Track::new([(0.0, joint), (0.0, joint)]), "Key 1 is not after the key before it; key times must increase."),
        (Track::new([(0.0, joint), (1.0, broken)]),
         "Key 1 holds a number that is not finite, or a rotation without a direction."),
        (Track::new([(f32::NAN, joint)]),
         "Key 0 holds a number that is not finite, or a rotation without a direction."),
    ];
    for (track, words) in tracks {
        assert_eq!(track.expect_err("unsound").to_string(), words);
    }
}

#[test]
fn parts_that_do_not_fit_make_no_model() {
    type Change = fn(&mut Model);
    #[rustfmt::skip]
    let cases: [(Change, &str, &str); 10] = [
        (|model| model.mesh.indices[4] = 14, "vertex-out-of-range",
         "Triangle 1 names vertex 14, but there are 14 vertices."),
        (|model| model.mesh.positions[7].y = f32::INFINITY, "position-not-finite",
         "The position of vertex 7 holds a number that is not finite."),
        (
            |model| {
                model.mesh.indices.pop();
            },
            "incomplete-triangle",
            "There are 35 indices; three make a triangle.",
        ),
        (|model| model.mesh.normals.truncate(13), "stream-length",
         "There are 13 normals for 14 vertices; every vertex has one."),
        (|model| model.mesh.influences.clear(), "stream-length",
         "There are 0 influences for 14 vertices; every vertex has one."),
        (|model| model.skeleton = Skeleton::default(), "joint-out-of-range",
         "Vertex 0 names joint 0, but there are 0 joints."),
        (|model| model.mesh.influences[5].joints[3] = 3, "joint-out-of-range",
         "Vertex 5 names joint 3, but there are 3 joints."),
        (|model| model.mesh.submeshes[0].triangle_count = u32::MAX, "submesh-out-of-range",
         "Submesh 0 names triangles or a material that are not there."),
        (|model| model.materials.clear(), "submesh-out-of-range",
         "Submesh 0 names triangles or a material that are not there."),
        (|model| model.clips[0].tracks.truncate(2), "track-count",
         "Clip 0 has 2 tracks for 3 joints; every joint has one."),
    ];
    let (sound, _) = m3d::from_document(&arm(), &LineMap::default()).expect("the arm is sound");
    for (change, code, words) in cases {
        let mut model = sound.clone();
        change(&mut model);
        let error = model.checked().expect_err("unsound");
        assert_eq!((error.code, error.to_string().as_str()), (code, words));
    }
}
