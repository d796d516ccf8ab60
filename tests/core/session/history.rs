//! Undo and redo.

use bindpose::anim::WrapMode;
use bindpose::model::{Handedness, JointIndex, UpAxis};
use bindpose::session::{
    CameraCommand, Command, Event, File, FileCommand, HistoryCommand, JointCommand, LookCommand, MaterialCommand,
    NameCommand, PlayCommand, Session, SubmeshCommand,
};
use proptest::prelude::*;

use super::loading::shortest;
use super::models::{self, jointed, moving, still};
use super::opened;
use super::random::{command, number};
use super::submeshes::parted;
use crate::documents::key;
use crate::rigs;

use HistoryCommand::{BeginEdit, EndEdit, Redo, Undo};

pub(super) fn three_parts(path: &str) -> File {
    models::file(path, &parted(models::skinned(&models::CLIPS)))
}

fn hide(submesh: usize) -> Command {
    let visible = false;
    SubmeshCommand::SetVisible { submesh, visible }.into()
}

fn paint(session: &Session, index: usize, red: f32) -> Command {
    let mut material = Box::new(session.materials()[index].clone());
    material.diffuse[0] = red;
    MaterialCommand::Edit { index, material }.into()
}

fn name(joint: u32, name: &str) -> Command {
    let (joint, name) = (JointIndex(joint), name.to_owned());
    NameCommand::Rename { joint, name }.into()
}

/// All that can be undone, in words. The clip counts only with a range of it.
fn kept(session: &Session) -> String {
    let open = session.open_model();
    let clips: Vec<_> = open.iter().flat_map(|open| open.clip_list()).collect();
    let compiled: Vec<_> = open
        .iter()
        .flat_map(|open| &open.compiled)
        .map(|clip| clip.end_secs())
        .collect();
    let diagnostics: Vec<_> = session
        .diagnostics()
        .map(|diagnostic| (&diagnostic.message, diagnostic.subject))
        .collect();
    let submeshes = session.submeshes();
    let hidden: Vec<bool> = (0..submeshes.count())
        .map(|submesh| submeshes.is_hidden(submesh))
        .collect();
    let playback = session.playback();
    format!(
        "{clips:?}\n{compiled:?}\n{diagnostics:?}\n{:?}\n{:?}\n{:?}\n{:?}\n{hidden:?} {:?} {:?}\n{:?}",
        session.sky_file().map(|file| &file.path),
        session.materials(),
        session.joint_names(),
        playback
            .range_secs()
            .map(|range_secs| (session.clip_index(), range_secs)),
        submeshes.solo(),
        submeshes.left_out(),
        (
            playback.wrap_mode(),
            session.handedness_override(),
            session.up_axis_override(),
            session.look().normal_green_flipped,
        )
    )
}

fn undo_all(session: &mut Session) -> usize {
    let mut steps = 0;
    while session.history().undo_label().is_some() {
        session.apply(Undo);
        steps += 1;
    }
    steps
}

#[test]
fn each_kind_of_edit_is_a_step_with_its_words() {
    let mut session = opened(three_parts("a.m3d"));
    let extra = models::file("more.m3d", &parted(models::skinned(&[("Walk", 0.0, 9)])));
    let painted = paint(&session, 1, 0.25);
    #[rustfmt::skip]
    let edits: [(Command, &str); 19] = [
        (hide(1), "hide Y"),
        (SubmeshCommand::SetVisible { submesh: 1, visible: true }.into(), "show Y"),
        (SubmeshCommand::Solo(2).into(), "show Z alone"),
        (SubmeshCommand::ShowAll.into(), "show all subsets"),
        (painted, "edit Y"),
        (MaterialCommand::Reset(1).into(), "reset Y"),
        (name(1, "Arm"), "name bone 1 Arm"),
        (name(1, "Hand"), "name bone 1 Hand"),
        (name(1, ""), "remove the name of bone 1"),
        (PlayCommand::SetRangeStart(Some(0.25)).into(), "set the range"),
        (PlayCommand::SetRangeEnd(Some(0.5)).into(), "set the range"),
        (PlayCommand::SelectClip(1).into(), "clear the range"),
        (PlayCommand::SetWrapMode(WrapMode::BookDemo).into(), "loop: As the book's demo"),
        (Command::SetHandedness(Some(Handedness::Right)), "set the handedness"),
        (Command::SetUpAxis(Some(UpAxis::Z)), "set the up axis"),
        (LookCommand::SetNormalGreenFlipped(true).into(), "flip green of normal maps"),
        (FileCommand::AddClips(vec![extra.clone()]).into(), "add clip Walk"),
        (
            FileCommand::AddClips(vec![models::file(
                "more.m3d",
                &parted(models::skinned(&[("Run", 0.0, 5), ("Walk", 0.0, 7)])),
            )])
            .into(),
            "replace 2 clips",
        ),
        (Command::SetHandedness(None), "set the handedness"),
    ];
    let start = kept(&session);
    let mut before = Vec::new();
    for (edit, label) in edits {
        before.push((kept(&session), label));
        session.apply(edit);
        assert_eq!(session.history().undo_label(), Some(label));
        assert_ne!(kept(&session), before[before.len() - 1].0, "{label}");
    }
    let end = kept(&session);
    for (before, label) in before.iter().rev() {
        assert_eq!(session.history().undo_label(), Some(*label));
        session.apply(Undo);
        assert_eq!(kept(&session), *before, "{label}");
        assert_eq!(session.history().redo_label(), Some(*label));
        assert_eq!(session.history().last(), Some(&*format!("Undone: {label}")));
    }
    assert_eq!((kept(&session), session.history().undo_label()), (start, None));
    for (_, label) in &before {
        session.apply(Redo);
        assert_eq!(session.history().last(), Some(&*format!("Redone: {label}")));
    }
    assert_eq!((kept(&session), session.history().redo_label()), (end, None));
}

