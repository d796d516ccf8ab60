//! Clips of a second file with the same bones.

use bindpose::diagnostic::{Severity, Subject};
use bindpose::format::Document;
use bindpose::session::{Event, File, FileCommand, PlayCommand, Session};

use super::{models, opened};
use crate::documents::{key, shared_bytes};
use crate::rigs::{self, JOINT_COUNTS};

fn file(path: &str, document: &Document) -> File {
    models::file(path, document)
}

fn hero() -> Session {
    opened(file(
        "hero.m3d",
        &rigs::rig(12, vec![rigs::even("idle", 12, 0.0, 5, 4.0)]),
    ))
}

fn list(session: &Session) -> Vec<(String, String)> {
    let open = session.open_model().expect("open");
    open.clip_list()
        .map(|clip| (clip.name.to_owned(), clip.file_name.to_owned()))
        .collect()
}

fn pairs(list: &[(&str, &str)]) -> Vec<(String, String)> {
    list.iter()
        .map(|&(name, file)| (name.to_owned(), file.to_owned()))
        .collect()
}

/// What is said about a file that is refused; nothing else happens.
#[track_caller]
fn assert_refused(session: &mut Session, refused: &File, code: &str, message: &str) {
    let before = (session.model_revision(), session.picture_revision(), list(session));
    session.apply(FileCommand::AddClips(vec![refused.clone()]));
    let error = session.error().expect("it is refused");
    assert_eq!(
        (error.diagnostic.code, error.diagnostic.message.as_str()),
        (code, message)
    );
    assert_eq!(error.file_name, refused.base_name());
    assert_eq!(
        (session.model_revision(), session.picture_revision(), list(session)),
        before
    );
    assert_eq!(session.take_events(), [Event::Error]);
}

#[test]
fn clips_join_with_free_names_and_their_files_and_nothing_is_uploaded_again() {
    let mut session = hero();
    session.advance(0.3);
    session.take_events();
    let (revision, maps, time_secs) = (
        session.model_revision(),
        session.maps_revision(),
        session.playback().time_secs(),
    );
    let clips = |names: &[&str]| names.iter().map(|name| rigs::ragged(name, 12)).collect::<Vec<_>>();
    let changes = session.apply(FileCommand::AddClips(vec![
        file("more/walk.m3d", &rigs::rig(12, clips(&["walk", "idle"]))),
        file("run.m3d", &rigs::rig(12, clips(&["run", "walk"]))),
    ]));
    assert!(!changes.model && session.error().is_none());
    assert_eq!((session.model_revision(), session.maps_revision()), (revision, maps));
    assert_eq!(
        (session.clip_index(), session.playback().time_secs()),
        (Some(0), time_secs)
    );
    assert_eq!(
        list(&session),
        pairs(&[
            ("idle", "hero.m3d"),
            ("walk", "walk.m3d"),
            ("idle (2)", "walk.m3d"),
            ("run", "run.m3d"),
            ("walk (2)", "run.m3d"),
        ])
    );
    assert_eq!(session.take_events(), [Event::PlaybackChange]);
    for clip in 1..5 {
        session.apply(PlayCommand::SelectClip(clip));
        session.advance(0.1);
        assert!(session.is_animating() && session.frame().palette.0.len() == 12);
        let open = session.open_model().expect("open");
        let joints = open.loop_gap(clip).map(|gap| gap.joints.len());
        assert_eq!((joints, open.activity(clip).map(<[_]>::len)), (Some(12), Some(12)));
        assert!(!open.key_times(clip, None).is_empty());
    }
}

