//! Crossfades from clip to clip, and two clips blended.

use bindpose::anim::{CompiledClip, GhostPlan, LocalPose, LoopMode, Playback, PoseBuffers, blend, sample};
use bindpose::model::JointIndex;
use bindpose::session::{Blend, FileCommand, LookCommand, MAX_CROSSFADE_SECS, PlayCommand, Session};
use glam::Affine3A;

use super::{models, opened};
use crate::rigs::{self, JOINT_COUNTS};

/// A rig that plays the first of its clips: ragged keys; one key; nine keys from 3 s on.
fn playing(bones: u32) -> Session {
    let clips = vec![
        rigs::ragged("ragged", bones),
        rigs::single("single", bones),
        rigs::even("even", bones, 3.0, 9, 4.0),
    ];
    opened(models::file("rig.m3d", &rigs::rig(bones, clips)))
}

fn pose(session: &Session, clip: usize, time_secs: f32) -> LocalPose {
    let mut pose = LocalPose::default();
    sample(
        &CompiledClip::new(&session.open_model().expect("open").model.clips[clip]),
        time_secs,
        &mut pose,
    );
    pose
}

fn mixed(from: &LocalPose, to: &LocalPose, weight: f32) -> LocalPose {
    let mut out = LocalPose::default();
    blend(from, to, weight, &mut out);
    out
}

fn palette(session: &Session, local: LocalPose) -> Vec<Affine3A> {
    let mut buffers = PoseBuffers {
        local,
        ..PoseBuffers::default()
    };
    buffers.place(&session.open_model().expect("open").model.skeleton);
    buffers.palette.0
}

#[track_caller]
fn assert_shows(session: &mut Session, local: LocalPose) {
    let expected = palette(session, local);
    assert!(session.frame().palette.0 == expected, "another pose is on show");
}

/// Slow at both ends.
fn smooth(part: f32) -> f32 {
    part * part * (3.0 - 2.0 * part)
}

#[test]
fn without_a_crossfade_clips_change_at_once() {
    let mut session = playing(3);
    session.apply(PlayCommand::SetCrossfade(0.0));
    session.advance(0.2);
    session.apply(PlayCommand::SelectClip(2));
    assert!(!session.is_fading());
    let expected = pose(&session, 2, 3.0);
    assert_shows(&mut session, expected);
}

#[test]
fn unless_told_otherwise_a_clip_that_plays_fades_for_three_tenths_of_a_second() {
    let mut session = playing(3);
    assert_eq!(session.crossfade_secs(), 0.3);
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    session.apply(PlayCommand::SelectClip(2));
    session.advance(0.15);
    let half = mixed(&pose(&session, 0, 0.65), &pose(&session, 2, 3.15), 0.5);
    assert!(session.is_fading());
    assert_shows(&mut session, half);
    session.advance(0.16);
    assert!(!session.is_fading());
}

#[test]
fn paused_and_under_reduced_motion_another_clip_is_there_at_once() {
    let mut paused = playing(3);
    paused.apply(PlayCommand::Pause);
    let mut calm = Session::new(true);
    let file = paused.open_model().expect("open").file.clone();
    calm.apply(FileCommand::Add(vec![file]));
    calm.apply(PlayCommand::Play);
    for mut session in [paused, calm] {
        session.apply(PlayCommand::Seek { time_secs: 0.5 });
        let picture = session.picture_revision();
        session.apply(PlayCommand::SelectClip(2));
        assert!(!session.is_fading() && session.picture_revision() > picture);
        let there = pose(&session, 2, 3.0);
        assert_shows(&mut session, there);
    }
}

#[test]
fn a_crossfade_goes_from_the_old_clip_to_the_new_one_while_both_go_on() {
    for bones in JOINT_COUNTS {
        let mut session = playing(bones);
        session.apply(PlayCommand::SetCrossfade(0.5));
        session.apply(PlayCommand::Seek { time_secs: 0.5 });
        let picture = session.picture_revision();
        session.apply(PlayCommand::SelectClip(2));
        assert!(session.is_fading() && session.picture_revision() > picture);
        // The clip that was, looping on its own.
        let ragged = &session.open_model().expect("open").model.clips[0];
        let mut old = Playback::new(ragged.start_secs, ragged.end_secs);
        old.seek(0.5);
        old.play();
        let before = pose(&session, 0, old.time_secs());
        assert_shows(&mut session, before);
        for step in 1..4 {
            old.advance(0.125);
            let gone_secs = step as f32 * 0.125;
            let picture = session.picture_revision();
            session.advance(0.125);
            assert!(session.picture_revision() > picture && session.is_moving());
            let (from, to) = (pose(&session, 0, old.time_secs()), pose(&session, 2, 3.0 + gone_secs));
            assert_shows(&mut session, mixed(&from, &to, smooth(gone_secs / 0.5)));
        }
        session.advance(0.125);
        assert!(!session.is_fading());
        let after = pose(&session, 2, 3.5);
        assert_shows(&mut session, after);
    }
}

