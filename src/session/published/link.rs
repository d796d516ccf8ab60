//! What stands behind `#` in an address: what a session shows, as far as it differs from a first visit of the model, as `name=value` joined
//! by `&`.

use std::collections::BTreeSet;

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::view_state::{CameraState, ViewState};
use crate::scene::{Camera, Light};
use crate::session::Session;
use crate::session::look::quality::QualityMode;

/// The most characters of an address with a link: some programs with which people send addresses cut longer ones off.
pub const MAX_LINK_LEN: usize = 2_000;

/// What a link says.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Linked {
    /// How the model is looked at.
    pub view: ViewState,
    /// How much detail is drawn.
    pub quality: QualityMode,
    /// Open panels, by the names that the interface gives them.
    pub panels: Vec<String>,
}

/// A link, and the names of what it has no room for.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Link {
    /// What stands behind `#`.
    pub text: String,
    /// The longest fields, if the link became too long.
    pub left_out: Vec<&'static str>,
}

/// The names of all fields.
pub fn names() -> impl Iterator<Item = &'static str> {
    FIELDS.iter().map(|(name, ..)| *name).chain([CAMERA])
}

/// A field: its name in links, where it stands in [`Linked`] as a JSON pointer, and how it is written.
type Field = (&'static str, &'static str, Form);

/// How a field is written.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    /// As it is. An empty text where there is no value.
    Text,
    /// 1 or 0.
    Flag,
    /// In the fewest digits that are read as the same number.
    Number,
    /// An angle in radians, written in degrees.
    Degrees,
    /// Names or numbers, with commas between them.
    List,
    /// A name and a number.
    Pair,
    /// Numbers, by the names of the object's fields.
    Object(&'static [&'static str]),
    /// A colour without its `#`, or a name.
    Color,
}

/// All but the camera's, in the order of writing.
const FIELDS: &[Field] = &[
    ("clip", "/view/playback/clip", Form::Text),
    ("t", TIME, Form::Number),
    (PLAYING, "/view/playback/playing", Form::Flag),
    ("back", "/view/playback/backward", Form::Flag),
    ("speed", "/view/playback/speed", Form::Number),
    ("loop", "/view/playback/loopMode", Form::Text),
    ("wrap", "/view/playback/wrapMode", Form::Text),
    ("range", "/view/playback/rangeSecs", Form::List),
    ("blend", "/view/playback/blend", Form::Pair),
    ("fade", "/view/playback/crossfadeSecs", Form::Number),
    ("bind", "/view/playback/bindWeight", Form::Number),
    ("bone", "/view/selection/bone", Form::Number),
    ("vertex", "/view/selection/vertex", Form::Number),
    ("subset", "/view/selection/subset", Form::Number),
    ("hide", "/view/selection/hiddenSubsets", Form::List),
    ("solo", "/view/selection/soloSubset", Form::Number),
    ("skin", "/view/appearance/skinView", Form::Text),
    ("bones", "/view/appearance/bonesVisible", Form::Flag),
    ("bonestyle", "/view/appearance/boneStyle", Form::Text),
    ("labels", "/view/appearance/labelsVisible", Form::Flag),
    ("trails", "/view/appearance/trails", Form::List),
    (
        "ghosts",
        "/view/appearance/ghosts",
        Form::Object(&["before", "after", "stepFrames"]),
    ),
    ("bindghost", "/view/appearance/bindGhost", Form::Flag),
    ("light", "/view/appearance/light", Form::Text),
    ("split", "/view/appearance/split", Form::Number),
    ("view", "/view/appearance/viewMode", Form::Text),
    ("bg", "/view/appearance/background", Form::Color),
    ("overlay", "/view/appearance/overlays", Form::List),
    ("lines", "/view/appearance/lineLength", Form::Number),
    ("exposure", "/view/appearance/exposureStops", Form::Number),
    ("env", "/view/appearance/environmentTurnRadians", Form::Degrees),
    ("lamps", "/view/appearance/bookLightsTurnRadians", Form::Degrees),
    ("ground", "/view/appearance/groundOffset", Form::Number),
    ("green", "/view/appearance/normalGreenFlipped", Form::Flag),
    ("hand", "/view/appearance/handedness", Form::Text),
    ("up", "/view/appearance/upAxis", Form::Text),
    ("crowd", "/view/crowd/count", Form::Number),
    ("seed", "/view/crowd/seed", Form::Number),
    ("instance", "/view/crowd/selected", Form::Number),
    ("ortho", "/view/camera/orthographic", Form::Flag),
    ("turntable", "/view/camera/turntable", Form::Flag),
    ("quality", "/quality", Form::Text),
    ("panel", "/panels", Form::List),
];

