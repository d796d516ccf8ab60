//! A clip that is kept over where it starts stays so, wherever that is said.

use bindpose::format::AnimationClip;
use bindpose::import::import;
use bindpose::model::{Clip, Track};
use bindpose::session::{
    CameraCommand, Command, CrowdCommand, ExportFormat, ExportOptions, File, FileCommand, HistoryCommand, MAX_LINK_LEN,
    PlayCommand, Session,
};

use super::models::file;
use super::opened;
use crate::rigs;

/// A clip of 12 bones whose first walks, and whose second sways on it.
fn walking(name: &str) -> AnimationClip {
    let mut clip = rigs::even(name, 12, 0.0, 9, 4.0);
    for (index, key) in clip.bones[1].keyframes.iter_mut().enumerate() {
        key.translation[0] = 0.25 * (index % 2) as f32;
    }
    clip
}

fn model(path: &str, clips: Vec<AnimationClip>) -> File {
    file(path, &rigs::rig(12, clips))
}

/// The hero with a clip that walks, one that does not, and one whose name is a number.
fn hero() -> File {
    model(
        "hero.m3d",
        vec![walking("walk"), rigs::single("stand", 12), walking("1")],
    )
}

fn switch(session: &mut Session, clip: usize, on: bool) {
    session.apply(PlayCommand::SetInPlace { clip, on });
}

fn in_place(session: &Session) -> Vec<String> {
    session.view_state().playback.in_place
}

fn clips(session: &Session) -> &[Clip] {
    &session.open_model().expect("it is open").model.clips
}

#[test]
fn files_that_come_again_leave_in_place_what_is() {
    let mut session = opened(hero());
    let guest = || model("guest.m3d", vec![walking("run")]);
    session.apply(FileCommand::AddClips(vec![guest()]));
    for clip in [0, 3] {
        switch(&mut session, clip, true);
    }
    let kept = clips(&session).to_vec();
    assert_eq!(in_place(&session), ["walk", "run"]);
    session.apply(FileCommand::AddClips(vec![guest()]));
    assert_eq!((in_place(&session).len(), clips(&session)), (2, &*kept), "the clips");
    session.apply(FileCommand::Add(vec![hero()]));
    assert_eq!((in_place(&session).len(), clips(&session)), (2, &*kept), "the model");
    switch(&mut session, 0, false);
    assert_ne!(clips(&session)[0], kept[0]);
    let standing = model("hero.m3d", vec![rigs::single("walk", 12), walking("1")]);
    session.apply(FileCommand::Add(vec![standing]));
    assert_eq!(in_place(&session), ["run"]);
    switch(&mut session, 2, false);
    assert_eq!(
        clips(&session)[2].tracks,
        clips(&session)[1].tracks,
        "as its file has it"
    );
    session.apply(FileCommand::Add(vec![model("other.m3d", vec![walking("run")])]));
    assert_eq!(in_place(&session), [""; 0], "another model");
}

#[test]
fn a_step_says_what_it_is() {
    let mut session = opened(hero());
    for (on, label) in [(true, "in place: clip walk"), (false, "no longer in place: clip walk")] {
        switch(&mut session, 0, on);
        assert_eq!(session.history().undo_label(), Some(label));
        session.apply(HistoryCommand::Undo);
        assert_eq!(in_place(&session).is_empty(), on);
        session.apply(HistoryCommand::Redo);
        assert_eq!(session.history().last(), Some(&*format!("Redone: {label}")));
        assert_eq!(in_place(&session).is_empty(), !on);
    }
    switch(&mut session, 1, true);
    assert_eq!(
        session.history().undo_label(),
        Some("no longer in place: clip walk"),
        "what stands leaves no step"
    );
    // A file that brings another walk replaces one that is kept.
    session.apply(FileCommand::AddClips(vec![model("guest.m3d", vec![walking("run")])]));
    switch(&mut session, 3, true);
    session.apply(FileCommand::AddClips(vec![model(
        "guest.m3d",
        vec![rigs::single("run", 12)],
    )]));
    assert_eq!(session.history().undo_label(), Some("replace clip run"));
}

#[test]
fn a_link_names_clips_that_are_there_even_those_called_a_number() {
    let mut session = opened(hero());
    switch(&mut session, 0, true);
    switch(&mut session, 2, true);
    session.apply(CameraCommand::FrameModel); // It needs less room.
    let link = session.link(Vec::new(), MAX_LINK_LEN).text;
    assert_eq!(link, "inplace=walk,1");
    let mut elsewhere = opened(hero());
    let (linked, left_out) = elsewhere.read_link(&link);
    assert_eq!(left_out, [""; 0]);
    elsewhere.apply(Command::Restore(Box::new(linked.view)));
    assert_eq!(clips(&elsewhere), clips(&session));
    let (linked, left_out) = elsewhere.read_link("inplace=1,fly");
    assert_eq!(
        (linked.view.playback.in_place, left_out),
        (vec!["1".to_owned()], vec!["inplace=1,fly".to_owned()])
    );
}

#[test]
fn a_crowd_has_the_room_that_its_clips_need() {
    let crowded = |session: &mut Session| {
        session.apply(CrowdCommand::Set { count: 9, seed: 1 });
    };
    let places = |session: &mut Session| {
        let frame = session.frame();
        let instances = frame.crowd.instances.iter();
        let places: Vec<_> = instances
            .map(|instance| instance.world_from_model.translation)
            .collect();
        (places, frame.world_bounds)
    };
    let mut session = opened(model("hero.m3d", vec![walking("walk")]));
    session.apply(PlayCommand::Pause);
    crowded(&mut session);
    let wide = places(&mut session);
    switch(&mut session, 0, true);
    let narrow = places(&mut session);
    let mut alone = opened(model("hero.m3d", vec![walking("walk")]));
    alone.apply(PlayCommand::Pause);
    switch(&mut alone, 0, true);
    crowded(&mut alone);
    assert_eq!(narrow, places(&mut alone));
    assert!(wide.1.size().x > narrow.1.size().x + 1.0, "{wide:?} {narrow:?}");
    session.apply(HistoryCommand::Undo);
    assert_eq!(places(&mut session), wide);
}

#[test]
fn what_is_in_place_is_written_so_and_told_once() {
    let mut session = opened(hero());
    switch(&mut session, 0, true);
    let alone = session.clone();
    for (session, in_place, count) in [(&session, false, 1), (&session, true, 2), (&alone, true, 2)] {
        let options = ExportOptions {
            format: ExportFormat::D3d12,
            in_place,
            ..ExportOptions::default()
        };
        let written = session
            .export_job(&options)
            .expect("it is open")
            .run()
            .expect("it can be written");
        let told: Vec<_> = written
            .plan
            .changes
            .iter()
            .filter(|change| change.code == "in-place")
            .collect();
        assert_eq!(told.len(), count, "{told:?}");
        assert_eq!(
            told[0].message,
            "\"walk\" stays over where it starts; it went 2.000 over the ground."
        );
        let model = import(&written.bytes).expect("what was written is read").model;
        let tracks = &model.clips[0].tracks;
        let reach = |track: &Track| {
            let places = track.translation().values();
            places.iter().map(|place| place.distance(places[0])).fold(0.0, f32::max)
        };
        let moved: Vec<_> = tracks.iter().map(reach).filter(|&reach| reach > 0.0).collect();
        assert_eq!(moved, [0.25], "it sways on the spot");
    }
}
