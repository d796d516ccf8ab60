//! Order of joints, offsets and the pose at rest.

use bindpose::format::LineMap;
use bindpose::import::m3d;
use bindpose::model::{JointIndex, LocalJoint};
use glam::{Affine3A, Vec3};

use crate::documents::{arm, assert_told, message_of, model_of, offset, reordered, track};

#[test]
fn a_valid_order_is_kept() {
    let (model, codes) = model_of(&arm());
    assert_eq!(model.skeleton.file_bones(), [0, 1, 2]);
    assert_eq!(
        model.skeleton.parents(),
        [None, Some(JointIndex(0)), Some(JointIndex(1))]
    );
    assert_eq!(codes, Vec::<&str>::new());
}

#[test]
fn a_child_before_its_parent_is_moved_behind_it() {
    // File bones: 0 is the tip, 1 the root, 2 the middle.
    let document = reordered(&arm(), &[2, 0, 1]);
    let (model, _) = model_of(&document);
    assert_eq!(model.skeleton.file_bones(), [1, 2, 0]);
    assert_eq!(model.skeleton.joint_of_bone(), [2, 0, 1].map(JointIndex));
    assert_eq!(
        model.skeleton.parents(),
        [None, Some(JointIndex(0)), Some(JointIndex(1))]
    );
    let words = "1 bone stands before the parent; the joints are sorted and keep the file's numbers for display.";
    assert_told(&document, "bones-reordered", words);
    // Influences follow their bones.
    let (sorted, _) = model_of(&arm());
    assert_eq!(model.mesh.influences, sorted.mesh.influences);
}

#[test]
fn among_bones_that_may_stand_next_the_lowest_number_does() {
    let mut document = arm();
    document
        .vertices
        .iter_mut()
        .for_each(|vertex| vertex.blend_indices = [0; 4]);
    document.bone_offsets = vec![offset([0.0; 3]); 6];
    document.bone_parents = vec![3, -1, 1, -1, 0, 1];
    document.clips.clear();
    let (model, _) = model_of(&document);
    assert_eq!(model.skeleton.file_bones(), [1, 2, 3, 0, 4, 5]);
    let roots: Vec<bool> = model.skeleton.parents().iter().map(Option::is_none).collect();
    assert_eq!(roots, [true, false, true, false, false, false]);
}

#[test]
fn the_pose_at_rest_is_the_bind_pose() {
    let (model, _) = model_of(&arm());
    let rest: Vec<Vec3> = model.skeleton.rest().iter().map(|joint| joint.translation).collect();
    assert_eq!(rest, [Vec3::ZERO, Vec3::Y, Vec3::Y]);
    let place = model.skeleton.bind_model_from_joint()[2];
    assert_eq!(place, Affine3A::from_translation(Vec3::new(0.0, 2.0, 0.0)));
}

#[test]
fn offsets_that_are_no_affine_or_invertible_matrices_are_told() {
    let mut document = arm();
    document.clips.clear();
    document.bone_offsets[0][3] = 0.5;
    document.bone_offsets[1][..11].fill(0.0);
    document.bone_offsets[2][5] = f32::NAN;
    let (model, codes) = model_of(&document);
    assert_eq!(codes, ["offset-not-finite", "offset-not-affine", "offset-singular"]);
    #[rustfmt::skip]
    let cases = [
        ("offset-not-finite", "1 bone offset has a number that is not finite; the identity stands in."),
        ("offset-not-affine", "1 bone offset has a fourth column that is not 0 0 0 1; that column was left out."),
        ("offset-singular", "1 bone offset has no inverse; the bone's place in the bind pose is unknown."),
    ];
    for (code, words) in cases {
        assert_eq!(message_of(&document, code), words);
    }
    let skeleton = &model.skeleton;
    assert_eq!(skeleton.joint_from_bind()[0], Affine3A::IDENTITY);
    assert_eq!(skeleton.joint_from_bind()[2], Affine3A::IDENTITY);
    assert!(skeleton.rest().iter().all(LocalJoint::is_finite));
    assert!(skeleton.bind_model_from_joint().iter().all(Affine3A::is_finite));
}

#[test]
fn a_small_unit_does_not_make_an_offset_singular() {
    let mut document = arm();
    document.clips.clear();
    for offset in &mut document.bone_offsets {
        offset[..11].iter_mut().for_each(|number| *number *= 1e-9);
    }
    let (_, codes) = model_of(&document);
    assert_eq!(codes, Vec::<&str>::new());
}

#[test]
fn a_thousand_bones_in_falling_order_are_sorted_and_told() {
    let mut document = arm();
    let count = 1_000;
    document.vertices.iter_mut().for_each(|vertex| {
        vertex.blend_weights = [1.0, 0.0, 0.0, 0.0];
        vertex.blend_indices = [999, 0, 0, 0];
    });
    document.bone_offsets = (0..count).rev().map(|bone| offset([0.0, bone as f32, 0.0])).collect();
    document.bone_parents = (0..count)
        .map(|bone| if bone + 1 == count { -1 } else { bone + 1 })
        .collect();
    document.clips[0].bones = vec![track([]); count as usize];
    let lines = LineMap {
        bone_parents: (5_000..).take(count as usize).collect(),
        ..LineMap::default()
    };
    let (model, findings) = m3d::from_document(&document, &lines).expect("a chain has an order");
    assert!(model.skeleton.file_bones().iter().copied().eq((0..1_000).rev()));
    assert!(
        model
            .mesh
            .influences
            .iter()
            .all(|influences| influences.joints == [0; 4])
    );
    let told: Vec<(&str, Option<u32>)> = findings
        .iter()
        .map(|finding| (finding.code, finding.position.map(|at| at.line)))
        .collect();
    assert_eq!(
        told,
        [
            ("bones-reordered", Some(5_000)),
            ("many-bones", None),
            ("bone-index-above-byte", None),
            ("track-empty", None),
        ]
    );
    assert_eq!(
        message_of(&document, "many-bones"),
        "There are 1000 bones; the books' shaders hold 96."
    );
    assert_eq!(
        message_of(&document, "bone-index-above-byte"),
        "14 influences name a bone above 255, which the books' loaders cannot hold."
    );
}