/// The name of the field that says whether time moves.
const PLAYING: &str = "play";

/// Where the time stands. A link without it is about the start of its clip.
const TIME: &str = "/view/playback/timeSecs";

/// Yaw and pitch in degrees; then, unless the model is framed, the distance and the target. Without a target it stays where it is.
const CAMERA: &str = "cam";

/// Names of clips are readable as far as an address may have their characters.
const ENCODED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'_').remove(b'.').remove(b'~');

impl Session {
    /// The link to what this session shows with these panels open. It is at most `max_len` bytes long: the longest fields are left out then.
    pub fn link(&self, panels: Vec<String>, max_len: usize) -> Link {
        if self.open_model().is_none() {
            return Link::default();
        }
        let mut now = Linked {
            view: self.view_state(),
            quality: self.quality.mode(),
            panels,
        };
        let look = &mut now.view.appearance;
        if look.light == Light::Studio && look.split.is_none() {
            // The book's lights turn while a clip plays, also where nobody sees them.
            look.book_lights_turn_radians = 0.0;
        }
        let mut first = self.first_visit();
        let playback = &mut first.view.playback;
        playback.time_secs = self.start_secs(&now.view).unwrap_or(playback.time_secs);
        // The link is for everyone, also where motion is not reduced.
        playback.playing = self.content.clip_count() > 0;
        fitting(self.fields(&now, &first), max_len)
    }

    /// What a link says of the open model, and the names of what in it is damaged, unknown or not of this model.
    pub fn read_link(&self, text: &str) -> (Linked, Vec<String>) {
        let mut linked = self.first_visit();
        let mut left_out = BTreeSet::new();
        let mut camera = None;
        let mut has_time = false;
        // No page writes one so long. Each field costs time.
        let (text, rest) = text.split_at(text.floor_char_boundary(2 * MAX_LINK_LEN));
        left_out.extend((!rest.is_empty()).then(|| format!("all behind {} characters", 2 * MAX_LINK_LEN)));
        for field in text.split('&').filter(|field| !field.is_empty()) {
            let (name, value) = field.split_once('=').unwrap_or((field, ""));
            let understood = match FIELDS.iter().find(|(known, ..)| *known == name) {
                Some((_, place, form)) => {
                    has_time |= *place == TIME;
                    form.read(value).and_then(|value| with(&linked, place, value))
                }
                None if name == CAMERA => read_camera(value).map(|read| {
                    camera = Some(read);
                    linked.clone()
                }),
                None => None,
            };
            match understood {
                Some(understood) => linked = understood,
                None => _ = left_out.insert(shortened(name)),
            }
        }
        left_out.extend(self.forget_foreign(&mut linked.view).into_iter().map(str::to_owned));
        if !has_time && let Some(start_secs) = self.start_secs(&linked.view) {
            linked.view.playback.time_secs = start_secs;
        }
        if let Some(read) = camera {
            read.apply(&mut linked.view.camera, self.view.camera.target.to_array());
        }
        (linked, left_out.into_iter().collect())
    }

    /// What somebody sees who opens this model with nothing chosen before.
    fn first_visit(&self) -> Linked {
        let mut view = ViewState::default();
        if let Some(clip) = self.content.clips().first() {
            view.playback.clip = Some(clip.name.clone());
            view.playback.playing = !self.reduced_motion;
            view.playback.time_secs = clip.start_secs;
        }
        // Framed, wherever that is in this window.
        (view.camera.framed, view.camera.distance) = (true, 0.0);
        Linked {
            view,
            ..Linked::default()
        }
    }

    /// The fields in which `now` differs from a first visit.
    fn fields(&self, now: &Linked, first: &Linked) -> Vec<(&'static str, String)> {
        let [now_json, first_json] = [now, first].map(|linked| json!(linked));
        let mut fields = Vec::new();
        for (name, place, form) in FIELDS {
            let [now, first] = [&now_json, &first_json].map(|json| json.pointer(place).unwrap_or(&Value::Null));
            if now != first
                && let Some(text) = form.written(now)
            {
                fields.push((*name, text));
            }
        }
        fields.extend(self.written_camera().map(|text| (CAMERA, text)));
        if self.reduced_motion {
            // Here it stands still at first, and elsewhere it plays.
            if now.view.playback.playing {
                fields.push((PLAYING, "1".to_owned()));
            } else if matches!(fields[..], [(PLAYING, _)]) {
                fields.clear();
            }
        }
        fields
    }