#[test]
fn playing_camera_selection_and_look_are_no_steps() {
    let mut session = opened(three_parts("a.m3d"));
    let commands: [Command; 8] = [
        PlayCommand::Toggle.into(),
        PlayCommand::Seek { time_secs: 0.3 }.into(),
        PlayCommand::SelectClip(1).into(),
        PlayCommand::SetSpeed(2.0).into(),
        CameraCommand::Reset.into(),
        SubmeshCommand::Select(Some(1)).into(),
        JointCommand::Select(Some(JointIndex(1))).into(),
        LookCommand::CycleViewMode(1).into(),
    ];
    for command in commands {
        session.apply(command.clone());
        assert_eq!(session.history().undo_label(), None, "{command:?}");
    }
    // What changes nothing is no step either.
    session.apply(SubmeshCommand::ShowAll);
    session.apply(MaterialCommand::Reset(0));
    session.apply(hide(99));
    assert_eq!(session.history().undo_label(), None);
    let revision = session.history().revision();
    session.apply(Undo);
    session.apply(Redo);
    assert_eq!(
        (session.history().last(), session.history().revision()),
        (None, revision)
    );
}

#[test]
fn undoing_tells_all_that_changed_at_once() {
    let mut session = opened(three_parts("a.m3d"));
    session.apply(paint(&session, 0, 0.75));
    session.apply(name(0, "Root"));
    let names = session.joint_names_revision();
    let changes = session.apply(Undo);
    assert!(changes.names && changes.picture && !changes.materials, "{changes:?}");
    assert!(session.joint_names_revision() > names, "the browser's store follows");
    let changes = session.apply(Undo);
    assert!(changes.materials && changes.picture && !changes.names, "{changes:?}");
    session.take_events();
    session.apply(PlayCommand::SetRangeEnd(Some(0.5)));
    session.apply(Undo);
    assert_eq!(session.take_events(), [Event::PlaybackChange]);
}

#[test]
fn a_new_edit_forgets_what_was_undone() {
    let mut session = opened(three_parts("a.m3d"));
    session.apply(hide(0));
    session.apply(Undo);
    assert_eq!(session.history().redo_label(), Some("hide X"));
    session.apply(hide(1));
    assert_eq!((session.history().redo_label(), session.history().last()), (None, None));
    session.apply(Redo);
    assert!(session.submeshes().is_visible(0) && !session.submeshes().is_visible(1));
}

#[test]
fn a_drag_is_one_step_for_each_thing_that_it_changed() {
    let mut session = opened(three_parts("a.m3d"));
    let start = kept(&session);
    session.apply(BeginEdit);
    for red in [0.1, 0.2, 0.3] {
        session.apply(paint(&session, 0, red));
    }
    session.apply(EndEdit);
    let dragged = kept(&session);
    session.apply(BeginEdit);
    for red in [0.4, 0.5] {
        session.apply(paint(&session, 0, red));
    }
    session.apply(paint(&session, 1, 0.5));
    session.apply(EndEdit);
    session.apply(Undo);
    session.apply(Undo);
    assert_eq!(kept(&session), dragged);
    session.apply(Undo);
    assert_eq!((kept(&session), session.history().undo_label()), (start, None));
    session.apply(Redo);
    assert_eq!(kept(&session), dragged);
}

