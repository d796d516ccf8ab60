//! Times and read-outs of every loop mode, range, speed and direction; frames, keys and ranges by command.

use bindpose::anim::{Direction, LoopMode, WrapMode};
use bindpose::model::JointIndex;
use bindpose::session::{Event, FileCommand, PlayCommand, Session};

use super::{models, opened};
use crate::rigs::{self, JOINT_COUNTS};

use Direction::{Backward, Forward};

/// Paused at the start of a clip of four seconds with four keys a second: all its times are numbers that f32 has.
fn paused() -> Session {
    let clips = vec![rigs::even("four", 3, 0.0, 17, 4.0), rigs::even("late", 3, 3.0, 9, 4.0)];
    let mut session = opened(models::file("rig.m3d", &rigs::rig(3, clips)));
    session.apply(PlayCommand::Pause);
    session.take_events();
    session
}

fn time_secs(session: &Session) -> f32 {
    session.playback().time_secs()
}

const ONCE: (LoopMode, WrapMode) = (LoopMode::Once, WrapMode::Wrap);
const LOOP: (LoopMode, WrapMode) = (LoopMode::Loop, WrapMode::Wrap);
const DEMO: (LoopMode, WrapMode) = (LoopMode::Loop, WrapMode::BookDemo);
const PING: (LoopMode, WrapMode) = (LoopMode::PingPong, WrapMode::Wrap);
const ALL: [f32; 2] = [0.0, 4.0];
const PART: [f32; 2] = [1.0, 3.0];
const ON: PlayCommand = PlayCommand::Toggle;
const BACK: PlayCommand = PlayCommand::ToggleBackward;

/// Modes, range, speed and direction; the time after each of six steps of ¾ s from the clip's start; whether it plays then.
type Row = ((LoopMode, WrapMode), [f32; 2], f32, PlayCommand, [f32; 6], bool);