    /// Nothing for the camera of a first visit. A model that is framed is so in any window, so its distance is not written.
    fn written_camera(&self) -> Option<String> {
        let (now, first) = (&self.view.camera, Camera::default());
        let [angles, first_angles] = [now, &first].map(|camera| [camera.yaw_radians, camera.pitch_radians]);
        let mut numbers = angles.map(degrees).to_vec();
        if self.view.framed {
            return (angles != first_angles).then(|| numbers.join(","));
        }
        let lengths = [now.distance].into_iter().chain(now.target.to_array());
        numbers.extend(lengths.map(|number| number.to_string()));
        Some(numbers.join(","))
    }

    /// Where the clip of a state starts, seconds.
    fn start_secs(&self, view: &ViewState) -> Option<f32> {
        let name = view.playback.clip.as_ref()?;
        let clip = self.content.clips().iter().find(|clip| clip.name == *name)?;
        Some(clip.start_secs)
    }

    /// Takes out of a state what the open model does not have. Returns the names of those fields.
    fn forget_foreign(&self, view: &mut ViewState) -> Vec<&'static str> {
        let clips = self.content.clips();
        let has_clip = |name: &String| clips.iter().any(|clip| clip.name == *name);
        let submesh_count = self.submeshes().count();
        let (open, first) = (self.open_model(), clips.first());
        let bone_count = open.map_or(0, |open| open.model.skeleton.joint_of_bone().len());
        let vertex_count = open.map_or(0, |open| open.model.mesh.vertex_count());
        let has_bone = |bone: &u32| (*bone as usize) < bone_count;
        let has_submesh = |submesh: &usize| *submesh < submesh_count;
        let ViewState {
            appearance,
            playback,
            selection,
            ..
        } = view;
        let hidden = selection.hidden_subsets.len();
        let trails = appearance.trails.len();
        selection.hidden_subsets.retain(has_submesh);
        appearance.trails.retain(has_bone);
        let mut foreign = vec![
            ("hide", selection.hidden_subsets.len() < hidden),
            ("trails", appearance.trails.len() < trails),
            ("bone", selection.bone.take_if(|bone| !has_bone(bone)).is_some()),
            (
                "vertex",
                selection
                    .vertex
                    .take_if(|vertex| *vertex as usize >= vertex_count)
                    .is_some(),
            ),
            (
                "subset",
                selection.subset.take_if(|subset| !has_submesh(subset)).is_some(),
            ),
            (
                "solo",
                selection.solo_subset.take_if(|subset| !has_submesh(subset)).is_some(),
            ),
            ("blend", playback.blend.take_if(|(name, _)| !has_clip(name)).is_some()),
        ];
        if playback.clip.take_if(|name| !has_clip(name)).is_some() {
            playback.clip = first.map(|clip| clip.name.clone());
            foreign.push(("clip", true));
        }
        foreign.retain(|(_, is_foreign)| *is_foreign);
        foreign.into_iter().map(|(name, _)| name).collect()
    }
}

/// What a link says of a camera: yaw and pitch, radians; distance; target.
#[derive(Clone, Copy)]
struct LinkedCamera {
    angles_radians: [f32; 2],
    distance: Option<f32>,
    target: Option<[f32; 3]>,
}

impl LinkedCamera {
    fn apply(self, camera: &mut CameraState, target_now: [f32; 3]) {
        [camera.yaw_radians, camera.pitch_radians] = self.angles_radians;
        camera.framed = self.distance.is_none();
        camera.distance = self.distance.unwrap_or(0.0);
        camera.target = self.target.unwrap_or(target_now);
    }
}

fn read_camera(text: &str) -> Option<LinkedCamera> {
    let numbers: Vec<&str> = text.split(',').collect();
    let [yaw, pitch, rest @ ..] = numbers.as_slice() else {
        return None;
    };
    let lengths: Vec<f32> = rest.iter().map(|text| read_number(text)).collect::<Option<_>>()?;
    let (distance, target) = match lengths[..] {
        [] => (None, None),
        [distance] => (Some(distance), None),
        [distance, x, y, z] => (Some(distance), Some([x, y, z])),
        _ => return None,
    };
    (distance.is_none_or(|distance| distance > 0.0)).then_some(LinkedCamera {
        angles_radians: [read_degrees(yaw)?, read_degrees(pitch)?],
        distance,
        target,
    })
}

