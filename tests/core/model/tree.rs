//! Rows, branches and counts of vertices, against walks over all parents.

use std::collections::BTreeSet;

use bindpose::import::m3d;
use bindpose::model::{JointIndex, JointTree, Model, Skeleton};
use glam::Affine3A;
use proptest::prelude::*;

use crate::chains::mirrored_model;
use crate::documents::{arm, model_of, quad, soldier};

fn skeleton(parents: Vec<Option<u32>>) -> Skeleton {
    let count = parents.len();
    let parents = parents.into_iter().map(|parent| parent.map(JointIndex)).collect();
    Skeleton::new(parents, vec![Affine3A::IDENTITY; count], (0..count as u32).collect()).expect("sound")
}

/// Whether `joint` is `of` or below it: by climbing.
fn climbs_to(skeleton: &Skeleton, joint: JointIndex, of: JointIndex) -> bool {
    let mut at = Some(joint);
    while let Some(joint) = at {
        if joint == of {
            return true;
        }
        at = skeleton.parents()[joint.index()];
    }
    false
}

fn check_tree(skeleton: &Skeleton) {
    let tree = JointTree::new(skeleton);
    let all: BTreeSet<_> = tree.order().iter().copied().collect();
    assert_eq!(
        (all.len(), tree.order().len()),
        (skeleton.joint_count(), skeleton.joint_count())
    );
    let joints = (0..skeleton.joint_count() as u32).map(JointIndex);
    for joint in joints.clone() {
        let parent = skeleton.parents()[joint.index()];
        let depth = parent.map_or(0, |parent| tree.depth(parent) + 1);
        assert_eq!(tree.depth(joint), depth);
        let branch = tree.branch(joint);
        assert_eq!(branch[0], joint, "a branch begins with its joint");
        let climbing = joints.clone().filter(|&other| climbs_to(skeleton, other, joint));
        assert_eq!(branch.iter().copied().collect::<BTreeSet<_>>(), climbing.collect());
        let children: Vec<_> = tree.children(joint).collect();
        let expected: Vec<_> = joints
            .clone()
            .filter(|other| skeleton.parents()[other.index()] == Some(joint))
            .collect();
        assert_eq!(children, expected, "in the skeleton's order");
    }
}

fn check_counts(model: &Model) {
    let skeleton = &model.skeleton;
    let tree = JointTree::new(skeleton);
    let counts = tree.vertex_counts(skeleton, &model.mesh);
    let mut own = vec![BTreeSet::new(); skeleton.joint_count()];
    let mut of_branch = own.clone();
    for (vertex, influences) in model.mesh.influences.iter().enumerate() {
        for (&joint, &weight) in influences.joints.iter().zip(&influences.weights) {
            let mut at = Some(JointIndex(joint)).filter(|_| weight > 0.0);
            if let Some(joint) = at {
                own[joint.index()].insert(vertex);
            }
            while let Some(joint) = at {
                of_branch[joint.index()].insert(vertex);
                at = skeleton.parents()[joint.index()];
            }
        }
    }
    let sizes = |sets: &[BTreeSet<usize>]| sets.iter().map(|set| set.len() as u32).collect::<Vec<_>>();
    assert_eq!(counts.own, sizes(&own));
    assert_eq!(counts.of_branch, sizes(&of_branch));
}

#[test]
fn rows_run_depth_first_with_children_in_order() {
    let tree = JointTree::new(&skeleton(vec![None, Some(0), None, Some(0), Some(1), Some(2), Some(1)]));
    let order: Vec<_> = tree.order().iter().map(|joint| joint.0).collect();
    assert_eq!(order, [0, 1, 4, 6, 3, 2, 5]);
    let depths: Vec<_> = tree.order().iter().map(|&joint| tree.depth(joint)).collect();
    assert_eq!(depths, [0, 1, 2, 2, 1, 0, 1]);
}

#[test]
fn trees_of_every_size_hold_each_joint_once() {
    for count in [1, 2, 300] {
        let model = mirrored_model(count);
        check_tree(&model.skeleton);
        check_counts(&model);
    }
    check_counts(&mirrored_model(2_000));
    check_counts(&model_of(&arm()).0);
}

#[test]
fn what_is_not_there_has_no_branch() {
    let empty = JointTree::new(&Skeleton::default());
    assert_eq!((empty.order().len(), empty.branch(JointIndex(0)).len()), (0, 0));
    let tree = JointTree::new(&skeleton(vec![None]));
    assert!(tree.branch(JointIndex(1)).is_empty() && tree.children(JointIndex(7)).next().is_none());
    assert!(!tree.is_in_branch(JointIndex(0), JointIndex(1)));
    let (model, _) = model_of(&quad());
    assert!(
        JointTree::new(&model.skeleton)
            .vertex_counts(&model.skeleton, &model.mesh)
            .own
            .is_empty()
    );
}

#[test]
fn the_soldiers_counts_are_those_of_a_walk_over_all_parents() {
    let Some(parsed) = soldier() else { return };
    let (model, _) = m3d::from_parsed(&parsed).expect("sound");
    check_tree(&model.skeleton);
    check_counts(&model);
}

proptest! {
    #![proptest_config(crate::properties::cases(100))]

    #[test]
    fn any_hierarchy_is_a_tree(parents in prop::collection::vec(any::<Option<prop::sample::Index>>(), 1..40)) {
        let parents = parents.iter().enumerate();
        let parents = parents.map(|(joint, parent)| parent.filter(|_| joint > 0).map(|parent| parent.index(joint) as u32));
        check_tree(&skeleton(parents.collect()));
    }
}