#[test]
fn the_first_difference_is_named() {
    let mut session = hero();
    let clips = |bones| vec![rigs::even("walk", bones, 0.0, 5, 4.0)];
    assert_refused(
        &mut session,
        &file("b.m3d", &rigs::rig(13, clips(13))),
        "clips-bones-differ",
        "b.m3d has 13 bones and hero.m3d has 12; clips can only be added from a file with the same bones.",
    );
    assert_refused(
        &mut session,
        &file("one.m3d", &rigs::rig(1, clips(1))),
        "clips-bones-differ",
        "one.m3d has 1 bone and hero.m3d has 12; clips can only be added from a file with the same bones.",
    );
    let mut other = rigs::rig(12, clips(12));
    other.bone_parents[7] = 2;
    other.bone_parents[9] = 0;
    assert_refused(
        &mut session,
        &file("b.m3d", &other),
        "clips-bones-differ",
        "Bone 7 has bone 2 as its parent in b.m3d and bone 6 as its parent in hero.m3d; clips can only be added from a file \
         with the same bones.",
    );
    other.bone_parents[7] = -1;
    assert_refused(
        &mut session,
        &file("b.m3d", &other),
        "clips-bones-differ",
        "Bone 7 has no parent in b.m3d and bone 6 as its parent in hero.m3d; clips can only be added from a file with the \
         same bones.",
    );
    assert_refused(
        &mut session,
        &file("b.m3d", &rigs::rig(12, vec![])),
        "clips-none",
        "b.m3d has no clips to add.",
    );
}

#[test]
fn files_that_are_no_models_are_refused_as_ever_and_the_others_join() {
    let mut session = hero();
    let sound = file("run.m3d", &rigs::rig(12, vec![rigs::single("run", 12)]));
    session.apply(FileCommand::AddClips(vec![models::broken("bad.m3d"), sound]));
    assert_eq!(session.error().map(|error| error.file_name.as_str()), Some("bad.m3d"));
    assert_eq!(list(&session).len(), 2);
    session.apply(FileCommand::AddClips(vec![File::new("skin.dds", *b"not looked at")]));
    assert_eq!(session.error().map(|error| error.diagnostic.code), Some("no-model"));
    let sound = file("jump.m3d", &rigs::rig(12, vec![rigs::single("jump", 12)]));
    session.apply(FileCommand::AddClips(vec![sound]));
    assert_eq!(session.error(), None, "the next success takes the error away");
}

#[test]
fn other_proportions_are_noted() {
    let mut session = hero();
    let mut taller = rigs::rig(12, vec![rigs::even("walk", 12, 0.0, 5, 4.0)]);
    for (bone, nudge) in [(2, 1e-4), (5, 0.3), (11, 0.3)] {
        taller.bone_offsets[bone][13] -= nudge;
    }
    session.apply(FileCommand::AddClips(vec![file("tall.m3d", &taller)]));
    assert_eq!((session.error(), list(&session).len()), (None, 2));
    let notice = session
        .diagnostics()
        .find(|notice| notice.code == "clips-offsets-differ")
        .expect("noted");
    assert_eq!(
        (notice.severity, notice.subject),
        (Severity::Note, Some(Subject::Bone(5)))
    );
    assert_eq!(
        notice.message,
        "2 of the 12 bone offsets of tall.m3d differ from those of hero.m3d, the first that of bone 5: its clips were made for \
         other proportions."
    );
    session.apply(FileCommand::AddClips(vec![file(
        "same.m3d",
        &rigs::rig(12, vec![rigs::single("s", 12)]),
    )]));
    let notes = session
        .diagnostics()
        .filter(|notice| notice.code == "clips-offsets-differ");
    assert_eq!(notes.count(), 1);
}

#[test]
fn what_was_mended_in_a_clip_is_noted_under_its_new_number() {
    let mut session = hero();
    let mut clips = vec![rigs::even("walk", 12, 0.0, 5, 4.0)];
    clips[0].bones[3].keyframes.push(key(0.1, [0.0; 3]));
    session.apply(FileCommand::AddClips(vec![file("walk.m3d", &rigs::rig(12, clips))]));
    let notice = session
        .diagnostics()
        .find(|notice| notice.code == "keys-not-sorted")
        .expect("noted");
    assert!(
        notice.message.starts_with("walk.m3d: 1 bone has "),
        "{}",
        notice.message
    );
    assert_eq!((notice.subject, notice.position), (Some(Subject::Clip(1)), None));
}

