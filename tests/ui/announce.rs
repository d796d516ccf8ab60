//! Sentences for screen readers: what has changed and is seen on the canvas alone.

use bindpose::anim::SkinView;
use bindpose::model::JointIndex;
use bindpose::scene::{Light, Overlay, ViewMode};
use bindpose::session::{
    CameraCommand, CrowdCommand, File, FileCommand, JointCommand, LookCommand, PlayCommand, Session, SubmeshCommand,
};
use bindpose::ui::{Announcement, Request, UiState, view_in_words};

const SKINNED: &[u8] = include_bytes!("../fixtures/good/d3d12_skinned.m3d");

fn open() -> (Session, UiState) {
    let mut session = Session::new(true);
    session.apply(FileCommand::Add(vec![File::new("arm.m3d", SKINNED)]));
    let mut announcer = UiState::default();
    told(&mut announcer, &session);
    (session, announcer)
}

fn told(announcer: &mut UiState, session: &Session) -> Vec<(String, bool)> {
    announcer.announce(session);
    let told = announcer
        .take_requests()
        .into_iter()
        .filter_map(|request| match request {
            Request::Announce(Announcement { text, assertive }) => Some((text, assertive)),
            _ => None,
        });
    told.collect()
}

#[track_caller]
fn assert_says(announcer: &mut UiState, session: &Session, text: &str) {
    assert_eq!(told(announcer, session), [(text.to_owned(), false)]);
    assert_eq!(told(announcer, session), [], "once");
}

#[test]
fn an_opened_model_is_told_with_its_counts_and_findings() {
    let mut announcer = UiState::default();
    let mut session = Session::new(true);
    assert_eq!(told(&mut announcer, &session), []);
    session.apply(FileCommand::Add(vec![File::new("arm.m3d", SKINNED)]));
    let [(text, false)] = &told(&mut announcer, &session)[..] else {
        panic!("one polite sentence");
    };
    assert!(
        text.starts_with("arm.m3d is open: ") && text.contains(" clip") && text.contains("finding"),
        "{text}"
    );
    assert_eq!(told(&mut announcer, &session), [], "once");
}

#[test]
fn a_failure_interrupts_and_says_what_stays() {
    let (mut session, mut announcer) = open();
    session.apply(FileCommand::Add(vec![File::new(
        "bad.m3d",
        *b"m3d-File-Header\n#Materials x\n",
    )]));
    let [(text, true)] = &told(&mut announcer, &session)[..] else {
        panic!("one that interrupts");
    };
    assert!(
        text.starts_with("bad.m3d was not opened: ") && text.ends_with(" arm.m3d stays open."),
        "{text}"
    );
    session.apply(FileCommand::DismissError);
    assert_eq!(told(&mut announcer, &session), []);
}

#[test]
fn view_mode_and_light_are_told_by_their_labels() {
    let (mut session, mut announcer) = open();
    session.apply(LookCommand::SetViewMode(ViewMode::Depth));
    session.apply(LookCommand::SetLight(Light::Book));
    let text = format!(
        "View mode: {}. Light: {}.",
        ViewMode::Depth.label(),
        Light::Book.label()
    );
    assert_says(&mut announcer, &session, &text);
    session.apply(LookCommand::SetSplit(Some(0.5)));
    assert_says(&mut announcer, &session, "Two lights, side by side.");
}

#[test]
fn what_is_selected_is_told_and_that_nothing_is() {
    let (mut session, mut announcer) = open();
    session.apply(JointCommand::Select(Some(JointIndex(1))));
    assert_says(&mut announcer, &session, "Bone 1.");
    session.apply(JointCommand::Select(None));
    assert_says(&mut announcer, &session, "Nothing is selected.");
    session.apply(SubmeshCommand::Select(Some(0)));
    let name = session.submesh_name(0).to_owned();
    assert_says(&mut announcer, &session, &format!("Subset {name}."));
}

#[test]
fn subsets_lines_and_the_turntable_are_told() {
    let (mut session, mut announcer) = open();
    session.apply(SubmeshCommand::SetVisible {
        submesh: 0,
        visible: false,
    });
    assert_says(&mut announcer, &session, "All subsets are hidden.");
    session.apply(SubmeshCommand::ShowAll);
    assert_says(&mut announcer, &session, "All subsets are shown.");
    session.apply(LookCommand::SetOverlay(Overlay::Wireframe, true));
    assert_says(&mut announcer, &session, "Wireframe on.");
    session.apply(CameraCommand::SetTurntable(true));
    assert_says(&mut announcer, &session, "Turntable on.");
}

#[test]
fn a_crowd_is_told_with_its_size_its_seed_and_who_is_selected() {
    let (mut session, mut announcer) = open();
    session.apply(CrowdCommand::Set { count: 100, seed: 1 });
    assert_says(&mut announcer, &session, "A crowd of 100.");
    assert!(view_in_words(&session).starts_with("arm.m3d, crowd of 100, "));
    session.apply(CrowdCommand::Select(36));
    let [(text, false)] = &told(&mut announcer, &session)[..] else {
        panic!("one polite sentence");
    };
    assert!(text.contains("Number 37 of 100."), "{text}");
    session.apply(CrowdCommand::Set { count: 100, seed: 2 });
    let [(text, false)] = &told(&mut announcer, &session)[..] else {
        panic!("one polite sentence");
    };
    assert!(text.contains("Another crowd of 100, seed 2."), "{text}");
    session.apply(CrowdCommand::Set { count: 1, seed: 2 });
    let [(text, false)] = &told(&mut announcer, &session)[..] else {
        panic!("one polite sentence");
    };
    assert!(text.contains("One model, no crowd."), "{text}");
}

#[test]
fn playing_and_steps_are_told_and_a_passing_time_is_not() {
    let (mut session, mut announcer) = open();
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    let frame = session.clip().map_or(0, |clip| clip.frame_at(0.5));
    assert_says(&mut announcer, &session, &format!("0.50 s, frame {frame}."));
    session.apply(PlayCommand::Play);
    assert_says(&mut announcer, &session, "Playing.");
    session.advance(0.1);
    assert_eq!(told(&mut announcer, &session), []);
    session.apply(PlayCommand::Pause);
    let [(text, false)] = &told(&mut announcer, &session)[..] else {
        panic!("one polite sentence");
    };
    assert!(text.starts_with("Paused at 0."), "{text}");
}

#[test]
fn what_was_said_comes_first() {
    let (session, mut announcer) = open();
    announcer.messages.say("Undone: visibility");
    assert_says(&mut announcer, &session, "Undone: visibility.");
}

#[test]
fn the_view_is_called_by_what_it_shows() {
    let (mut session, _) = open();
    let clip = session.clip().map_or(String::new(), |clip| clip.name.clone());
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    session.apply(JointCommand::Select(Some(JointIndex(1))));
    assert_eq!(
        view_in_words(&session),
        format!("arm.m3d, {clip}, 0.50 s, bone 1 selected")
    );
    session.apply(LookCommand::SetSkinView(Some(SkinView::Weight)));
    assert_eq!(
        view_in_words(&session),
        format!("arm.m3d, {clip}, 0.50 s, weights of bone 1")
    );
    assert_eq!(view_in_words(&Session::new(true)), "3D view, no model is open");
}
