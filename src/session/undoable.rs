//! The parts of a session that can be undone: copies of them, what differs between two, and how they are restored.

use std::collections::{BTreeMap, BTreeSet};
use std::mem::discriminant;
use std::sync::Arc;

use super::clip_swap::ClipSwap;
use super::materials::Materials;
use super::open_model::OpenModel;
use super::submeshes::Visibility;
use super::{Event, Session};
use crate::anim::WrapMode;
use crate::model::{Handedness, JointNames, Material, UpAxis};

/// A copy of all that can be undone. Large parts are shared with the session.
pub(super) struct Undoable {
    open: Option<Arc<OpenModel>>,
    materials: Materials,
    names: Arc<JointNames>,
    visibility: Visibility,
    range: ClipRange,
    wrap_mode: WrapMode,
    handedness: Option<Handedness>,
    up_axis: Option<UpAxis>,
    normal_green_flipped: bool,
}

/// The range, which belongs to the clip on show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ClipRange {
    clip: Option<usize>,
    secs: Option<[f32; 2]>,
}

/// A thing that was changed, with the value that it had.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Material {
        index: usize,
        material: Material,
    },
    /// Names of bones, by their numbers in the file.
    Names(BTreeMap<usize, Option<String>>),
    Visibility(Visibility),
    Range(ClipRange),
    WrapMode(WrapMode),
    Handedness(Option<Handedness>),
    UpAxis(Option<UpAxis>),
    NormalGreenFlipped(bool),
}

/// A name, cut where it is too long for a line of a menu.
pub(super) fn brief(name: &str) -> String {
    const MOST_CHARS: usize = 24;
    if name.chars().count() <= MOST_CHARS {
        return name.to_owned();
    }
    let mut cut: String = name.chars().take(MOST_CHARS - 1).collect();
    cut.push('…');
    cut
}

impl Value {
    /// Whether both are values of one thing.
    pub(super) fn is_of_the_same_thing_as(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Material { index, .. }, Self::Material { index: of_other, .. }) => index == of_other,
            (Self::Names(names), Self::Names(of_other)) => names.keys().eq(of_other.keys()),
            _ => discriminant(self) == discriminant(other),
        }
    }

    /// The present value of the same thing.
    pub(super) fn now(&self, session: &Session) -> Self {
        match self {
            Self::Material { index, material } => Self::Material {
                index: *index,
                material: session.materials().get(*index).unwrap_or(material).clone(),
            },
            Self::Names(names) => {
                let all = session.joint_names().all();
                Self::Names(names.keys().map(|bone| (*bone, all.get(bone).cloned())).collect())
            }
            Self::Visibility(_) => Self::Visibility(session.submeshes().visibility().clone()),
            Self::Range(_) => Self::Range(session.clip_range()),
            Self::WrapMode(_) => Self::WrapMode(session.playback().wrap_mode()),
            Self::Handedness(_) => Self::Handedness(session.handedness_override()),
            Self::UpAxis(_) => Self::UpAxis(session.up_axis_override()),
            Self::NormalGreenFlipped(_) => Self::NormalGreenFlipped(session.look().normal_green_flipped),
        }
    }

    /// Gives the thing this value.
    pub(super) fn restore(self, session: &mut Session) {
        match self {
            Self::Material { index, material } => {
                session.content.changes.materials |= session.content.materials.replace(index, material);
            }
            Self::Names(names) => {
                let mut all = session.joint_names().clone();
                for (bone, name) in names {
                    all.set(bone as u32, &name.unwrap_or_default());
                }
                session.replace_names(all);
            }
            Self::Visibility(visibility) => session.selection.submeshes.set_visibility(visibility),
            Self::Range(range) => session.set_clip_range(range),
            Self::WrapMode(mode) => session.actors.picked_mut().playback.set_wrap_mode(mode),
            Self::Handedness(handedness) => {
                session.view.handedness = handedness;
                session.change_goal(Session::frame_model);
            }
            Self::UpAxis(up_axis) => {
                session.view.up_axis = up_axis;
                session.change_goal(Session::frame_model);
            }
            Self::NormalGreenFlipped(flipped) => session.view.look.normal_green_flipped = flipped,
        }
    }
}

impl Session {
    pub(super) fn undoable(&self) -> Undoable {
        Undoable {
            open: self.content.open.clone(),
            materials: self.content.materials.clone(),
            names: Arc::clone(&self.content.names),
            visibility: self.submeshes().visibility().clone(),
            range: self.clip_range(),
            wrap_mode: self.playback().wrap_mode(),
            handedness: self.handedness_override(),
            up_axis: self.up_axis_override(),
            normal_green_flipped: self.look().normal_green_flipped,
        }
    }

