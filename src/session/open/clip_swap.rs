//! Clips that joined the model or were replaced, put back.

use std::sync::Arc;

use super::open_model::{ClipFacts, JoinedFile, OpenModel};
use crate::anim::CompiledClip;
use crate::diagnostic::Diagnostic;
use crate::model::Clip;

/// The clips that stood where others stand now.
#[derive(Clone, Debug)]
pub(in crate::session) struct ClipSwap {
    /// Index of the first.
    at: usize,
    clips: Vec<Arc<KeptClip>>,
    count_now: usize,
    joined: Vec<JoinedFile>,
    /// All diagnostics of the model, which name clips by their indices.
    diagnostics: Vec<Diagnostic>,
}

/// A clip that is not in the list.
#[derive(Clone, Debug)]
struct KeptClip {
    clip: Clip,
    compiled: CompiledClip,
    facts: ClipFacts,
}

impl ClipSwap {
    /// What leads from the clips of one list back to those of another of the same model; `None` where they are the same.
    pub(in crate::session) fn between(now: &OpenModel, then: &OpenModel) -> Option<Self> {
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

    /// What the step did to how many clips, and the name of the first: `add`, 3, `walk`.
    pub(in crate::session) fn deed<'a>(&'a self, now: &'a OpenModel) -> (&'static str, usize, &'a str) {
        let name = |clip: Option<&'a Clip>| clip.map_or("", |clip| clip.name.as_str());
        let of_now = name(now.model.clips.get(self.at));
        match self.clips.first() {
            Some(kept) if self.count_now == 0 => ("remove", self.clips.len(), name(Some(&kept.clip))),
            Some(_) => ("replace", self.count_now, of_now),
            None => ("add", self.count_now, of_now),
        }
    }
}

impl OpenModel {
    fn kept_clips(&self, at: usize, count: usize) -> Vec<Arc<KeptClip>> {
        let parts = self.model.clips.iter().zip(&self.compiled).zip(&self.clip_facts);
        let kept = parts.skip(at).take(count).map(|((clip, compiled), facts)| KeptClip {
            clip: clip.clone(),
            compiled: compiled.clone(),
            facts: facts.clone(),
        });
        kept.map(Arc::new).collect()
    }

    /// Puts the clips back. Returns those that stood in their place.
    pub(in crate::session) fn swap_clips(&mut self, swap: ClipSwap) -> ClipSwap {
        let places = swap.at..swap.at + swap.count_now;
        let removed = self.kept_clips(swap.at, swap.count_now);
        let count_now = swap.clips.len();
        let back = swap.clips.into_iter().map(Arc::unwrap_or_clone);
        let (clips, (compiled, facts)): (Vec<_>, (Vec<_>, Vec<_>)) =
            back.map(|kept| (kept.clip, (kept.compiled, kept.facts))).unzip();
        self.model.clips.splice(places.clone(), clips);
        self.compiled.splice(places.clone(), compiled);
        self.clip_facts.splice(places, facts);
        ClipSwap {
            at: swap.at,
            clips: removed,
            count_now,
            joined: std::mem::replace(&mut self.joined, swap.joined),
            diagnostics: std::mem::replace(&mut self.diagnostics, swap.diagnostics),
        }
    }
}
