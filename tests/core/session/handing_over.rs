//! What one session has open, edited and in sight is so in another that it was handed over to.

use bindpose::session::{FileCommand, HandedOver, Session, load};
use proptest::prelude::*;

use super::dropped;
use super::models::{moving, still};
use super::random::{command, number};

/// As the page does it.
fn go_on(handed: HandedOver) -> Session {
    let mut session = Session::new(false);
    for files in handed.openings {
        session.apply(FileCommand::Add(files));
    }
    let shown = session.open_model().map(|open| open.file.path.clone());
    if let Some(model) = handed.model.filter(|model| shown.as_ref() != Some(model)) {
        session.apply(FileCommand::Open(model));
    }
    for files in handed.clips {
        session.apply(FileCommand::AddClips(files));
    }
    if let Some(sky) = handed.sky {
        session.apply(FileCommand::Add(vec![sky]));
    }
    assert_eq!(session.go_on_from(&handed.rest), ["model"]);
    session
}

fn clips(session: &Session) -> Vec<String> {
    let open = session.open_model();
    let clips = open.iter().flat_map(|open| open.clip_list());
    clips.map(|clip| format!("{}: {}", clip.file_name, clip.name)).collect()
}

/// The listed models that can be read. One that cannot may be listed where another came with it, and is told of elsewhere when it comes by itself.
fn models(session: &Session) -> Vec<String> {
    let models = session.models();
    let sound = models.iter().filter(|file| load(file).is_ok());
    let mut paths: Vec<_> = sound.map(|file| file.path.clone()).collect();
    paths.sort();
    paths
}

fn pictures(session: &Session) -> Vec<String> {
    let mut used: Vec<_> = session.maps().pictures().iter().map(|file| file.path.clone()).collect();
    used.sort();
    used
}

proptest! {
    #![proptest_config(crate::properties::cases(192))]

    #[test]
    fn all_that_is_open_edited_and_seen_is_so_elsewhere(
        commands in prop::collection::vec((command(), prop::option::of(number())), 0..40),
    ) {
        let mut session = dropped(vec![moving("a.m3d"), still("c.m3d")]);
        for (command, dt_secs) in commands {
            session.apply(command);
            dt_secs.map(|dt_secs| session.advance(dt_secs));
        }
        let elsewhere = go_on(session.handed_over(vec!["model".to_owned()]));
        let path = |session: &Session| session.open_model().map(|open| open.file.path.clone());
        prop_assert_eq!(path(&elsewhere), path(&session));
        prop_assert_eq!(models(&elsewhere), models(&session));
        prop_assert_eq!(clips(&elsewhere), clips(&session));
        prop_assert_eq!(pictures(&elsewhere), pictures(&session));
        prop_assert_eq!(elsewhere.materials(), session.materials());
        prop_assert_eq!(elsewhere.joint_names(), session.joint_names());
        prop_assert_eq!(elsewhere.sky_file(), session.sky_file());
        prop_assert_eq!(elsewhere.quality().mode(), session.quality().mode());
        prop_assert_eq!(elsewhere.view_state(), session.view_state());
    }
}

#[test]
fn what_cannot_be_read_is_left_out() {
    let mut session = dropped(vec![moving("a.m3d")]);
    let before = session.view_state();
    assert_eq!(session.go_on_from("{"), [""; 0]);
    assert_eq!(session.materials(), session.open_model().expect("open").model.materials);
    assert_eq!(session.view_state().selection, before.selection);
}