    /// The values that lead back to what was before.
    pub(super) fn values_to(&self, before: &Undoable) -> Vec<Value> {
        let mut values = Vec::new();
        for (index, (now, then)) in self.materials().iter().zip(before.materials.drawn()).enumerate() {
            if now != then {
                let material = then.clone();
                values.push(Value::Material { index, material });
            }
        }
        if self.content.names != before.names {
            let (now, then) = (self.joint_names().all(), before.names.all());
            let bones: BTreeSet<usize> = now.keys().chain(then.keys()).copied().collect();
            let changed = bones.into_iter().filter(|bone| now.get(bone) != then.get(bone));
            values.push(Value::Names(
                changed.map(|bone| (bone, then.get(&bone).cloned())).collect(),
            ));
        }
        let others = [
            Value::Visibility(before.visibility.clone()),
            Value::WrapMode(before.wrap_mode),
            Value::Handedness(before.handedness),
            Value::UpAxis(before.up_axis),
            Value::NormalGreenFlipped(before.normal_green_flipped),
        ];
        values.extend(others.into_iter().filter(|value| value.now(self) != *value));
        if self.clip_range().secs != before.range.secs {
            values.push(Value::Range(before.range));
        }
        values
    }

    /// The clips that lead back to what was before; `None` where they are the same.
    pub(super) fn clips_to(&self, before: &Undoable) -> Option<ClipSwap> {
        let (now, then) = (self.content.open.as_ref()?, before.open.as_ref()?);
        let same = Arc::ptr_eq(now, then);
        (!same).then(|| ClipSwap::between(now, then)).flatten()
    }

    /// What was done, in the words of a person. `clips` and `values` lead back to what was before.
    pub(super) fn label_since(&self, clips: Option<&ClipSwap>, values: &[Value]) -> String {
        match (clips.zip(self.open_model()), values) {
            (Some((clips, open)), _) => clips.label(open),
            (None, [value]) => self.label_of(value),
            (None, _) => "change the view".to_owned(),
        }
    }

    fn label_of(&self, value: &Value) -> String {
        match value {
            Value::Material { index, material } => {
                let verb = if self.is_edited(*index) { "edit" } else { "reset" };
                format!("{verb} {}", brief(&material.name))
            }
            Value::Names(names) => match names.first_key_value() {
                Some((&bone, _)) if names.len() == 1 => match self.joint_names().get(bone as u32) {
                    Some(name) => format!("name bone {bone} {}", brief(name)),
                    None => format!("remove the name of bone {bone}"),
                },
                _ => format!("name {} bones", names.len()),
            },
            Value::Visibility(then) => self.label_of_visibility(then),
            Value::Range(_) if self.playback().range_secs().is_none() => "clear the range".to_owned(),
            Value::Range(_) => "set the range".to_owned(),
            Value::WrapMode(_) => format!("loop: {}", self.playback().wrap_mode().label()),
            Value::Handedness(_) => "set the handedness".to_owned(),
            Value::UpAxis(_) => "set the up axis".to_owned(),
            Value::NormalGreenFlipped(_) => "flip green of normal maps".to_owned(),
        }
    }

    fn label_of_visibility(&self, then: &Visibility) -> String {
        let submeshes = self.submeshes();
        let name = |index: usize| {
            let open = self.open_model()?;
            let submesh = open.model.mesh.submeshes.get(index)?;
            Some(brief(&self.materials().get(submesh.material as usize)?.name))
        };
        let name = |index| name(index).unwrap_or_default();
        let was_left_out = then.left_out();
        let differ = |&index: &usize| submeshes.left_out().get(index) != was_left_out.get(index);
        let changed: Vec<usize> = (0..submeshes.count()).filter(differ).collect();
        match (submeshes.solo(), &*changed) {
            (Some(solo), _) if then.solo != Some(solo) => format!("show {} alone", name(solo)),
            (_, &[index]) if submeshes.is_visible(index) => format!("show {}", name(index)),
            (_, &[index]) => format!("hide {}", name(index)),
            _ if !submeshes.left_out().contains(&true) => "show all subsets".to_owned(),
            _ => "show other subsets".to_owned(),
        }
    }

    fn clip_range(&self) -> ClipRange {
        ClipRange {
            clip: self.clip_index(),
            secs: self.playback().range_secs(),
        }
    }

    /// Shows the clip of the range, if another is on show, with the range.
    fn set_clip_range(&mut self, ClipRange { clip, secs }: ClipRange) {
        if let (Some(clip), Some(open)) = (clip, self.content.open.clone())
            && self.clip_index() != Some(clip)
        {
            let actor = self.actors.picked_mut();
            actor.fade_to(clip, true);
            actor.show_clip(&open, clip);
            self.note(Event::TimeUpdate);
        }
        let playback = &mut self.actors.picked_mut().playback;
        playback.clear_range();
        if let Some([start_secs, end_secs]) = secs {
            playback.set_range_end(end_secs);
            playback.set_range_start(start_secs);
        }
    }
}
