//! Clips that joined the model or were replaced, put back.

use std::sync::Arc;

use super::open_model::{ClipFacts, JoinedFile, OpenModel};
use super::undoable::brief;
use super::{Event, Session};
use crate::anim::{CompiledClip, Playback};
use crate::diagnostic::Diagnostic;
use crate::model::Clip;

/// The clips that stood where others stand now.
#[derive(Clone, Debug)]
pub(super) struct ClipSwap {
    /// Index of the first.
    at: usize,
    clips: Vec<Arc<KeptClip>>,
    /// How many stand there now.
    count_now: usize,
    /// All files whose clips had joined.
    joined: Vec<JoinedFile>,
    /// All diagnostics of the model, which name clips by their indices.
    diagnostics: Vec<Diagnostic>,
}

/// A clip that is not in the list.
#[derive(Clone, Debug)]
struct KeptClip {
    clip: Clip,
    compiled: CompiledClip,
    file_name: String,
    joined: bool,
}

impl KeptClip {
    fn facts(&self) -> ClipFacts {
        if self.joined {
            ClipFacts::joined_from(&self.file_name)
        } else {
            ClipFacts::of_file(&self.file_name)
        }
    }
}

impl ClipSwap {
    /// What leads from the clips of one list back to those of another of the same model; `None` where they are the same.
    pub(super) fn between(now: &OpenModel, then: &OpenModel) -> Option<Self> {
        let same = |(now_at, then_at): (usize, usize)| {
            let file_name = |open: &OpenModel, at: usize| open.clip_facts.get(at).map(|facts| facts.file_name.clone());
            now.model.clips.get(now_at) == then.model.clips.get(then_at)
                && file_name(now, now_at) == file_name(then, then_at)
        };
        let [now_count, then_count] = [now, then].map(|open| open.model.clips.len());
        let shorter = now_count.min(then_count);
        let at = (0..shorter).take_while(|&at| same((at, at))).count();
        let behind = (1..=shorter - at)
            .take_while(|back| same((now_count - back, then_count - back)))
            .count();
        let (count_now, count_then) = (now_count - at - behind, then_count - at - behind);
        (count_now > 0 || count_then > 0).then(|| Self {
            at,
            clips: then.kept_clips(at, count_then),
            count_now,
            joined: then.joined.clone(),
            diagnostics: then.diagnostics.clone(),
        })
    }

    /// What the step did, in words: `add clip walk`, `add 3 clips`.
    pub(super) fn label(&self, now: &OpenModel) -> String {
        let (verb, count, first) = match (self.clips.first(), self.count_now) {
            (Some(kept), 0) => ("remove", self.clips.len(), Some(&kept.clip)),
            (first, count) => {
                let verb = if first.is_some() { "replace" } else { "add" };
                (verb, count, now.model.clips.get(self.at))
            }
        };
        match (count, first) {
            (1, Some(clip)) => format!("{verb} clip {}", brief(&clip.name)),
            _ => format!("{verb} {count} clips"),
        }
    }
}

impl OpenModel {
    fn kept_clips(&self, at: usize, count: usize) -> Vec<Arc<KeptClip>> {
        let parts = self.model.clips.iter().zip(&self.compiled).zip(&self.clip_facts);
        let kept = parts.skip(at).take(count).map(|((clip, compiled), facts)| KeptClip {
            clip: clip.clone(),
            compiled: compiled.clone(),
            file_name: facts.file_name.clone(),
            joined: facts.joined,
        });
        kept.map(Arc::new).collect()
    }

    /// Puts the clips back. Returns those that stood in their place.
    fn swap_clips(&mut self, swap: ClipSwap) -> ClipSwap {
        let places = swap.at..swap.at + swap.count_now;
        let removed = self.kept_clips(swap.at, swap.count_now);
        let count_now = swap.clips.len();
        self.clip_facts
            .splice(places.clone(), swap.clips.iter().map(|kept| kept.facts()));
        let (clips, compiled): (Vec<_>, Vec<_>) = swap
            .clips
            .into_iter()
            .map(Arc::unwrap_or_clone)
            .map(|kept| (kept.clip, kept.compiled))
            .unzip();
        self.model.clips.splice(places.clone(), clips);
        self.compiled.splice(places, compiled);
        ClipSwap {
            at: swap.at,
            clips: removed,
            count_now,
            joined: std::mem::replace(&mut self.joined, swap.joined),
            diagnostics: std::mem::replace(&mut self.diagnostics, swap.diagnostics),
        }
    }
}

impl Session {
    /// Puts clips back in the list. What plays goes on as far as it is still there. Returns what does the reverse.
    pub(super) fn swap_clips(&mut self, swap: ClipSwap) -> ClipSwap {
        let before = self.shown_clips();
        let had_clips = self.content.clip_count() > 0;
        let Some(open) = &mut self.content.open else {
            return swap;
        };
        let back = Arc::make_mut(open).swap_clips(swap);
        if self.content.clip_count() == 0 {
            self.set_playing(false);
            let actor = self.actors.picked_mut();
            actor.mixer.end_fades();
            actor.mixer.set_blend(None);
            (actor.clip, actor.playback) = (None, Playback::default());
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