#[rustfmt::skip]
const TABLE: [Row; 48] = [
    (ONCE, ALL, 0.5, ON, [0.375, 0.75, 1.125, 1.5, 1.875, 2.25], true),
    (ONCE, ALL, 0.5, BACK, [3.625, 3.25, 2.875, 2.5, 2.125, 1.75], true),
    (ONCE, ALL, 1.0, ON, [0.75, 1.5, 2.25, 3.0, 3.75, 4.0], false),
    (ONCE, ALL, 1.0, BACK, [3.25, 2.5, 1.75, 1.0, 0.25, 0.0], false),
    (ONCE, ALL, 4.0, ON, [3.0, 4.0, 4.0, 4.0, 4.0, 4.0], false),
    (ONCE, ALL, 4.0, BACK, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], false),
    (ONCE, PART, 0.5, ON, [1.375, 1.75, 2.125, 2.5, 2.875, 3.0], false),
    (ONCE, PART, 0.5, BACK, [2.625, 2.25, 1.875, 1.5, 1.125, 1.0], false),
    (ONCE, PART, 1.0, ON, [1.75, 2.5, 3.0, 3.0, 3.0, 3.0], false),
    (ONCE, PART, 1.0, BACK, [2.25, 1.5, 1.0, 1.0, 1.0, 1.0], false),
    (ONCE, PART, 4.0, ON, [3.0, 3.0, 3.0, 3.0, 3.0, 3.0], false),
    (ONCE, PART, 4.0, BACK, [1.0, 1.0, 1.0, 1.0, 1.0, 1.0], false),
    (LOOP, ALL, 0.5, ON, [0.375, 0.75, 1.125, 1.5, 1.875, 2.25], true),
    (LOOP, ALL, 0.5, BACK, [3.625, 3.25, 2.875, 2.5, 2.125, 1.75], true),
    (LOOP, ALL, 1.0, ON, [0.75, 1.5, 2.25, 3.0, 3.75, 0.5], true),
    (LOOP, ALL, 1.0, BACK, [3.25, 2.5, 1.75, 1.0, 0.25, 3.5], true),
    (LOOP, ALL, 4.0, ON, [3.0, 2.0, 1.0, 4.0, 3.0, 2.0], true),
    (LOOP, ALL, 4.0, BACK, [1.0, 2.0, 3.0, 0.0, 1.0, 2.0], true),
    (LOOP, PART, 0.5, ON, [1.375, 1.75, 2.125, 2.5, 2.875, 1.25], true),
    (LOOP, PART, 0.5, BACK, [2.625, 2.25, 1.875, 1.5, 1.125, 2.75], true),
    (LOOP, PART, 1.0, ON, [1.75, 2.5, 1.25, 2.0, 2.75, 1.5], true),
    (LOOP, PART, 1.0, BACK, [2.25, 1.5, 2.75, 2.0, 1.25, 2.5], true),
    (LOOP, PART, 4.0, ON, [2.0, 1.0, 2.0, 1.0, 2.0, 1.0], true),
    (LOOP, PART, 4.0, BACK, [2.0, 3.0, 2.0, 3.0, 2.0, 3.0], true),
    (DEMO, ALL, 0.5, ON, [0.375, 0.75, 1.125, 1.5, 1.875, 2.25], true),
    (DEMO, ALL, 0.5, BACK, [4.0, 3.625, 3.25, 2.875, 2.5, 2.125], true),
    (DEMO, ALL, 1.0, ON, [0.75, 1.5, 2.25, 3.0, 3.75, 0.0], true),
    (DEMO, ALL, 1.0, BACK, [4.0, 3.25, 2.5, 1.75, 1.0, 0.25], true),
    (DEMO, ALL, 4.0, ON, [3.0, 0.0, 3.0, 0.0, 3.0, 0.0], true),
    (DEMO, ALL, 4.0, BACK, [4.0, 1.0, 4.0, 1.0, 4.0, 1.0], true),
    (DEMO, PART, 0.5, ON, [1.375, 1.75, 2.125, 2.5, 2.875, 1.0], true),
    (DEMO, PART, 0.5, BACK, [2.625, 2.25, 1.875, 1.5, 1.125, 3.0], true),
    (DEMO, PART, 1.0, ON, [1.75, 2.5, 1.0, 1.75, 2.5, 1.0], true),
    (DEMO, PART, 1.0, BACK, [2.25, 1.5, 3.0, 2.25, 1.5, 3.0], true),
    (DEMO, PART, 4.0, ON, [1.0, 1.0, 1.0, 1.0, 1.0, 1.0], true),
    (DEMO, PART, 4.0, BACK, [3.0, 3.0, 3.0, 3.0, 3.0, 3.0], true),
    (PING, ALL, 0.5, ON, [0.375, 0.75, 1.125, 1.5, 1.875, 2.25], true),
    (PING, ALL, 0.5, BACK, [0.375, 0.75, 1.125, 1.5, 1.875, 2.25], true),
    (PING, ALL, 1.0, ON, [0.75, 1.5, 2.25, 3.0, 3.75, 3.5], true),
    (PING, ALL, 1.0, BACK, [0.75, 1.5, 2.25, 3.0, 3.75, 3.5], true),
    (PING, ALL, 4.0, ON, [3.0, 2.0, 1.0, 4.0, 1.0, 2.0], true),
    (PING, ALL, 4.0, BACK, [3.0, 2.0, 1.0, 4.0, 1.0, 2.0], true),
    (PING, PART, 0.5, ON, [1.375, 1.75, 2.125, 2.5, 2.875, 2.75], true),
    (PING, PART, 0.5, BACK, [2.625, 2.25, 1.875, 1.5, 1.125, 1.25], true),
    (PING, PART, 1.0, ON, [1.75, 2.5, 2.75, 2.0, 1.25, 1.5], true),
    (PING, PART, 1.0, BACK, [2.25, 1.5, 1.25, 2.0, 2.75, 2.5], true),
    (PING, PART, 4.0, ON, [2.0, 3.0, 2.0, 1.0, 2.0, 3.0], true),
    (PING, PART, 4.0, BACK, [2.0, 1.0, 2.0, 3.0, 2.0, 1.0], true),
];

