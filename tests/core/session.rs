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
mod handing_over;
mod history;
mod in_place;
mod joining;
mod joints;
mod link;
mod loading;
mod looking;
mod maps;
mod materials;
mod mixing;
mod models;
mod motion;
mod named_bones;
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

use bindpose::diagnostic::Diagnostic;
use bindpose::scene::Insets;
use bindpose::session::{CameraCommand, File, FileCommand, Session};
use glam::{Vec2, Vec3};

/// A session with one drop in it, its events taken.
fn opened(file: File) -> Session {
    let mut session = Session::new(false);
    session.apply(FileCommand::Add(vec![file]));
    assert_eq!(session.error(), None);
    session.take_events();
    session
}

/// A session with one drop in it, whatever came of it.
fn dropped(files: Vec<File>) -> Session {
    let mut session = Session::new(false);
    session.apply(FileCommand::Add(files));
    session
}

/// The first finding of a code.
#[track_caller]
fn noted(session: &Session, code: &str) -> Diagnostic {
    let mut findings = session.diagnostics().filter(|finding| finding.code == code);
    findings.next().unwrap_or_else(|| panic!("no finding {code}")).clone()
}

fn orbit(yaw_radians: f32, pitch_radians: f32) -> CameraCommand {
    CameraCommand::Orbit {
        yaw_radians,
        pitch_radians,
    }
}

/// In the middle of the picture.
fn zoom(factor: f32) -> CameraCommand {
    let pointer = Vec2::ZERO;
    CameraCommand::Zoom { factor, pointer }
}

/// A window of this shape without panels.
fn viewport(aspect: f32) -> CameraCommand {
    let insets = Insets::default();
    CameraCommand::SetViewport { aspect, insets }
}

/// Where a point of the world is in a square picture, −1…1, and its depth.
fn in_picture(session: &mut Session, point: Vec3) -> Vec3 {
    let frame = session.frame();
    let clip_from_world = frame.camera.clip_from_view(1.0, &frame.world_bounds) * frame.camera.view_from_world();
    clip_from_world.project_point3(point)
}

/// The same without the depth.
fn on_screen(session: &mut Session, point: Vec3) -> Vec2 {
    in_picture(session, point).truncate()
}
