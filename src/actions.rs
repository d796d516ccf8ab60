//! The table of actions: what a person can ask for by a key, a button or a line of a menu. Keys, the table of keys, tooltips, menus
//! and the README's table all read it, so a new action with its key is one entry here.
//!
//! Keys are words as people read them: `Shift Space`, `Ctrl Z`, `←`. This module knows no window.

use std::fmt;

use glam::Vec2;

use crate::anim::{Direction, SkinView};
use crate::scene::{Overlay, Projection, ViewPreset};
use crate::session::{
    CameraCommand, Command, HistoryCommand, JointCommand, LookCommand, PlayCommand, Session, SubmeshCommand,
};

/// A key turns the camera by 5 degrees: fine enough for one press, and held it goes half round the model in a second.
const ORBIT_STEP_RADIANS: f32 = std::f32::consts::PI / 36.0;
/// A key moves the camera by this fraction of the picture's height.
const PAN_STEP: f32 = 0.04;
/// A key scales the distance by this, or by its inverse.
const ZOOM_STEP: f32 = 1.08;

/// The stable name of a control, whatever it says and wherever it stands: `frame-model`, `bone-12`. An action has one, and panels give one
/// to what they show. On the page it is `data-control`, for tests, scripts and guides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Control {
    name: &'static str,
    index: Option<usize>,
}

impl Control {
    /// A control of this name: words with a hyphen or an underscore between them.
    pub const fn new(name: &'static str) -> Self {
        Self { name, index: None }
    }

    /// One of many alike, by its number.
    pub const fn at(self, index: usize) -> Self {
        Self {
            index: Some(index),
            ..self
        }
    }
}

impl fmt::Display for Control {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name.to_ascii_lowercase().replace('_', "-"))?;
        self.index.map_or(Ok(()), |index| write!(f, "-{index}"))
    }
}

/// What an action asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Ask {
    /// Something of the session.
    Command(Command),
    /// Show or hide what the page is for, and the table of keys.
    Help,
    /// Close what is on top, or clear the selection.
    Close,
    /// Type a name for the selected bone.
    NameBone,
    /// Choose files to open.
    OpenFiles,
    /// Read the open files again.
    ReadAgain,
    /// Show or hide what was found in the file.
    Findings,
    /// Choose how to save the model as a file of another format.
    Export,
    /// Save the view as a picture.
    SavePicture {
        /// Without the background, whatever was chosen.
        transparent: bool,
    },
}

/// The parts of the table of keys, in the order of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Playing and stepping.
    Time,
    /// Where the camera is.
    Camera,
    /// Bones and skin.
    Bones,
    /// How the model is shown, and the rest.
    Picture,
}

impl Group {
    /// All groups, in order.
    pub const ALL: [Self; 4] = [Self::Time, Self::Camera, Self::Bones, Self::Picture];
}

/// One action. Its methods answer for a session as it is.
#[derive(Clone, Copy, Debug)]
pub struct Action {
    /// The name of the button, switch or line of a menu that asks for it.
    pub control: Control,
    /// Where it stands in the table of keys.
    pub group: Group,
    /// What it does, in the words of the table of keys. Neighbours with the same words share a row.
    pub does: &'static str,
    /// What a button or a line of a menu says.
    pub label: &'static str,
    /// The keys that ask for it. The first one is shown. Empty if it has none.
    pub keys: &'static [&'static str],
    /// Whether it is asked for again while its key is held.
    pub repeats: bool,
    /// Whether Shift with its key asks for nothing. Otherwise Shift is ignored where it has no meaning of its own.
    pub without_shift: bool,
    /// Whether a message says what its key changed, since neither the picture nor a chip does.
    pub announced: bool,
    ask: fn(&Session) -> Option<Ask>,
    now: fn(&Session) -> Option<String>,
}

