//! Sentences for screen readers: what has changed and is seen on the canvas alone.

use std::collections::BTreeMap;

use crate::actions::speed_label;
use crate::anim::{LoopMode, SkinView};
use crate::model::JointIndex;
use crate::scene::{Light, Overlay, Overlays, Projection, ViewMode};
use crate::session::{CrowdState, QualityMode, Session};

use crate::ui::kit::wording::{counted, grouped};
use crate::ui::window::message::Offer;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Announcement {
    /// One sentence or a few.
    pub text: String,
    /// It may interrupt what is being spoken.
    pub assertive: bool,
}

/// Compares a session with what it was, and has words for what differs.
#[derive(Debug, Default)]
pub(in crate::ui) struct Announcer {
    seen: Option<Seen>,
    said: Vec<String>,
    /// A sentence about what is not seen elsewhere, to be shown too.
    pub(in crate::ui) unseen: Option<(String, Option<Offer>)>,
    /// What a key changes next is not seen elsewhere.
    pub(in crate::ui) by_key: bool,
    names: BTreeMap<usize, String>,
    left_out: Vec<bool>,
    left_out_revision: u64,
}

/// What of a session is told of.
#[derive(Clone, Debug, Default, PartialEq)]
struct Seen {
    model: u64,
    is_open: bool,
    error: Option<String>,
    view_mode: ViewMode,
    skin_view: Option<SkinView>,
    light: Light,
    split: bool,
    joint: Option<JointIndex>,
    vertex: Option<u32>,
    submesh: Option<usize>,
    playing: bool,
    clip: Option<usize>,
    time_secs: f32,
    /// The device is too slow for all the detail, now or before with this model.
    lowered: bool,
    undone: u64,
    names: u64,
    speed: f32,
    loop_mode: LoopMode,
    orthographic: bool,
    left_out_revision: u64,
    overlays: Overlays,
    turntable: bool,
    crowd: CrowdState,
}

impl Seen {
    fn of(session: &Session, left_out_revision: u64) -> Self {
        let (look, playback, joints) = (session.look(), session.playback(), session.joints());
        let quality = session.quality();
        Self {
            model: session.model_revision(),
            is_open: session.open_model().is_some(),
            error: session
                .error()
                .map(|error| failure(session, &error.file_name, &error.diagnostic.message)),
            view_mode: look.view_mode,
            skin_view: look.skin_view,
            light: look.light,
            split: look.split.is_some(),
            joint: joints.selected(),
            vertex: joints.selected_vertex().map(|selected| selected.vertex),
            submesh: session.submeshes().selected(),
            playing: playback.is_playing(),
            clip: session.clip_index(),
            time_secs: playback.time_secs(),
            lowered: quality.mode() == QualityMode::Auto && quality.lowered().is_some(),
            undone: session.history().revision(),
            names: session.joint_names_revision(),
            speed: playback.speed(),
            loop_mode: playback.loop_mode(),
            orthographic: session.camera().projection == Projection::Orthographic,
            left_out_revision,
            overlays: look.overlays,
            turntable: session.turntable(),
            crowd: session.crowd(),
        }
    }
}

impl Announcer {
    /// Says a sentence with the next ones.
    pub(in crate::ui) fn say(&mut self, text: impl Into<String>) {
        self.said.push(text.into());
    }

    /// What there is to tell since the last call: at most one of each kind. A failure comes first.
    pub(in crate::ui) fn observe(&mut self, session: &Session) -> Vec<Announcement> {
        let left_out = session.submeshes().left_out();
        if self.left_out != left_out {
            self.left_out = left_out.to_vec();
            self.left_out_revision += 1;
        }
        let mut now = Seen::of(session, self.left_out_revision);
        let first = Seen {
            speed: now.speed,
            ..Seen::default()
        };
        let before = self.seen.take().unwrap_or(first);
        // Once for each model: detail comes and goes.
        now.lowered |= before.lowered && before.model == now.model;
        self.seen = Some(now.clone());
        let failure = now.error.clone().filter(|_| now.error != before.error);
        let mut sentences = changes(session, &before, &now);
        let undone = now.undone != before.undone;
        if (undone || std::mem::take(&mut self.by_key)) && now.model == before.model {
            // The last one is of what was undone.
            self.unseen = sentences.last().map(|sentence| (sentence.clone(), None));
        }
        if now.names != before.names || now.model != before.model {
            let names = session.joint_names().all();
            let names_before = std::mem::replace(&mut self.names, names.clone());
            // Names that were kept from another day are no step. What is undone has its own words.
            if now.model == before.model && !undone && session.history().undo_label().is_some() {
                let sentence = naming(&names_before, names);
                self.unseen = Some((sentence.clone(), Some(Offer::Undo)));
                sentences.push(sentence);
            }
        }
        self.said.extend(sentences);
        let sentences = std::mem::take(&mut self.said);
        let told = |text: String, assertive| (!text.is_empty()).then_some(Announcement { text, assertive });
        let failure = told(failure.unwrap_or_default(), true);
        failure.into_iter().chain(told(sentences.join(" "), false)).collect()
    }
}

