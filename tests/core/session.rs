//! Tests of `session`: what is open and how it is looked at, without a window.

mod archive_limit;
mod archives;
mod clips;
mod crowd;
mod exporting;
mod files;
mod folders;
mod ghosts;
mod going_back;
mod history;
mod joining;
mod joints;
mod loading;
mod looking;
mod maps;
mod materials;
mod mixing;
mod models;
mod motion;
mod nearest;
mod opening;
mod pacing;
mod picking;
mod places;
mod playing;
mod random;
mod replay;
mod series;
mod sky;
mod slowness;
mod submeshes;
mod transport;
mod verdicts;
mod view_state;

use bindpose::session::{File, FileCommand, Session};

/// A session with one drop in it, its events taken.
fn opened(file: File) -> Session {
    let mut session = Session::new(false);
    session.apply(FileCommand::Add(vec![file]));
    assert_eq!(session.error(), None);
    session.take_events();
    session
}
