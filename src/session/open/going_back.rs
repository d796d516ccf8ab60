//! Until the GPU has taken what was dropped, a copy of what was open before is kept. If the GPU refuses, the copy is open again.

use crate::diagnostic::codes;
use crate::session::changes::Changes;
use crate::session::look::camera::CameraCommand;
use crate::session::{Event, LoadError, Session};

impl Session {
    /// A copy of all that is open, for [`Session::go_back`]. None when there is an older copy: that one is still on the screen.
    pub(in crate::session) fn to_go_back_to(&self) -> Option<Box<Self>> {
        self.before.is_none().then(|| Box::new(self.clone()))
    }

    /// Learns that the GPU has taken all that is open.
    pub fn confirm_uploads(&mut self) {
        self.before = None;
    }

    /// Learns that the GPU could not take what is open, and why. What was open before is open again, as it was; without any, or
    /// when the GPU refuses that too, nothing is. The error is shown.
    pub fn go_back(&mut self, reason: &str) {
        let refused = self.content.open.as_ref().map(|open| open.file.base_name().to_owned());
        let before = self.before.take().map_or_else(|| self.closed(), |before| *before);
        let (aspect, insets, theme) = (self.view.aspect, self.view.insets, self.view.theme);
        *self = Self {
            revisions: self.revisions,
            events: std::mem::take(&mut self.events),
            opening: std::mem::take(&mut self.opening),
            ..before
        };
        self.view.theme = theme;
        self.apply_to_camera(CameraCommand::SetViewport { aspect, insets });
        // New revisions, so that no cache of the model that failed is used for this one.
        self.commit(Changes::CONTENT);
        self.note(Event::Load);
        self.fail(LoadError::refused_by_gpu(refused.unwrap_or_default(), reason));
    }

    /// Learns that the GPU could not draw the view, and why. The error is shown.
    pub fn note_undrawn(&mut self, reason: &str) {
        self.fail(LoadError::refused_by_gpu(String::new(), reason));
    }

    /// This session with nothing open, with the same look and quality.
    fn closed(&mut self) -> Self {
        self.clear_sky();
        let mut closed = Self::new(self.reduced_motion);
        closed.view.look.clone_from(&self.view.look);
        closed.view.look.trails = Default::default();
        closed.quality.clone_from(&self.quality);
        closed
    }
}

impl LoadError {
    fn refused_by_gpu(file_name: String, reason: &str) -> Self {
        let message = format!("This cannot be drawn here: {reason}.");
        Self {
            file_name,
            diagnostic: codes::GPU_REFUSED.says(message),
            excerpt: None,
        }
    }
}