impl Action {
    const fn new(
        group: Group,
        keys: &'static [&'static str],
        does: &'static str,
        label: &'static str,
        ask: fn(&Session) -> Option<Ask>,
    ) -> Self {
        Self {
            control: Control::new(""),
            group,
            does,
            label,
            keys,
            repeats: false,
            without_shift: false,
            announced: false,
            ask,
            now: |_| None,
        }
    }

    const fn named(self, name: &'static str) -> Self {
        Self {
            control: Control::new(name),
            ..self
        }
    }

    const fn now(self, now: fn(&Session) -> Option<String>) -> Self {
        Self { now, ..self }
    }

    const fn repeats(self) -> Self {
        Self { repeats: true, ..self }
    }

    const fn without_shift(self) -> Self {
        Self {
            without_shift: true,
            ..self
        }
    }

    const fn announced(self) -> Self {
        Self {
            announced: true,
            ..self
        }
    }

    /// What it asks for. None when it is not possible: a model without bones shows none.
    pub fn ask(&self, session: &Session) -> Option<Ask> {
        (self.ask)(session)
    }

    /// The command it asks for, if it is possible and about the session.
    pub fn command(&self, session: &Session) -> Option<Command> {
        match self.ask(session)? {
            Ask::Command(command) => Some(command),
            _ => None,
        }
    }

    /// What of it is in force: `on`, `1×`, `Lit`. None while it is off, or when there is nothing to say.
    pub fn in_force(&self, session: &Session) -> Option<String> {
        (self.now)(session)
    }

    /// Whether it is on.
    pub fn is_on(&self, session: &Session) -> bool {
        self.in_force(session).is_some()
    }

    /// The key that is shown beside it; empty if it has none.
    pub fn key(&self) -> &'static str {
        self.keys.first().copied().unwrap_or_default()
    }

    /// Its label with its key: `Turntable`, `Frame the model (Shift F)`.
    pub fn hint(&self) -> String {
        self.hint_of(self.label)
    }

    /// Other words with its key: `Pause (Space)`.
    pub fn hint_of(&self, words: &str) -> String {
        match self.key() {
            "" => words.to_owned(),
            key => format!("{words} ({key})"),
        }
    }
}

/// A row of the table of keys: actions of one group that share their words.
pub type Row = &'static [Action];

/// The rows of a group, without actions that have no key.
pub fn rows(group: Group) -> impl Iterator<Item = Row> {
    ALL.chunk_by(|a, b| (a.group, a.does) == (b.group, b.does))
        .filter(move |row| row[0].group == group && !row[0].key().is_empty())
}

/// The keys of a row: `← →`, `Shift ← →`, `Alt ←↑→↓`, `F, Shift F`.
pub fn keys_of(row: Row) -> String {
    let keys: Vec<&str> = row.iter().map(Action::key).collect();
    let split = |key: &&'static str| key.rsplit_once(' ').unwrap_or(("", key));
    let (first_modifier, _) = row.first().map_or(("", ""), |action| split(&action.key()));
    if row.iter().any(|action| split(&action.key()).0 != first_modifier) {
        return keys.join(", ");
    }
    let keys: Vec<&str> = row.iter().map(|action| split(&action.key()).1).collect();
    // All four arrows stand close together, so that they fit behind two modifiers.
    let are_arrows = keys.len() == 4 && keys.iter().all(|key| "←↑→↓".contains(key));
    let keys = keys.join(if are_arrows { "" } else { " " });
    format!("{first_modifier} {keys}").trim().to_owned()
}

/// The action of a key that is pressed. `is_pressed` says whether the key is one of the table's, with Shift or without, whatever is held. Shift is
/// ignored where it has no meaning of its own.
pub fn of_key(shift: bool, is_pressed: impl Fn(&str, bool) -> bool) -> Option<&'static Action> {
    let with = |shift| {
        let mut all = ALL.iter();
        all.find(|action| action.keys.iter().any(|words| is_pressed(words, shift)))
    };
    with(shift).or_else(|| with(false).filter(|action| shift && !action.without_shift))
}

/// Clears what was selected last: the vertex before the joint before the submesh.
pub fn let_go(session: &Session) -> Option<Command> {
    let joints = session.joints();
    if joints.selected_vertex().is_some() {
        Some(JointCommand::SelectVertex(None).into())
    } else if joints.selected().is_some() {
        Some(JointCommand::Select(None).into())
    } else {
        let submesh = session.submeshes().selected();
        submesh.map(|_| SubmeshCommand::Select(None).into())
    }
}

