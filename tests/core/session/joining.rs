//! Clips of a second file with the same bones.

use bindpose::diagnostic::{Severity, Subject};
use bindpose::format::AnimationClip;
use bindpose::session::{Event, File, FileCommand, PlayCommand, Session};

use super::models::file;
use super::{models, noted, opened};
use crate::documents::{key, soldier_bytes};
use crate::rigs::{self, JOINT_COUNTS};

fn hero() -> Session {
    opened(guest_of("hero.m3d", vec![rigs::even("idle", 12, 0.0, 5, 4.0)]))
}

/// File and name of each clip.
fn list(session: &Session) -> Vec<String> {
    let clips = session.open_model().expect("open").clip_list();
    clips.map(|clip| format!("{}: {}", clip.file_name, clip.name)).collect()
}

/// A file of the hero's bones with these clips.
fn guest_of(path: &str, clips: Vec<AnimationClip>) -> File {
    file(path, &rigs::rig(12, clips))
}

fn add_clips(session: &mut Session, file: File) {
    session.apply(FileCommand::AddClips(vec![file]));
}

/// What is said about a file that is refused; nothing else happens.
#[track_caller]
fn assert_refused(session: &mut Session, refused: &File, code: &str, message: &str) {
    let before = (session.model_revision(), session.picture_revision(), list(session));
    add_clips(session, refused.clone());
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
        guest_of("more/walk.m3d", clips(&["walk", "idle"])),
        guest_of("run.m3d", clips(&["run", "walk"])),
    ]));
    assert!(!changes.model && session.error().is_none());
    assert_eq!((session.model_revision(), session.maps_revision()), (revision, maps));
    assert_eq!(
        (session.clip_index(), session.playback().time_secs()),
        (Some(0), time_secs)
    );
    assert_eq!(
        list(&session),
        [
            "hero.m3d: idle",
            "walk.m3d: walk",
            "walk.m3d: idle (2)",
            "run.m3d: run",
            "run.m3d: walk (2)"
        ]
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
    let mut other = rigs::rig(12, clips(12));
    other.bone_parents[7] = 2;
    other.bone_parents[9] = 0;
    let mut rootless = other.clone();
    rootless.bone_parents[7] = -1;
    let the_same = "clips can only be added from a file with the same bones.";
    #[rustfmt::skip]
    let cases = [
        (file("b.m3d", &rigs::rig(13, clips(13))), "b.m3d has 13 bones and hero.m3d has 12"),
        (file("one.m3d", &rigs::rig(1, clips(1))), "one.m3d has 1 bone and hero.m3d has 12"),
        (file("b.m3d", &other), "Bone 7 has bone 2 as its parent in b.m3d and bone 6 as its parent in hero.m3d"),
        (file("b.m3d", &rootless), "Bone 7 has no parent in b.m3d and bone 6 as its parent in hero.m3d"),
    ];
    for (refused, difference) in cases {
        let words = format!("{difference}; {the_same}");
        assert_refused(&mut session, &refused, "clips-bones-differ", &words);
    }
    let empty = guest_of("b.m3d", vec![]);
    assert_refused(&mut session, &empty, "clips-none", "b.m3d has no clips to add.");
}

#[test]
fn files_that_are_no_models_are_refused_as_ever_and_the_others_join() {
    let mut session = hero();
    let sound = guest_of("run.m3d", vec![rigs::single("run", 12)]);
    session.apply(FileCommand::AddClips(vec![models::broken("bad.m3d"), sound]));
    assert_eq!(session.error().map(|error| error.file_name.as_str()), Some("bad.m3d"));
    assert_eq!(list(&session).len(), 2);
    add_clips(&mut session, File::new("skin.dds", *b"not looked at"));
    assert_eq!(session.error().map(|error| error.diagnostic.code), Some("no-model"));
    let sound = guest_of("jump.m3d", vec![rigs::single("jump", 12)]);
    add_clips(&mut session, sound);
    assert_eq!(session.error(), None, "the next success takes the error away");
}

#[test]
fn other_proportions_are_noted() {
    let mut session = hero();
    let mut taller = rigs::rig(12, vec![rigs::even("walk", 12, 0.0, 5, 4.0)]);
    for (bone, nudge) in [(2, 1e-4), (5, 0.3), (11, 0.3)] {
        taller.bone_offsets[bone][13] -= nudge;
    }
    add_clips(&mut session, file("tall.m3d", &taller));
    assert_eq!((session.error(), list(&session).len()), (None, 2));
    let notice = noted(&session, "clips-offsets-differ");
    assert_eq!(
        (notice.severity, notice.subject),
        (Severity::Note, Some(Subject::Bone(5)))
    );
    assert_eq!(
        notice.message,
        "2 of the 12 bone offsets of tall.m3d differ from those of hero.m3d, the first that of bone 5: its clips were made for \
         other proportions."
    );
    add_clips(&mut session, guest_of("same.m3d", vec![rigs::single("s", 12)]));
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
    add_clips(&mut session, guest_of("walk.m3d", clips));
    let notice = noted(&session, "keys-not-sorted");
    assert!(
        notice.message.starts_with("walk.m3d: 1 bone has "),
        "{}",
        notice.message
    );
    assert_eq!((notice.subject, notice.position), (Some(Subject::Clip(1)), None));
}

