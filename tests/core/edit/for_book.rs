//! What the books' demo needs.

use bindpose::edit::{EditError, Edits, apply};
use bindpose::model::{Clip, Handedness, JointIndex, JointNames, LocalJoint, Model, Skeleton, Track, UpAxis};
use glam::{Quat, Vec3};

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
fn what_is_too_large_for_the_demo_is_refused_with_all_that_is() {
    let refused = try_edit(&model_of(&swaying(97, 0.1)).0, &for_book()).expect_err("too many bones");
    assert_eq!(
        refused.to_string(),
        "The model has 97 bones; the books' demo has room for 96."
    );
    let mut document = swaying(96, 0.1);
    document.bone_parents[5] = -1;
    let refused = try_edit(&model_of(&document).0, &for_book()).expect_err("no room for a root");
    assert!(matches!(refused, EditError::TooLarge(_)));
    let mut model = model_of(&document).0;
    let more = 66_000 - model.mesh.vertex_count();
    let mesh = &mut model.mesh;
    mesh.positions.extend(vec![mesh.positions[0]; more]);
    mesh.normals.extend(vec![mesh.normals[0]; more]);
    mesh.tangents.clear();
    mesh.tex_coords.extend(vec![mesh.tex_coords[0]; more]);
    mesh.influences.extend(vec![mesh.influences[0]; more]);
    let refused = try_edit(&model, &for_book()).expect_err("too much of both");
    assert_eq!(
        refused.to_string(),
        "The model has 97 bones with the root that all hang from; the books' demo has room for 96. The model has 66000 vertices; the books' \
         demo can number 65536."
    );
}

/// The same figure on a bone that is turned, placed and scaled, moves no vertex and has no keys, as the object of an armature is.
fn on_a_still_bone(model: &Model) -> Model {
    let still = LocalJoint {
        rotation: Quat::from_rotation_x(1.5),
        translation: Vec3::new(1.0, 2.0, -3.0),
        scale: Vec3::splat(0.01),
    };
    let above = still.parent_from_joint();
    let mut model = model.clone();
    let old = &model.skeleton;
    let parents = old
        .parents()
        .iter()
        .map(|parent| Some(JointIndex(parent.map_or(0, |parent| parent.0 + 1))));
    // The figure stays where it was: only its root hangs from the new one, which is taken out of its own place.
    let taken_out = |joint: LocalJoint| {
        let matrix = above.inverse() * joint.parent_from_joint();
        let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
        LocalJoint {
            rotation,
            translation,
            scale,
        }
    };
    let rest = old.rest().iter().zip(old.parents());
    let rest: Vec<LocalJoint> = [still]
        .into_iter()
        .chain(rest.map(|(&rest, parent)| if parent.is_none() { taken_out(rest) } else { rest }))
        .collect();
    let matrices = [above.inverse()]
        .into_iter()
        .chain(old.joint_from_bind().iter().copied());
    let bones = (0..=old.joint_count() as u32).collect();
    let names = ["Armature".to_owned()]
        .into_iter()
        .chain((0..old.joint_count()).map(|bone| format!("bone {bone}")));
    let roots: Vec<bool> = old.parents().iter().map(Option::is_none).collect();
    let new = Skeleton::new([None].into_iter().chain(parents).collect(), matrices.collect(), bones).expect("sound");
    model.skeleton = new.with_rest(&rest).with_names(names.collect());
    for clip in &mut model.clips {
        let tracks = clip.tracks.iter().zip(&roots).map(|(track, is_root)| {
            if !is_root {
                return track.clone();
            }
            if !track.has_keys() {
                return Track::at_rest(taken_out(track.key(0)));
            }
            let keys = (0..track.key_count()).map(|key| (track.times_secs()[key], taken_out(track.key(key))));
            Track::new(keys).expect("sound keys")
        });
        let tracks = [Track::at_rest(still)].into_iter().chain(tracks).collect();
        *clip = Clip::new(clip.name.clone(), tracks);
    }
    for influences in &mut model.mesh.influences {
        influences.joints = influences.joints.map(|joint| joint + 1);
    }
    model.checked().expect("it is sound")
}