/// The key that asks for a command now; empty if none does.
pub fn key_of(session: &Session, command: &Command) -> &'static str {
    let asked = ALL
        .iter()
        .find(|action| action.command(session).as_ref() == Some(command));
    asked.map_or("", Action::key)
}

/// A speed as it is shown: `1×`, `0.75×`.
pub fn speed_label(speed: f32) -> String {
    format!("{}×", (speed * 100.0).round() / 100.0)
}

/// The name of what is shown of the surface: colours of the skin take the place of the view mode.
pub fn view_mode_label(session: &Session) -> &'static str {
    match session.look().skin_view {
        Some(view) => view.label(),
        None => session.look().view_mode.label(),
    }
}

fn ask(command: impl Into<Command>) -> Option<Ask> {
    Some(Ask::Command(command.into()))
}

fn glide(command: CameraCommand) -> Option<Ask> {
    ask(CameraCommand::Glide(Box::new(command)))
}

/// Looks from a side; if the camera does so already, from the opposite side.
fn look_from(session: &Session, side: ViewPreset, opposite: ViewPreset) -> Option<Ask> {
    let preset = if session.looks_from(side) { opposite } else { side };
    glide(CameraCommand::LookFrom(preset))
}

/// Turns the camera by steps to its left and up.
fn orbit(left: f32, up: f32) -> Option<Ask> {
    glide(CameraCommand::Orbit {
        yaw_radians: left * ORBIT_STEP_RADIANS,
        pitch_radians: up * ORBIT_STEP_RADIANS,
    })
}

/// Moves the camera by steps to its left and up.
fn pan(left: f32, up: f32) -> Option<Ask> {
    glide(CameraCommand::Pan {
        drag: Vec2::new(left, up) * PAN_STEP,
    })
}

fn zoom(factor: f32) -> Option<Ask> {
    let pointer = Vec2::ZERO;
    glide(CameraCommand::Zoom { factor, pointer })
}

/// Asks only for a model that has bones.
fn with_bones(session: &Session, command: impl Into<Command>) -> Option<Ask> {
    (session.joints().count() > 0).then(|| Ask::Command(command.into()))
}

fn step_key(session: &Session, direction: Direction) -> Option<Ask> {
    ask(PlayCommand::StepKey {
        direction,
        joint: session.joints().selected(),
    })
}

fn on(is_on: bool) -> Option<String> {
    is_on.then(|| "on".to_owned())
}

fn overlay_on(session: &Session, overlay: Overlay) -> Option<String> {
    on(session.look().overlays.has(overlay))
}

fn plays(session: &Session, backward: bool) -> Option<String> {
    let playback = session.playback();
    on(playback.is_playing() && playback.is_backward() == backward)
}

fn range_on(session: &Session) -> Option<String> {
    on(session.playback().range_secs().is_some())
}

fn speed(session: &Session) -> Option<String> {
    Some(speed_label(session.playback().speed()))
}

