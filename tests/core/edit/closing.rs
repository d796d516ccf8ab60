//! Loops that are closed.

use bindpose::anim::{CompiledClip, loop_gap};
use bindpose::edit::Edits;
use bindpose::model::Model;

use super::{apart, curved, edit, figure, key_times, seen, size, spread, try_edit};
use crate::documents::model_of;
use crate::rigs;

fn close(secs: f32) -> Edits {
    Edits {
        close_loop_secs: Some(secs),
        ..Edits::default()
    }
}

fn gap(model: &Model, clip: usize) -> (f32, f32) {
    let clip = &model.clips[clip];
    let gap = loop_gap(
        &model.skeleton,
        &CompiledClip::new(clip),
        [clip.start_secs, clip.end_secs],
        size(model),
    );
    let travels = gap.joints.iter().map(|joint| joint.travel);
    let turns = gap.joints.iter().map(|joint| joint.rotation_degrees);
    (travels.fold(0.0, f32::max), turns.fold(0.0, f32::max))
}

fn models() -> [(&'static str, Model); 4] {
    let rig = rigs::rig(12, vec![rigs::ragged("one", 12)]);
    let sway = super::swaying(6, 2.0);
    [
        ("figure", figure()),
        ("curved", curved()),
        ("ragged", model_of(&rig).0),
        ("swaying", model_of(&sway).0),
    ]
}

#[test]
fn a_closed_loop_has_no_gap_and_begins_as_before() {
    for (name, model) in models() {
        for secs in [0.1, 0.4, 0.6] {
            let closed = edit(&model, &close(secs)).model;
            for (index, clip) in model.clips.iter().enumerate() {
                let (travel, turn) = gap(&closed, index);
                assert!(
                    travel <= 1e-5 * size(&model) && turn < 0.05,
                    "{name} {secs} s: {travel}, {turn}°"
                );
                let new = &closed.clips[index];
                assert_eq!((new.start_secs, new.end_secs), (clip.start_secs, clip.end_secs));
                let until_secs = clip.end_secs - secs;
                for time_secs in spread(clip).filter(|time_secs| *time_secs <= until_secs) {
                    let off = apart(
                        &seen(&model, index, time_secs).positions,
                        &seen(&closed, index, time_secs).positions,
                    );
                    assert!(off <= 5e-5 * size(&model), "{name} at {time_secs} s: {off}");
                }
            }
        }
    }
}

#[test]
fn no_key_jumps_where_the_loop_is_closed() {
    let (_, model) = models().into_iter().nth(3).expect("the swaying one");
    let closed = edit(&model, &close(1.0)).model;
    let clip = &closed.clips[0];
    let most_step = |model: &Model| {
        let times: Vec<f32> = (0..=200)
            .map(|step| clip.duration_secs() * step as f32 / 200.0)
            .collect();
        let poses: Vec<_> = times.iter().map(|secs| seen(model, 0, *secs).positions).collect();
        poses
            .windows(2)
            .map(|pair| apart(&pair[0], &pair[1]))
            .fold(0.0, f32::max)
    };
    // The way back is added to the motion, over a second.
    assert!(most_step(&closed) < 2.0 * most_step(&model));
}

#[test]
fn a_loop_that_is_closed_already_is_no_change() {
    let (model, _) = model_of(&rigs::rig(3, vec![rigs::single("one", 3)]));
    assert_eq!(edit(&model, &close(0.1)).changes, [], "a clip without length");
    let once = edit(&curved(), &close(0.5)).model;
    assert_eq!(edit(&once, &close(0.5)).changes, []);
}

#[test]
fn keys_stay_in_order_and_apart() {
    for (name, model) in models() {
        for clip in &edit(&model, &close(0.37)).model.clips {
            let times = key_times(clip);
            assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{name}");
            assert!(times.len() < 1_000, "{name}: {} times", times.len());
        }
    }
}

#[test]
fn more_seconds_than_there_are_are_refused() {
    for secs in [0.0, -1.0, 2.5, f32::NAN] {
        let refused = try_edit(&curved(), &close(secs)).expect_err("no such end");
        let sentence = format!("its end cannot be eased over {secs} s.");
        assert!(refused.to_string().ends_with(&sentence), "{refused}");
    }
}