#[test]
fn ninety_six_bones_on_a_still_one_fit() {
    let model = on_a_still_bone(&model_of(&swaying(96, 0.1)).0);
    assert_eq!(model.skeleton.joint_count(), 97);
    let edited = edit(&model, &for_book());
    assert_shape(&edited.model);
    assert_eq!(edited.model.skeleton.joint_count(), 96);
    assert_eq!(edited.model.skeleton.name(JointIndex(3)), Some("bone 3"));
    let told = edited.changes.iter().find(|change| change.code == "bones-folded");
    assert!(
        told.is_some_and(|told| told.message.contains("Bone 0, \"Armature\",")),
        "{told:?}"
    );
    assert_seen_alike(&model, &edited.model);

    // One that fits stays as it is, and one that moves is no still one.
    let small = on_a_still_bone(&model_of(&swaying(95, 0.1)).0);
    assert_eq!(edit(&small, &for_book()).model.skeleton.joint_count(), 96);
    let mut moving = model;
    let mut tracks = moving.clips[0].tracks.clone();
    tracks[0] = Track::new([(0.0, tracks[0].key(0)), (1.0, LocalJoint::IDENTITY)]).expect("sound keys");
    moving.clips[0] = Clip::new("Take1", tracks);
    let refused = try_edit(&moving, &for_book()).expect_err("it moves");
    assert!(refused.to_string().contains("97 bones"), "{refused}");
}

/// Each takes a pass over the model, so a file of thousands is refused at once.
#[test]
fn only_a_few_still_bones_are_folded() {
    let on_bones = |count: u32| {
        let figure = model_of(&swaying(96, 0.1)).0;
        (0..count).fold(figure, |model, _| on_a_still_bone(&model))
    };
    assert_eq!(edit(&on_bones(8), &for_book()).model.skeleton.joint_count(), 96);
    let refused = try_edit(&on_bones(9), &for_book()).expect_err("too many");
    assert!(refused.to_string().contains("105 bones"), "{refused}");
}

/// The books' programs stop at a bone without keys.
#[test]
fn each_bone_gets_a_key_in_what_is_written_for_the_books() {
    let mut model = model_of(&swaying(5, 0.5)).0;
    let rest = model.skeleton.rest()[3];
    let mut tracks = model.clips[0].tracks.clone();
    tracks[3] = Track::at_rest(rest);
    model.clips[0] = Clip::new("Walk", tracks);
    let (start_secs, end_secs) = (model.clips[0].start_secs, model.clips[0].end_secs);
    let edited = edit(&model, &Edits::default().in_space_of_the_books(&model));
    let clip = &edited.model.clips[0];
    let told = edited.changes.iter().find(|change| change.code == "track-empty");
    assert_eq!(
        told.map(|told| told.message.as_str()),
        Some("1 bone gets a key at rest in \"Walk\".")
    );
    assert!(clip.tracks.iter().all(Track::has_keys));
    let mut several = model.clone();
    for (index, resting) in [(1, 2), (2, 2), (3, 2), (4, 3)] {
        let mut tracks = model.clips[0].tracks.clone();
        tracks[..resting].fill(Track::at_rest(rest));
        several.clips.push(Clip::new(format!("Step {index}"), tracks));
    }
    let told = edit(&several, &Edits::default().in_space_of_the_books(&several)).changes;
    let told: Vec<_> = told.iter().filter(|change| change.code == "track-empty").collect();
    assert_eq!(told.len(), 1, "one line, however many clips");
    let words = "Up to 4 bones get a key at rest in \"Walk\", \"Step 1\", \"Step 2\" and 2 more.";
    assert_eq!(told[0].message, words);
    assert_eq!(
        (clip.start_secs, clip.end_secs),
        (start_secs, end_secs),
        "as long as before"
    );
    assert_eq!(clip.tracks[3].key_count(), 1);
    let kept = edit(&model, &Edits::default());
    assert!(!kept.model.clips[0].tracks[3].has_keys(), "nothing comes in unasked");
}
