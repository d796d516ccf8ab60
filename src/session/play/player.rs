//! A clip of the open model, and where playing is in it.

use crate::anim::{ClipPose, LoopMode, Playback};
use crate::session::open::open_model::OpenModel;

/// What each instance of the model has of its own. Clips are those of the model, by their indices.
#[derive(Clone, Debug, Default)]
pub(in crate::session) struct Player {
    pub(in crate::session) clip: Option<usize>,
    pub(in crate::session) playback: Playback,
}

impl Player {
    /// The pose of now, without what is mixed into it.
    pub(in crate::session) fn pose(&self) -> ClipPose {
        ClipPose::new(self.clip, self.playback.time_secs())
    }

    /// Goes to a clip's first time; false when there is no such clip.
    pub(in crate::session) fn show_clip(&mut self, open: &OpenModel, index: usize) -> bool {
        let Some(clip) = open.model.clips.get(index) else {
            return false;
        };
        self.playback.set_span(clip.start_secs, clip.end_secs);
        self.playback.seek(if self.playback.is_backward() {
            clip.end_secs
        } else {
            clip.start_secs
        });
        self.clip = Some(index);
        true
    }

    /// Finds its clip, by the name it had, in a file that was read again: time, range and way of playing stay as far as the clips
    /// have them.
    pub(in crate::session) fn show_again(&mut self, open: &OpenModel, name: Option<&str>) {
        let named = name.and_then(|name| place_of(open, name));
        let (time_secs, range_secs) = (self.playback.time_secs(), self.playback.range_secs());
        if !self.show_clip(open, named.unwrap_or(0)) {
            *self = Self::default();
            return;
        }
        if named.is_some() {
            self.set_range(range_secs);
        }
        self.playback.seek(time_secs);
    }

    /// Finds its clip, by the name it had, among clips that took the places of others. Time and range stay as far as the clip has
    /// them; when its name is gone, the clip in its place is shown.
    pub(in crate::session) fn follow_clips(&mut self, open: &OpenModel, name: Option<&str>) {
        let clips = &open.model.clips;
        let place = name.and_then(|name| place_of(open, name));
        let Some((place, clip)) = place.and_then(|place| Some((place, clips.get(place)?))) else {
            let last = clips.len().saturating_sub(1);
            self.show_clip(open, self.clip.unwrap_or_default().min(last));
            return;
        };
        self.clip = Some(place);
        if [clip.start_secs, clip.end_secs] != [self.playback.start_secs(), self.playback.end_secs()] {
            let range_secs = self.playback.range_secs();
            self.playback.set_span(clip.start_secs, clip.end_secs);
            self.set_range(range_secs);
        }
    }

    /// The model has no clips any more. Speed, loop and wrap mode stay.
    pub(in crate::session) fn show_no_clip(&mut self) {
        self.playback.set_span(0.0, 0.0);
        self.clip = None;
    }

    /// Sets the range, if there is one.
    pub(in crate::session) fn set_range(&mut self, range_secs: Option<[f32; 2]>) {
        if let Some([start_secs, end_secs]) = range_secs {
            self.playback.set_range_end(end_secs);
            self.playback.set_range_start(start_secs);
        }
    }

    /// Whether time that goes by changes anything. A clip of no length would loop on the spot for ever; playing it once still has to
    /// end.
    pub(in crate::session) fn has_way(&self) -> bool {
        let [start_secs, end_secs] = self.playback.played_secs();
        self.clip.is_some() && (start_secs < end_secs || self.playback.loop_mode() == LoopMode::Once)
    }

    /// Plays as another does: as fast, in its direction, with its ends.
    pub(in crate::session) fn play_as(&mut self, other: &Playback) {
        let playback = &mut self.playback;
        playback.set_speed(other.speed());
        playback.set_backward(other.is_backward());
        if playback.loop_mode() != other.loop_mode() {
            playback.set_loop_mode(other.loop_mode());
        }
        playback.set_wrap_mode(other.wrap_mode());
    }

    pub(in crate::session) fn set_playing(&mut self, playing: bool) {
        if playing {
            self.playback.play();
        } else {
            self.playback.pause();
        }
    }
}

fn place_of(open: &OpenModel, name: &str) -> Option<usize> {
    open.model.clips.iter().position(|clip| clip.name == name)
}