/// Sentences about what differs, the most important first.
fn changes(session: &Session, before: &Seen, now: &Seen) -> Vec<String> {
    if now.model != before.model {
        // All else is new with it.
        return opened(session).into_iter().collect();
    }
    let mut sentences = Vec::new();
    if now.view_mode != before.view_mode {
        sentences.push(format!("View mode: {}.", now.view_mode.label()));
    }
    if now.skin_view != before.skin_view {
        sentences.push(match now.skin_view {
            Some(view) => format!("Colours of the skin: {}.", view.label()),
            None => "The skin as it is.".to_owned(),
        });
    }
    if (now.light, now.split) != (before.light, before.split) {
        sentences.push(match now.split {
            true => "Two lights, side by side.".to_owned(),
            false => format!("Light: {}.", now.light.label()),
        });
    }
    if (now.joint, now.vertex, now.submesh) != (before.joint, before.vertex, before.submesh) {
        sentences.push(selection(session, now));
    }
    if now.clip != before.clip
        && let Some(clip) = session.clip()
    {
        sentences.push(format!("Clip {}.", clip.name));
    }
    if now.playing != before.playing {
        sentences.push(if now.playing {
            "Playing.".to_owned()
        } else {
            format!("Paused at {}.", time(session))
        });
    } else if !now.playing && now.time_secs != before.time_secs && !session.is_scrubbing() {
        sentences.push(format!("{}.", time(session)));
    }
    if now.speed != before.speed {
        sentences.push(format!("Speed {}.", speed_label(now.speed)));
    }
    if now.loop_mode != before.loop_mode {
        sentences.push(format!("At the end: {}.", now.loop_mode.label()));
    }
    if now.orthographic != before.orthographic {
        let projection = if now.orthographic {
            "Orthographic"
        } else {
            "Perspective"
        };
        sentences.push(format!("{projection}."));
    }
    if now.lowered && !before.lowered {
        sentences.push("The picture has less detail while it moves, for speed.".to_owned());
    }
    if now.left_out_revision != before.left_out_revision {
        sentences.push(subsets(session, session.submeshes().left_out()));
    }
    let on_off = |on| if on { "on" } else { "off" };
    for overlay in Overlay::ALL {
        let on = now.overlays.has(overlay);
        if on != before.overlays.has(overlay) {
            sentences.push(format!("{} {}.", overlay.label(), on_off(on)));
        }
    }
    if now.turntable != before.turntable {
        sentences.push(format!("Turntable {}.", on_off(now.turntable)));
    }
    sentences.extend(crowd(&before.crowd, &now.crowd));
    if now.undone != before.undone
        && let Some(what) = session.history().last()
    {
        sentences.push(format!("{what}."));
    }
    sentences
}

fn opened(session: &Session) -> Option<String> {
    let open = session.open_model()?;
    let model = &open.model;
    let counts = [
        (model.mesh.submeshes.len(), "subset"),
        (session.joints().count(), "bone"),
        (model.clips.len(), "clip"),
    ];
    let counts: Vec<String> = counts
        .into_iter()
        .filter(|&(count, _)| count > 0)
        .map(|(count, word)| counted(count, word))
        .collect();
    let findings = match session.diagnostics().count() {
        0 => "no findings".to_owned(),
        count => counted(count, "finding"),
    };
    Some(format!(
        "{} is open: {}; {findings}.",
        open.file.base_name(),
        counts.join(", ")
    ))
}

fn failure(session: &Session, file_name: &str, message: &str) -> String {
    let subject = if file_name.is_empty() {
        String::new()
    } else {
        format!("{file_name} was not opened: ")
    };
    let stays = session
        .open_model()
        .map(|open| format!(" {} stays open.", open.file.base_name()));
    format!("{subject}{message}{}", stays.unwrap_or_default())
}

