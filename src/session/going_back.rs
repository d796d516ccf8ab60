//! What was dropped is on the screen when the GPU has taken it. Until then what was there before is kept, and comes back when the
//! GPU refuses.

use super::{Command, Event, LoadError, Session};
use crate::diagnostic::{Diagnostic, Severity};

/// The finding that something open could not be brought to the GPU.
pub const GPU_REFUSED: &str = "gpu-refused";

impl Session {
    /// What the renderer holds besides the pose and the values of the materials: other numbers, another upload.
    pub(super) fn uploads(&self) -> [u64; 3] {
        [self.model_revision, self.maps_revision, self.sky.revision()]
    }

    /// A copy of all that is open, for [`Session::go_back`]; none when there is an older one, which the screen still shows.
    pub(super) fn to_go_back_to(&self) -> Option<Box<Self>> {
        self.before.is_none().then(|| Box::new(self.clone()))
    }

    /// Learns that the GPU has taken all that is open.
    pub fn confirm_uploads(&mut self) {
        self.before = None;
    }

    /// Learns that the GPU could not take what is open, and why. What was open before is open again, as it was; without any, or
    /// when the GPU refuses that too, nothing is. The error is shown.
    pub fn go_back(&mut self, reason: &str) {
        let refused = self.open.as_ref().map(|open| open.file.base_name().to_owned());
        let mut before = self.before.take().map_or_else(|| self.closed(), |before| *before);
        // Whoever has seen the one that failed must not take this for it.
        before.model_revision = self.model_revision + 1;
        before.clips_revision = self.clips_revision + 1;
        before.maps_revision = self.maps_revision + 1;
        before.picture_revision = self.picture_revision + 1;
        before.sky.follow(&self.sky);
        let (aspect, insets) = (self.aspect, self.insets);
        before.theme = self.theme;
        before.events = std::mem::take(&mut self.events);
        *self = before;
        self.perform(Command::SetViewport { aspect, insets });
        self.note(Event::Load);
        self.fail(LoadError::refused_by_gpu(refused.unwrap_or_default(), reason));
    }

    /// Learns that the GPU could not draw the view, and why. The error is shown.
    pub fn note_undrawn(&mut self, reason: &str) {
        self.fail(LoadError::refused_by_gpu(String::new(), reason));
    }

    /// The same view of nothing.
    fn closed(&mut self) -> Self {
        self.clear_sky();
        Self {
            look: self.look,
            quality: self.quality.clone(),
            ..Self::new(self.reduced_motion)
        }
    }
}

impl LoadError {
    fn refused_by_gpu(file_name: String, reason: &str) -> Self {
        let message = format!("This cannot be drawn here: {reason}.");
        Self {
            file_name,
            diagnostic: Diagnostic::without_place(Severity::Error, GPU_REFUSED, message),
            excerpt: None,
        }
    }
}
