//! All that a person or a program can ask for, and what came of it.

use glam::{Vec2, Vec3};

use super::files::File;
use super::joints::JointCommand;
use super::look::LookCommand;
use super::quality::{PassChoice, RenderScale};
use super::subsets::SubsetCommand;
use super::view_state::ViewState;
use crate::anim::{Direction, GhostPlan, LoopMode, WrapMode};
use crate::model::{Handedness, JointIndex, Material, UpAxis};
use crate::scene::{Insets, Pass, Theme, ViewPreset};

/// A wish. [`super::Session::apply`] is the one place where things change.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Opens the largest model of a drop; the others are listed, pictures are kept beside it, a cube map becomes the sky.
    AddFiles(Vec<File>),
    /// Adds the clips of other models with the same bones to the open one; without an open model it opens them. One whose
    /// bones differ is refused as an error, and the model stays.
    AddClips(Vec<File>),
    /// Opens another model of the last drop, by its path.
    OpenFile(String),
    /// Takes the sky away that was dropped.
    ClearSky,
    /// Takes the error card away.
    DismissError,

    /// Plays on in the direction it had; a clip that stopped at its end starts over.
    Play,
    /// Stops where it is.
    Pause,
    /// Plays or pauses.
    TogglePlay,
    /// Plays backward, or pauses when it does.
    TogglePlayBackward,
    /// Goes to a time, clamped to the clip.
    Seek {
        /// Seconds in the clip's own time.
        time_secs: f32,
    },
    /// Pauses and goes some frames on (or back), to a whole frame.
    StepFrames(i32),
    /// Goes to a place in frames of the clip's own key rate, clamped to the clip; between two frames where it has a fraction.
    SeekFrame(f64),
    /// Pauses and goes to the next key of a joint, or of any, in a direction; nowhere when there is none.
    StepKey {
        /// To later or to earlier keys.
        direction: Direction,
        /// Whose keys; `None` is every joint's.
        joint: Option<JointIndex>,
    },
    /// First frame, of the range where there is one.
    SeekStart,
    /// Last frame, of the range where there is one.
    SeekEnd,
    /// Lets playing begin at a time, seconds, or at the present one. A range that would end before then ends with the clip.
    /// Ranges are forgotten with their clip.
    SetRangeStart(Option<f32>),
    /// Lets playing end at a time, seconds, or at the present one. A range that would begin after then begins with the clip.
    SetRangeEnd(Option<f32>),
    /// Lets the whole clip play.
    ClearRange,
    /// The pointer holds the time: playing waits until [`Command::EndScrub`].
    BeginScrub,
    /// The pointer let go: playing goes on if it played before.
    EndScrub,
    /// Shows a clip, by its index.
    SelectClip(usize),
    /// Shows the clip some places further, around the end.
    CycleClip(i32),
    /// How long the pose takes from clip to clip when one is selected while another plays, in seconds; 0 is at once.
    /// Under reduced motion it is at once in any case.
    SetCrossfade(f32),
    /// Blends a second clip into the one on show, at the same fraction of its length. Nothing for the clip on show itself.
    SetBlend {
        /// Index of the clip.
        clip: usize,
        /// Its weight in the pose, clamped to 0…1.
        weight: f32,
    },
    /// Shows the clip on show alone.
    ClearBlend,
    /// Speed as a factor of the file's, clamped to [`crate::anim::MIN_SPEED`] and [`crate::anim::MAX_SPEED`].
    SetSpeed(f32),
    /// One of the [`super::SPEEDS`] down.
    Slower,
    /// One of the [`super::SPEEDS`] up.
    Faster,
    /// What happens at the end.
    SetLoopMode(LoopMode),
    /// Once, loop, ping-pong, in turn.
    CycleLoopMode,
    /// How a loop begins again.
    SetWrapMode(WrapMode),

    /// Turns the camera about its target.
    Orbit {
        /// Positive moves the eye to its left.
        yaw_radians: f32,
        /// Positive lifts the eye.
        pitch_radians: f32,
    },
    /// Moves the scene with the pointer.
    Pan {
        /// Shares of the picture's height, x right, y down.
        drag: Vec2,
    },
    /// Comes nearer (factor below 1) to what is under the pointer.
    Zoom {
        /// Factor of the distance.
        factor: f32,
        /// Shares of the picture's height from its centre, x right, y down.
        pointer: Vec2,
    },
    /// Frames all that the clip reaches.
    FrameModel,
    /// Frames what is selected as it is posed now: what a joint moves, the neighbourhood of a vertex, or a subset; all that the
    /// clip reaches when nothing is selected.
    FrameSelection,
    /// Looks from a named direction and frames.
    LookFrom(ViewPreset),
    /// Perspective or orthographic.
    ToggleProjection,
    /// The default view.
    ResetCamera,
    /// Does what another command asks, but lets the camera go there within a quarter of a second where it would jump.
    /// Under reduced motion it jumps.
    Glide(Box<Command>),
    /// The pointer holds the camera: what it did by itself ends, and the turntable waits until [`Command::EndDrag`].
    BeginDrag,
    /// The pointer let go.
    EndDrag,
    /// Turns on after a drag, slower and slower. Nothing under reduced motion.
    Fling {
        /// Rate of [`Command::Orbit`]'s yaw when the pointer let go, radians a second.
        yaw_radians_per_sec: f32,
        /// Rate of its pitch.
        pitch_radians_per_sec: f32,
    },
    /// Turns the camera about the model, once in twelve seconds, or leaves it.
    SetTurntable(bool),
    /// Turns the camera about the model, or leaves it, in turn.
    ToggleTurntable,
    /// Flies on, at one radius of the scene a second, until another command of this kind: the keys that are held now.
    Fly {
        /// To the right, up in the world, forward: −1…1 each. Zero ends it.
        direction: Vec3,
        /// Four times as fast.
        fast: bool,
    },
    /// Turns the head: the eye stays where it is.
    FlyLook {
        /// Positive looks to the right.
        yaw_radians: f32,
        /// Positive looks up.
        pitch_radians: f32,
    },
    /// The picture's shape, and what of it is covered by panels.
    SetViewport {
        /// Width / height.
        aspect: f32,
        /// Covered margins.
        insets: Insets,
    },

    /// Takes the file as left- or right-handed; `None` is what was found.
    SetHandedness(Option<Handedness>),
    /// Takes the file's up axis as given; `None` is what was found.
    SetUpAxis(Option<UpAxis>),
    /// Which subsets are drawn, selected, hovered.
    Subset(SubsetCommand),
    /// Selects the bone, the vertex or the subset that is shown at a point of the picture: x right, y up, −1…1. What is selected
    /// is a subset, or a joint and a vertex: one lets the other go.
    SelectAt(Vec2),
    /// Which joints are selected, hovered, how they are called and shown.
    Joint(JointCommand),
    /// Brings the pose a part of the way to the bind pose: 0 as the clip has it … 1 the bind pose.
    SetBindWeight(f32),
    /// The bind pose, or the clip's, in turn.
    ToggleBindPose,
    /// Draws a material with the values of another. Its names, the names of its maps and its book stay; numbers are brought
    /// into their range.
    EditMaterial {
        /// Which of the model's.
        index: usize,
        /// The values.
        material: Material,
    },
    /// Draws a material as the file has it.
    ResetMaterial(usize),
    /// Shows poses before and after that of now as ghosts, or none.
    SetGhosts(Option<GhostPlan>),
    /// Shows the bind pose as a ghost, or not.
    SetBindGhost(bool),
    /// Light, view mode, background, lines.
    Look(LookCommand),
    /// Whether a costly pass is drawn.
    SetPass(Pass, PassChoice),
    /// How fine the picture in the window is.
    SetRenderScale(RenderScale),
    /// The dark or the light theme.
    SetTheme(Theme),
    /// Looks at the open model as a state says; see [`super::Session::view_state`]. Clips, bones and subsets that the model has not
    /// are ignored, and numbers are brought into their ranges.
    Restore(Box<ViewState>),
}

impl From<LookCommand> for Command {
    fn from(command: LookCommand) -> Self {
        Self::Look(command)
    }
}

impl From<JointCommand> for Command {
    fn from(command: JointCommand) -> Self {
        Self::Joint(command)
    }
}

impl From<SubsetCommand> for Command {
    fn from(command: SubsetCommand) -> Self {
        Self::Subset(command)
    }
}

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