fn selection(session: &Session, now: &Seen) -> String {
    if let Some(vertex) = now.vertex {
        return format!("Vertex {}.", grouped(vertex as usize));
    }
    if let Some(joint) = now.joint {
        let name = session.joint_name(joint).map(|name| format!(" {name}"));
        return format!("Bone {}{}.", session.bone_number(joint), name.unwrap_or_default());
    }
    match now.submesh {
        Some(submesh) => format!("Subset {}.", session.submesh_name(submesh)),
        None => "Nothing is selected.".to_owned(),
    }
}

/// Which names bones got or lost.
fn naming(before: &BTreeMap<usize, String>, now: &BTreeMap<usize, String>) -> String {
    let given: Vec<_> = now
        .iter()
        .filter(|&(bone, name)| before.get(bone) != Some(name))
        .collect();
    let lost = before.keys().filter(|&bone| !now.contains_key(bone)).count();
    match (&given[..], lost) {
        ([(bone, name)], 0) => format!("Bone {bone} is named {name}."),
        (given, 0) => format!("{} are named.", counted(given.len(), "bone")),
        ([], lost) => format!("{} cleared.", counted(lost, "name")),
        (given, lost) => format!("{} changed.", counted(given.len() + lost, "name")),
    }
}

/// Which subsets are shown: those that are fewer are named, unless they are many.
fn subsets(session: &Session, left_out: &[bool]) -> String {
    const MOST_NAMES: usize = 3;
    let (hidden, shown): (Vec<usize>, Vec<usize>) = (0..left_out.len()).partition(|&index| left_out[index]);
    let names = |of: &[usize]| {
        let names: Vec<&str> = of.iter().map(|&index| session.submesh_name(index)).collect();
        names.join(", ")
    };
    match (hidden.len(), shown.len()) {
        (0, _) => "All subsets are shown.".to_owned(),
        (_, 0) => "All subsets are hidden.".to_owned(),
        (_, 1) => format!("Only {} is shown.", names(&shown)),
        (count, _) if count <= MOST_NAMES => format!("Hidden: {}.", names(&hidden)),
        (count, _) => format!("{} hidden.", counted(count, "subset")),
    }
}

/// How many there are, if that changed; or else which is selected.
fn crowd(before: &CrowdState, now: &CrowdState) -> Option<String> {
    let count = grouped(now.count);
    if now.count == 1 {
        (before.count > 1).then(|| "One model, no crowd.".to_owned())
    } else if now.count != before.count {
        Some(format!("A crowd of {count}."))
    } else if now.selected != before.selected {
        Some(format!("Number {} of {count}.", grouped(now.selected + 1)))
    } else {
        (now.seed != before.seed).then(|| format!("Another crowd of {count}, seed {}.", now.seed))
    }
}

fn time(session: &Session) -> String {
    let secs = session.playback().time_secs();
    match session.clip() {
        Some(clip) => format!("{secs:.2} s, frame {}", clip.frame_at(secs)),
        None => format!("{secs:.2} s"),
    }
}

/// What the view shows, for somebody who does not see it: `soldier.m3d, Take1, 0.90 s, weights of bone 50`.
pub fn view_in_words(session: &Session) -> String {
    let Some(open) = session.open_model() else {
        return "3D view, no model is open".to_owned();
    };
    let mut parts = vec![open.file.base_name().to_owned()];
    let crowd = session.crowd();
    if crowd.count > 1 {
        parts.push(format!("crowd of {}", grouped(crowd.count)));
    }
    if let Some(clip) = session.clip() {
        parts.push(clip.name.clone());
        parts.push(if session.playback().is_playing() {
            "playing".to_owned()
        } else {
            format!("{:.2} s", session.playback().time_secs())
        });
    }
    let look = session.look();
    let joint = session
        .joints()
        .selected()
        .map(|joint| match session.joint_name(joint) {
            Some(name) => name.to_owned(),
            None => format!("bone {}", session.bone_number(joint)),
        });
    match (look.skin_view, joint) {
        (Some(SkinView::Weight), Some(joint)) => parts.push(format!("weights of {joint}")),
        (Some(view), _) => parts.push(view.label().to_lowercase()),
        (None, Some(joint)) => parts.push(format!("{joint} selected")),
        (None, None) => {}
    }
    if look.skin_view.is_none() && look.view_mode != ViewMode::default() {
        parts.push(look.view_mode.label().to_lowercase());
    }
    parts.join(", ")
}
