//! What stands behind `#` in an address: what a session shows, as far as it differs from a first visit of the model, as `name=value` joined
//! by `&`.

use std::collections::BTreeMap;

use percent_encoding::percent_decode_str;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::link_fields::{CAMERA, FIELDS, PLAYING, TIME, degrees, read_degrees, read_number};
use super::view_state::{CameraState, ViewState};
use crate::model::Clip;
use crate::scene::{Camera, Light, ViewPreset};
use crate::session::Session;
use crate::session::look::framing::is_same_shape;
use crate::session::look::quality::QualityMode;
use crate::session::look::view::Framed;

/// The most characters of an address with a link: some programs with which people send addresses cut longer ones off.
pub const MAX_LINK_LEN: usize = 2_000;

/// The most characters of a value that is told of.
const MOST_OF_VALUE: usize = 24;

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

impl Session {
    /// The link to what this session shows with these panels open. It is at most `max_len` bytes long: the longest fields are left out then.
    pub fn link(&self, panels: Vec<String>, max_len: usize) -> Link {
        if self.open_model().is_none() {
            return Link::default();
        }
        let mut now = self.seen_now(panels);
        let look = &mut now.view.appearance;
        if look.light == Light::Studio && look.split.is_none() {
            // The book's lights turn while a clip plays, also where nobody sees them.
            look.book_lights_turn_radians = 0.0;
        }
        let mut first = self.first_visit();
        let playback = &mut first.view.playback;
        playback.time_secs = self
            .clip_of(&now.view)
            .map_or(playback.time_secs, |clip| clip.start_secs);
        // The link is for everyone, also where motion is not reduced.
        playback.playing = self.content.clip_count() > 0;
        fitting(self.fields(&now, &first), max_len)
    }

    /// What a link says of the open model, and the fields of it that are damaged, unknown or not of this model, cut short.
    pub fn read_link(&self, text: &str) -> (Linked, Vec<String>) {
        let (linked, left_out) = self.read_fields(text, self.first_visit(), false);
        (linked, told(left_out))
    }

    /// The same where what it does not name, or names wrongly, stays as it is now, with these panels open. Another clip begins at its start.
    pub fn read_change(&self, text: &str, panels: &[String]) -> (Linked, Vec<String>) {
        let name = |field: &str| field.split('=').next().unwrap_or_default().to_owned();
        let has_no_clip = |text: &str| !text.split('&').any(|field| name(field) == "clip");
        let now = || self.seen_now(panels.to_vec());
        let (_, left_out) = self.read_fields(text, now(), has_no_clip(text));
        let understood: Vec<_> = text
            .split('&')
            // A time beyond the clip is its end.
            .filter(|field| name(field) == "t" || !left_out.contains_key(&name(field)))
            .collect();
        let understood = understood.join("&");
        let (linked, _) = self.read_fields(&understood, now(), has_no_clip(&understood));
        (linked, told(left_out))
    }

    fn seen_now(&self, panels: Vec<String>) -> Linked {
        Linked {
            view: self.view_state(),
            quality: self.quality.mode(),
            panels,
        }
    }

