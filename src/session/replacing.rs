//! A file of clips that comes a second time: its clips take the places of those that it brought before.

use super::clips::ClipFacts;
use super::{Event, OpenModel, Session};
use crate::diagnostic::{Diagnostic, Severity, Subject};

/// What of the clips is on show, by name.
#[derive(Clone, Debug)]
pub(super) struct NamedClips {
    shown: Option<String>,
    blended: Option<(String, f32)>,
}

impl Session {
    /// What is on show, to be found again among other clips.
    pub(super) fn named_clips(&self) -> NamedClips {
        let name = |index: usize| Some(self.open.as_ref()?.model.clips.get(index)?.name.clone());
        NamedClips {
            shown: self.clip.and_then(name),
            blended: self.blend().and_then(|blend| Some((name(blend.clip)?, blend.share))),
        }
    }

    /// Finds what was on show among clips that took the places of others. Time and range stay as far as the clip has them; when
    /// its name is gone, what stands in its place is shown.
    pub(super) fn take_up_clips(&mut self, before: &NamedClips) {
        self.clips_revision += 1;
        self.mix.end_fades();
        let Some(open) = &self.open else { return };
        let clips = &open.model.clips;
        let place_of = |name: &str| clips.iter().position(|clip| clip.name == name);
        let blend = before
            .blended
            .as_ref()
            .and_then(|(name, share)| Some((place_of(name)?, *share)));
        let place = before.shown.as_deref().and_then(place_of);
        let last = clips.len().saturating_sub(1);
        let was_at = self.playback.time_secs();
        match place.and_then(|place| Some((place, clips.get(place)?))) {
            Some((place, clip)) => {
                self.clip = Some(place);
                if [clip.start_secs, clip.end_secs] != [self.playback.start_secs(), self.playback.end_secs()] {
                    let range_secs = self.playback.range_secs();
                    self.playback.set_span(clip.start_secs, clip.end_secs);
                    if let Some([start_secs, end_secs]) = range_secs {
                        self.playback.set_range_end(end_secs);
                        self.playback.set_range_start(start_secs);
                    }
                }
            }
            None => {
                self.show_clip(self.clip.unwrap_or_default().min(last));
            }
        }
        self.clear_blend();
        if let Some((clip, share)) = blend {
            self.set_blend(clip, share);
        }
        if self.playback.time_secs() != was_at {
            self.note(Event::TimeUpdate);
        }
    }

    /// Counts changes of which clips are under which indices, but for clips that join at the end: another number, other clips.
    pub fn clips_revision(&self) -> u64 {
        self.clips_revision
    }
}

impl OpenModel {
    /// Takes the clips away that a file of this name brought, and what was found about them. The place of the first and how many
    /// there were.
    pub(super) fn remove_joined(&mut self, file_name: &str) -> Option<(usize, usize)> {
        let is_gone = |facts: &ClipFacts| facts.joined && facts.file_name == file_name;
        let gone: Vec<bool> = self.clip_facts.iter().map(is_gone).collect();
        let first = gone.iter().position(|&gone| gone)?;
        let count = gone.iter().filter(|&&gone| gone).count();
        let mut keeps = gone.iter().map(|gone| !gone);
        self.model.clips.retain(|_| keeps.next().unwrap_or(true));
        self.clip_facts.retain(|facts| !is_gone(facts));
        let place_of = |clip: u32| gone.iter().take(clip as usize).filter(|&&gone| !gone).count() as u32;
        self.notices.retain_mut(|notice| {
            let Some(Subject::Clip(clip)) = notice.subject else {
                return true;
            };
            notice.subject = Some(Subject::Clip(place_of(clip)));
            gone.get(clip as usize) != Some(&true)
        });
        Some((first, count))
    }

    /// Lets findings be about clips some places further on, from a place on.
    pub(super) fn move_clip_notices(&mut self, from: usize, by: usize) {
        for notice in &mut self.notices {
            if let Some(Subject::Clip(clip)) = &mut notice.subject
                && *clip as usize >= from
            {
                *clip = clip.saturating_add(by as u32);
            }
        }
    }
}

/// A note that clips took the places of others.
pub(super) fn replaced_notice(file_name: &str, first: usize, count: usize, before: usize) -> Diagnostic {
    let clips = |count: usize| format!("{count} clip{}", if count == 1 { "" } else { "s" });
    let replace = if count == 1 { "replaces" } else { "replace" };
    let (now, before) = (clips(count), clips(before));
    let message = format!("{file_name} was added before; its {now} {replace} the {before} from then.");
    Diagnostic {
        subject: Some(Subject::Clip(first as u32)),
        ..Diagnostic::without_place(Severity::Note, "clips-replaced", message)
    }
}