/// Joins fields. Where they are too long, the longest are left out.
fn fitting(mut fields: Vec<(&'static str, String)>, max_len: usize) -> Link {
    let mut left_out = Vec::new();
    let len = |(name, text): &(&str, String)| name.len() + text.len() + "=&".len();
    while fields.iter().map(len).sum::<usize>() > max_len + 1 {
        let longest = (0..fields.len()).max_by_key(|&index| len(&fields[index]));
        let Some(longest) = longest else { break };
        left_out.push(fields.remove(longest).0);
    }
    let fields = fields.into_iter().map(|(name, text)| format!("{name}={text}"));
    Link {
        text: fields.collect::<Vec<_>>().join("&"),
        left_out,
    }
}

/// A state with another value of one field, if it can have it.
fn with(linked: &Linked, place: &str, value: Value) -> Option<Linked> {
    let mut json = json!(linked);
    *json.pointer_mut(place)? = value;
    serde_json::from_value(json).ok()
}

impl Form {
    fn written(self, value: &Value) -> Option<String> {
        let text = |text: &str| utf8_percent_encode(text, ENCODED).to_string();
        Some(match (self, value) {
            (_, Value::Null) => String::new(),
            (Self::Text, Value::String(name)) => text(name),
            (Self::Color, Value::String(name)) => text(name.trim_start_matches('#')),
            (Self::Flag, Value::Bool(flag)) => u8::from(*flag).to_string(),
            (Self::Number, Value::Number(_)) => number(value)?,
            (Self::Degrees, Value::Number(radians)) => degrees(radians.as_f64()? as f32),
            (Self::List | Self::Pair, Value::Array(items)) => {
                let items = items
                    .iter()
                    .map(|item| item.as_str().map(text).or_else(|| number(item)));
                items.collect::<Option<Vec<_>>>()?.join(",")
            }
            (Self::Object(names), Value::Object(fields)) => {
                let numbers = names.iter().map(|name| number(fields.get(*name)?));
                numbers.collect::<Option<Vec<_>>>()?.join(",")
            }
            _ => return None,
        })
    }

    fn read(self, written: &str) -> Option<Value> {
        let text = |written: &str| Some(percent_decode_str(written).decode_utf8().ok()?.into_owned());
        let number = |written: &str| match written.parse::<u64>() {
            Ok(whole) => Some(json!(whole)),
            Err(_) => Some(json!(read_number(written)?)),
        };
        let has_none = matches!(self, Self::Text | Self::Number | Self::Pair | Self::Object(_));
        if written.is_empty() && has_none {
            return Some(Value::Null);
        }
        Some(match self {
            Self::Text => json!(text(written)?),
            Self::Color if is_color(written) => json!(format!("#{written}")),
            Self::Color => json!(text(written)?),
            Self::Flag => match written {
                "1" => json!(true),
                "0" => json!(false),
                _ => return None,
            },
            Self::Number => number(written)?,
            Self::Degrees => json!(read_degrees(written)?),
            Self::List if written.is_empty() => json!([]),
            Self::List => {
                let items = written
                    .split(',')
                    .map(|item| number(item).or_else(|| Some(json!(text(item)?))));
                Value::Array(items.collect::<Option<_>>()?)
            }
            Self::Pair => {
                let (name, weight) = written.rsplit_once(',')?;
                json!([text(name)?, read_number(weight)?])
            }
            Self::Object(names) => {
                let numbers: Vec<Value> = written.split(',').map(number).collect::<Option<_>>()?;
                let fields = names.iter().map(|name| (*name).to_owned()).zip(numbers.iter().cloned());
                let fits = numbers.len() == names.len();
                fits.then(|| Value::Object(fields.collect()))?
            }
        })
    }
}

fn is_color(text: &str) -> bool {
    text.len() == 6 && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// A name of a damaged link, as far as it can be shown.
fn shortened(name: &str) -> String {
    let plain = name.chars().filter(|char| char.is_alphanumeric());
    plain.take(16).collect()
}

/// The fewest digits that are read as the same number.
fn number(value: &Value) -> Option<String> {
    match value.as_u64() {
        Some(whole) => Some(whole.to_string()),
        None => Some((value.as_f64()? as f32).to_string()),
    }
}

fn read_number(text: &str) -> Option<f32> {
    text.parse::<f32>().ok().filter(|number| number.is_finite())
}

/// An angle in the fewest digits that are read as the same.
fn degrees(radians: f32) -> String {
    let degrees = f64::from(radians).to_degrees();
    let written = (0..9).map(|digits| format!("{degrees:.digits$}"));
    let mut exact = written.filter(|text| read_degrees(text) == Some(radians));
    exact.next().unwrap_or_else(|| degrees.to_string())
}

fn read_degrees(text: &str) -> Option<f32> {
    let degrees = text.parse::<f64>().ok()?;
    Some(degrees.to_radians() as f32).filter(|radians| radians.is_finite())
}
