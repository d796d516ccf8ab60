//! Mirrored joints, names and how they are kept.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use bindpose::format::Document;
use bindpose::import::m3d;
use bindpose::model::{
    Front, Handedness, JointIndex, JointNames, JointTree, MirrorPair, Model, SavedNames, UpAxis, hierarchy_fingerprint,
    mirror_pairs, world_from_model,
};
use glam::Affine3A;

use crate::chains::{mirrored, mirrored_model};
use crate::documents::{arm, figure, model_of, offset, reordered, soldier};

fn pairs(model: &Model) -> Vec<MirrorPair> {
    let world_from_model = world_from_model(model.handedness, model.up_axis, model.front);
    mirror_pairs(&model.skeleton, &JointTree::new(&model.skeleton), world_from_model)
}

/// Left and right by their numbers in the file.
fn bones(model: &Model, pairs: &[MirrorPair]) -> Vec<(u32, u32)> {
    let bone = |joint: JointIndex| model.skeleton.file_bones()[joint.index()];
    pairs.iter().map(|pair| (bone(pair.left), bone(pair.right))).collect()
}

#[test]
fn mirrored_chains_of_every_size_are_paired_left_with_right() {
    for count in [1, 3, 299, 1_999] {
        let model = mirrored_model(count);
        let expected: Vec<_> = (0..count as u32 / 2).map(|pair| (pair * 2 + 1, pair * 2 + 2)).collect();
        assert_eq!(bones(&model, &pairs(&model)), expected);
    }
}

#[test]
fn in_a_file_that_is_mirrored_into_the_world_left_is_left_there() {
    let model = mirrored_model(3);
    let tree = JointTree::new(&model.skeleton);
    let in_world = |handedness| {
        mirror_pairs(
            &model.skeleton,
            &tree,
            world_from_model(handedness, UpAxis::Y, Front::Negative),
        )
    };
    assert_eq!(bones(&model, &in_world(Handedness::Left)), [(1, 2)]);
    assert_eq!(bones(&model, &in_world(Handedness::Right)), [(2, 1)]);
}

#[test]
fn what_is_off_by_more_than_the_tolerance_is_no_pair_nor_what_hangs_from_it() {
    let mut document = mirrored(21);
    let all = pairs(&model_of(&document).0).len();
    assert_eq!(all, 10);
    // 1 % of a skeleton that is 6.4 wide, and 15 % of a bone of 0.3: 0.109.
    let moved = |document: &mut Document, by: f32| document.bone_offsets[4][13] -= by;
    moved(&mut document, 0.09);
    assert_eq!(pairs(&model_of(&document).0).len(), all, "a little off");
    moved(&mut document, 0.04);
    let left = bones(&model_of(&document).0, &pairs(&model_of(&document).0));
    assert_eq!(left, [(1, 2)], "bones 3 and 4 and all beyond them");
}

