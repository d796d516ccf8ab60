//! All that a person or a program can ask for, in groups that follow the parts of the session.

use super::choose::naming::NameCommand;
use super::choose::selecting::{JointCommand, SubmeshCommand};
use super::history::HistoryCommand;
use super::look::LookCommand;
use super::look::camera::CameraCommand;
use super::look::materials::MaterialCommand;
use super::look::quality::QualityCommand;
use super::open::opening::FileCommand;
use super::play::crowd::CrowdCommand;
use super::play::playing::PlayCommand;
use super::published::view_state::ViewState;
use super::write::export::ExportCommand;
use crate::model::{Handedness, UpAxis};
use crate::scene::Theme;

/// A command to a session. [`super::Session::apply`] is the one place where things change.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Models, clips and pictures from files; the sky.
    File(FileCommand),
    /// The clip that plays, its time, range and speed; what is blended into the pose.
    Play(PlayCommand),
    /// From where the model is seen.
    Camera(CameraCommand),
    /// Which joints and vertices are selected, hovered, folded.
    Joint(JointCommand),
    Name(NameCommand),
    Submesh(SubmeshCommand),
    /// Light, view mode, background, lines, ghosts, bones, colours of the skin, trails.
    Look(LookCommand),
    Material(MaterialCommand),
    /// Which costly passes are drawn, and how fine the picture is.
    Quality(QualityCommand),
    /// Several instances of the model.
    Crowd(CrowdCommand),
    Export(ExportCommand),
    History(HistoryCommand),

    /// Takes the file as left- or right-handed; `None` is what was found.
    SetHandedness(Option<Handedness>),
    /// Takes the file's up axis as given; `None` is what was found.
    SetUpAxis(Option<UpAxis>),
    /// The dark or the light theme.
    SetTheme(Theme),
    /// Looks at the open model as a state says; see [`super::Session::view_state`]. Clips, bones and submeshes that the model does
    /// not have are ignored, and numbers are clamped to their ranges.
    Restore(Box<ViewState>),
}

/// Makes the command of each group a [`Command`].
macro_rules! groups {
    ($($group:ident($command:ty)),* $(,)?) => {$(
        impl From<$command> for Command {
            fn from(command: $command) -> Self {
                Self::$group(command)
            }
        }
    )*};
}

groups! {
    File(FileCommand),
    Play(PlayCommand),
    Camera(CameraCommand),
    Joint(JointCommand),
    Name(NameCommand),
    Submesh(SubmeshCommand),
    Look(LookCommand),
    Material(MaterialCommand),
    Quality(QualityCommand),
    Crowd(CrowdCommand),
    Export(ExportCommand),
    History(HistoryCommand),
}

impl Command {
    /// Whether what it changes can be undone. Names that are read from where they were kept, and a view that
    /// comes back, were no change of the person's; which instances there are and which is selected is how the model is looked at.
    pub(super) fn is_undoable(&self) -> bool {
        !matches!(
            self,
            Self::History(_) | Self::Crowd(_) | Self::Export(_) | Self::Name(NameCommand::Import(_)) | Self::Restore(_)
        )
    }
}