#[test]
fn clips_come_to_a_model_that_had_none_and_play() {
    let mut session = opened(file("still.m3d", &rigs::rig(12, vec![])));
    assert_eq!(session.clip_index(), None);
    session.apply(FileCommand::AddClips(vec![file(
        "walk.m3d",
        &rigs::rig(12, vec![rigs::even("walk", 12, 3.0, 5, 4.0)]),
    )]));
    assert_eq!((session.clip_index(), session.playback().time_secs()), (Some(0), 3.0));
    assert!(session.is_animating());
    assert_eq!(
        session.take_events(),
        [Event::Play, Event::TimeUpdate, Event::PlaybackChange]
    );
}

#[test]
fn with_nothing_open_they_are_opened() {
    let mut session = Session::new(false);
    assert!(
        session
            .apply(FileCommand::AddClips(vec![models::moving("a.m3d")]))
            .model
    );
    assert_eq!(session.error(), None);
}

#[test]
fn when_the_file_comes_again_its_guests_stay_if_they_still_fit() {
    let mut session = hero();
    session.apply(FileCommand::AddClips(vec![file(
        "walk.m3d",
        &rigs::rig(12, vec![rigs::even("walk", 12, 0.0, 9, 4.0)]),
    )]));
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::Seek { time_secs: 1.5 });
    session.apply(FileCommand::Add(vec![file(
        "hero.m3d",
        &rigs::rig(12, vec![rigs::even("idle", 12, 0.0, 5, 4.0)]),
    )]));
    assert_eq!(list(&session), pairs(&[("idle", "hero.m3d"), ("walk", "walk.m3d")]));
    assert_eq!((session.clip_index(), session.playback().time_secs()), (Some(1), 1.5));

    session.apply(FileCommand::Add(vec![file(
        "hero.m3d",
        &rigs::rig(11, vec![rigs::even("idle", 11, 0.0, 5, 4.0)]),
    )]));
    assert_eq!(list(&session), pairs(&[("idle", "hero.m3d")]));
    let notice = session
        .diagnostics()
        .find(|notice| notice.code == "clips-bones-differ")
        .expect("told");
    assert_eq!(notice.severity, Severity::Warning);
    // Another file has no guests.
    session.apply(FileCommand::Add(vec![models::moving("b.m3d")]));
    assert_eq!(list(&session).len(), models::CLIPS.len());
}

#[test]
fn skeletons_of_every_size_are_compared() {
    for bones in JOINT_COUNTS {
        let mut session = opened(file("a.m3d", &rigs::rig(bones, vec![rigs::ragged("a", bones)])));
        session.apply(FileCommand::AddClips(vec![file(
            "b.m3d",
            &rigs::rig(bones, vec![rigs::single("b", bones)]),
        )]));
        assert_eq!((session.error(), list(&session).len()), (None, 2));
    }
}

#[test]
fn a_real_file_joins_itself() {
    let Some(bytes) = shared_bytes("models/d3d12/soldier.m3d") else {
        return;
    };
    let mut session = opened(File::new("soldier.m3d", bytes.clone()));
    let clips = list(&session).len();
    session.apply(FileCommand::AddClips(vec![File::new("again.m3d", bytes)]));
    assert_eq!((session.error(), list(&session).len()), (None, 2 * clips));
    assert!(
        session
            .diagnostics()
            .all(|notice| notice.code != "clips-offsets-differ")
    );
    session.apply(FileCommand::AddClips(vec![models::moving("box.m3d")]));
    assert!(session.error().is_some_and(|error| {
        error
            .diagnostic
            .message
            .starts_with("box.m3d has 2 bones and soldier.m3d has ")
    }));
}