#[test]
fn joints_of_the_middle_are_no_pairs_and_joints_at_one_place_go_by_their_branches() {
    assert!(pairs(&model_of(&arm()).0).is_empty());
    // Two bones at the root's place, each with a hand at its side.
    let mut document = mirrored(5);
    document.bone_offsets = [[0.0; 3], [0.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]
        .map(offset)
        .to_vec();
    let model = model_of(&document).0;
    assert_eq!(bones(&model, &pairs(&model)), [(1, 2), (3, 4)]);
}

#[test]
fn a_fingerprint_is_of_the_files_hierarchy_alone() {
    let fingerprint = |document: &Document| hierarchy_fingerprint(&model_of(document).0.skeleton);
    let document = mirrored(9);
    let mut moved = document.clone();
    moved.bone_offsets[3][12] += 0.5;
    moved.clips.clear();
    assert_eq!(fingerprint(&document), fingerprint(&moved));
    let order = [1, 0, 2, 3, 4, 5, 6, 7, 8];
    assert_ne!(
        fingerprint(&document),
        fingerprint(&reordered(&document, &order)),
        "other numbers, other names"
    );
    assert_ne!(fingerprint(&document), fingerprint(&mirrored(8)));
    // What was kept long ago must be found: one root, FNV-1a of FF FF FF FF.
    assert_eq!(fingerprint(&mirrored(1)), 0x994f_7665_3e2a_3951);
}

#[test]
fn names_are_cleaned_kept_and_taken_up_again() {
    let (model, other) = (mirrored_model(5), mirrored_model(7));
    let mut names = JointNames::default();
    names.set(3, "  hand\n ");
    names.set(4, &"x".repeat(100));
    names.set(0, "root");
    names.set(0, " \t");
    assert_eq!((names.get(3), names.get(0)), (Some("hand"), None));
    assert_eq!(names.get(4).map(str::len), Some(64));

    let mut saved = names.saved(&model.skeleton);
    assert_eq!(JointNames::from_saved(&saved, &model.skeleton), Some(names.clone()));
    assert_eq!(JointNames::from_saved(&saved, &other.skeleton), None);
    saved.names.insert(5, "no such bone".to_owned());
    saved.names.insert(usize::MAX, "none".to_owned());
    saved.names.insert(1, " ".to_owned());
    assert_eq!(JointNames::from_saved(&saved, &model.skeleton), Some(names));
    let nothing = SavedNames {
        fingerprint: saved.fingerprint,
        names: BTreeMap::new(),
    };
    assert!(
        JointNames::from_saved(&nothing, &model.skeleton)
            .expect("the same hierarchy")
            .is_empty()
    );
}

#[test]
fn one_named_side_proposes_names_for_the_other() {
    let model = mirrored_model(9);
    let pairs = pairs(&model);
    let proposed = |given: &[(u32, &str)]| {
        let mut names = JointNames::default();
        for &(bone, name) in given {
            names.set(bone, name);
        }
        names.mirrored(&model.skeleton, &pairs).into_iter().collect::<Vec<_>>()
    };
    let expected = |names: &[(usize, &str)]| {
        names
            .iter()
            .map(|&(bone, name)| (bone, name.to_owned()))
            .collect::<Vec<_>>()
    };
    assert_eq!(proposed(&[(1, "L arm")]), expected(&[(2, "R arm")]));
    assert_eq!(proposed(&[(2, "right_hand")]), expected(&[(1, "L hand")]));
    assert_eq!(proposed(&[(3, "knee")]), expected(&[(3, "L knee"), (4, "R knee")]));
    assert_eq!(proposed(&[(4, "knee")]), expected(&[(3, "L knee"), (4, "R knee")]));
    assert_eq!(
        proposed(&[(3, "R leg")]),
        expected(&[(4, "L leg")]),
        "what a person calls right is right"
    );
    assert_eq!(proposed(&[(1, "L arm"), (2, "other"), (0, "root")]), []);
    assert_eq!(proposed(&[(1, "Lara")]), expected(&[(1, "L Lara"), (2, "R Lara")]));
}

/// A root with this many pairs of children at its sides, the right ones off by what six digits of a file lose; and named on the
/// left.
fn many_siblings(pairs: usize, place: impl Fn(usize) -> [f32; 3]) -> (Model, JointNames) {
    let mut document = mirrored(1);
    let mut names = JointNames::default();
    for pair in 0..pairs {
        let [x, y, z] = place(pair);
        let lost = ((pair % 7) as f32 - 3.0) * 1e-7;
        for place in [[x, y, z], [-x + lost, y - lost, z + lost]] {
            document.bone_parents.push(0);
            document.bone_offsets.push(offset(place));
        }
        names.set(pair as u32 * 2 + 1, &format!("L {pair}"));
    }
    document.clips.clear();
    (model_of(&document).0, names)
}

#[test]
fn twenty_thousand_siblings_are_paired_as_quickly_as_they_are_read() {
    // The pairs that would have to be compared each with each: a hundred million, and gigabytes of candidates.
    let most = Duration::from_secs(20);
    let (model, names) = many_siblings(10_000, |pair| {
        [0.5 + (pair % 100) as f32 * 0.01, (pair / 100) as f32 * 0.01, 0.3]
    });
    let start = Instant::now();
    let found = pairs(&model);
    let expected: Vec<_> = (0..10_000).map(|pair| (pair * 2 + 1, pair * 2 + 2)).collect();
    assert!(bones(&model, &found) == expected, "each with its own image");
    let proposed = names.mirrored(&model.skeleton, &found);
    assert_eq!(proposed.len(), 10_000);
    assert_eq!(proposed.get(&20_000).map(String::as_str), Some("R 9999"));
    assert!(start.elapsed() < most, "{:?}", start.elapsed());

    // All at one place, on which no grid has a hold.
    let (model, _) = many_siblings(10_000, |_| [0.5, 0.0, 0.0]);
    let start = Instant::now();
    assert_eq!(pairs(&model).len(), 10_000);
    assert!(start.elapsed() < most, "{:?}", start.elapsed());
}

#[test]
fn the_figure_is_paired_limb_by_limb() {
    let (model, _) = m3d::from_parsed(&figure()).expect("sound");
    let pairs = pairs(&model);
    // Seven joints of the middle, then 16 of the left and 16 of the right.
    let expected: Vec<_> = (7..23).map(|left| (left, left + 16)).collect();
    assert_eq!(bones(&model, &pairs), expected);
}

#[test]
fn kept_names_read_back_what_was_written_whatever_they_are() {
    let model = mirrored_model(5);
    let mut names = JointNames::default();
    for (bone, name) in [(0, "Hüfte \n links"), (2, "1 2"), (4, "  a  b ")] {
        names.set(bone, name);
    }
    let saved = names.saved(&model.skeleton);
    let text = saved.to_text();
    assert_eq!(text, "0 Hüfte  links\n2 1 2\n4 a  b\n");
    assert_eq!(SavedNames::from_text(saved.fingerprint, &text), saved);
    // What somebody else wrote there is left out line by line.
    let odd = "x\n\n7\n-1 a\n99999999999999999999 b\n3 c";
    let read = SavedNames::from_text(saved.fingerprint, odd);
    assert_eq!(read.names, BTreeMap::from([(3, "c".to_owned())]));
}

#[test]
fn the_soldiers_limbs_are_pairs() {
    let Some(parsed) = soldier() else { return };
    let (model, _) = m3d::from_parsed(&parsed).expect("sound");
    let pairs = pairs(&model);
    let world = world_from_model(model.handedness, model.up_axis, model.front);
    let x = |joint: JointIndex| {
        let place: Affine3A = world * model.skeleton.bind_model_from_joint()[joint.index()];
        place.translation.x
    };
    // Eyes, arms to the finger tips, legs: all but the spine, the neck and the head.
    let arms = (12..31).zip(31..50);
    let legs = (50..54).zip(54..58);
    let of_limbs: Vec<(u32, u32)> = arms.chain(legs).collect();
    let found = bones(&model, &pairs);
    let sided = |(a, b): &(u32, u32)| found.contains(&(*a, *b)) || found.contains(&(*b, *a));
    let missing: Vec<_> = of_limbs.iter().filter(|pair| !sided(pair)).collect();
    assert!(missing.is_empty(), "{missing:?}");
    assert!(pairs.iter().all(|pair| x(pair.left) > x(pair.right)));
}
