//! What the books' demo needs.

use bindpose::edit::{EditError, Edits, apply};
use bindpose::model::{Handedness, JointNames, Model, UpAxis};

use super::{apart, edit, seen, size, spread, swaying, try_edit};
use crate::documents::{model_of, reordered};
use crate::rigs;

fn for_book() -> Edits {
    Edits {
        for_book: true,
        ..Edits::default()
    }
}

/// The world sees the same, but for a scale and for the time at which clips begin.
fn assert_seen_alike(old: &Model, new: &Model) {
    let scale = size(new) / size(old);
    for (index, clip) in old.clips.iter().enumerate() {
        for secs in spread(clip) {
            let mut before = seen(old, index, secs).positions;
            before.iter_mut().for_each(|position| *position *= scale);
            let after = seen(new, index, secs - clip.start_secs).positions;
            let off = apart(&before, &after);
            assert!(off <= 1e-4 * size(new), "{} at {secs} s: {off}", clip.name);
        }
    }
}

fn assert_shape(model: &Model) {
    let bones = model.skeleton.file_bones();
    for (joint, parent) in model.skeleton.parents().iter().enumerate() {
        match parent {
            None => assert_eq!(bones[joint], 0, "one root, bone 0"),
            Some(parent) => assert!(bones[parent.index()] < bones[joint], "children after their parents"),
        }
    }
    assert_eq!((model.handedness, model.up_axis), (Handedness::Right, UpAxis::Y));
    assert!(model.clips.iter().any(|clip| clip.name == "Take1"));
    for clip in &model.clips {
        assert!(!clip.name.contains(char::is_whitespace), "{:?}", clip.name);
        assert!(clip.tracks.iter().all(|track| track.has_keys()));
        assert_eq!(clip.start_secs, 0.0);
    }
    let height = model.bind_bounds().size().y * 0.05;
    assert!((0.9..=14.4).contains(&height), "{height}");
}

#[test]
fn a_chain_comes_out_as_the_demo_wants_it() {
    let (model, _) = model_of(&swaying(6, 2.0));
    let edited = edit(&model, &for_book());
    assert_shape(&edited.model);
    assert_seen_alike(&model, &edited.model);
    let codes: Vec<_> = edited.changes.iter().map(|change| change.code).collect();
    assert_eq!(codes, ["handedness-changed", "scaled", "book-clip-name"]);
    assert_eq!(edit(&edited.model, &for_book()).changes, [], "it needs nothing more");
}

#[test]
fn clips_without_keys_and_late_ones_are_brought_in() {
    let model = rigs::model(20);
    let edited = edit(&model, &for_book());
    assert_shape(&edited.model);
    assert_seen_alike(&model, &edited.model);
}

#[test]
fn several_roots_and_free_vertices_hang_from_a_new_bone() {
    let mut document = swaying(6, 1.0);
    document.bone_parents[3] = -1;
    document.vertices[4].blend_weights = [0.0; 4];
    let (model, _) = model_of(&document);
    let mut names = JointNames::default();
    names.set(3, "second root");
    let edited = apply(model.clone(), &names, &for_book()).expect("small enough");
    assert_eq!(edited.model.skeleton.joint_count(), 7);
    assert_eq!(edited.names.get(4), Some("second root"));
    assert_shape(&edited.model);
    assert_seen_alike(&model, &edited.model);
    let is_free = |weights: [f32; 4]| weights == [0.0; 4];
    assert!(
        !edited
            .model
            .mesh
            .influences
            .iter()
            .any(|influences| is_free(influences.weights))
    );
}

#[test]
fn bones_before_their_parents_get_other_numbers_and_keep_their_names() {
    let (model, _) = model_of(&reordered(&swaying(4, 1.0), &[2, 0, 3, 1]));
    let mut names = JointNames::default();
    names.set(0, "third");
    names.set(1, "first");
    let edited = apply(model.clone(), &names, &for_book()).expect("small enough");
    assert_shape(&edited.model);
    assert_seen_alike(&model, &edited.model);
    assert_eq!(edited.names.get(0), Some("first"));
    assert_eq!(edited.names.get(2), Some("third"));
}

#[test]
fn names_of_several_words_become_one_and_stay_apart() {
    let mut document = swaying(3, 1.0);
    let clip = document.clips[0].clone();
    let named = |name: &str| bindpose::format::AnimationClip {
        name: name.to_owned(),
        ..clip.clone()
    };
    document.clips = vec![named("run away"), named("run_away"), named("Take1"), named("{")];
    document.materials[0].name = "soft skin".to_owned();
    let edited = edit(&model_of(&document).0, &for_book());
    let names: Vec<_> = edited.model.clips.iter().map(|clip| clip.name.as_str()).collect();
    assert_eq!(names, ["run_away_2", "run_away", "Take1", "_"]);
    assert_eq!(edited.model.materials[0].name, "soft_skin");
}

#[test]
fn a_figure_without_clips_stands_still() {
    let mut document = swaying(3, 1.0);
    document.clips.clear();
    let edited = edit(&model_of(&document).0, &for_book());
    assert_shape(&edited.model);
}

#[test]
fn an_asked_scale_is_kept() {
    let (model, _) = model_of(&swaying(6, 2.0));
    let edits = Edits {
        scale: Some(10.0),
        ..for_book()
    };
    let scaled = edit(&model, &edits).model;
    assert!((size(&scaled) / size(&model) - 10.0).abs() < 1e-3);
}

#[test]
fn a_static_model_keeps_the_hand_of_the_books() {
    let (model, _) = model_of(&crate::documents::quad());
    let edited = edit(&model, &for_book());
    assert_eq!(edited.model.handedness, Handedness::Left);
    assert_eq!(edited.changes, []);
}

#[test]
fn what_is_too_large_for_the_demo_is_refused() {
    let refused = try_edit(&model_of(&swaying(97, 0.1)).0, &for_book()).expect_err("too many bones");
    assert_eq!(
        refused.to_string(),
        "The model has 97 bones; the books' demo has room for 96."
    );
    let mut document = swaying(96, 0.1);
    document.bone_parents[5] = -1;
    let refused = try_edit(&model_of(&document).0, &for_book()).expect_err("no room for a root");
    assert!(matches!(
        refused,
        EditError::TooManyBones {
            bones: 97,
            added: true,
            ..
        }
    ));
}