#[test]
fn every_mode_range_speed_and_direction_goes_its_way() {
    for ((loop_mode, wrap_mode), range, speed, play, times_secs, plays) in TABLE {
        let mut session = paused();
        session.apply(PlayCommand::SetLoopMode(loop_mode));
        session.apply(PlayCommand::SetWrapMode(wrap_mode));
        session.apply(PlayCommand::SetSpeed(speed));
        session.apply(PlayCommand::SetRangeStart(Some(range[0])));
        session.apply(PlayCommand::SetRangeEnd(Some(range[1])));
        assert_eq!(session.playback().played_secs(), range);
        session.apply(play);
        let row = format!("{loop_mode:?} {wrap_mode:?} {range:?} {speed} {play:?}");
        for (step, expected) in times_secs.into_iter().enumerate() {
            session.advance(0.75);
            assert_eq!(time_secs(&session), expected, "{row}, step {step}");
            let place = f64::from(expected) * 4.0;
            assert_eq!(session.frame_place(), Some(place), "{row}, step {step}");
            let frame = session.clip().map(|clip| clip.frame_at(expected));
            assert_eq!(frame, Some(place.round() as u32));
        }
        assert_eq!(session.playback().is_playing(), plays, "{row}");
        assert_eq!(session.is_animating(), plays, "{row}");
    }
}

#[test]
fn frames_are_sought_whole_and_between() {
    let mut session = paused();
    for (frame, time) in [
        (3.0, 0.75),
        (2.5, 0.625),
        (-7.0, 0.0),
        (99.0, 4.0),
        (16.0, 4.0),
        (f64::INFINITY, 4.0),
    ] {
        session.apply(PlayCommand::SeekFrame(frame));
        assert_eq!(time_secs(&session), time, "{frame}");
    }
    session.apply(PlayCommand::SeekFrame(f64::NAN));
    assert_eq!(time_secs(&session), 4.0);
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::SeekFrame(1.0));
    assert_eq!((time_secs(&session), session.frame_place()), (3.25, Some(1.0)));
}

#[test]
fn a_frame_is_its_key_however_it_was_reached() {
    for bones in JOINT_COUNTS {
        let clips = vec![rigs::even("thirds", bones, 0.1, 31, 30.0)];
        let keys_secs: Vec<f32> = clips[0].bones[0].keyframes.iter().map(|key| key.time_secs).collect();
        let mut session = opened(models::file("rig.m3d", &rigs::rig(bones, clips)));
        session.apply(PlayCommand::SeekStart);
        for (frame, key_secs) in keys_secs.iter().enumerate() {
            assert_eq!(time_secs(&session).to_bits(), key_secs.to_bits(), "{frame} by steps");
            session.apply(PlayCommand::SeekFrame(frame as f64));
            assert_eq!(
                time_secs(&session).to_bits(),
                key_secs.to_bits(),
                "{frame} by its number"
            );
            session.apply(PlayCommand::StepFrames(1));
        }
        for key_secs in keys_secs.iter().rev() {
            assert_eq!(time_secs(&session).to_bits(), key_secs.to_bits());
            session.apply(PlayCommand::StepKey {
                direction: Backward,
                joint: None,
            });
        }
    }
}

#[test]
fn keys_of_a_joint_or_of_any_are_stepped_to_and_playing_pauses() {
    let mut clips = vec![rigs::even("mixed", 3, 0.0, 5, 1.0)];
    clips[0].bones[1].keyframes.drain(1..4);
    clips[0].bones[2].keyframes.clear();
    let mut session = opened(models::file("rig.m3d", &rigs::rig(3, clips)));
    session.advance(1.5);
    session.take_events();
    session.apply(PlayCommand::StepKey {
        direction: Forward,
        joint: None,
    });
    assert_eq!(session.take_events(), [Event::Pause, Event::TimeUpdate]);
    assert_eq!(time_secs(&session), 2.0);
    for (joint, direction, time) in [
        (Some(1), Backward, 0.0),
        (Some(1), Backward, 0.0),
        (Some(0), Forward, 1.0),
        (Some(1), Forward, 4.0),
        (Some(0), Backward, 3.0),
        (Some(2), Backward, 3.0),
        (Some(9), Forward, 3.0),
        (None, Forward, 4.0),
        (None, Forward, 4.0),
    ] {
        session.apply(PlayCommand::StepKey {
            direction,
            joint: joint.map(JointIndex),
        });
        assert_eq!(time_secs(&session), time, "{joint:?} {direction:?}");
    }
    assert_eq!(session.key_times(None), [0.0, 1.0, 2.0, 3.0, 4.0]);
    assert_eq!(session.key_times(Some(JointIndex(1))), [0.0, 4.0]);
}

