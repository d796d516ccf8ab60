//! Time: playing, seeking, stepping, scrubbing, clips, speeds, loop modes, and what listeners hear of it.

use bindpose::anim::{LoopMode, WrapMode};
use bindpose::session::{CameraCommand, Command, Event, FileCommand, PlayCommand, SPEEDS, Session};

use super::models::{self, KEYS_PER_SEC, jointed, moving, still};
use super::opened;

/// Paused at the start of `Bend`, a second long.
fn paused() -> Session {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Pause);
    session.take_events();
    session
}

fn time_secs(session: &Session) -> f32 {
    session.playback().time_secs()
}

#[track_caller]
fn assert_near(actual: f32, expected: f32) {
    assert!((actual - expected).abs() < 1e-5, "{actual} instead of {expected}");
}

#[test]
fn playing_and_pausing_say_so_once() {
    let mut session = paused();
    session.apply(PlayCommand::Pause);
    assert_eq!(session.take_events(), []);
    session.apply(PlayCommand::Play);
    session.apply(PlayCommand::Play);
    session.advance(0.1);
    session.advance(0.1);
    assert_eq!(session.take_events(), [Event::Play, Event::TimeUpdate]);
    session.apply(PlayCommand::Toggle);
    assert_eq!(session.take_events(), [Event::Pause]);
    session.advance(0.1);
    assert_near(time_secs(&session), 0.2);
    assert_eq!(session.take_events(), []);
    assert_eq!(Event::TimeUpdate.name(), "timeupdate");
}

#[test]
fn toggling_backward_turns_a_forward_clip_and_pauses_a_backward_one() {
    let mut session = opened(moving("a.m3d"));
    session.advance(0.5);
    session.apply(PlayCommand::ToggleBackward);
    session.advance(0.2);
    assert_near(time_secs(&session), 0.3);
    session.apply(PlayCommand::ToggleBackward);
    assert!(!session.is_animating());
    session.apply(PlayCommand::Toggle);
    session.advance(0.1);
    assert_near(time_secs(&session), 0.4);
}

#[test]
fn seeking_stays_inside_the_clip() {
    let mut session = paused();
    session.apply(PlayCommand::SelectClip(1));
    for (wish, time) in [
        (1.0, 1.0),
        (-3.0, 0.5),
        (99.0, 2.5),
        (f32::INFINITY, 2.5),
        (f32::NEG_INFINITY, 0.5),
    ] {
        session.apply(PlayCommand::Seek { time_secs: wish });
        assert_near(time_secs(&session), time);
    }
    session.apply(PlayCommand::SeekStart);
    assert_near(time_secs(&session), 0.5);
    session.apply(PlayCommand::SeekEnd);
    assert_near(time_secs(&session), 2.5);
    session.apply(PlayCommand::Seek { time_secs: f32::NAN });
    assert_near(time_secs(&session), 2.5);
}

#[test]
fn steps_pause_and_reach_whole_frames_and_stop_at_the_ends() {
    let mut session = opened(moving("a.m3d"));
    session.advance(0.51);
    session.take_events();
    session.apply(PlayCommand::StepFrames(1));
    assert_eq!(session.take_events(), [Event::Pause, Event::TimeUpdate]);
    assert_near(time_secs(&session), 16.0 / KEYS_PER_SEC);
    session.apply(PlayCommand::StepFrames(-10));
    assert_near(time_secs(&session), 6.0 / KEYS_PER_SEC);
    for (frames, end) in [(i32::MIN, 0.0), (-1, 0.0), (i32::MAX, 1.0), (1, 1.0)] {
        session.apply(PlayCommand::StepFrames(frames));
        assert_near(time_secs(&session), end);
    }
}

/// By the demo's 0.1 radians a second, whatever the speed of the clip; never out of a turn.
#[test]
fn the_books_lights_turn_while_a_clip_plays() {
    let turn = |session: &Session| session.look().book_lights_turn_radians;
    let mut session = paused();
    session.advance(0.2);
    assert_eq!(turn(&session), 0.0, "paused");
    session.apply(PlayCommand::Play);
    session.apply(PlayCommand::SetSpeed(2.0));
    for seconds in 1..=3 {
        for _ in 0..10 {
            session.advance(0.1);
        }
        assert_near(turn(&session), 0.1 * seconds as f32);
    }
    assert_eq!(session.frame().options.book_lights_turn_radians, turn(&session));
    // 62.8 s are a whole turn.
    for _ in 0..600 {
        session.advance(0.1);
    }
    assert!(
        (turn(&session) - (6.3 - std::f32::consts::TAU)).abs() < 1e-3,
        "{}",
        turn(&session)
    );
}

