//! Drops, the same file again, failures.

use bindpose::anim::LoopMode;
use bindpose::model::Handedness;
use bindpose::scene::{FrameCost, Pass, ViewPreset};
use bindpose::session::{
    CameraCommand, Command, Event, File, FileCommand, News, PassChoice, PlayCommand, QualityCommand, Session,
};
use glam::Vec2;

use super::models::{self, broken, jointed, moving, still};
use super::{dropped, opened, orbit};

fn picture(path: &str) -> File {
    File::new(path, *b"not looked at")
}

fn open_path(session: &Session) -> Option<&str> {
    Some(session.open_model()?.file.path.as_str())
}

#[test]
fn a_new_model_plays_its_first_clip_around_and_around() {
    let mut session = Session::new(false);
    let changes = session.apply(FileCommand::Add(vec![moving("a.m3d")]));
    assert!(changes.model);
    assert_eq!(session.take_events(), [Event::Load, Event::Play, Event::TimeUpdate]);
    let playback = session.playback();
    assert_eq!(
        (playback.time_secs(), playback.speed(), playback.loop_mode()),
        (0.0, 1.0, LoopMode::Loop)
    );
    assert_eq!(session.clip().map(|clip| clip.name.as_str()), Some("Bend"));
    assert!(session.is_animating());
}

#[test]
fn under_reduced_motion_it_waits_on_the_first_frame() {
    let mut session = Session::new(true);
    session.apply(FileCommand::Add(vec![moving("a.m3d")]));
    assert_eq!(session.take_events(), [Event::Load, Event::TimeUpdate]);
    session.advance(0.5);
    assert!(!session.is_animating());
    assert_eq!(session.playback().time_secs(), 0.0);
    session.apply(PlayCommand::Play);
    session.advance(0.5);
    assert_eq!(session.playback().time_secs(), 0.5);
}

#[test]
fn the_same_file_again_keeps_camera_clip_time_and_playing() {
    for playing in [false, true] {
        let mut session = opened(moving("drop/a.m3d"));
        session.apply(PlayCommand::SelectClip(1));
        session.apply(PlayCommand::Seek { time_secs: 1.25 });
        session.apply(PlayCommand::SetSpeed(0.5));
        session.apply(PlayCommand::SetLoopMode(LoopMode::PingPong));
        session.apply(Command::SetHandedness(Some(Handedness::Right)));
        session.apply(orbit(1.0, 0.2));
        session.apply(CameraCommand::Pan {
            drag: Vec2::new(0.1, 0.2),
        });
        session.apply(if playing { PlayCommand::Play } else { PlayCommand::Pause });
        session.take_events();
        let (camera, playback) = (*session.camera(), session.playback().clone());
        let revision = session.model_revision();

        // Found by its name: the folder may be another one.
        let changes = session.apply(FileCommand::Add(vec![moving("a.m3d")]));
        assert!(changes.model && session.model_revision() > revision);
        assert_eq!(session.camera(), &camera);
        assert_eq!(session.playback(), &playback);
        assert_eq!(session.clip_index(), Some(1));
        assert_eq!(session.handedness_override(), Some(Handedness::Right));
        assert_eq!(session.take_events(), [Event::Load, Event::TimeUpdate]);
    }
}

#[test]
fn the_same_file_with_its_clips_in_another_order_keeps_the_clip_by_name() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::SelectClip(1));
    let turned: Vec<_> = models::CLIPS.iter().rev().copied().collect();
    session.apply(FileCommand::Add(vec![models::file("a.m3d", &models::skinned(&turned))]));
    assert_eq!(session.clip().map(|clip| clip.name.as_str()), Some("Turn"));
}

#[test]
fn the_same_file_with_a_shorter_clip_keeps_the_time_inside_it() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Seek { time_secs: 0.9 });
    session.apply(FileCommand::Add(vec![models::file(
        "a.m3d",
        &models::skinned(&[("Bend", 0.0, 16)]),
    )]));
    assert_eq!(session.playback().time_secs(), 0.5);
}

#[test]
fn the_same_file_without_its_clips_stops() {
    let mut session = opened(moving("a.m3d"));
    session.apply(FileCommand::Add(vec![jointed("a.m3d")]));
    assert_eq!((session.clip_index(), session.playback().is_playing()), (None, false));
    assert_eq!(session.playback().time_secs(), 0.0);
    assert_eq!(session.take_events(), [Event::Load, Event::Pause, Event::TimeUpdate]);
}