#[test]
fn a_range_is_set_here_or_there_and_home_and_end_are_its_ends() {
    let mut session = paused();
    session.apply(PlayCommand::SeekFrame(3.0));
    session.apply(PlayCommand::SetRangeStart(None));
    session.apply(PlayCommand::SetRangeEnd(Some(2.0)));
    assert_eq!(session.playback().range_secs(), Some([0.75, 2.0]));
    session.apply(PlayCommand::SeekEnd);
    assert_eq!(time_secs(&session), 2.0);
    session.apply(PlayCommand::SeekStart);
    assert_eq!(time_secs(&session), 0.75);
    // Steps and seeks go beyond, so that the range can be made wider.
    session.apply(PlayCommand::StepFrames(10));
    assert_eq!(time_secs(&session), 3.25);
    session.apply(PlayCommand::SetRangeEnd(None));
    assert_eq!(session.playback().range_secs(), Some([0.75, 3.25]));
    session.apply(PlayCommand::ClearRange);
    session.apply(PlayCommand::SeekEnd);
    assert_eq!((session.playback().range_secs(), time_secs(&session)), (None, 4.0));
}

#[test]
fn a_range_is_forgotten_with_its_clip_and_kept_when_the_file_comes_again() {
    let mut session = paused();
    session.apply(PlayCommand::SetRangeStart(Some(1.0)));
    session.apply(PlayCommand::SetRangeEnd(Some(3.0)));
    session.apply(PlayCommand::Seek { time_secs: 3.5 });
    let file = session.open_model().expect("open").file.clone();
    session.apply(FileCommand::Add(vec![file]));
    assert_eq!(
        (session.playback().range_secs(), time_secs(&session)),
        (Some([1.0, 3.0]), 3.5)
    );
    session.apply(PlayCommand::SelectClip(1));
    assert_eq!(session.playback().played_secs(), [3.0, 5.0]);
    session.apply(PlayCommand::SelectClip(0));
    assert_eq!(session.playback().range_secs(), None);
}

#[test]
fn scrubbing_out_of_the_range_goes_on_inside_it() {
    let mut session = paused();
    session.apply(PlayCommand::SetRangeStart(Some(1.0)));
    session.apply(PlayCommand::SetRangeEnd(Some(3.0)));
    session.apply(PlayCommand::Play);
    session.apply(PlayCommand::BeginScrub);
    session.apply(PlayCommand::Seek { time_secs: 3.75 });
    session.advance(0.5);
    assert_eq!(time_secs(&session), 3.75);
    session.apply(PlayCommand::EndScrub);
    session.advance(0.5);
    assert_eq!(time_secs(&session), 1.5);
}

#[test]
fn without_a_clip_there_is_nothing_to_go_to() {
    let mut session = opened(models::still("a.m3d"));
    for command in [
        PlayCommand::SeekFrame(1.0),
        (PlayCommand::StepKey {
            direction: Forward,
            joint: None,
        }),
        PlayCommand::SetRangeStart(None),
        PlayCommand::SetRangeEnd(Some(1.0)),
        PlayCommand::ClearRange,
    ] {
        session.apply(command);
    }
    assert_eq!((session.frame_place(), session.key_times(None)), (None, &[][..]));
    assert_eq!((time_secs(&session), session.take_events()), (0.0, vec![]));
}