#[test]
fn scrubbing_holds_the_time_and_playing_goes_on_from_there() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::BeginScrub);
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    session.advance(0.3);
    assert_near(time_secs(&session), 0.5);
    assert!(session.playback().is_playing() && !session.is_animating() && session.is_scrubbing());
    session.apply(PlayCommand::EndScrub);
    session.advance(0.3);
    assert_near(time_secs(&session), 0.8);

    session.apply(PlayCommand::Pause);
    session.apply(PlayCommand::BeginScrub);
    session.apply(PlayCommand::Seek { time_secs: 0.1 });
    session.apply(PlayCommand::EndScrub);
    session.advance(0.3);
    assert_near(time_secs(&session), 0.1);
}

#[test]
fn a_model_that_comes_while_the_time_is_held_plays() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::BeginScrub);
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    assert!(session.is_animating());
}

#[test]
fn listeners_hear_of_another_clip_range_speed_or_way_to_end_and_of_nothing_that_is_as_it_was() {
    let mut session = opened(moving("a.m3d"));
    let other_clip = vec![Event::TimeUpdate, Event::PlaybackChange];
    for (command, heard) in [
        (Command::from(PlayCommand::SetSpeed(2.0)), vec![Event::PlaybackChange]),
        (PlayCommand::SetSpeed(2.0).into(), vec![]),
        (PlayCommand::Slower.into(), vec![Event::PlaybackChange]),
        (PlayCommand::CycleLoopMode.into(), vec![Event::PlaybackChange]),
        (PlayCommand::SetLoopMode(LoopMode::PingPong).into(), vec![]),
        (
            PlayCommand::SetWrapMode(WrapMode::BookDemo).into(),
            vec![Event::PlaybackChange],
        ),
        (PlayCommand::SetRangeEnd(Some(0.5)).into(), vec![Event::PlaybackChange]),
        (PlayCommand::SetRangeEnd(Some(0.5)).into(), vec![]),
        (PlayCommand::ClearRange.into(), vec![Event::PlaybackChange]),
        (PlayCommand::SelectClip(1).into(), other_clip),
        (PlayCommand::SelectClip(1).into(), vec![]),
        (CameraCommand::Reset.into(), vec![]),
    ] {
        session.apply(command.clone());
        assert_eq!(session.take_events(), heard, "{command:?}");
    }
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    assert!(
        !session.take_events().contains(&Event::PlaybackChange),
        "that is a load"
    );
}

#[test]
fn each_loop_mode_ends_in_its_way() {
    for (mode, after_secs, time, playing) in [
        (LoopMode::Once, 1.25, 1.0, false),
        (LoopMode::Loop, 1.25, 0.25, true),
        (LoopMode::PingPong, 1.25, 0.75, true),
        (LoopMode::PingPong, 2.25, 0.25, true),
    ] {
        let mut session = opened(moving("a.m3d"));
        session.apply(PlayCommand::SetLoopMode(mode));
        session.take_events();
        session.advance(after_secs);
        assert_near(time_secs(&session), time);
        assert_eq!(session.playback().is_playing(), playing, "{mode:?}");
        let ended = if playing {
            vec![Event::TimeUpdate]
        } else {
            vec![Event::TimeUpdate, Event::Pause]
        };
        assert_eq!(session.take_events(), ended, "{mode:?}");
    }
}

#[test]
fn a_pause_on_the_way_back_goes_on_back() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::SetLoopMode(LoopMode::PingPong));
    session.advance(1.25);
    for command in [PlayCommand::Toggle, PlayCommand::Toggle] {
        session.apply(command);
    }
    session.advance(0.25);
    assert_near(time_secs(&session), 0.5);
    // Backward it turns around.
    session.apply(PlayCommand::ToggleBackward);
    session.advance(0.25);
    assert_near(time_secs(&session), 0.25);
    assert!(session.playback().is_backward());
}

#[test]
fn what_stopped_at_its_end_starts_over() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::SetLoopMode(LoopMode::Once));
    session.advance(9.0);
    session.take_events();
    let picture = session.picture_revision();
    session.apply(PlayCommand::Play);
    assert_eq!(time_secs(&session), 0.0);
    assert!(session.picture_revision() > picture);
    assert_eq!(session.take_events(), [Event::Play, Event::TimeUpdate]);
}

#[test]
fn loop_modes_come_in_turn() {
    let mut session = paused();
    for mode in [LoopMode::PingPong, LoopMode::Once, LoopMode::Loop] {
        session.apply(PlayCommand::CycleLoopMode);
        assert_eq!(session.playback().loop_mode(), mode);
    }
}

