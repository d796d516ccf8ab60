//! Names, and the clips that are kept.

use bindpose::edit::{Edits, apply};
use bindpose::model::JointNames;

use super::{edit, try_edit};
use crate::rigs;

fn names(pairs: &[(&str, &str)]) -> Edits {
    Edits {
        clip_names: pairs
            .iter()
            .map(|(old, new)| ((*old).to_owned(), (*new).to_owned()))
            .collect(),
        ..Edits::default()
    }
}

fn kept(clips: &[&str]) -> Edits {
    Edits {
        clips: Some(clips.iter().map(|name| (*name).to_owned()).collect()),
        ..Edits::default()
    }
}

#[test]
fn chosen_clips_keep_the_order_of_the_model() {
    let model = rigs::model(3);
    let edited = edit(&model, &kept(&["even", "ragged"]));
    let left: Vec<_> = edited.model.clips.iter().map(|clip| clip.name.as_str()).collect();
    assert_eq!(left, ["ragged", "even"]);
    assert_eq!(edited.changes[0].message, "1 clip is left out.");
    assert_eq!(edit(&model, &kept(&["even", "ragged", "single"])).changes, []);
}

#[test]
fn clips_exchange_their_names() {
    let edited = edit(&rigs::model(3), &names(&[("ragged", "even"), ("even", " ragged ")]));
    let left: Vec<_> = edited.model.clips.iter().map(|clip| clip.name.as_str()).collect();
    assert_eq!(left, ["even", "single", "ragged"]);
    assert_eq!(edited.changes.len(), 2);
}

#[test]
fn names_that_cannot_be_are_refused() {
    let model = rigs::model(3);
    let known = "There is no clip \"odd\"; it has \"ragged\", \"single\", \"even\".";
    for (edits, words) in [
        (
            names(&[("even", "single")]),
            "A clip cannot be named \"single\": another one is.",
        ),
        (
            names(&[("even", " \n")]),
            "A clip cannot be named \"\": that is no name.",
        ),
        (names(&[("odd", "x")]), known),
        (kept(&["odd"]), known),
    ] {
        assert_eq!(try_edit(&model, &edits).expect_err("refused").to_string(), words);
    }
}

#[test]
fn bones_are_named_by_their_numbers_in_the_file() {
    let mut given = JointNames::default();
    given.set(1, "spine");
    let edits = Edits {
        bone_names: vec![(0, "root".to_owned()), (1, "spine".to_owned()), (2, "head".to_owned())],
        ..Edits::default()
    };
    let edited = apply(rigs::model(3), &given, &edits).expect("three bones");
    let all: Vec<_> = edited.names.all().values().map(String::as_str).collect();
    assert_eq!(all, ["root", "spine", "head"]);
    let told: Vec<_> = edited.changes.iter().map(|change| change.message.as_str()).collect();
    assert_eq!(told, ["Bone 0 is named \"root\".", "Bone 2 is named \"head\"."]);
    let edits = Edits {
        bone_names: vec![(3, "tail".to_owned())],
        ..Edits::default()
    };
    let refused = apply(rigs::model(3), &given, &edits).expect_err("no such bone");
    assert_eq!(refused.to_string(), "There is no bone 3; there are 3.");
}
