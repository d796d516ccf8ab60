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
    /// The time is another one.
    TimeUpdate,
    /// What of the open model plays, or how, is another: clips, range, speed, what happens at the end.
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
