//! What programs can listen for.

/// Something that happened, for programs that listen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Event {
    /// A model was opened.
    Load,
    /// A file could not be opened.
    Error,
    Play,
    Pause,
    /// The time changed.
    TimeUpdate,
    /// The clips, the clip that plays, or its range, speed, loop or wrap mode changed.
    PlaybackChange,
}

/// What a command about files did out of sight. A message tells of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum News {
    /// Of so many models that came together, the largest was opened, of this name.
    OpenedLargest(String, usize),
    /// A cube map of this name became the sky. Undo takes it back.
    SkyUsed(String),
    /// A cube map with this path came among other files, and can be the sky.
    SkyFound(String),
    /// So many models were closed, the oldest, since the files of all had too many bytes.
    ModelsClosed(usize),
}

impl Event {
    /// The name that listeners use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::Error => "error",
            Self::Play => "play",
            Self::Pause => "pause",
            Self::TimeUpdate => "timeupdate",
            Self::PlaybackChange => "playbackchange",
        }
    }
}
