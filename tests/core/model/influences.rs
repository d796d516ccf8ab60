//! Weights.

use bindpose::format::Document;
use bindpose::model::Influences;

use crate::documents::{arm, message_of, model_of};

fn with_weights(weights: [f32; 4]) -> Document {
    let mut document = arm();
    document.vertices[3].blend_weights = weights;
    document.vertices[3].blend_indices = [2, 1, 0, 1];
    document
}

#[test]
fn weights_are_normalised_and_the_fourth_is_kept() {
    #[rustfmt::skip]
    let cases = [
        // Rounded to 7 digits in the file: nothing to tell.
        ([0.25, 0.25, 0.25, 0.2500001], [0.25, 0.25, 0.25, 0.25], None),
        ([0.5, 0.25, 0.125, 0.125], [0.5, 0.25, 0.125, 0.125], None),
        ([2.0, 1.0, 1.0, 4.0], [0.25, 0.125, 0.125, 0.5], Some("weights-not-normalized")),
        ([0.5, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], Some("weights-not-normalized")),
        ([f32::MAX; 4], [0.25; 4], Some("weights-not-normalized")),
        ([1e-40, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], Some("weights-not-normalized")),
        ([0.0; 4], [0.0; 4], Some("weights-all-zero")),
        ([1.0, -0.5, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], Some("weights-invalid")),
        ([f32::NAN, 1.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], Some("weights-invalid")),
    ];
    for (stored, expected, code) in cases {
        let (model, codes) = model_of(&with_weights(stored));
        let Influences { weights, joints } = model.mesh.influences[3];
        for (weight, expected) in weights.iter().zip(expected) {
            assert!((weight - expected).abs() <= 1e-6, "{stored:?} became {weights:?}");
        }
        assert_eq!(codes, code.into_iter().collect::<Vec<_>>(), "{stored:?}");
        for slot in 0..4 {
            let named = if weights[slot] > 0.0 { [2, 1, 0, 1][slot] } else { 0 };
            assert_eq!(joints[slot], named, "{stored:?}, slot {slot}");
        }
    }
}

#[test]
fn words_of_the_findings() {
    let mut document = arm();
    document.vertices[0].blend_weights = [0.9, 0.0, 0.0, 0.0];
    document.vertices[1].blend_weights = [0.9, 0.0, 0.0, 0.0];
    document.vertices[2].blend_weights = [0.0; 4];
    document.vertices[3].blend_weights = [1.0, 0.0, f32::INFINITY, 0.0];
    #[rustfmt::skip]
    let rows = [
        ("weights-not-normalized",
         "2 vertices have blend weights whose sum is off from 1 by more than 0.001; normalised."),
        ("weights-all-zero", "1 vertex has no blend weight; not moved by any bone."),
        ("weights-invalid", "1 vertex has a blend weight that is negative or not finite; taken as 0."),
    ];
    for (code, words) in rows {
        assert_eq!(message_of(&document, code), words);
    }
}

#[test]
fn without_bones_there_are_no_influences() {
    let mut document = arm();
    document.bone_offsets.clear();
    document.bone_parents.clear();
    document.clips.clear();
    let (model, codes) = model_of(&document);
    assert!(model.mesh.influences.is_empty());
    assert_eq!(codes, Vec::<&str>::new());
}