#[test]
fn another_file_starts_anew() {
    let mut session = opened(moving("a.m3d"));
    let framed = *session.camera();
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::SetSpeed(4.0));
    session.apply(PlayCommand::SetLoopMode(LoopMode::Once));
    session.apply(Command::SetHandedness(Some(Handedness::Right)));
    session.apply(CameraCommand::LookFrom(ViewPreset::Top));
    session.apply(PlayCommand::Pause);
    session.take_events();
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    assert_eq!(session.camera(), &framed);
    assert_eq!((session.clip_index(), session.handedness_override()), (Some(0), None));
    let playback = session.playback();
    assert_eq!(
        (playback.speed(), playback.loop_mode(), playback.time_secs()),
        (1.0, LoopMode::Loop, 0.0)
    );
    assert_eq!(session.take_events(), [Event::Load, Event::Play, Event::TimeUpdate]);
}

#[test]
fn a_failed_load_keeps_the_model_and_says_why() {
    let mut session = opened(moving("a.m3d"));
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    session.take_events();
    let (revision, picture) = (session.model_revision(), session.picture_revision());
    let changes = session.apply(FileCommand::Add(vec![broken("in/b.m3d")]));
    assert!(!changes.model);
    assert_eq!(session.take_events(), [Event::Error]);
    assert_eq!(
        (session.model_revision(), session.picture_revision()),
        (revision, picture)
    );
    assert_eq!(open_path(&session), Some("a.m3d"));
    assert_eq!(session.playback().time_secs(), 0.5);
    assert!(session.is_animating());

    let error = session.error().expect("it is broken");
    assert_eq!(error.file_name, "b.m3d");
    let at = error.diagnostic.position.expect("broken somewhere");
    let place = format!("b.m3d:{}:{}: error[{}]: ", at.line, at.column, error.diagnostic.code);
    assert!(error.to_text().starts_with(&place), "{}", error.to_text());
    let excerpt = error.excerpt.as_ref().expect("it has a place");
    assert_eq!(excerpt.lines.last().map(|(line, _)| *line), Some(at.line));

    session.advance(3.0);
    assert!(session.error().is_some(), "it waits until somebody has read it");
    session.apply(FileCommand::DismissError);
    assert_eq!(session.error(), None);
}

#[test]
fn the_next_success_takes_the_error_away_and_the_next_failure_replaces_it() {
    let mut session = dropped(vec![broken("a.m3d")]);
    session.apply(FileCommand::Add(vec![File::new("b.m3d", *b"")]));
    assert_eq!(session.error().map(|error| error.diagnostic.code), Some("empty-file"));
    session.apply(FileCommand::Add(vec![still("c.m3d")]));
    assert_eq!(session.error(), None);
}

