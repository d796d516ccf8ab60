//! The steps that can be undone and redone, as plain data.

pub(super) mod step_labels;
pub(super) mod undoing;

use std::collections::BTreeMap;
use std::mem::discriminant;
use std::sync::Arc;

use super::choose::submeshes::Visibility;
use super::look::sky::Taken;
use super::open::clip_swap::ClipSwap;
use super::open::open_model::OpenModel;
use crate::anim::WrapMode;
use crate::model::{Handedness, Material, UpAxis, hierarchy_fingerprint};

const MOST_STEPS: usize = 100;

/// A command about what was done before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HistoryCommand {
    /// Takes the last step back.
    Undo,
    /// Does again what was undone last.
    Redo,
    /// A pointer, a key or a text field takes hold of a value: until [`HistoryCommand::EndEdit`], changes of one thing are one step.
    BeginEdit,
    /// It let go. A value that came back to what it was leaves no step.
    EndEdit,
}

/// The steps of a session that can be undone and redone. It belongs to the open model.
///
/// Steps are edits of materials, names of joints, which submeshes are shown, the range, added clips, the sky, and what was chosen
/// instead of what was found in the file. Playing, the camera, the selection and the look are no steps.
#[derive(Clone, Debug, Default)]
pub struct History {
    undo: Vec<Step>,
    redo: Vec<Step>,
    /// What could be redone before what is held did the last step.
    redo_before: Vec<Step>,
    /// Between [`HistoryCommand::BeginEdit`] and [`HistoryCommand::EndEdit`].
    held: bool,
    /// The last step was done by what is held: more of the same belongs to it.
    grows: bool,
    last: Option<String>,
    revision: u64,
}

/// A change in the words of a person, and what brings it back. Undoing turns it into the step that does it again.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) label: String,
    /// They come first: what else is restored may name a clip by its index.
    pub(super) clips: Option<ClipSwap>,
    pub(super) values: Vec<Value>,
}

impl Step {
    /// Whether another step changed the same things.
    fn is_about_the_same_as(&self, other: &Self) -> bool {
        let same = |(a, b): (&Value, &Value)| a.is_of_the_same_thing_as(b);
        self.clips.is_none()
            && other.clips.is_none()
            && self.values.len() == other.values.len()
            && self.values.iter().zip(&other.values).all(same)
    }
}

/// The range, which belongs to the clip on show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ClipRange {
    /// Of the model.
    pub(super) instance: usize,
    pub(super) clip: Option<usize>,
    pub(super) secs: Option<[f32; 2]>,
}

/// A thing that was changed, with the value that it had.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Material {
        index: usize,
        material: Box<Material>,
    },
    /// Names of bones, by their numbers in the file.
    Names(BTreeMap<usize, Option<String>>),
    Visibility(Arc<Visibility>),
    Range(ClipRange),
    WrapMode(WrapMode),
    Handedness(Option<Handedness>),
    UpAxis(Option<UpAxis>),
    NormalGreenFlipped(bool),
    Sky(Option<Arc<Taken>>),
}

impl Value {
    /// Whether both are values of one thing.
    fn is_of_the_same_thing_as(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Material { index, .. }, Self::Material { index: of_other, .. }) => index == of_other,
            (Self::Names(names), Self::Names(of_other)) => names.keys().eq(of_other.keys()),
            _ => discriminant(self) == discriminant(other),
        }
    }
}

impl History {
    /// What [`HistoryCommand::Undo`] would take back: `hide head`.
    pub fn undo_label(&self) -> Option<&str> {
        self.undo.last().map(|step| step.label.as_str())
    }

    /// What [`HistoryCommand::Redo`] would do again.
    pub fn redo_label(&self) -> Option<&str> {
        self.redo.last().map(|step| step.label.as_str())
    }

    /// What was undone or redone since the last other step: `Undone: hide head`.
    pub fn last(&self) -> Option<&str> {
        self.last.as_deref()
    }

    /// Counts what was undone and redone: another number, another [`History::last`], even where its words are the same.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Forgets all steps. What is held stays held.
    pub(super) fn clear(&mut self) {
        *self = Self {
            held: self.held,
            revision: self.revision,
            ..Self::default()
        };
    }

    /// Whether the steps of a model make sense for one that was read again: it has the same parts, and no step holds clips, which
    /// may be others now.
    pub(super) fn fits(&self, before: &OpenModel, open: &OpenModel) -> bool {
        let (model, model_before) = (&open.model, &before.model);
        model.materials == model_before.materials
            && model.mesh.submeshes.len() == model_before.mesh.submeshes.len()
            && hierarchy_fingerprint(&model.skeleton) == hierarchy_fingerprint(&model_before.skeleton)
            && open
                .clip_list()
                .map(|clip| clip.name)
                .eq(before.clip_list().map(|clip| clip.name))
            && !self.undo.iter().chain(&self.redo).any(|step| step.clips.is_some())
    }

    pub(super) fn record(&mut self, step: Step) {
        let redo = std::mem::take(&mut self.redo);
        self.last = None;
        match self.undo.last_mut() {
            // It holds the oldest value already.
            Some(last) if self.grows && last.is_about_the_same_as(&step) => last.label = step.label,
            _ => {
                self.undo.push(step);
                self.redo_before = redo;
            }
        }
        if self.undo.len() > MOST_STEPS {
            self.undo.remove(0);
        }
        self.grows = self.held;
    }

    /// Takes the last step, which will be undone.
    pub(super) fn begin_undo(&mut self) -> Option<Step> {
        let step = self.undo.pop()?;
        self.tell("Undone", &step.label);
        Some(step)
    }

    /// Keeps what does an undone step again.
    pub(super) fn end_undo(&mut self, back: Step) {
        self.redo.push(back);
    }

    /// Takes the step that was undone last, which will be redone.
    pub(super) fn begin_redo(&mut self) -> Option<Step> {
        let step = self.redo.pop()?;
        self.tell("Redone", &step.label);
        Some(step)
    }

    /// Keeps what undoes a redone step again.
    pub(super) fn end_redo(&mut self, back: Step) {
        self.undo.push(back);
    }

    pub(super) fn begin_edit(&mut self) {
        (self.held, self.grows) = (true, false);
    }

    /// Returns the step that was done by what was held, if there is one.
    pub(super) fn end_edit(&mut self) -> Option<&Step> {
        self.held = false;
        let grew = std::mem::take(&mut self.grows);
        self.undo.last().filter(|_| grew)
    }

    /// Forgets the last step where it changed nothing in the end, as if it had not been.
    pub(super) fn settle_edit(&mut self, is_back: bool) {
        let redo = std::mem::take(&mut self.redo_before);
        if is_back {
            self.undo.pop();
            self.redo = redo;
        }
    }

    fn tell(&mut self, words: &str, label: &str) {
        self.last = Some(format!("{words}: {label}"));
        self.revision += 1;
        self.grows = false;
    }
}