#[test]
fn a_clip_that_stands_still_is_faded_to_as_well() {
    let mut session = playing(3);
    session.apply(PlayCommand::SetCrossfade(0.5));
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    session.apply(PlayCommand::SelectClip(1));
    assert!(!session.is_animating() && session.is_moving(), "only the fade moves");
    session.advance(0.25);
    let (old, new) = (pose(&session, 0, 0.75), pose(&session, 1, 1.5));
    assert_shows(&mut session, mixed(&old, &new, 0.5));
    session.advance(1.0);
    assert!(!session.is_moving());
    assert_shows(&mut session, new);
}

#[test]
fn paused_a_fade_ends_and_the_time_stands() {
    let mut session = playing(3);
    session.apply(PlayCommand::SetCrossfade(0.5));
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    session.apply(PlayCommand::SelectClip(2));
    session.advance(0.125);
    session.apply(PlayCommand::Pause);
    session.advance(0.125);
    let (old, new) = (pose(&session, 0, 0.625), pose(&session, 2, 3.125));
    assert_shows(&mut session, mixed(&old, &new, 0.5));
    session.advance(0.25);
    assert!(!session.is_moving());
    assert_shows(&mut session, new);
    // What is paused changes at once.
    session.apply(PlayCommand::SelectClip(0));
    assert!(!session.is_fading());
}

#[test]
fn a_clip_that_ends_before_its_fade_is_seen_to_the_end_of_it() {
    let mut session = playing(3);
    session.apply(PlayCommand::SetLoopMode(LoopMode::Once));
    session.apply(PlayCommand::SetCrossfade(4.0));
    session.apply(PlayCommand::SelectClip(2));
    session.advance(2.5);
    assert!(!session.playback().is_playing() && session.is_fading());
    session.advance(1.5);
    assert!(!session.is_moving());
    let end = pose(&session, 2, 5.0);
    assert_shows(&mut session, end);
}

#[test]
fn who_asks_for_a_time_sees_that_time() {
    for command in [
        PlayCommand::Seek { time_secs: 3.25 },
        PlayCommand::SeekFrame(1.0),
        PlayCommand::StepFrames(1),
        PlayCommand::SeekStart,
    ] {
        let mut session = playing(3);
        session.apply(PlayCommand::SetCrossfade(0.5));
        session.apply(PlayCommand::SelectClip(2));
        session.advance(0.125);
        session.apply(command);
        assert!(!session.is_fading());
        let there = pose(&session, 2, session.playback().time_secs());
        assert_shows(&mut session, there);
    }
}

#[test]
fn fades_follow_each_other_without_a_jump() {
    let mut session = playing(3);
    session.apply(PlayCommand::SetCrossfade(0.5));
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    session.apply(PlayCommand::SelectClip(2));
    session.advance(0.125);
    let before = session.frame().palette.0.clone();
    session.apply(PlayCommand::SelectClip(1));
    assert!(
        session.frame().palette.0 == before,
        "the next fade begins where the last one is"
    );
    session.advance(0.125);
    let first = mixed(&pose(&session, 0, 0.75), &pose(&session, 2, 3.25), smooth(0.5));
    let both = mixed(&first, &pose(&session, 1, 1.5), smooth(0.25));
    assert_shows(&mut session, both);
    // Any number of them in a moment, and all of them end.
    for turn in 0..20 {
        session.apply(PlayCommand::SelectClip(turn % 3));
        session.advance(0.01);
    }
    session.advance(0.5);
    assert!(!session.is_fading());
}

#[test]
fn odd_lengths_of_fades_are_left_out() {
    let mut session = playing(1);
    session.apply(PlayCommand::SetCrossfade(0.25));
    for odd in [-1.0, f32::NAN, f32::INFINITY] {
        session.apply(PlayCommand::SetCrossfade(odd));
        assert_eq!(session.crossfade_secs(), 0.25, "{odd}");
    }
    session.apply(PlayCommand::SetCrossfade(1e9));
    assert_eq!(session.crossfade_secs(), MAX_CROSSFADE_SECS);
}