#[test]
fn clips_come_to_a_model_that_had_none_and_play() {
    let mut session = opened(guest_of("still.m3d", vec![]));
    assert_eq!(session.clip_index(), None);
    add_clips(
        &mut session,
        guest_of("walk.m3d", vec![rigs::even("walk", 12, 3.0, 5, 4.0)]),
    );
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
    add_clips(
        &mut session,
        guest_of("walk.m3d", vec![rigs::even("walk", 12, 0.0, 9, 4.0)]),
    );
    session.apply(PlayCommand::SelectClip(1));
    session.apply(PlayCommand::Seek { time_secs: 1.5 });
    session.apply(FileCommand::Add(vec![guest_of(
        "hero.m3d",
        vec![rigs::even("idle", 12, 0.0, 5, 4.0)],
    )]));
    assert_eq!(list(&session), ["hero.m3d: idle", "walk.m3d: walk"]);
    assert_eq!((session.clip_index(), session.playback().time_secs()), (Some(1), 1.5));

    session.apply(FileCommand::Add(vec![file(
        "hero.m3d",
        &rigs::rig(11, vec![rigs::even("idle", 11, 0.0, 5, 4.0)]),
    )]));
    assert_eq!(list(&session), ["hero.m3d: idle"]);
    let notice = noted(&session, "clips-bones-differ");
    assert_eq!(notice.severity, Severity::Warning);
    // Another file has no guests.
    session.apply(FileCommand::Add(vec![models::moving("b.m3d")]));
    assert_eq!(list(&session).len(), models::CLIPS.len());
}

#[test]
fn skeletons_of_every_size_are_compared() {
    for bones in JOINT_COUNTS {
        let mut session = opened(file("a.m3d", &rigs::rig(bones, vec![rigs::ragged("a", bones)])));
        add_clips(
            &mut session,
            file("b.m3d", &rigs::rig(bones, vec![rigs::single("b", bones)])),
        );
        assert_eq!((session.error(), list(&session).len()), (None, 2));
    }
}

#[test]
fn a_real_file_joins_itself() {
    let Some(bytes) = soldier_bytes() else { return };
    let mut session = opened(File::new("soldier.m3d", bytes.clone()));
    let clips = list(&session).len();
    add_clips(&mut session, File::new("again.m3d", bytes));
    assert_eq!((session.error(), list(&session).len()), (None, 2 * clips));
    assert!(
        session
            .diagnostics()
            .all(|notice| notice.code != "clips-offsets-differ")
    );
    add_clips(&mut session, models::moving("box.m3d"));
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
    add_clips(&mut session, guest("walk.m3d", &["walk", "idle"], 5));
    add_clips(&mut session, guest("run.m3d", &["run"], 5));
    let model = (session.model_revision(), session.clips_revision());
    session.apply(PlayCommand::SelectClip(3));
    session.apply(PlayCommand::SetBlend { clip: 1, weight: 0.25 });
    session.apply(PlayCommand::Seek { time_secs: 0.5 });
    session.take_events();
    let picture = session.picture_revision();
    add_clips(&mut session, guest("elsewhere/walk.m3d", &["walk", "trot", "idle"], 9));
    let listed = [
        "hero.m3d: idle",
        "walk.m3d: walk",
        "walk.m3d: trot",
        "walk.m3d: idle (2)",
        "run.m3d: run",
    ];
    assert_eq!(list(&session), listed);
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
    add_clips(&mut session, guest("walk.m3d", &["walk"], 5));
    assert_eq!(
        told(&session),
        note("walk.m3d was added before; its 1 clip replaces the 3 clips from then."),
        "what was said of clips that are gone is gone"
    );
    // What the model's own file brought stays, and a file of another name joins.
    add_clips(&mut session, guest("hero.m3d", &["jump"], 5));
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
        add_clips(&mut session, guest("walk.m3d", &["walk"], 9));
        session.apply(PlayCommand::SelectClip(1));
        session.apply(PlayCommand::SetRangeStart(Some(0.5)));
        session.apply(PlayCommand::SetRangeEnd(Some(1.75)));
        session.apply(PlayCommand::Seek { time_secs: 1.5 });
        session.apply(PlayCommand::Pause);
        let before = session.frame().palette.0.clone();
        add_clips(&mut session, guest("walk.m3d", names, keys));
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
    add_clips(&mut session, unsorted("a.m3d", "a"));
    add_clips(&mut session, unsorted("b.m3d", "b"));
    add_clips(&mut session, guest("a.m3d", &["one", "two", "three"], 5));
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
    add_clips(&mut session, guest(short, &["one"], 5));
    let left = noted_of(&session);
    assert_eq!(left.len(), 1, "{left:?}");
    assert!(left[0].contains(&format!("bone offsets of {long} differ")), "{left:?}");
}

#[test]
fn files_of_one_name_in_one_drop_all_join() {
    let mut session = hero();
    let both = || vec![guest("walk/clip.m3d", &["walk"], 5), guest("run/clip.m3d", &["run"], 5)];
    session.apply(FileCommand::AddClips(both()));
    let listed = ["hero.m3d: idle", "clip.m3d: walk", "clip.m3d: run"];
    assert_eq!(list(&session), listed);
    session.apply(FileCommand::AddClips(both()));
    assert_eq!(list(&session).len(), 3, "and both are replaced");
    // What cannot be read replaces nothing.
    add_clips(&mut session, models::broken("clip.m3d"));
    assert!(session.error().is_some() && list(&session).len() == 3);
}