#[test]
fn without_a_hold_each_change_is_a_step() {
    let mut session = opened(three_parts("a.m3d"));
    for end_secs in [0.25, 0.5, 0.75] {
        session.apply(PlayCommand::SetRangeEnd(Some(end_secs)));
    }
    assert_eq!(undo_all(&mut session), 3);
}

#[test]
fn a_drag_that_comes_back_leaves_no_step() {
    let mut session = opened(three_parts("a.m3d"));
    let was = session.materials()[0].diffuse[0];
    session.apply(hide(2));
    session.apply(BeginEdit);
    session.apply(paint(&session, 0, 0.1));
    session.apply(paint(&session, 0, was));
    session.apply(EndEdit);
    assert_eq!(session.history().undo_label(), Some("hide Z"));
}

#[test]
fn an_undo_within_a_hold_ends_its_step() {
    let mut session = opened(three_parts("a.m3d"));
    session.apply(BeginEdit);
    session.apply(paint(&session, 0, 0.1));
    session.apply(Undo);
    session.apply(paint(&session, 0, 0.2));
    session.apply(paint(&session, 0, 0.3));
    session.apply(EndEdit);
    assert_eq!(undo_all(&mut session), 1);
    assert!(!session.is_edited(0));
}

#[test]
fn steps_last_while_the_same_file_is_read_again_and_its_parts_fit() {
    let mut session = opened(three_parts("a.m3d"));
    session.apply(hide(1));
    session.apply(FileCommand::Add(vec![three_parts("a.m3d")]));
    assert_eq!(session.history().undo_label(), Some("hide Y"));
    session.apply(Undo);
    assert!(session.submeshes().is_visible(1));

    session.apply(Redo);
    session.apply(FileCommand::Add(vec![moving("a.m3d")]));
    assert_eq!(session.history().undo_label(), None, "it has one subset now");

    session.apply(name(0, "Root"));
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    assert_eq!(session.history().undo_label(), None, "it is another file");

    session.apply(name(0, "Root"));
    session.start_over(false);
    assert_eq!(session.history().undo_label(), None);
}

#[test]
fn names_that_were_kept_elsewhere_are_no_step() {
    let mut session = opened(moving("a.m3d"));
    session.apply(name(1, "Arm"));
    let saved = session.saved_joint_names().expect("open");
    session.apply(Undo);
    session.apply(NameCommand::Import(saved));
    assert_eq!(session.joint_name(JointIndex(1)), Some("Arm"));
    assert_eq!(session.history().undo_label(), None);
}

#[test]
fn clips_that_were_added_to_a_model_without_clips_go_and_come_back() {
    let mut session = opened(jointed("a.m3d"));
    let start = kept(&session);
    // As on the page.
    session.open_in(&shortest());
    session.apply(FileCommand::AddClips(vec![moving("walk.m3d")]));
    while session.is_opening() {
        session.advance_opening();
    }
    assert_eq!(session.history().undo_label(), Some("add 3 clips"));
    session.advance(0.5);
    assert!(session.playback().is_playing());
    let added = kept(&session);
    session.take_events();

    session.apply(Undo);
    assert_eq!((kept(&session), session.clip_index()), (start, None));
    assert!(!session.is_animating());
    let events = session.take_events();
    assert!(
        events.contains(&Event::Pause) && events.contains(&Event::PlaybackChange),
        "{events:?}"
    );

    session.apply(Redo);
    assert_eq!((kept(&session), session.clip_index()), (added, Some(0)));
    assert!(session.is_animating());
}

#[test]
fn clips_that_were_replaced_come_back_with_their_keys_and_pose() {
    let walk = |angle: f32| {
        let mut clip = rigs::even("walk", 12, 0.0, 5, 4.0);
        for bone in &mut clip.bones {
            for keyframe in &mut bone.keyframes {
                *keyframe = crate::documents::turned(key(keyframe.time_secs, keyframe.translation), angle);
            }
        }
        models::file("walk.m3d", &rigs::rig(12, vec![clip]))
    };
    let idle = rigs::rig(12, vec![rigs::even("idle", 12, 0.0, 5, 4.0)]);
    let mut session = opened(models::file("hero.m3d", &idle));
    session.apply(FileCommand::AddClips(vec![walk(0.1)]));
    session.apply(PlayCommand::Pause);
    session.apply(PlayCommand::SelectClip(1));
    let pose = |session: &mut Session| format!("{:?}", session.frame().palette);
    let slight = pose(&mut session);
    session.apply(FileCommand::AddClips(vec![walk(0.9)]));
    let wide = pose(&mut session);
    assert_ne!(wide, slight);
    let clips = session.clips_revision();
    session.apply(Undo);
    assert_eq!(pose(&mut session), slight);
    assert!(session.clips_revision() > clips);
    session.apply(Redo);
    assert_eq!(pose(&mut session), wide);
}

