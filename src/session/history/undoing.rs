//! Undo and redo: what a command changed becomes a step, and a step is taken back.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::anim::WrapMode;
use crate::model::{Handedness, JointNames, UpAxis};
use crate::session::choose::submeshes::Visibility;
use crate::session::history::{ClipRange, History, HistoryCommand, Step, Value};
use crate::session::look::materials::Materials;
use crate::session::look::sky::Taken;
use crate::session::open::clip_swap::ClipSwap;
use crate::session::open::open_model::OpenModel;
use crate::session::{Event, Session};

/// A copy of all that can be undone. Large parts are shared with the session.
pub(in crate::session) struct Undoable {
    open: Option<Arc<OpenModel>>,
    materials: Materials,
    names: Arc<JointNames>,
    visibility: Arc<Visibility>,
    range: ClipRange,
    wrap_mode: WrapMode,
    handedness: Option<Handedness>,
    up_axis: Option<UpAxis>,
    normal_green_flipped: bool,
    sky: Option<Arc<Taken>>,
}

impl Session {
    /// What can be undone and redone.
    pub fn history(&self) -> &History {
        &self.history
    }

    pub(in crate::session) fn apply_to_history(&mut self, command: HistoryCommand) {
        match command {
            HistoryCommand::Undo => {
                if let Some(step) = self.history.begin_undo() {
                    let back = self.swap(step);
                    self.history.end_undo(back);
                }
            }
            HistoryCommand::Redo => {
                if let Some(step) = self.history.begin_redo() {
                    let back = self.swap(step);
                    self.history.end_redo(back);
                }
            }
            HistoryCommand::BeginEdit => self.history.begin_edit(),
            HistoryCommand::EndEdit => {
                let values = self.history.end_edit().map_or(Vec::new(), |step| step.values.clone());
                let is_back = !values.is_empty() && values.iter().all(|value| self.now(value) == *value);
                self.history.settle_edit(is_back);
            }
        }
    }

    /// Records what differs from before as a step.
    pub(in crate::session) fn record_step(&mut self, before: &Undoable) {
        let clips = self.clips_to(before);
        let values = self.values_to(before);
        if clips.is_some() || !values.is_empty() {
            let label = self.label_of_step(clips.as_ref(), &values);
            self.history.record(Step { label, clips, values });
        }
    }

    /// Restores what a step holds. Returns the step back.
    fn swap(&mut self, step: Step) -> Step {
        let clips = step.clips.map(|clips| self.swap_clips(clips));
        let swap = |value: Value| {
            let now = self.now(&value);
            self.set(value);
            now
        };
        let values = step.values.into_iter().map(swap).collect();
        Step { clips, values, ..step }
    }

    /// The present value of the same thing.
    fn now(&self, value: &Value) -> Value {
        match value {
            Value::Material { index, material } => Value::Material {
                index: *index,
                material: self
                    .materials()
                    .get(*index)
                    .map_or_else(|| material.clone(), |now| Box::new(now.clone())),
            },
            Value::Names(names) => {
                let all = self.joint_names().all();
                Value::Names(names.keys().map(|bone| (*bone, all.get(bone).cloned())).collect())
            }
            Value::Visibility(_) => Value::Visibility(Arc::clone(self.submeshes().visibility())),
            Value::Range(range) => Value::Range(self.clip_range(range.instance)),
            Value::WrapMode(_) => Value::WrapMode(self.playback().wrap_mode()),
            Value::Handedness(_) => Value::Handedness(self.handedness_override()),
            Value::UpAxis(_) => Value::UpAxis(self.up_axis_override()),
            Value::NormalGreenFlipped(_) => Value::NormalGreenFlipped(self.look().normal_green_flipped),
            Value::Sky(_) => Value::Sky(self.content.sky.taken()),
        }
    }

    fn set(&mut self, value: Value) {
        match value {
            Value::Material { index, material } => {
                self.content.changes.materials |= self.content.materials.replace(index, *material);
            }
            Value::Names(names) => {
                let mut all = self.joint_names().clone();
                for (bone, name) in names {
                    all.set(bone as u32, &name.unwrap_or_default());
                }
                self.replace_names(all);
            }
            Value::Visibility(visibility) => self.selection.submeshes.set_visibility(visibility),
            Value::Range(range) => self.set_clip_range(range),
            Value::WrapMode(mode) => {
                self.actor.player.playback.set_wrap_mode(mode);
                self.instances.play_as(&self.actor.player);
            }
            Value::Handedness(handedness) => {
                self.view.handedness = handedness;
                self.change_goal(Self::frame_model);
            }
            Value::UpAxis(up_axis) => {
                self.view.up_axis = up_axis;
                self.change_goal(Self::frame_model);
            }
            Value::NormalGreenFlipped(flipped) => self.view.look.normal_green_flipped = flipped,
            Value::Sky(taken) => {
                self.content.sky.restore(taken, &mut self.view.look.background);
                self.content.changes.sky = true;
            }
        }
    }

