//! Opening in slices, with and without a session.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use bindpose::model::MapSlot;
use bindpose::session::{Event, File, FileCommand, FileSet, LoadJob, PlayCommand, Session, load_job};
use bindpose::slices::{Slices, StageProgress};

use super::maps::{mapped, picture};
use super::models::{broken, moving, still};
use super::opened;

/// Slices that end at every place where they can.
fn shortest() -> Slices {
    Slices::new(|| true)
}

fn job(files: Vec<File>, slices: &Slices) -> LoadJob {
    let files = Arc::new(FileSet::new(files));
    let file = files.models().first().copied().cloned().expect("a model");
    load_job(files, file, slices)
}

fn path(session: &Session) -> Option<&str> {
    session.open_model().map(|open| open.file.path.as_str())
}

/// Goes on until nothing is being opened; how often.
fn end(session: &mut Session) -> usize {
    let mut slices = 0;
    while session.being_opened().is_some() {
        session.advance_opening();
        slices += 1;
    }
    slices
}

#[test]
fn slices_go_through_all_stages_in_their_order_and_come_to_what_one_slice_comes_to() {
    let files = || {
        vec![
            mapped("a.m3d", "a.png", "none.png"),
            picture("a.png", [255, 0, 0, 255]),
            picture("stranger.png", [0, 255, 0, 255]),
        ]
    };
    let mut job_in_slices = job(files(), &shortest());
    let mut told: Vec<StageProgress> = Vec::new();
    let loaded = loop {
        match job_in_slices.advance() {
            Some(outcome) => break outcome.expect("sound files"),
            None => told.push(job_in_slices.progress()),
        }
    };
    assert!(
        told.windows(2).all(|two| two[0].percent() <= two[1].percent()),
        "{told:?}"
    );
    assert!(told.windows(2).all(|two| two[0].stage <= two[1].stage), "{told:?}");
    let mut stages: Vec<_> = told.iter().map(|progress| progress.stage).collect();
    stages.dedup();
    assert!(stages.len() >= 6, "{stages:?}");
    assert!(loaded.maps().image(0, MapSlot::Diffuse).is_some());

    let at_once = job(files(), &Slices::ENDLESS).run().expect("sound files");
    let [in_slices, at_once] = [&loaded, &at_once].map(|loaded| {
        let (open, maps) = (loaded.model(), loaded.maps());
        let image = maps.image(0, MapSlot::Diffuse).expect("it is there");
        let levels = [0, 1].map(|level| image.to_rgba8(0, level));
        format!(
            "{:?} {:?} {:?} {levels:?} {:?} {:?}",
            open.model,
            open.diagnostics,
            open.extent(None),
            maps.checklist(),
            maps.diagnostics()
        )
    });
    assert_eq!(in_slices, at_once);
}

#[test]
fn a_slice_goes_on_as_long_as_it_may() {
    let (left, asked) = (Rc::new(Cell::new(3)), Rc::new(Cell::new(0)));
    let slices = Slices::new({
        let (left, asked) = (Rc::clone(&left), Rc::clone(&asked));
        move || {
            asked.set(asked.get() + 1);
            left.set(left.get() - 1);
            left.get() == 0
        }
    });
    let mut job = job(vec![moving("a.m3d")], &slices);
    assert!(job.advance().is_none());
    assert_eq!(asked.get(), 3, "it went on until it was told to stop");
}

#[test]
fn a_file_that_is_no_model_ends_the_job() {
    let outcome = job(vec![broken("b.m3d"), picture("a.png", [0; 4])], &Slices::ENDLESS).run();
    let error = outcome.expect_err("it cannot be read");
    assert_eq!(error.file_name, "b.m3d");
    assert!(error.excerpt.is_some());
}

