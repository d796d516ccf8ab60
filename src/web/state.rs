//! What scripts see of the session: plain objects.

use std::collections::BTreeMap;

use js_sys::{Array, Object, Reflect};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::{JsCast as _, JsValue};

use super::picture::Drawn;
use super::rim::books;
use crate::scene::{Detail, FrameCost, Pass, Theme, TimedPass};
use crate::session::summary::{self, Books, Finding};
use crate::session::{
    AppearanceState, BeingOpened, Checklist, CrowdState, Event, LoadError, PlaybackState, Quality, Session, ViewState,
};

/// `bindpose.state()`.
#[derive(Serialize)]
pub(super) struct State<'a> {
    backend: Option<&'a str>,
    adapter: Option<&'a str>,
    model: Option<Model<'a>>,
    /// Paths of all models that are open, in the order of opening.
    models: Vec<&'a str>,
    /// What is being opened.
    opening: Option<Opening<'a>>,
    /// Milliseconds of each stage of the last opening.
    timings: BTreeMap<&'static str, f64>,
    textures: &'a Checklist,
    blend: Option<Blend>,
    time_secs: f32,
    playing: bool,
    backward: bool,
    #[serde(flatten)]
    playback: Playback,
    camera: Camera,
    grid_visible: bool,
    look: Look,
    skeleton: Skeleton<'a>,
    crowd: CrowdState,
    cost: Cost,
    undo: Option<&'a str>,
    redo: Option<&'a str>,
    frames_rendered: u64,
    /// The one that a person chose, whatever the system's is.
    theme: Option<Theme>,
    /// What stands behind `#` in a link to what is seen, but for the model.
    link: String,
    notices: Vec<Finding<'a>>,
    book: Option<Books<'a>>,
    error: Option<FileError<'a>>,
}

/// What is being opened, and how far that is.
#[derive(Serialize)]
struct Opening<'a> {
    name: &'a str,
    stage: &'static str,
    percent: usize,
}

#[derive(Serialize)]
struct Model<'a> {
    name: &'a str,
    path: &'a str,
    /// The number of the opening that brought it: another number, another drop.
    opening: Option<u64>,
    #[serde(flatten)]
    summary: summary::Model<'a>,
}

/// The clip that is blended into the one on show, and its weight in the pose.
#[derive(Serialize)]
struct Blend {
    clip: Option<String>,
    share: f32,
}

/// What of the model plays, and how.
#[derive(Serialize)]
struct Playback {
    clip: Option<String>,
    range_secs: Option<[f32; 2]>,
    speed: f32,
    #[serde(rename = "loop")]
    loop_mode: &'static str,
    wrap: &'static str,
}

#[derive(Serialize)]
struct Camera {
    target: [f32; 3],
    distance: f32,
    yaw_radians: f32,
    pitch_radians: f32,
    orthographic: bool,
}

/// How the model is looked at, with the names that `snapshot` takes, and what became of each pass.
#[derive(Serialize)]
struct Look {
    light: &'static str,
    split: Option<f32>,
    view_mode: &'static str,
    background: String,
    overlays: Vec<&'static str>,
    exposure: f32,
    passes: BTreeMap<&'static str, &'static str>,
    render_scale: f32,
    quality: &'static str,
    /// Of how many pictures the one in the window is the mean.
    samples: u32,
    /// Whether what lights the model is as fine as it will be.
    refined: bool,
    /// What is less fine while the picture moves.
    lowered: Option<Lowered>,
}

/// Fraction of the width and height that is drawn, what became of the rest, and how long frames took, milliseconds.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Lowered {
    scale: f32,
    occlusion: &'static str,
    shadow: &'static str,
    frame_millis: f32,
}

/// What is chosen of the bones and the skin, and how they are shown. Bones go by their numbers in the file.
#[derive(Serialize)]
struct Skeleton<'a> {
    selected: Option<u32>,
    vertex: Option<u32>,
    bones_visible: bool,
    bone_style: &'static str,
    labels_visible: bool,
    skin_view: Option<&'static str>,
    bind_share: f32,
    names: BTreeMap<String, &'a str>,
}

/// What the frame that was drawn last cost.
#[derive(Serialize)]
struct Cost {
    cpu_ms: Option<f32>,
    /// Of an earlier frame, since the GPU answers late.
    gpu_ms: Option<BTreeMap<String, f32>>,
    vertices: u64,
    uploaded_bytes: u64,
}

#[derive(Serialize)]
struct FileError<'a> {
    #[serde(flatten)]
    finding: Finding<'a>,
    file: &'a str,
}

impl<'a> State<'a> {
    /// `backend` and `adapter` are those of the running viewer, and so is what was `drawn`.
    pub(super) fn new(
        session: &'a Session,
        backend: Option<&'a str>,
        adapter: Option<&'a str>,
        drawn: Drawn,
        (theme, link): (Option<Theme>, String),
        timings: BTreeMap<&'static str, f64>,
    ) -> Self {
        let ViewState {
            camera,
            appearance,
            playback,
            crowd,
            selection,
        } = session.view_state();
        Self {
            backend,
            adapter,
            model: model(session),
            models: session.models().into_iter().map(|file| &*file.path).collect(),
            opening: session.being_opened().map(|BeingOpened { name, progress }| Opening {
                name,
                stage: progress.stage.as_str(),
                percent: progress.percent(),
            }),
            timings,
            textures: session.maps().checklist(),
            blend: playback.blend.clone().map(|(clip, share)| Blend {
                clip: Some(clip),
                share,
            }),
            time_secs: playback.time_secs,
            playing: playback.playing,
            backward: playback.backward,
            camera: Camera {
                target: camera.target,
                distance: camera.distance,
                yaw_radians: camera.yaw_radians,
                pitch_radians: camera.pitch_radians,
                orthographic: camera.orthographic,
            },
            grid_visible: session.grid_visible(),
            look: look(&appearance, session.quality(), drawn),
            skeleton: Skeleton {
                selected: selection.bone,
                vertex: selection.vertex,
                bones_visible: appearance.bones_visible,
                bone_style: appearance.bone_style.name(),
                labels_visible: appearance.labels_visible,
                skin_view: appearance.skin_view.map(|view| view.name()),
                bind_share: playback.bind_weight,
                names: names(session),
            },
            playback: playback.into(),
            crowd,
            cost: cost(session),
            undo: session.history().undo_label(),
            redo: session.history().redo_label(),
            frames_rendered: drawn.frames,
            theme,
            link,
            notices: session.diagnostics().map(Finding::from).collect(),
            book: books(session),
            error: session.error().map(FileError::from),
        }
    }
}