    /// A copy of what can be undone, to compare with what is after a command.
    pub(in crate::session) fn undoable(&self) -> Undoable {
        Undoable {
            open: self.content.open.clone(),
            materials: self.content.materials.clone(),
            names: Arc::clone(&self.content.names),
            visibility: Arc::clone(self.submeshes().visibility()),
            range: self.clip_range(self.crowd().selected),
            wrap_mode: self.playback().wrap_mode(),
            handedness: self.handedness_override(),
            up_axis: self.up_axis_override(),
            normal_green_flipped: self.look().normal_green_flipped,
            sky: self.content.sky.taken(),
        }
    }

    /// The values that lead back to what was before.
    fn values_to(&self, before: &Undoable) -> Vec<Value> {
        let mut values = Vec::new();
        if !self.content.materials.are_shared_with(&before.materials) {
            for (index, (now, then)) in self.materials().iter().zip(before.materials.drawn()).enumerate() {
                if now != then {
                    let material = Box::new(then.clone());
                    values.push(Value::Material { index, material });
                }
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
            Value::Visibility(Arc::clone(&before.visibility)),
            Value::WrapMode(before.wrap_mode),
            Value::Handedness(before.handedness),
            Value::UpAxis(before.up_axis),
            Value::NormalGreenFlipped(before.normal_green_flipped),
            Value::Sky(before.sky.clone()),
        ];
        values.extend(others.into_iter().filter(|value| self.now(value) != *value));
        if self.clip_range(before.range.instance).secs != before.range.secs {
            values.push(Value::Range(before.range));
        }
        values
    }

    /// The clips that lead back to what was before; `None` where they are the same.
    fn clips_to(&self, before: &Undoable) -> Option<ClipSwap> {
        let (now, then) = (self.content.open.as_ref()?, before.open.as_ref()?);
        let same = Arc::ptr_eq(now, then);
        (!same).then(|| ClipSwap::between(now, then)).flatten()
    }

    /// The range of an instance; none of one that is gone.
    fn clip_range(&self, instance: usize) -> ClipRange {
        let player = self.player(instance);
        ClipRange {
            instance,
            clip: player.and_then(|player| player.clip),
            secs: player.and_then(|player| player.playback.range_secs()),
        }
    }

    /// Shows the clip of the range, if another is on show, with the range, on the instance that had it.
    fn set_clip_range(&mut self, ClipRange { instance, clip, secs }: ClipRange) {
        if self.player(instance).is_none() {
            return;
        }
        self.select_instance(instance);
        if let (Some(clip), Some(open)) = (clip, self.content.open.clone())
            && self.clip_index() != Some(clip)
        {
            let actor = &mut self.actor;
            actor.fade_to(clip, true);
            actor.player.show_clip(&open, clip);
            self.note(Event::TimeUpdate);
        }
        self.actor.player.playback.clear_range();
        self.actor.player.set_range(secs);
    }

    /// Puts clips back in the list. What plays goes on as far as it is still there. Returns what does the reverse.
    fn swap_clips(&mut self, swap: ClipSwap) -> ClipSwap {
        let before = self.shown_clips();
        let had_clips = self.content.clip_count() > 0;
        let Some(open) = &mut self.content.open else {
            return swap;
        };
        let back = Arc::make_mut(open).swap_clips(swap);
        if open.model.clips.is_empty() {
            self.instances.show_no_clips(open);
        }
        if self.content.clip_count() == 0 {
            self.set_playing(false);
            let actor = &mut self.actor;
            actor.mixer.end_fades();
            actor.mixer.set_blend(None);
            actor.player.show_no_clip();
            self.content.changes.clips = true;
            self.note(Event::TimeUpdate);
        } else if had_clips {
            self.show_clips_again(&before);
        } else {
            self.content.changes.clips = true;
            self.begin_first_clip();
        }
        back
    }
}
