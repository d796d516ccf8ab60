//! Undo and redo: the steps that can be taken back, and those that were.

use super::Session;
use super::clip_swap::ClipSwap;
use super::open_model::OpenModel;
use super::undoable::{Undoable, Value};
use crate::model::hierarchy_fingerprint;

/// Older steps are forgotten.
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
/// Steps are edits of materials, names of joints, which submeshes are shown, the range, added clips, and what was chosen instead of what
/// was found in the file. Playing, the camera, the selection and the look are no steps.
#[derive(Clone, Debug, Default)]
pub struct History {
    undo: Vec<Step>,
    redo: Vec<Step>,
    /// Between [`HistoryCommand::BeginEdit`] and [`HistoryCommand::EndEdit`].
    held: bool,
    /// The last step was done by what is held: more of the same belongs to it.
    grows: bool,
    last: Option<String>,
    revision: u64,
}

/// A change in the words of a person, and what brings it back. Undoing turns it into the step that does it again.
#[derive(Clone, Debug)]
struct Step {
    label: String,
    /// They come first: what else is restored may name a clip by its index.
    clips: Option<ClipSwap>,
    values: Vec<Value>,
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

    fn record(&mut self, step: Step) {
        self.redo.clear();
        self.last = None;
        match self.undo.last_mut() {
            // It holds the oldest value already.
            Some(last) if self.grows && last.is_about_the_same_as(&step) => last.label = step.label,
            _ => self.undo.push(step),
        }
        if self.undo.len() > MOST_STEPS {
            self.undo.remove(0);
        }
        self.grows = self.held;
    }

    fn tell(&mut self, words: &str, label: &str) {
        self.last = Some(format!("{words}: {label}"));
        self.revision += 1;
        self.grows = false;
    }
}

impl Session {
    /// What can be undone and redone.
    pub fn history(&self) -> &History {
        &self.history
    }

    pub(super) fn apply_to_history(&mut self, command: HistoryCommand) {
        match command {
            HistoryCommand::Undo => {
                if let Some(step) = self.history.undo.pop() {
                    self.history.tell("Undone", &step.label);
                    let step = self.swap(step);
                    self.history.redo.push(step);
                }
            }
            HistoryCommand::Redo => {
                if let Some(step) = self.history.redo.pop() {
                    self.history.tell("Redone", &step.label);
                    let step = self.swap(step);
                    self.history.undo.push(step);
                }
            }
            HistoryCommand::BeginEdit => (self.history.held, self.history.grows) = (true, false),
            HistoryCommand::EndEdit => {
                let grew = std::mem::take(&mut self.history.grows);
                self.history.held = false;
                if let Some(last) = self.history.undo.last()
                    && grew
                    && last.clips.is_none()
                    && last.values.iter().all(|value| value.now(self) == *value)
                {
                    self.history.undo.pop();
                }
            }
        }
    }

    /// Records what differs from before as a step.
    pub(super) fn record_step(&mut self, before: &Undoable) {
        let clips = self.clips_to(before);
        let values = self.values_to(before);
        if clips.is_some() || !values.is_empty() {
            let label = self.label_since(clips.as_ref(), &values);
            self.history.record(Step { label, clips, values });
        }
    }

    /// Restores what a step holds. Returns the step back.
    fn swap(&mut self, step: Step) -> Step {
        let clips = step.clips.map(|clips| self.swap_clips(clips));
        let swap = |value: Value| {
            let now = value.now(self);
            value.restore(self);
            now
        };
        let values = step.values.into_iter().map(swap).collect();
        Step { clips, values, ..step }
    }
}
