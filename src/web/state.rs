//! What scripts see of the session: plain objects.

use js_sys::{Array, Object, Reflect};
use wasm_bindgen::JsValue;

use crate::anim::{LoopMode, WrapMode};
use crate::diagnostic::Diagnostic;
use crate::scene::{Aabb, Overlay, Pass, Projection};
use crate::session::{Event, OpenModel, Session};

/// Names of what happens at the end, as the state gives them.
pub(super) const LOOP_NAMES: [(LoopMode, &str); 3] = [
    (LoopMode::Once, "once"),
    (LoopMode::Loop, "loop"),
    (LoopMode::PingPong, "pingpong"),
];

/// Names of how a loop goes on.
pub(super) const WRAP_NAMES: [(WrapMode, &str); 2] = [(WrapMode::Wrap, "wrap"), (WrapMode::BookDemo, "book-demo")];

/// An object built field by field.
struct Fields(Object);

impl Fields {
    fn new() -> Self {
        Self(Object::new())
    }

    fn with(self, name: &str, value: impl Into<JsValue>) -> Self {
        // Setting a field of a fresh plain object cannot fail.
        let _ = Reflect::set(&self.0, &name.into(), &value.into());
        self
    }

    fn done(self) -> JsValue {
        self.0.into()
    }
}

/// What the running viewer adds to the session.
pub(super) struct View<'a> {
    pub(super) backend: Option<&'a str>,
    pub(super) adapter: Option<&'a str>,
    pub(super) frames_rendered: u64,
}

/// `bindpose.state()`.
pub(super) fn state(session: &Session, view: &View<'_>) -> JsValue {
    let playback = session.playback();
    let camera = session.camera();
    let error = session.error().map_or(JsValue::NULL, |error| {
        Fields(diagnostic(&error.diagnostic))
            .with("file", &*error.file_name)
            .done()
    });
    let fields = Fields::new()
        .with("backend", view.backend)
        .with("adapter", view.adapter)
        .with(
            "model",
            session.open_model().map_or(JsValue::NULL, |open| model(session, open)),
        )
        .with("textures", textures(session))
        .with("blend", blend(session))
        .with("timeSecs", playback.time_secs())
        .with("playing", playback.is_playing())
        .with("backward", playback.is_backward());
    how_it_plays(session, fields)
        .with(
            "camera",
            Fields::new()
                .with("target", vector(camera.target))
                .with("distance", camera.distance)
                .with("yawRadians", camera.yaw_radians)
                .with("pitchRadians", camera.pitch_radians)
                .with("orthographic", camera.projection == Projection::Orthographic)
                .done(),
        )
        .with("gridVisible", session.grid_visible())
        .with("look", look(session))
        .with("skeleton", skeleton(session))
        .with("framesRendered", view.frames_rendered as f64)
        .with(
            "notices",
            session
                .notices()
                .map(|notice| JsValue::from(diagnostic(notice)))
                .collect::<Array>(),
        )
        .with("error", error)
        .done()
}

/// What of the model plays, and how.
fn how_it_plays(session: &Session, fields: Fields) -> Fields {
    let playback = session.playback();
    let range_secs = playback.range_secs();
    fields
        .with("clip", session.clip().map(|clip| clip.name.as_str()))
        .with(
            "rangeSecs",
            range_secs.map_or(JsValue::NULL, |range| numbers(range).into()),
        )
        .with("speed", playback.speed())
        .with("loop", name_of(&LOOP_NAMES, playback.loop_mode()))
        .with("wrap", name_of(&WRAP_NAMES, playback.wrap_mode()))
}

fn model(session: &Session, open: &OpenModel) -> JsValue {
    let model = &open.model;
    let clips = model.clips.iter().map(|clip| {
        Fields::new()
            .with("name", &*clip.name)
            .with("startSecs", clip.start_secs)
            .with("endSecs", clip.end_secs)
            .with("keysPerSec", clip.keys_per_sec)
            .with("keys", clip.key_count as f64)
            .done()
    });
    let materials = model.materials.iter().map(|material| JsValue::from(&*material.name));
    Fields::new()
        .with("name", open.file.base_name())
        .with("path", &*open.file.path)
        .with("dialect", open.dialect.as_str())
        .with("handedness", session.handedness().as_str())
        .with("upAxis", session.up_axis().as_str())
        .with(
            "counts",
            Fields::new()
                .with("materials", model.materials.len() as f64)
                .with("vertices", model.mesh.vertex_count() as f64)
                .with("triangles", model.mesh.triangle_count() as f64)
                .with("bones", model.skeleton.joint_count() as f64)
                .with("clips", model.clips.len() as f64)
                .done(),
        )
        .with("materials", materials.collect::<Array>())
        .with("clips", clips.collect::<Array>())
        .with("bindBounds", bounds(&open.bind_bounds))
        .done()
}