macro_rules! actions {
    ($($(#[$doc:meta])* $name:ident: $action:expr;)*) => {
        $($(#[$doc])* pub const $name: Action = $action.named(stringify!($name));)*

        /// All actions, in the order of the table of keys.
        pub const ALL: &[Action] = &[$($name),*];
    };
}

actions! {
    /// Play or pause.
    PLAY: Action::new(Group::Time, &["Space"], "play or pause", "Play", |_| ask(PlayCommand::Toggle))
        .now(|session| plays(session, false));
    /// Play backward or pause.
    PLAY_BACKWARD: Action::new(Group::Time, &["Shift Space"], "play backward", "Backward", |_| {
        ask(PlayCommand::ToggleBackward)
    })
    .now(|session| plays(session, true));
    /// One frame back.
    FRAME_BACK: Action::new(Group::Time, &["←", ","], "one frame", "One frame back", |_| ask(PlayCommand::StepFrames(-1)))
        .repeats();
    /// One frame on.
    FRAME_ON: Action::new(Group::Time, &["→", "."], "one frame", "One frame on", |_| ask(PlayCommand::StepFrames(1)))
        .repeats();
    /// Ten frames back.
    TEN_FRAMES_BACK: Action::new(Group::Time, &["Shift ←", "Shift ,"], "ten frames", "Ten frames back", |_| {
        ask(PlayCommand::StepFrames(-10))
    })
    .repeats();
    /// Ten frames on.
    TEN_FRAMES_ON: Action::new(Group::Time, &["Shift →", "Shift ."], "ten frames", "Ten frames on", |_| {
        ask(PlayCommand::StepFrames(10))
    })
    .repeats();
    /// To the next key of the selected joint, or of any.
    NEXT_KEY: Action::new(Group::Time, &["↑"], "next, previous key", "Next key", |session| {
        step_key(session, Direction::Forward)
    })
    .repeats();
    /// To the previous key of the selected joint, or of any.
    PREVIOUS_KEY: Action::new(Group::Time, &["↓"], "next, previous key", "Previous key", |session| {
        step_key(session, Direction::Backward)
    })
    .repeats();
    /// To the first frame of what plays.
    FIRST_FRAME: Action::new(Group::Time, &["Home"], "first, last frame", "First frame", |_| ask(PlayCommand::SeekStart));
    /// To the last frame of what plays.
    LAST_FRAME: Action::new(Group::Time, &["End"], "first, last frame", "Last frame", |_| ask(PlayCommand::SeekEnd));
    /// Begin the range at the present time.
    RANGE_IN: Action::new(Group::Time, &["I"], "range in, out", "Range in", |_| ask(PlayCommand::SetRangeStart(None)))
        .now(range_on);
    /// End the range at the present time.
    RANGE_OUT: Action::new(Group::Time, &["O"], "range in, out", "Range out", |_| ask(PlayCommand::SetRangeEnd(None)))
        .now(range_on)
        .without_shift();
    /// Play the whole clip again.
    CLEAR_RANGE: Action::new(Group::Time, &["Shift I"], "no range", "Clear the range", |_| ask(PlayCommand::ClearRange));
    /// Play slower.
    SLOWER: Action::new(Group::Time, &["["], "slower, faster, 1×", "Slower", |_| ask(PlayCommand::Slower)).now(speed).repeats();
    /// Play faster.
    FASTER: Action::new(Group::Time, &["]"], "slower, faster, 1×", "Faster", |_| ask(PlayCommand::Faster)).now(speed).repeats();
    /// Play at the speed of the file.
    NORMAL_SPEED: Action::new(Group::Time, &["\\"], "slower, faster, 1×", "Speed 1×", |_| ask(PlayCommand::SetSpeed(1.0)))
        .now(speed);
    /// To the next loop mode: once, loop, there and back.
    NEXT_LOOP_MODE: Action::new(Group::Time, &["L"], "next loop mode", "Loop mode", |_| ask(PlayCommand::CycleLoopMode))
        .now(|session| Some(session.playback().loop_mode().label().to_owned()))
        .announced();
    /// To the next clip.
    NEXT_CLIP: Action::new(Group::Time, &["C"], "next clip", "Next clip", |_| ask(PlayCommand::CycleClip(1)));
    /// To the previous clip.
    PREVIOUS_CLIP: Action::new(Group::Time, &["Shift C"], "previous clip", "Previous clip", |_| ask(PlayCommand::CycleClip(-1)));

    /// Turn the camera to its left.
    ORBIT_LEFT: Action::new(Group::Camera, &["Alt ←"], "orbit", "Orbit left", |_| orbit(1.0, 0.0)).repeats();
    /// Lift the camera.
    ORBIT_UP: Action::new(Group::Camera, &["Alt ↑"], "orbit", "Orbit up", |_| orbit(0.0, 1.0)).repeats();
    /// Turn the camera to its right.
    ORBIT_RIGHT: Action::new(Group::Camera, &["Alt →"], "orbit", "Orbit right", |_| orbit(-1.0, 0.0)).repeats();
    /// Lower the camera.
    ORBIT_DOWN: Action::new(Group::Camera, &["Alt ↓"], "orbit", "Orbit down", |_| orbit(0.0, -1.0)).repeats();
    /// Move the camera to its left.
    PAN_LEFT: Action::new(Group::Camera, &["Alt Shift ←"], "pan", "Pan left", |_| pan(1.0, 0.0)).repeats();
    /// Move the camera up.
    PAN_UP: Action::new(Group::Camera, &["Alt Shift ↑"], "pan", "Pan up", |_| pan(0.0, 1.0)).repeats();
    /// Move the camera to its right.
    PAN_RIGHT: Action::new(Group::Camera, &["Alt Shift →"], "pan", "Pan right", |_| pan(-1.0, 0.0)).repeats();
    /// Move the camera down.
    PAN_DOWN: Action::new(Group::Camera, &["Alt Shift ↓"], "pan", "Pan down", |_| pan(0.0, -1.0)).repeats();
    /// Bring the camera nearer.
    ZOOM_IN: Action::new(Group::Camera, &["+", "="], "zoom in, out", "Zoom in", |_| zoom(1.0 / ZOOM_STEP)).repeats();
    /// Take the camera farther away.
    ZOOM_OUT: Action::new(Group::Camera, &["−"], "zoom in, out", "Zoom out", |_| zoom(ZOOM_STEP)).repeats();
    /// Frame what is selected, or the model.
    FRAME_SELECTION: Action::new(Group::Camera, &["F"], "frame the selection, all", "Frame the selection", |_| {
        glide(CameraCommand::FrameSelection)
    });
    /// Frame the whole clip.
    FRAME_MODEL: Action::new(Group::Camera, &["Shift F"], "frame the selection, all", "Frame the model", |_| {
        glide(CameraCommand::FrameModel)
    });
    /// View from the front, or else from the back.
    FRONT: Action::new(Group::Camera, &["1"], "front; again: back", "Front", |session| {
        look_from(session, ViewPreset::Front, ViewPreset::Back)
    });
    /// View from the right, or else from the left.
    RIGHT: Action::new(Group::Camera, &["3"], "right; again: left", "Right", |session| {
        look_from(session, ViewPreset::Right, ViewPreset::Left)
    });
    /// View from above, or else from below.
    TOP: Action::new(Group::Camera, &["7"], "top; again: bottom", "Top", |session| {
        look_from(session, ViewPreset::Top, ViewPreset::Bottom)
    });
    /// Orthographic or perspective.
    ORTHOGRAPHIC: Action::new(Group::Camera, &["5"], "orthographic", "Orthographic", |_| ask(CameraCommand::ToggleProjection))
        .now(|session| on(session.camera().projection == Projection::Orthographic))
        .announced();
    /// View from an upper corner.
    ISOMETRIC: Action::new(Group::Camera, &["9"], "isometric, reset", "Isometric", |_| {
        glide(CameraCommand::LookFrom(ViewPreset::Isometric))
    });
    /// The camera that a model opens with.
    RESET_CAMERA: Action::new(Group::Camera, &["0"], "isometric, reset", "Reset the camera", |_| glide(CameraCommand::Reset));
    /// The camera goes round the model.
    TURNTABLE: Action::new(Group::Camera, &[], "turntable", "Turntable", |_| ask(CameraCommand::ToggleTurntable))
        .now(|session| on(session.turntable()));

    /// Bones over the model.
    BONES: Action::new(Group::Bones, &["B"], "bones", "Bones", |session| {
        with_bones(session, LookCommand::SetBonesVisible(!session.look().bones_visible))
    })
    .now(|session| on(session.look().bones_visible));
    /// Names at the bones.
    BONE_NAMES: Action::new(Group::Bones, &["Shift B"], "names of bones", "Names of bones", |session| {
        with_bones(session, LookCommand::SetLabelsVisible(!session.look().labels_visible()))
    })
    .now(|session| on(session.look().labels_visible()));
    /// Weights of the selected bone on the skin.
    WEIGHTS: Action::new(Group::Bones, &["W"], "weights of the bone", "Weights", |session| {
        let shown = session.look().skin_view == Some(SkinView::Weight);
        with_bones(session, LookCommand::SetSkinView((!shown).then_some(SkinView::Weight)))
    })
    .now(|session| on(session.look().skin_view == Some(SkinView::Weight)));
    /// Between the clip and the bind pose.
    BIND_POSE: Action::new(Group::Bones, &["K"], "bind pose, clip", "Bind pose", |session| {
        with_bones(session, PlayCommand::ToggleBindPose)
    })
    .now(|session| on(session.bind_weight() >= 1.0));
    /// Name the selected bone.
    NAME_BONE: Action::new(Group::Bones, &["F2"], "name the bone", "Rename", |session| {
        session.joints().selected().map(|_| Ask::NameBone)
    });

    /// To the next view mode.
    NEXT_VIEW_MODE: Action::new(Group::Picture, &["T"], "view mode", "View mode", |_| ask(LookCommand::CycleViewMode(1)))
        .now(|session| Some(view_mode_label(session).to_owned()));
    /// To the previous view mode.
    PREVIOUS_VIEW_MODE: Action::new(Group::Picture, &["Shift T"], "previous view mode", "Previous view mode", |_| {
        ask(LookCommand::CycleViewMode(-1))
    });
    /// To the other light.
    OTHER_LIGHT: Action::new(Group::Picture, &["V"], "the other light", "Light", |_| ask(LookCommand::ToggleLight))
        .now(|session| Some(session.look().light.label().to_owned()));
    /// Grid on the ground.
    GRID: Action::new(Group::Picture, &["G"], "ground grid", "Ground grid", |_| {
        ask(LookCommand::ToggleOverlay(Overlay::Grid))
    })
    .now(|session| overlay_on(session, Overlay::Grid));
    /// Edges of triangles.
    WIREFRAME: Action::new(Group::Picture, &["Z"], "wireframe", "Wireframe", |_| {
        ask(LookCommand::ToggleOverlay(Overlay::Wireframe))
    })
    .now(|session| overlay_on(session, Overlay::Wireframe));
    /// Normals of vertices.
    NORMALS: Action::new(Group::Picture, &["N"], "vertex normals", "Vertex normals", |_| {
        ask(LookCommand::ToggleOverlay(Overlay::Normals))
    })
    .now(|session| overlay_on(session, Overlay::Normals));
    /// Axes of the world.
    AXES: Action::new(Group::Picture, &["X"], "axes", "Axes", |_| ask(LookCommand::ToggleOverlay(Overlay::Axes)))
        .now(|session| overlay_on(session, Overlay::Axes));
    /// Take the last edit back.
    UNDO: Action::new(Group::Picture, &["Ctrl Z"], "undo", "Undo", |session| {
        session.history().undo_label()?;
        ask(HistoryCommand::Undo)
    })
    .repeats()
    .without_shift();
    /// Do again what was undone.
    REDO: Action::new(Group::Picture, &["Ctrl Shift Z", "Ctrl Y"], "redo", "Redo", |session| {
        session.history().redo_label()?;
        ask(HistoryCommand::Redo)
    })
    .repeats()
    .without_shift();
    /// Choose files to open.
    OPEN_FILES: Action::new(Group::Picture, &["Ctrl O"], "open files", "Open files…", |_| Some(Ask::OpenFiles)).without_shift();
    /// Read the open files again.
    READ_AGAIN: Action::new(Group::Picture, &["R"], "read the files again", "Read the files again", |_| Some(Ask::ReadAgain))
        .without_shift();
    /// Show or hide what was found in the file.
    FINDINGS: Action::new(Group::Picture, &["D"], "findings", "Findings", |session| {
        session.open_model().map(|_| Ask::Findings)
    });
    /// Save the view as a picture.
    SAVE_PICTURE: Action::new(Group::Picture, &["P"], "save a picture", "Save PNG", |_| {
        Some(Ask::SavePicture { transparent: false })
    });
    /// Save the view as a picture without its background.
    SAVE_TRANSPARENT: Action::new(Group::Picture, &["Shift P"], "with transparent ground", "Save PNG, transparent", |_| {
        Some(Ask::SavePicture { transparent: true })
    });
    /// Save the model as a file of another format.
    EXPORT: Action::new(Group::Picture, &["E"], "export the model", "Export…", |_| Some(Ask::Export));
    /// Show or hide what the page is for, and the table of keys.
    HELP: Action::new(Group::Picture, &["?"], "this help", "Help", |_| Some(Ask::Help));
    /// Close what is on top, or clear the selection.
    CLOSE: Action::new(Group::Picture, &["Esc"], "close, or let go", "Close", |_| Some(Ask::Close));
}
