//! A series of pictures: what a session shows, at other times and from other sides.
//!
//! For each picture the copy is sought and turned, so it shows what its time alone gives, to the byte.

use crate::scene::{Camera, Insets, RenderFrame, Shot};
use crate::session::look::view::Framed;
use crate::session::play::playing::PlayCommand;
use crate::session::{CameraCommand, Session};

/// The pictures of a series, one at a time. It has a copy of the session, which goes on meanwhile and does not notice.
#[derive(Debug)]
pub struct Series {
    session: Session,
    /// Of the first picture.
    camera: Camera,
    shots: Vec<Shot>,
}

impl Series {
    /// For pictures of a shape: width / height. A model that is framed in the session is framed in them, and stays in them while the
    /// camera turns; a camera that was moved by hand stays where it is.
    pub fn new(mut session: Session, aspect: f32, shots: Vec<Shot>) -> Self {
        session.before = None;
        session.apply(CameraCommand::SetViewport {
            aspect,
            insets: Insets::default(),
        });
        if let Some(goal) = session.view.motion.goal() {
            session.view.camera = goal;
        }
        session.view.motion = Default::default();
        if session.view.framed != Framed::No && shots.iter().any(|shot| shot.turn_radians.is_some()) {
            session.frame_all_round();
        }
        Self {
            camera: session.view.camera,
            session,
            shots,
        }
    }

    /// What the pictures are of.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// Number of pictures.
    pub fn count(&self) -> usize {
        self.shots.len()
    }

    /// All that a renderer needs for a picture; beyond the last one, for the one before. As a picture that is saved, with all detail.
    pub fn frame(&mut self, index: usize) -> RenderFrame<'_> {
        if let Some(shot) = self.shots.get(index) {
            self.session.view.camera = self.camera;
            if let Some(turn) = shot.turn_radians {
                self.session.view.camera.orbit(turn, 0.0);
            }
            if let Some(time_secs) = shot.time_secs {
                self.session.apply(PlayCommand::Seek { time_secs });
            }
        }
        self.session.frame_at_rest()
    }

    /// What a label says of a picture.
    pub fn caption(&self, index: usize) -> Vec<String> {
        let shot = self.shots.get(index);
        shot.map_or_else(Vec::new, |shot| shot.caption(self.session.clip()))
    }
}