/// A file of clips; each of a second more than the one before it, from 0 s.
fn guest(path: &str, names: &[&str], keys: u32) -> File {
    let clips = (0..)
        .zip(names)
        .map(|(index, name)| rigs::even(name, 12, 0.0, keys + 4 * index, 4.0));
    file(path, &rigs::rig(12, clips.collect()))
}

#[test]
fn a_file_that_is_added_again_replaces_its_clips_where_they_stood() {
    let mut session = hero();
    let add = |session: &mut Session, file| session.apply(FileCommand::AddClips(vec![file]));
    add(&mut session, guest("walk.m3d", &["walk", "idle"], 5));
    add(&mut session, guest("run.m3d", &["run"], 5));
    let model = (session.model_revision(), session.clips_revision());
    session.apply(PlayCommand::SelectClip(3));
    session.apply(PlayCommand::SetBlend { clip: 1, weight: 0.25 });
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    session.take_events();
    let picture = session.picture_revision();
    add(&mut session, guest("elsewhere/walk.m3d", &["walk", "trot", "idle"], 9));
    let listed = [
        ("idle", "hero.m3d"),
        ("walk", "walk.m3d"),
        ("trot", "walk.m3d"),
        ("idle (2)", "walk.m3d"),
        ("run", "run.m3d"),
    ];
    assert_eq!(list(&session), pairs(&listed));
    assert_eq!(session.model_revision(), model.0, "nothing is uploaded again");
    assert!(session.clips_revision() > model.1 && session.picture_revision() > picture);
    assert_eq!(
        (session.clip_index(), session.playback().time_secs()),
        (Some(4), 0.5),
        "the clip on show is found under its new number"
    );
    assert_eq!(session.blend().map(|blend| (blend.clip, blend.weight)), Some((1, 0.25)));
    assert!(session.is_animating());
    assert_eq!(session.take_events(), [Event::PlaybackChange]);
    let told = |session: &Session| {
        let notices = session.diagnostics().filter(|notice| notice.code == "clips-replaced");
        notices
            .map(|notice| (notice.severity, notice.subject, notice.message.clone()))
            .collect::<Vec<_>>()
    };
    let note = |message: &str| vec![(Severity::Note, Some(Subject::Clip(1)), message.to_owned())];
    assert_eq!(
        told(&session),
        note("walk.m3d was added before; its 3 clips replace the 2 clips from then.")
    );
    add(&mut session, guest("walk.m3d", &["walk"], 5));
    assert_eq!(
        told(&session),
        note("walk.m3d was added before; its 1 clip replaces the 3 clips from then."),
        "what was said of clips that are gone is gone"
    );
    // What the model's own file brought stays, and a file of another name joins.
    add(&mut session, guest("hero.m3d", &["jump"], 5));
    assert_eq!(list(&session).len(), 4);
    // They come back in their order with the model.
    let joined = list(&session);
    let own = session.open_model().expect("open").file.clone();
    session.apply(FileCommand::Add(vec![own]));
    assert_eq!(list(&session), joined);
}

#[test]
fn the_clip_on_show_goes_on_as_far_as_its_replacement_has_it() {
    for (names, keys, shown, time_secs, range_secs) in [
        // As long as before.
        (&["walk", "trot"][..], 9, 1, 1.5, Some([0.5, 1.75])),
        // Under another number.
        (&["trot", "walk"], 5, 2, 1.5, Some([0.5, 1.75])),
        // Shorter: one second.
        (&["walk"], 5, 1, 1.0, Some([0.5, 1.0])),
        // Gone: what stands in its place, from its start.
        (&["trot"], 9, 1, 0.0, None),
    ] {
        let mut session = hero();
        session.apply(FileCommand::AddClips(vec![guest("walk.m3d", &["walk"], 9)]));
        session.apply(PlayCommand::SelectClip(1));
        session.apply(PlayCommand::SetRangeStart(Some(0.5)));
        session.apply(PlayCommand::SetRangeEnd(Some(1.75)));
        session.apply(PlayCommand::Seek { time_secs: 1.5 });
        session.apply(PlayCommand::Pause);
        let before = session.frame().palette.0.clone();
        session.apply(FileCommand::AddClips(vec![guest("walk.m3d", names, keys)]));
        assert_eq!(session.clip_index(), Some(shown), "{names:?}");
        assert_eq!(session.playback().time_secs(), time_secs, "{names:?}");
        assert_eq!(session.playback().range_secs(), range_secs, "{names:?}");
        let clip = session.clip().expect("on show");
        assert_eq!(session.playback().end_secs(), clip.end_secs);
        assert!(!session.is_animating() && !session.is_fading());
        if (names, keys) == (&["walk", "trot"], 9) {
            assert!(session.frame().palette.0 == before, "the same pose");
        } else {
            assert_eq!(session.frame().palette.0.len(), before.len());
        }
    }
}