    /// What `linked` becomes by the fields of a link, and the values of those that are left out, by their names. Without `has_time` it stands
    /// at the clip's start, unless they say when.
    fn read_fields<'t>(&self, text: &'t str, mut linked: Linked, mut has_time: bool) -> (Linked, LeftOut<'t>) {
        let mut left_out = LeftOut::new();
        let mut said = BTreeMap::new();
        let mut camera = None;
        // No page writes one so long. Each field costs time.
        let (text, rest) = text.split_at(text.floor_char_boundary(2 * MAX_LINK_LEN));
        let behind = || (format!("all behind {} characters", 2 * MAX_LINK_LEN), None);
        left_out.extend((!rest.is_empty()).then(behind));
        for field in text.split('&').filter(|field| !field.is_empty()) {
            let given = field.split_once('=');
            let (name, value) = given.unwrap_or((field, ""));
            let understood = match FIELDS.iter().find(|(known, ..)| *known == name) {
                Some((_, place, form)) => {
                    let read = form.read(value).and_then(|value| with(&linked, place, value));
                    has_time |= *place == TIME && read.is_some();
                    read
                }
                None if name == CAMERA => read_camera(value).map(|read| {
                    camera = Some(read);
                    linked.clone()
                }),
                None => None,
            };
            match understood {
                Some(understood) => {
                    linked = understood;
                    said.insert(name, value);
                }
                None => _ = left_out.insert(shortened(name), given.map(|_| value)),
            }
        }
        let of_understood = |name: &'static str| (name.to_owned(), said.get(name).copied());
        left_out.extend(self.forget_foreign(&mut linked.view).into_iter().map(of_understood));
        if let Some(clip) = self.clip_of(&linked.view) {
            let time_secs = &mut linked.view.playback.time_secs;
            let within = time_secs.max(clip.start_secs).min(clip.end_secs);
            left_out.extend((has_time && within != *time_secs).then(|| of_understood("t")));
            *time_secs = if has_time { within } else { clip.start_secs };
        }
        if let Some(read) = camera {
            read.apply(
                &mut linked.view.camera,
                self.view.camera.target.to_array(),
                self.view.aspect,
            );
        }
        (linked, left_out)
    }

    fn shows_joined_clip(&self) -> bool {
        let facts = self.open_model().zip(self.clip_index());
        facts.is_some_and(|(open, clip)| open.clip_facts.get(clip).is_some_and(|facts| facts.joined))
    }

    fn first_clip(&self) -> Option<&Clip> {
        let open = self.open_model()?;
        open.model.clips.get(open.first_clip()?)
    }

    /// What somebody sees who opens this model with nothing chosen before.
    fn first_visit(&self) -> Linked {
        let mut view = ViewState::default();
        if let Some(clip) = self.first_clip() {
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
            // A clip that joined is none that everybody has who opens the model.
            if (now != first || (*name == "clip" && self.shows_joined_clip()))
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

    /// Nothing for the camera of a first visit. A model that is framed is so in any window, so its distance is not written. Where it was framed
    /// before the camera went round it, the distance is that of this picture, and holds for pictures of its shape.
    fn written_camera(&self) -> Option<String> {
        let (now, first) = (&self.view.camera, Camera::default());
        let [angles, first_angles] = [now, &first].map(|camera| [camera.yaw_radians, camera.pitch_radians]);
        let mut numbers = angles.map(degrees).to_vec();
        if self.is_framed_from_here() {
            return (angles != first_angles).then(|| numbers.join(","));
        }
        let lengths = [now.distance].into_iter().chain(now.target.to_array());
        let shape = match self.view.framed {
            Framed::No => None,
            Framed::Yes => Some(self.view.aspect),
            Framed::InShape(aspect) => Some(aspect),
        };
        numbers.extend(lengths.chain(shape).map(|number| number.to_string()));
        Some(numbers.join(","))
    }

    fn clip_of(&self, view: &ViewState) -> Option<&Clip> {
        let name = view.playback.clip.as_ref()?;
        self.content.clips().iter().find(|clip| clip.name == *name)
    }

    /// Takes out of a state what the open model does not have. Returns the names of those fields.
    fn forget_foreign(&self, view: &mut ViewState) -> Vec<&'static str> {
        let clips = self.content.clips();
        let has_clip = |name: &String| clips.iter().any(|clip| clip.name == *name);
        let submesh_count = self.submeshes().count();
        let (open, first) = (self.open_model(), self.first_clip());
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
        let in_place = playback.in_place.len();
        selection.hidden_subsets.retain(has_submesh);
        appearance.trails.retain(has_bone);
        playback.in_place.retain(has_clip);
        let mut foreign = vec![
            ("hide", selection.hidden_subsets.len() < hidden),
            ("trails", appearance.trails.len() < trails),
            ("inplace", playback.in_place.len() < in_place),
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
    /// Width / height of the picture in which the distance shows the model whole.
    aspect: Option<f32>,
}

impl LinkedCamera {
    /// In a picture of this shape. In one of another than the link's the model is framed anew.
    fn apply(self, camera: &mut CameraState, target_now: [f32; 3], aspect: f32) {
        let shows_whole = self.aspect.is_none_or(|of| is_same_shape(of, aspect));
        let distance = self.distance.filter(|_| shows_whole);
        [camera.yaw_radians, camera.pitch_radians] = self.angles_radians;
        camera.framed = distance.is_none() || self.aspect.is_some();
        camera.distance = distance.unwrap_or(0.0);
        camera.target = self.target.unwrap_or(target_now);
    }
}

fn read_camera(text: &str) -> Option<LinkedCamera> {
    if let Some(preset) = ViewPreset::from_name(text) {
        return Some(LinkedCamera {
            angles_radians: preset.yaw_pitch_radians().into(),
            distance: None,
            target: None,
            aspect: None,
        });
    }
    let numbers: Vec<&str> = text.split(',').collect();
    let [yaw, pitch, rest @ ..] = numbers.as_slice() else {
        return None;
    };
    let lengths: Vec<f32> = rest.iter().map(|text| read_number(text)).collect::<Option<_>>()?;
    let (distance, target, aspect) = match lengths[..] {
        [] => (None, None, None),
        [distance] => (Some(distance), None, None),
        [distance, x, y, z] => (Some(distance), Some([x, y, z]), None),
        [distance, x, y, z, aspect] => (Some(distance), Some([x, y, z]), Some(aspect)),
        _ => return None,
    };
    let are_above_0 = [distance, aspect].into_iter().flatten().all(|number| number > 0.0);
    are_above_0.then_some(LinkedCamera {
        angles_radians: [read_degrees(yaw)?, read_degrees(pitch)?],
        distance,
        target,
        aspect,
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

/// Fields of a link that are not followed: the value of each name, where it has one.
type LeftOut<'t> = BTreeMap<String, Option<&'t str>>;

/// They as they stand in the link, as far as they can be shown.
fn told(left_out: LeftOut<'_>) -> Vec<String> {
    let field = |(name, value): (String, Option<&str>)| {
        let Some(value) = value else { return name };
        let value = percent_decode_str(value).decode_utf8_lossy();
        let mut plain = value.chars().filter(|char| !char.is_control());
        let start: String = plain.by_ref().take(MOST_OF_VALUE).collect();
        format!("{name}={start}{}", if plain.next().is_some() { "…" } else { "" })
    };
    left_out.into_iter().map(field).collect()
}

/// A name of a damaged link, as far as it can be shown.
fn shortened(name: &str) -> String {
    let plain = name.chars().filter(|char| char.is_alphanumeric());
    plain.take(16).collect()
}
