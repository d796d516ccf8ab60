//! What programs can listen for.

/// Something that happened, for programs that listen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Event {
    /// A model was opened.
    Load,
    /// A file could not be opened.
    Error,
    /// Playing began.
    Play,
    /// Playing ended.
    Pause,
    /// The time changed.
    TimeUpdate,
    /// The clips, the clip that plays, or its range, speed, loop or wrap mode changed.
    PlaybackChange,
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