#[test]
fn the_largest_of_a_drop_opens_and_the_rest_can_be_opened() {
    let mut session = Session::new(false);
    let files = vec![
        still("x/small.m3d"),
        moving("x/large.m3d"),
        picture("x/skin.dds"),
        jointed("x/middle.m3d"),
    ];
    session.apply(FileCommand::Add(files));
    assert_eq!(open_path(&session), Some("x/large.m3d"));
    let listed = |session: &Session| {
        session
            .files()
            .models()
            .iter()
            .map(|file| file.path.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(listed(&session), ["x/large.m3d", "x/middle.m3d", "x/small.m3d"]);

    assert!(session.apply(FileCommand::Open("x/small.m3d".to_owned())).model);
    assert_eq!(open_path(&session), Some("x/small.m3d"));
    assert_eq!(listed(&session).len(), 3);

    let revision = session.model_revision();
    assert!(!session.apply(FileCommand::Open("x/none.m3d".to_owned())).model);
    assert_eq!((session.model_revision(), session.error()), (revision, None));
}

#[test]
fn the_same_drop_again_opens_the_model_that_was_chosen_of_it() {
    let drop = || vec![still("x/small.m3d"), moving("x/large.m3d")];
    let mut session = dropped(drop());
    session.apply(FileCommand::Open("x/small.m3d".to_owned()));
    let mut with_a_map = drop();
    with_a_map.push(picture("skin.png"));
    session.apply(FileCommand::Add(with_a_map));
    assert_eq!(open_path(&session), Some("x/small.m3d"));

    let mut others = drop();
    others.push(still("x/third.m3d"));
    session.apply(FileCommand::Add(others));
    assert_eq!(open_path(&session), Some("x/large.m3d"), "another drop");
    session.apply(FileCommand::Open("x/small.m3d".to_owned()));
    session.apply(FileCommand::Add(vec![still("y/small.m3d"), moving("y/large.m3d")]));
    assert_eq!(open_path(&session), Some("y/large.m3d"), "of another folder");
}

fn listed(session: &Session) -> Vec<&str> {
    session.models().iter().map(|file| file.path.as_str()).collect()
}

#[test]
fn every_model_that_came_stays_listed_in_the_order_of_opening_and_can_be_opened_again() {
    let mut session = opened(still("z.m3d"));
    assert_eq!(listed(&session), ["z.m3d"]);
    let drop = || vec![moving("x/b.m3d"), still("x/A.m3d"), jointed("x/c.m3d")];
    session.apply(FileCommand::Add(drop()));
    let all = ["z.m3d", "x/A.m3d", "x/b.m3d", "x/c.m3d"];
    assert_eq!((open_path(&session), listed(&session)), (Some("x/b.m3d"), all.to_vec()));
    let first = session.shown_opening();
    for path in ["z.m3d", "x/c.m3d", "x/A.m3d", "z.m3d", "x/b.m3d"] {
        assert!(session.apply(FileCommand::Open(path.to_owned())).model);
        assert_eq!((open_path(&session), listed(&session)), (Some(path), all.to_vec()));
        assert_eq!(
            session.shown_opening() == first,
            path != "z.m3d",
            "{path} came with another drop"
        );
    }

    session.apply(FileCommand::Add(vec![still("a.m3d")]));
    let all = ["z.m3d", "x/A.m3d", "x/b.m3d", "x/c.m3d", "a.m3d"];
    assert_eq!(listed(&session), all, "what comes stands at the end");
    session.apply(FileCommand::Add(drop()));
    assert_eq!(listed(&session), all, "the same again stands where it stood");
    session.apply(FileCommand::Add(vec![still("d.m3d"), moving("x/b.m3d")]));
    assert_eq!(
        listed(&session),
        ["z.m3d", "x/A.m3d", "x/c.m3d", "a.m3d", "d.m3d", "x/b.m3d"],
        "none stands there twice"
    );
    let largest = |count| News::OpenedLargest("b.m3d".to_owned(), count);
    assert_eq!(
        session.take_news(),
        [largest(3), largest(2)],
        "told of each drop of several, once"
    );
}

#[test]
fn a_model_can_be_closed_and_the_one_beside_it_comes_in_its_place() {
    let mut session = opened(still("a.m3d"));
    session.apply(FileCommand::Add(vec![
        still("b.m3d"),
        moving("c.m3d"),
        picture("c.png"),
    ]));
    session.apply(FileCommand::Add(vec![still("d.m3d")]));
    let revision = session.model_revision();
    for (closed, open, still_listed, replaced, why) in [
        (
            "none.m3d",
            "d.m3d",
            "a.m3d b.m3d c.m3d d.m3d",
            0,
            "there is none of that name",
        ),
        ("a.m3d", "d.m3d", "b.m3d c.m3d d.m3d", 0, "not on screen"),
        ("d.m3d", "c.m3d", "b.m3d c.m3d", 1, "the last: the one before"),
        ("b.m3d", "c.m3d", "c.m3d", 1, "another of the same drop"),
        ("c.m3d", "c.m3d", "c.m3d", 1, "the only one stays"),
    ] {
        session.apply(FileCommand::Close(closed.to_owned()));
        assert_eq!(
            (open_path(&session), listed(&session).join(" ")),
            (Some(open), still_listed.to_owned()),
            "{why}"
        );
        assert_eq!(session.model_revision(), revision + replaced, "{why}");
    }
    assert_eq!(session.files().files().len(), 2, "with its picture");
    session.apply(FileCommand::Add(vec![still("b.m3d"), moving("c.m3d"), still("e.m3d")]));
    session.apply(FileCommand::Open("b.m3d".to_owned()));
    session.apply(FileCommand::Close("b.m3d".to_owned()));
    assert_eq!(
        (open_path(&session), listed(&session)),
        (Some("c.m3d"), vec!["c.m3d", "e.m3d"])
    );
}

#[test]
fn a_model_on_screen_stays_listed_when_the_one_in_its_place_cannot_be_read() {
    let mut session = opened(still("b.m3d"));
    session.apply(FileCommand::Add(vec![moving("large.m3d"), broken("small.m3d")]));
    session.apply(FileCommand::Close("b.m3d".to_owned()));
    session.apply(FileCommand::Close("large.m3d".to_owned()));
    assert_eq!(
        (open_path(&session), listed(&session)),
        (Some("large.m3d"), vec!["large.m3d", "small.m3d"])
    );
    assert_eq!(session.error().map(|error| &*error.file_name), Some("small.m3d"));
}

#[test]
fn the_oldest_models_are_closed_when_their_files_have_too_many_bytes() {
    // Bytes that all of them share, since they are counted for each.
    let bytes = bytes::Bytes::from(vec![0; 150 << 20]);
    let drop = |name: &str| {
        vec![
            still(&format!("{name}1.m3d")),
            still(&format!("{name}2.m3d")),
            File::sharing(&format!("{name}.bin"), bytes.clone()),
        ]
    };
    let closed = |session: &mut Session| {
        let news = session.take_news().into_iter();
        news.filter(|news| matches!(news, News::ModelsClosed(_)))
            .collect::<Vec<_>>()
    };
    let mut session = Session::new(false);
    for name in ["a", "b", "c"] {
        session.apply(FileCommand::Add(drop(name)));
    }
    assert_eq!((listed(&session).len(), closed(&mut session)), (6, vec![]));
    session.apply(FileCommand::Add(drop("d")));
    assert_eq!(
        listed(&session),
        ["b1.m3d", "b2.m3d", "c1.m3d", "c2.m3d", "d1.m3d", "d2.m3d"]
    );
    assert_eq!(closed(&mut session), [News::ModelsClosed(2)]);
    let many: Vec<_> = (0..4)
        .map(|index| File::new(&format!("{index}.bin"), bytes.clone()))
        .collect();
    session.apply(FileCommand::Add([many, vec![still("large.m3d")]].concat()));
    assert_eq!(
        listed(&session),
        ["large.m3d"],
        "the one on screen stays, whatever it needs"
    );
    assert_eq!(closed(&mut session), [News::ModelsClosed(6)]);
}

#[test]
fn what_was_too_slow_for_one_model_is_tried_again_with_the_next() {
    let mut session = opened(moving("a.m3d"));
    session.apply(QualityCommand::SetPass(Pass::Shadow, PassChoice::Off));
    for _ in 0..20 {
        session.begin_pass(1.0);
        session.frame_drawn(FrameCost::default());
    }
    let lowered = session.quality().lowered();
    assert!(lowered.is_some());
    session.apply(FileCommand::Add(vec![moving("a.m3d")]));
    assert_eq!(session.quality().lowered(), lowered, "the same again is as slow");
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    assert_eq!(session.quality().lowered(), None);
    assert_eq!(
        session.quality().choice(Pass::Shadow),
        PassChoice::Off,
        "what was chosen stays chosen"
    );
}

#[test]
fn the_list_of_a_drop_outlives_a_drop_that_failed() {
    let mut session = dropped(vec![still("small.m3d"), moving("large.m3d")]);
    session.apply(FileCommand::Add(vec![broken("bad.m3d")]));
    assert_eq!(session.files().models().len(), 2);
    session.apply(FileCommand::Add(vec![picture("a.png")]));
    assert!(session.apply(FileCommand::Open("small.m3d".to_owned())).model);
}

#[test]
fn a_drop_of_pictures_has_no_model_to_join() {
    for (files, message) in [
        (vec![picture("a.dds")], "the file is a picture."),
        (vec![picture("a.dds"), picture("b.PNG")], "the files are all pictures."),
        (
            vec![picture("a.dds"), File::new("readme.txt", *b"By somebody.")],
            "no other file begins like a model.",
        ),
    ] {
        let mut session = Session::new(false);
        assert!(!session.apply(FileCommand::Add(files)).model);
        let error = session.error().expect("nothing to open");
        assert_eq!((error.diagnostic.code, error.file_name.as_str()), ("no-model", ""));
        assert!(
            error.diagnostic.message.contains(message),
            "{}",
            error.diagnostic.message
        );
        assert!(error.to_text().contains("error[no-model]"));
    }
}

#[test]
fn a_drop_of_nothing_changes_nothing_but_says_so() {
    let mut session = opened(still("a.m3d"));
    session.apply(FileCommand::Add(Vec::new()));
    let error = session.error().expect("nothing came");
    assert_eq!(error.diagnostic.code, "no-model");
    assert!(
        !error.diagnostic.message.contains("picture"),
        "{}",
        error.diagnostic.message
    );
}