#[test]
fn findings_follow_the_clips_that_they_are_about() {
    let mut session = hero();
    let unsorted = |path: &str, name: &str| {
        let mut clip = rigs::even(name, 12, 0.0, 5, 4.0);
        clip.bones[3].keyframes.push(key(0.1, [0.0; 3]));
        let mut document = rigs::rig(12, vec![clip]);
        document.bone_offsets[5][13] -= 0.3;
        file(path, &document)
    };
    session.apply(FileCommand::AddClips(vec![unsorted("a.m3d", "a")]));
    session.apply(FileCommand::AddClips(vec![unsorted("b.m3d", "b")]));
    session.apply(FileCommand::AddClips(vec![guest("a.m3d", &["one", "two", "three"], 5)]));
    let subjects = |code: &str| {
        let notices = session.diagnostics().filter(|notice| notice.code == code);
        notices
            .map(|notice| (notice.subject, notice.message[..5].to_owned()))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        subjects("keys-not-sorted"),
        [(Some(Subject::Clip(4)), "b.m3d".to_owned())]
    );
    assert_eq!(
        subjects("clips-offsets-differ").len(),
        1,
        "that of a.m3d is not true any more"
    );
}

#[test]
fn what_is_noted_of_a_file_goes_with_it_and_with_no_other() {
    let mut session = hero();
    let taller = |path: &str, name: &str| {
        let mut document = rigs::rig(12, vec![rigs::even(name, 12, 0.0, 5, 4.0)]);
        document.bone_offsets[5][13] -= 0.3;
        file(path, &document)
    };
    // The name of one begins like that of the other.
    let (short, long) = ("walk.m3d", "walk.m3d, copied.m3d");
    session.apply(FileCommand::AddClips(vec![taller(short, "a"), taller(long, "b")]));
    let noted_of = |session: &Session| {
        let of_offsets = session
            .diagnostics()
            .filter(|notice| notice.code == "clips-offsets-differ");
        of_offsets.map(|notice| notice.message.clone()).collect::<Vec<_>>()
    };
    assert_eq!(noted_of(&session).len(), 2);
    session.apply(FileCommand::AddClips(vec![guest(short, &["one"], 5)]));
    let left = noted_of(&session);
    assert_eq!(left.len(), 1, "{left:?}");
    assert!(left[0].contains(&format!("bone offsets of {long} differ")), "{left:?}");
}

#[test]
fn files_of_one_name_in_one_drop_all_join() {
    let mut session = hero();
    let both = || vec![guest("walk/clip.m3d", &["walk"], 5), guest("run/clip.m3d", &["run"], 5)];
    session.apply(FileCommand::AddClips(both()));
    let listed = pairs(&[("idle", "hero.m3d"), ("walk", "clip.m3d"), ("run", "clip.m3d")]);
    assert_eq!(list(&session), listed);
    session.apply(FileCommand::AddClips(both()));
    assert_eq!(list(&session).len(), 3, "and both are replaced");
    // What cannot be read replaces nothing.
    session.apply(FileCommand::AddClips(vec![models::broken("clip.m3d")]));
    assert!(session.error().is_some() && list(&session).len() == 3);
}
