//! What is looked at, as plain data that brings the same view back.

use bindpose::anim::GhostPlan;
use bindpose::session::{Command, FileCommand, JointCommand, PlayCommand, Session, SubmeshCommand, ViewState};
use proptest::prelude::*;

use super::models::{moving, still};
use super::random::{command, number};
use super::{dropped, opened};

/// Commands that change how a model is looked at, and not which one.
pub(super) fn looking() -> impl Strategy<Value = Command> {
    command().prop_filter("it opens another model", |command| {
        !matches!(
            command,
            Command::File(
                FileCommand::Add(_) | FileCommand::AddClips(_) | FileCommand::Open(_) | FileCommand::Close(_)
            )
        )
    })
}

fn start() -> Session {
    dropped(vec![moving("a.m3d"), still("c.m3d")])
}

fn json(state: &ViewState) -> String {
    serde_json::to_string(state).expect("plain data")
}

proptest! {
    #![proptest_config(crate::properties::cases(96))]

    #[test]
    fn a_state_that_is_restored_is_the_state_again(
        before in prop::collection::vec((looking(), prop::option::of(number())), 0..40),
        other in prop::collection::vec(looking(), 0..20),
    ) {
        let mut session = start();
        for (command, dt_secs) in before {
            session.apply(command);
            dt_secs.map(|dt_secs| session.advance(dt_secs));
        }
        let state = session.view_state();
        let text = json(&state);
        let read: ViewState = serde_json::from_str(&text).expect("what was written");
        prop_assert_eq!(&read, &state, "{}", text);

        let mut elsewhere = start();
        for command in other {
            elsewhere.apply(command);
        }
        elsewhere.apply(Command::Restore(Box::new(read)));
        prop_assert_eq!(elsewhere.view_state(), state);
    }
}

#[test]
fn a_state_that_says_little_is_the_default_and_one_that_says_nonsense_is_brought_into_range() {
    let mut session = opened(moving("a.m3d"));
    let state: ViewState = serde_json::from_str(
        r#"{"camera": {"distance": -3.0, "pitchRadians": 99.0}, "playback": {"clip": "Turn", "timeSecs": 1e9, "speed": 1000.0},
            "appearance": {"viewMode": "tangent", "exposureStops": 77.0, "trails": [1, 400], "ghosts": {"before": 2}}, "selection": {"bone": 70}}"#,
    )
    .expect("known names");
    session.apply(Command::Restore(Box::new(state)));
    let restored = session.view_state();
    assert_eq!(restored.camera.distance, ViewState::default().camera.distance);
    assert!(restored.camera.pitch_radians < 1.6);
    assert_eq!(restored.playback.clip.as_deref(), Some("Turn"));
    assert_eq!(restored.playback.time_secs, session.playback().end_secs());
    assert_eq!(restored.playback.speed, bindpose::anim::MAX_SPEED);
    assert_eq!(restored.appearance.trails, [1]);
    assert_eq!(restored.selection.bone, None);
    let ghosts = GhostPlan {
        before: 2,
        after: 0,
        step_frames: 1,
    };
    assert_eq!(restored.appearance.ghosts, Some(ghosts));
    assert!(json(&restored).contains(r#""ghosts":{"before":2,"after":0,"stepFrames":1}"#));
    assert!(restored.appearance.exposure_stops <= bindpose::session::MAX_EXPOSURE_STOPS);

    let unknown = serde_json::from_str::<ViewState>(r#"{"appearance": {"viewMode": "x-ray"}}"#);
    let words = unknown.expect_err("no such mode").to_string();
    assert!(words.contains("x-ray") && words.contains("tangent"), "{words}");
}

#[test]
fn clips_and_bones_go_by_what_a_person_calls_them() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::SelectClip(1));
    session.apply(JointCommand::Select(Some(bindpose::model::JointIndex(1))));
    session.apply(SubmeshCommand::SetVisible {
        submesh: 0,
        visible: false,
    });
    let state = session.view_state();
    assert_eq!(state.playback.clip.as_deref(), Some("Turn"));
    assert_eq!(
        (state.selection.bone, state.selection.hidden_subsets),
        (Some(1), vec![0])
    );
}