#[test]
fn two_clips_blend_at_the_same_fraction_of_their_lengths() {
    for bones in JOINT_COUNTS {
        let mut session = playing(bones);
        session.apply(PlayCommand::SelectClip(2));
        session.apply(PlayCommand::Pause);
        let [start_secs, end_secs] = {
            let ragged = &session.open_model().expect("open").model.clips[0];
            [ragged.start_secs, ragged.end_secs]
        };
        session.apply(PlayCommand::SetBlend { clip: 0, weight: 0.3 });
        assert_eq!(session.blend(), Some(Blend { clip: 0, weight: 0.3 }));
        for phase in [0.0_f32, 0.25, 0.5, 1.0] {
            session.apply(PlayCommand::Seek {
                time_secs: 3.0 + 2.0 * phase,
            });
            let other_secs = start_secs + (end_secs - start_secs) * phase;
            let (shown, other) = (pose(&session, 2, 3.0 + 2.0 * phase), pose(&session, 0, other_secs));
            let expected = palette(&session, mixed(&shown, &other, 0.3));
            let near = |(a, b): (&Affine3A, &Affine3A)| a.abs_diff_eq(*b, 1e-3);
            // The other clip's time is rounded once more here.
            assert!(
                session.frame().palette.0.iter().zip(&expected).all(near),
                "{bones} {phase}"
            );
        }
        session.apply(PlayCommand::SetBlend { clip: 0, weight: 0.0 });
        let shown = pose(&session, 2, 5.0);
        assert_shows(&mut session, shown.clone());
        session.apply(PlayCommand::SetBlend { clip: 0, weight: 7.0 });
        assert_eq!(session.blend().map(|blend| blend.weight), Some(1.0));
        session.apply(PlayCommand::ClearBlend);
        assert_eq!(session.blend(), None);
        assert_shows(&mut session, shown);
    }
}

#[test]
fn a_blend_needs_another_clip_that_is_there() {
    let mut session = playing(1);
    let picture = session.picture_revision();
    for (clip, weight) in [(0, 0.5), (3, 0.5), (1, f32::NAN)] {
        session.apply(PlayCommand::SetBlend { clip, weight });
        assert_eq!((session.blend(), session.picture_revision()), (None, picture));
    }
    session.apply(PlayCommand::SetBlend { clip: 2, weight: 0.5 });
    assert!(session.picture_revision() > picture);
    session.apply(PlayCommand::SelectClip(1));
    assert_eq!(
        session.blend().map(|blend| blend.clip),
        Some(2),
        "it goes on with another clip"
    );
    session.apply(PlayCommand::SelectClip(2));
    assert_eq!(session.blend(), None, "but not with itself");
    session.apply(PlayCommand::SetBlend { clip: 0, weight: 0.5 });
    let file = session.open_model().expect("open").file.clone();
    session.apply(FileCommand::Add(vec![file]));
    assert_eq!(session.blend(), None);
}

#[test]
fn the_box_holds_all_clips_in_the_pose() {
    let mut session = playing(2);
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::Pause);
    let still = session.world_bounds();
    session.apply(PlayCommand::SetBlend { clip: 2, weight: 0.5 });
    let both = session.world_bounds();
    // The first bone of the third clip wanders two units along x.
    assert!(
        both.max.x - both.min.x > still.max.x - still.min.x + 1.5,
        "{still:?} {both:?}"
    );
    session.apply(PlayCommand::ClearBlend);
    assert_eq!(session.world_bounds(), still);
}

#[test]
fn ghosts_and_trails_are_of_what_is_on_show_a_blend_too() {
    let mut session = playing(3);
    session.apply(PlayCommand::Pause);
    let plan = GhostPlan {
        before: 1,
        after: 1,
        step_frames: 1,
    };
    session.apply(LookCommand::SetGhosts(Some(plan)));
    session.apply(LookCommand::ToggleTrail(JointIndex(2)));
    let clip = session.open_model().expect("open").model.clips[0].clone();
    let (away_secs, now_secs) = (1.0 / clip.keys_per_sec, 0.5 * (clip.start_secs + clip.end_secs));
    session.apply(PlayCommand::Seek { time_secs: now_secs });
    let trail = |session: &mut Session| session.frame().seen_through.expect("lines").lines.clone();
    let alone = trail(&mut session);
    assert_eq!(
        alone.len(),
        2 * clip.last_frame() as usize,
        "a line from frame to frame"
    );

    let mut trails = Vec::new();
    for weight in [0.0, 0.5] {
        session.apply(PlayCommand::SetBlend { clip: 2, weight });
        let expected = [-away_secs, away_secs].map(|by_secs| {
            let time_secs = now_secs + by_secs;
            let part = (time_secs - clip.start_secs) / (clip.end_secs - clip.start_secs);
            let local = mixed(
                &pose(&session, 0, time_secs),
                &pose(&session, 2, 3.0 + 2.0 * part),
                weight,
            );
            palette(&session, local)
        });
        let ghosts: Vec<_> = session
            .frame()
            .ghosts
            .palettes
            .iter()
            .map(|palette| palette.0.clone())
            .collect();
        assert_eq!(ghosts.len(), 2);
        for (ghost, expected) in ghosts.iter().flatten().zip(expected.iter().flatten()) {
            assert!(
                ghost.abs_diff_eq(*expected, 1e-5),
                "blend {weight}: {ghost} instead of {expected}"
            );
        }
        trails.push(trail(&mut session));
    }
    assert!(trails[0] == alone, "a weight of nothing changes nothing");
    assert!(trails[1] != alone, "the way of the blend is another");
}