#[test]
fn what_is_open_stays_until_the_next_is_whole() {
    let mut session = opened(still("small.m3d"));
    session.open_in(&shortest());
    session.confirm_uploads();
    session.take_events();
    let changes = session.apply(FileCommand::Add(vec![moving("a.m3d")]));
    assert!(!changes.model);
    let mine = session.openings();
    assert_eq!(session.being_opened().map(|now| now.name), Some("a.m3d"));
    for _ in 0..4 {
        assert!(!session.advance_opening().model);
    }
    session.apply(PlayCommand::SetSpeed(0.5));
    assert_eq!(path(&session), Some("small.m3d"));
    assert!(end(&mut session) > 5);
    assert_eq!(path(&session), Some("a.m3d"));
    assert_eq!(session.openings(), mine, "nothing overtook it");
    assert!(session.take_events().contains(&Event::Load));
    session.go_back("no memory");
    assert_eq!(path(&session), Some("small.m3d"));
    assert_eq!(session.openings(), mine, "nobody asked for this one");
}

#[test]
fn what_can_bring_a_model_overtakes_and_the_rest_waits() {
    for overtakes in [
        FileCommand::Add(vec![still("c.m3d")]),
        FileCommand::Open("small.m3d".to_owned()),
        FileCommand::Add(vec![broken("c.m3d")]),
        FileCommand::CancelOpening,
    ] {
        let mut session = opened(still("small.m3d"));
        session.open_in(&shortest());
        session.apply(FileCommand::Add(vec![moving("a.m3d")]));
        let mine = session.openings();
        session.advance_opening();
        session.apply(overtakes.clone());
        assert_ne!(session.openings(), mine, "{overtakes:?}");
        end(&mut session);
        assert_ne!(path(&session), Some("a.m3d"), "{overtakes:?}");
    }
    let mut session = opened(still("small.m3d"));
    session.open_in(&shortest());
    session.apply(FileCommand::Add(vec![moving("a.m3d")]));
    let mine = session.openings();
    session.apply(FileCommand::AddClips(vec![moving("more.m3d")]));
    session.apply(FileCommand::Add(vec![picture("a.png", [0; 4])]));
    assert_eq!(session.openings(), mine);
    end(&mut session);
    assert_eq!(path(&session), Some("a.m3d"));
    let clips = session.open_model().expect("it is open").clip_list();
    assert!(clips.into_iter().any(|clip| clip.file_name == "more.m3d"));
    assert_eq!(session.maps().pictures().len(), 1);
    assert!(session.error().is_none(), "{:?}", session.error());
}

#[test]
fn nothing_begins_anew_before_it_can_be_shown() {
    let mut session = opened(still("small.m3d"));
    session.open_in(&shortest());
    session.apply(PlayCommand::SetSpeed(0.5));
    session.begin_anew(true, vec![moving("a.m3d")]);
    session.advance_opening();
    assert_eq!(path(&session), Some("small.m3d"));
    assert!(!session.reduced_motion());
    end(&mut session);
    assert_eq!(path(&session), Some("a.m3d"));
    assert_eq!(session.models().len(), 1, "the list begins anew");
    assert_eq!(session.playback().speed(), 1.0);
    assert!(session.reduced_motion() && !session.playback().is_playing());
    session.apply(FileCommand::Add(vec![still("b.m3d")]));
    assert!(session.being_opened().is_some(), "it still opens in slices");
}

#[test]
fn a_model_is_closed_once_the_one_beside_it_is_there() {
    let mut session = opened(still("a.m3d"));
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    session.open_in(&shortest());
    session.apply(FileCommand::Close("b.m3d".to_owned()));
    assert_eq!((path(&session), session.models().len()), (Some("b.m3d"), 2));
    end(&mut session);
    assert_eq!((path(&session), session.models().len()), (Some("a.m3d"), 1));
}

#[test]
fn a_file_that_comes_again_with_the_same_bytes_is_not_read_again() {
    let mut session = opened(moving("a.m3d"));
    session.open_in(&shortest());
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    let anew = end(&mut session);
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    let again = end(&mut session);
    assert!(again * 4 < anew, "{again} of {anew} slices");
    assert_eq!(path(&session), Some("b.m3d"));
    session.apply(FileCommand::Add(vec![File::new("b.m3d", still("b.m3d").bytes)]));
    end(&mut session);
    assert_eq!(
        session.open_model().map(|open| open.model.clips.len()),
        Some(0),
        "other bytes are read"
    );
}