fn model(session: &Session) -> Option<Model<'_>> {
    let open = session.open_model()?;
    Some(Model {
        name: open.file.base_name(),
        path: &open.file.path,
        opening: session.shown_opening(),
        summary: summary::Model {
            // The person may have corrected them.
            handedness: session.handedness().name(),
            up_axis: session.up_axis().name(),
            ..open.into()
        },
    })
}

impl From<PlaybackState> for Playback {
    fn from(state: PlaybackState) -> Self {
        Self {
            clip: state.clip,
            range_secs: state.range_secs,
            speed: state.speed,
            loop_mode: state.loop_mode.name(),
            wrap: state.wrap_mode.name(),
        }
    }
}

fn look(look: &AppearanceState, quality: &Quality, drawn: Drawn) -> Look {
    Look {
        light: look.light.name(),
        split: look.split,
        view_mode: look.view_mode.name(),
        background: look.background.name(),
        overlays: look.overlays.iter().map(|overlay| overlay.name()).collect(),
        exposure: look.exposure_stops,
        passes: Pass::ALL.map(|pass| (pass.name(), quality.state(pass).name())).into(),
        render_scale: quality.render_scale().fraction(),
        quality: quality.mode().name(),
        samples: drawn.samples,
        refined: drawn.refined,
        lowered: quality.lowered().map(|lowered| Lowered {
            scale: lowered.scale,
            occlusion: if lowered.without_occlusion {
                "off"
            } else {
                detail_name(lowered.occlusion)
            },
            shadow: detail_name(lowered.shadow),
            frame_millis: lowered.frame_secs * 1e3,
        }),
    }
}

fn detail_name(detail: Detail) -> &'static str {
    match detail {
        Detail::Full => "full",
        Detail::Low => "low",
    }
}

/// The names that bones were given, by their numbers in the file.
fn names(session: &Session) -> BTreeMap<String, &str> {
    let names = session.joint_names().all().iter();
    names.map(|(bone, name)| (bone.to_string(), name.as_str())).collect()
}

fn cost(session: &Session) -> Cost {
    let FrameCost {
        cpu_secs,
        gpu_secs,
        vertices,
        uploaded_bytes,
        ..
    } = session.frame_cost();
    let passes = TimedPass::ALL.map(|pass| pass.name().replace(' ', "_"));
    Cost {
        cpu_ms: cpu_secs.map(|secs| secs * 1e3),
        gpu_ms: gpu_secs.map(|secs| passes.into_iter().zip(secs.map(|secs| secs * 1e3)).collect()),
        vertices,
        uploaded_bytes,
    }
}

impl<'a> From<&'a LoadError> for FileError<'a> {
    fn from(error: &'a LoadError) -> Self {
        Self {
            finding: Finding::from(&error.diagnostic),
            file: &error.file_name,
        }
    }
}

/// The detail of an event: enough to act on without asking for the whole state.
pub(super) fn event_detail(session: &Session, event: Event) -> JsValue {
    match event {
        Event::Load => {
            let name = session.open_model().map(|open| open.file.base_name());
            to_js(&BTreeMap::from([("name", name)]))
        }
        Event::Error => to_js(&session.error().map(FileError::from)),
        Event::Play | Event::Pause | Event::TimeUpdate => {
            to_js(&BTreeMap::from([("time_secs", session.playback().time_secs())]))
        }
        Event::PlaybackChange => to_js(&Playback::from(session.view_state().playback)),
    }
}

/// A plain object with keys in camelCase; what is `None` is `null`.
pub(super) fn to_js(value: &impl Serialize) -> JsValue {
    let value = value.serialize(&Serializer::json_compatible());
    // All of our values can be written.
    value.map_or(JsValue::NULL, with_camel_case_keys)
}

fn with_camel_case_keys(value: JsValue) -> JsValue {
    if let Some(array) = value.dyn_ref::<Array>() {
        return array.iter().map(with_camel_case_keys).collect::<Array>().into();
    }
    let Some(object) = value.dyn_ref::<Object>() else {
        return value;
    };
    let renamed = Object::new();
    for entry in Object::entries(object).iter() {
        let [key, value] = [0, 1].map(|index| entry.unchecked_ref::<Array>().get(index));
        let key = camel_case(&key.as_string().unwrap_or_default());
        // Setting a field of a fresh plain object cannot fail.
        let _ = Reflect::set(&renamed, &key.into(), &with_camel_case_keys(value));
    }
    renamed.into()
}

/// `bind_bounds` as `bindBounds`.
fn camel_case(key: &str) -> String {
    let mut words = key.split('_');
    let first = words.next().unwrap_or_default().to_owned();
    words.fold(first, |name, word| {
        let (initial, rest) = word.split_at(word.len().min(1));
        name + &initial.to_uppercase() + rest
    })
}