#[test]
fn speeds_go_up_and_down_by_steps_and_end_at_the_ends() {
    let mut session = paused();
    let speed = |session: &Session| session.playback().speed();
    for expected in [1.25, 1.5, 2.0, 4.0, 4.0] {
        session.apply(PlayCommand::Faster);
        assert_eq!(speed(&session), expected);
    }
    for expected in SPEEDS.iter().rev().skip(1).chain([&SPEEDS[0]]) {
        session.apply(PlayCommand::Slower);
        assert_eq!(speed(&session), *expected);
    }
    session.apply(PlayCommand::SetSpeed(0.6));
    session.apply(PlayCommand::Faster);
    assert_eq!(speed(&session), 0.75);
    session.apply(PlayCommand::SetSpeed(0.6));
    session.apply(PlayCommand::Slower);
    assert_eq!(speed(&session), 0.5);
    for odd in [f32::NAN, f32::INFINITY, 0.0, -1.0] {
        session.apply(PlayCommand::SetSpeed(odd));
        assert_eq!(speed(&session), 0.5, "{odd}");
    }
    session.apply(PlayCommand::Play);
    session.advance(0.5);
    assert_near(time_secs(&session), 0.25);
}

#[test]
fn clips_come_in_turn_around_both_ends_and_begin_at_their_start() {
    let mut session = opened(moving("a.m3d"));
    session.advance(0.7);
    for (places, clip, start_secs) in [
        (1, 1, 0.5),
        (1, 2, 0.25),
        (1, 0, 0.0),
        (-1, 2, 0.25),
        (-2, 0, 0.0),
        (7, 1, 0.5),
    ] {
        session.apply(PlayCommand::CycleClip(places));
        assert_eq!(session.clip_index(), Some(clip));
        assert_near(time_secs(&session), start_secs);
        assert!(session.playback().is_playing());
    }
    session.apply(PlayCommand::CycleClip(i32::MIN));
    session.apply(PlayCommand::SelectClip(99));
    assert!(session.clip_index().is_some_and(|clip| clip < models::CLIPS.len()));
}

#[test]
fn the_clip_on_show_is_not_begun_again() {
    let mut session = paused();
    session.apply(PlayCommand::Seek { time_secs: 0.4 });
    session.take_events();
    session.apply(PlayCommand::SelectClip(0));
    assert_near(time_secs(&session), 0.4);
    assert_eq!(session.take_events(), []);
}

#[test]
fn without_clips_there_is_no_time() {
    for file in [still("a.m3d"), jointed("a.m3d")] {
        let mut session = opened(file);
        let picture = session.picture_revision();
        for command in [
            PlayCommand::Play,
            PlayCommand::Toggle,
            PlayCommand::ToggleBackward,
            PlayCommand::Seek { time_secs: 1.0 },
            PlayCommand::StepFrames(1),
            PlayCommand::SeekEnd,
            PlayCommand::CycleClip(1),
            PlayCommand::SelectClip(0),
        ] {
            session.apply(command);
            session.advance(0.1);
        }
        assert_eq!(
            (session.clip_index(), time_secs(&session), session.is_animating()),
            (None, 0.0, false)
        );
        assert_eq!((session.take_events(), session.picture_revision()), (vec![], picture));
    }
}

#[test]
fn bones_that_never_move_leave_the_bind_pose() {
    let mut session = opened(jointed("a.m3d"));
    let frame = session.frame();
    assert_eq!(frame.palette.0, [glam::Affine3A::IDENTITY; 2]);
}

#[test]
fn a_clip_of_one_key_stands_still() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::SelectClip(2));
    assert!(!session.is_animating(), "nothing would move");
    session.advance(5.0);
    assert_near(time_secs(&session), 0.25);
    session.apply(PlayCommand::SetLoopMode(LoopMode::Once));
    session.take_events();
    session.advance(0.1);
    assert_eq!(session.take_events(), [Event::Pause]);
    session.apply(PlayCommand::SeekEnd);
    assert_near(time_secs(&session), 0.25);
    assert_eq!(session.clip().map(bindpose::model::Clip::last_frame), Some(0));
}

#[test]
fn time_stands_still_for_odd_steps() {
    let mut session = opened(moving("a.m3d"));
    session.advance(0.25);
    for dt_secs in [f32::NAN, 0.0, -1.0] {
        session.advance(dt_secs);
        assert_near(time_secs(&session), 0.25);
    }
}

#[test]
fn the_palette_follows_the_time() {
    let mut session = paused();
    let mut upper_at = |time_secs: f32| {
        session.apply(PlayCommand::Seek { time_secs });
        session.frame().palette.0[1]
    };
    let (start, later) = (upper_at(0.0), upper_at(0.2));
    assert!(start.abs_diff_eq(glam::Affine3A::IDENTITY, 1e-6));
    // Key 6: 1.2 sin(6 · 0.2).
    let angle = later.matrix3.x_axis.y.atan2(later.matrix3.x_axis.x);
    assert_near(angle, 1.2 * (1.2_f32).sin());
    assert_eq!(upper_at(0.0), start);
}
