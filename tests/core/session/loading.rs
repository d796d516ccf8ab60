//! Opening in slices, with and without a session.

use std::cell::Cell;
use std::rc::Rc;

use bindpose::model::MapSlot;
use bindpose::session::{Event, File, FileCommand, PlayCommand, Session};
use bindpose::slices::{Slices, Stage, StageProgress};
use zip::CompressionMethod;

use super::archives::zipped;
use super::maps::{mapped, picture};
use super::models::{broken, moving, still};
use super::{dropped, opened};

/// Slices that end at every place where they can.
pub(super) fn shortest() -> Slices {
    Slices::new(|| true)
}

fn path(session: &Session) -> Option<&str> {
    session.open_model().map(|open| open.file.path.as_str())
}

/// Goes on until nothing is being opened; how often.
fn end(session: &mut Session) -> usize {
    told(session).len()
}

/// What is told until nothing is being opened.
fn told(session: &mut Session) -> Vec<StageProgress> {
    let mut told = Vec::new();
    while let Some(now) = session.being_opened() {
        told.push(now.progress);
        session.advance_opening();
    }
    told
}

/// The stages that were told, each once.
fn stages(told: &[StageProgress]) -> Vec<Stage> {
    let mut stages: Vec<_> = told.iter().map(|progress| progress.stage).collect();
    stages.dedup();
    stages
}

/// Whether neither the part that is done nor the stage ever goes back.
fn assert_goes_on(told: &[StageProgress]) {
    for two in told.windows(2) {
        assert!(two[0].percent() <= two[1].percent(), "{two:?}");
        assert!(two[0].stage <= two[1].stage, "{two:?}");
    }
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
    let mut in_slices = Session::new(true);
    in_slices.open_in(&shortest());
    in_slices.apply(FileCommand::Add(files()));
    let told = told(&mut in_slices);
    assert_goes_on(&told);
    assert!(stages(&told).len() >= 6, "{:?}", stages(&told));
    assert!(in_slices.maps().image(0, MapSlot::Diffuse).is_some());

    let [in_slices, at_once] = [&in_slices, &dropped(files())].map(|session| {
        let (open, maps) = (session.open_model().expect("it is open"), session.maps());
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
fn no_progress_ever_goes_back_whatever_is_opened() {
    let mut session = Session::new(true);
    session.open_in(&shortest());
    let mut opened = |command| {
        session.apply(command);
        let told = told(&mut session);
        assert_goes_on(&told);
        assert!(session.error().is_none(), "{:?}", session.error());
        stages(&told)
    };
    // Each archive is a part of the unpacking.
    let hero = moving("hero.m3d");
    let archives = [("x.zip", &hero), ("y.zip", &picture("a.png", [255, 0, 0, 255]))];
    let archives =
        archives.map(|(name, file)| zipped(name, CompressionMethod::Stored, &[(&*file.path, &file.bytes[..])]));
    opened(FileCommand::Add(archives.into()));
    // The clips of a model that is read again are read again too; so is the file for the books, once a map less is missing.
    let clips = || vec![moving("one.m3d"), moving("two.m3d")];
    let joining = opened(FileCommand::AddClips(clips()));
    assert_eq!(joining, [Stage::Fetching, Stage::Joining]);
    let changed = |file: &File| File::new(&file.path, [&file.bytes[..], b"\n"].concat());
    let again = opened(FileCommand::Add(vec![changed(&hero)]));
    let [from, to] = [Stage::Reading, Stage::Measuring].map(|stage| again.iter().position(|&told| told == stage));
    assert_eq!(
        again[from.expect("it is read")..to.expect("it is measured")].last(),
        Some(&Stage::Joining)
    );

    let alone = moving("alone.m3d");
    opened(FileCommand::Add(vec![alone.clone()]));
    let judged = opened(FileCommand::Add(vec![alone, picture("b.png", [0, 0, 255, 255])]));
    assert!(!judged.contains(&Stage::Reading), "{judged:?}");
}

#[test]
fn an_archive_that_is_damaged_is_unpacked_once() {
    let (sound, picture) = (still("sound.m3d"), picture("a.png", [7; 4]));
    let files = [(&*sound.path, &sound.bytes[..]), (&*picture.path, &picture.bytes[..])];
    let mut bytes = zipped("drop.zip", CompressionMethod::Stored, &files).bytes.to_vec();
    let place = bytes
        .windows(4)
        .position(|window| window == b"IHDR")
        .expect("the picture's head");
    bytes[place] ^= 1;
    let mut session = Session::new(true);
    session.open_in(&shortest());
    session.apply(FileCommand::Add(vec![File::new("drop.zip", bytes)]));
    let told = told(&mut session);
    assert_goes_on(&told);
    assert_eq!(stages(&told), [Stage::Fetching, Stage::Unpacking]);
    let error = session.error().expect("it is refused");
    assert_eq!(error.diagnostic.code, "archive-unreadable");
    assert!(
        error.diagnostic.message.contains("a.png in it is damaged"),
        "{}",
        error.diagnostic.message
    );
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
    let mut session = Session::new(true);
    session.open_in(&slices);
    session.apply(FileCommand::Add(vec![moving("a.m3d")]));
    session.advance_opening();
    assert!(session.is_opening());
    assert_eq!(asked.get(), 3, "it went on until it was told to stop");
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
