//! Clips that stand where others stood: that joined the model, were replaced or are kept in place, and how they are put back.

use std::sync::Arc;

use super::open_model::{ClipFacts, JoinedFile, OpenModel};
use crate::anim::CompiledClip;
use crate::diagnostic::Diagnostic;
use crate::edit;
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
pub(in crate::session) struct KeptClip {
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
        let leads_away = |facts: Option<&ClipFacts>, clip: Option<&Clip>| {
            let away = facts.and_then(|facts| facts.leading_away.as_ref());
            away.is_some_and(|away| Some(&away.0) == clip)
        };
        match self.clips.first() {
            Some(kept) if self.count_now == 0 => ("remove", self.clips.len(), name(Some(&kept.clip))),
            Some(kept) if leads_away(now.clip_facts.get(self.at), Some(&kept.clip)) => {
                ("in place:", self.count_now, of_now)
            }
            Some(kept) if leads_away(Some(&kept.facts), now.model.clips.get(self.at)) => {
                ("no longer in place:", self.count_now, of_now)
            }
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

    /// A clip over where it starts, or as its file has it; `None` where it is so already, and for one that goes nowhere.
    pub(in crate::session) fn placed(&self, index: usize, is_kept: bool) -> Option<KeptClip> {
        let (clip, facts) = self.model.clips.get(index).zip(self.clip_facts.get(index))?;
        let (clip, leading_away) = match (&facts.leading_away, is_kept) {
            (None, true) => {
                let (kept, change) = edit::in_place(&self.model, clip)?;
                (kept, Some(Arc::new((clip.clone(), change))))
            }
            (Some(away), false) => (away.0.clone(), None),
            _ => return None,
        };
        let (mut known, compiled) = (ClipFacts::of_file(&facts.file_name), CompiledClip::new(&clip));
        (known.joined, known.leading_away) = (facts.joined, leading_away);
        Some(KeptClip {
            clip,
            compiled,
            facts: known,
        })
    }

    /// Puts a clip in the place of one.
    pub(in crate::session) fn put(&mut self, index: usize, KeptClip { clip, compiled, facts }: KeptClip) {
        self.model.clips[index] = clip;
        self.compiled[index] = compiled;
        self.clip_facts[index] = facts;
    }

    /// Keeps in place what was so before, by the names of clips.
    pub(in crate::session) fn keep_as_before(&mut self, before: &Self) {
        for index in 0..self.model.clips.len() {
            let mut kept = before.kept_in_place();
            if kept.any(|(name, _)| *name == self.model.clips[index].name)
                && let Some(placed) = self.placed(index, true)
            {
                self.put(index, placed);
            }
        }
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