/// How the model is looked at, with the names that `snapshot` takes, and what became of each pass.
fn look(session: &Session) -> JsValue {
    let look = session.look();
    let overlays = Overlay::ALL.into_iter().filter(|&overlay| look.overlays.has(overlay));
    let quality = session.quality();
    let passes = Pass::ALL.into_iter().fold(Fields::new(), |passes, pass| {
        passes.with(pass.name(), quality.state(pass).name())
    });
    Fields::new()
        .with("light", look.light.name())
        .with("split", look.split.map_or(JsValue::NULL, JsValue::from))
        .with("viewMode", look.view_mode.name())
        .with("background", look.background.name())
        .with(
            "overlays",
            overlays.map(|overlay| JsValue::from(overlay.name())).collect::<Array>(),
        )
        .with("exposure", look.exposure_stops)
        .with("passes", passes.done())
        .with("renderScale", quality.render_scale().fraction())
        .done()
}

/// The clip that is blended into the one on show, and its share of the pose.
fn blend(session: &Session) -> JsValue {
    let clip_name = |index: usize| Some(&*session.open_model()?.model.clips.get(index)?.name);
    session.blend().map_or(JsValue::NULL, |blend| {
        Fields::new()
            .with("clip", clip_name(blend.clip))
            .with("share", blend.share)
            .done()
    })
}

/// What is chosen of the bones and the skin, and how they are shown. Bones go by their numbers in the file.
fn skeleton(session: &Session) -> JsValue {
    let joints = session.joints();
    let bones = session.open_model().map(|open| open.model.skeleton.file_bones());
    let selected = joints.selected().and_then(|joint| bones?.get(joint.index()).copied());
    let names = session.joint_names().all().iter();
    Fields::new()
        .with("selected", selected.map_or(JsValue::NULL, JsValue::from))
        .with(
            "vertex",
            joints
                .selected_vertex()
                .map_or(JsValue::NULL, |selected| selected.vertex.into()),
        )
        .with("bonesVisible", joints.bones_visible())
        .with("boneStyle", joints.bone_style().name())
        .with("labelsVisible", joints.labels_visible())
        .with(
            "skinView",
            joints.skin_view().map_or(JsValue::NULL, |view| view.name().into()),
        )
        .with("bindShare", session.bind_share())
        .with(
            "names",
            names
                .fold(Fields::new(), |names, (bone, name)| {
                    names.with(&bone.to_string(), name.as_str())
                })
                .done(),
        )
        .done()
}

/// How many maps the materials name, and the names that no file fits.
fn textures(session: &Session) -> JsValue {
    let checklist = session.maps().checklist();
    let list = |names: &[String]| names.iter().map(|name| JsValue::from(&**name)).collect::<Array>();
    Fields::new()
        .with("named", checklist.named as f64)
        .with("missing", list(&checklist.missing))
        .with("unreadable", list(&checklist.unreadable))
        .done()
}

/// The detail of an event: enough to act on without asking for the whole state.
pub(super) fn event_detail(session: &Session, event: Event) -> JsValue {
    match event {
        Event::Load => Fields::new()
            .with("name", session.open_model().map(|open| open.file.base_name()))
            .done(),
        Event::Error => session.error().map_or(JsValue::NULL, |error| {
            Fields(diagnostic(&error.diagnostic))
                .with("file", &*error.file_name)
                .done()
        }),
        Event::Play | Event::Pause | Event::TimeUpdate => {
            Fields::new().with("timeSecs", session.playback().time_secs()).done()
        }
        Event::PlaybackChange => how_it_plays(session, Fields::new()).done(),
    }
}

fn diagnostic(finding: &Diagnostic) -> Object {
    Fields::new()
        .with("severity", finding.severity.as_str())
        .with("code", finding.code)
        .with("message", &*finding.message)
        .with("expected", finding.expected.as_deref())
        .with("found", finding.found.as_deref())
        .with("line", finding.position.map(|position| position.line))
        .with("column", finding.position.map(|position| position.column))
        .0
}

fn bounds(bounds: &Aabb) -> JsValue {
    if bounds.is_empty() {
        return JsValue::NULL;
    }
    Fields::new()
        .with("min", vector(bounds.min))
        .with("max", vector(bounds.max))
        .done()
}

fn vector(vector: glam::Vec3) -> Array {
    numbers(vector.to_array())
}

fn numbers(numbers: impl IntoIterator<Item = f32>) -> Array {
    numbers.into_iter().map(JsValue::from).collect()
}

fn name_of<T: Copy + PartialEq>(names: &[(T, &'static str)], value: T) -> &'static str {
    let named = names.iter().find(|(named, _)| *named == value);
    named.map_or("", |(_, name)| name)
}

/// The value that has this name.
pub(super) fn named<T: Copy>(names: &[(T, &str)], wanted: &str) -> Option<T> {
    let named = names.iter().find(|(_, name)| *name == wanted);
    named.map(|(value, _)| *value)
}