#[test]
fn a_range_comes_back_with_its_clip() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::SetRangeEnd(Some(1.5)));
    let range_secs = session.playback().range_secs();
    session.apply(PlayCommand::ClearRange);
    session.apply(PlayCommand::SelectClip(0));
    session.apply(Undo);
    assert_eq!(
        (session.clip_index(), session.playback().range_secs()),
        (Some(1), range_secs)
    );
    session.apply(Redo);
    assert_eq!((session.clip_index(), session.playback().range_secs()), (Some(0), None));
}

#[test]
fn long_names_are_cut_in_labels() {
    let mut session = opened(moving("a.m3d"));
    session.apply(name(0, &"x".repeat(64)));
    assert_eq!(
        session.history().undo_label(),
        Some(&*format!("name bone 0 {}…", "x".repeat(23)))
    );
}

#[test]
fn old_steps_are_forgotten() {
    let mut session = opened(three_parts("a.m3d"));
    for step in 0..250 {
        session.apply(paint(&session, 0, step as f32 / 250.0));
    }
    assert_eq!(undo_all(&mut session), 100);
    assert!(session.is_edited(0), "the first edits stay");
}

/// Commands that open no other model and undo nothing. A range belongs to an instance, which may be gone with its crowd.
fn edit() -> impl Strategy<Value = Command> {
    command().prop_filter("it is no edit of this model", |command| {
        !matches!(
            command,
            Command::File(FileCommand::Add(_) | FileCommand::Open(_) | FileCommand::Close(_))
                | Command::Crowd(_)
                | Command::Name(NameCommand::Import(_))
                | Command::History(HistoryCommand::Undo | HistoryCommand::Redo)
        )
    })
}

proptest! {
    #![proptest_config(crate::properties::cases(256))]

    #[test]
    fn what_is_undone_is_as_before_and_what_is_redone_is_as_after(
        first in prop::sample::select(vec![three_parts("a.m3d"), moving("a.m3d"), jointed("a.m3d"), still("a.m3d")]),
        edits in prop::collection::vec((edit(), prop::option::of(number())), 1..60),
        back in 0usize..60,
    ) {
        let mut session = opened(first);
        let start = kept(&session);
        for (edit, dt_secs) in edits {
            session.apply(edit);
            dt_secs.map(|dt_secs| session.advance(dt_secs));
        }
        session.apply(EndEdit);
        let end = kept(&session);
        let steps = undo_all(&mut session);
        prop_assert_eq!(kept(&session), start.clone());
        for _ in 0..steps {
            session.apply(Redo);
        }
        prop_assert_eq!(kept(&session), end.clone());
        prop_assert_eq!(session.history().redo_label(), None);
        for _ in 0..back.min(steps) {
            session.apply(Undo);
        }
        for _ in 0..back.min(steps) {
            session.apply(Redo);
        }
        prop_assert_eq!(kept(&session), end);
        undo_all(&mut session);
        prop_assert_eq!(kept(&session), start);
    }
}

#[test]
fn an_edit_that_ends_where_it_began_leaves_what_can_be_redone() {
    let mut session = opened(three_parts("a.m3d"));
    let red = session.materials()[0].diffuse[0];
    session.apply(hide(1));
    session.apply(Undo);
    session.apply(BeginEdit);
    session.apply(paint(&session, 0, 0.125));
    assert_eq!(session.history().redo_label(), None, "it is an edit so far");
    session.apply(paint(&session, 0, red));
    session.apply(EndEdit);
    assert_eq!(
        (session.history().undo_label(), session.history().redo_label()),
        (None, Some("hide Y"))
    );
    session.apply(Redo);
    assert!(!session.submeshes().is_visible(1));
    // One that ends elsewhere does not.
    session.apply(Undo);
    session.apply(BeginEdit);
    session.apply(paint(&session, 0, 0.125));
    session.apply(EndEdit);
    assert_eq!(session.history().redo_label(), None);
}
