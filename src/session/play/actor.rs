//! The selected instance of the open model: the clip that plays, its time, what is mixed into it, and the pose.

use super::mixer::{Blend, Mixer};
use super::player::Player;
use crate::anim::{LoopMode, PoseBuffers, WrapMode};
use crate::scene::Aabb;
use crate::session::open::open_model::OpenModel;

/// The instance of the open model that timeline, skeleton and read-outs are of.
#[derive(Clone, Debug, Default)]
pub(in crate::session) struct Actor {
    pub(in crate::session) player: Player,
    /// The pointer holds the time.
    pub(in crate::session) scrubbing: bool,
    pub(in crate::session) mixer: Mixer,
    /// 0 the clip's pose … 1 the bind pose.
    pub(in crate::session) bind_weight: f32,
    pub(in crate::session) pose: PoseBuffers,
    /// The revision of the pose in the buffers.
    posed: Option<u64>,
}

/// What plays, and how. A change of it is [`crate::session::Event::PlaybackChange`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::session) struct PlaybackSettings {
    clip: Option<usize>,
    range_secs: Option<[f32; 2]>,
    speed: f32,
    loop_mode: LoopMode,
    wrap_mode: WrapMode,
}

/// What the pose depends on, beside what is mixed into the clip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::session) struct PoseInputs {
    clip: Option<usize>,
    time_secs: f32,
    bind_weight: f32,
}

impl Actor {
    /// One for a model that has just opened, at rest. The length of crossfades stays as it was chosen.
    pub(in crate::session) fn for_model(open: &OpenModel, before: &Self) -> Self {
        Self {
            mixer: Mixer::with_crossfade_of(&before.mixer),
            pose: PoseBuffers::for_skeleton(&open.model.skeleton),
            ..Self::default()
        }
    }

    /// The same for a file that was read again: clip (by its name), time, range and way of playing stay as far as the clips have
    /// them.
    pub(in crate::session) fn for_model_again(open: &OpenModel, before: &Self, clip_name: Option<&str>) -> Self {
        let mut actor = Self {
            player: before.player.clone(),
            bind_weight: before.bind_weight,
            ..Self::for_model(open, before)
        };
        actor.player.show_again(open, clip_name);
        actor
    }

    pub(in crate::session) fn settings(&self) -> PlaybackSettings {
        PlaybackSettings {
            clip: self.player.clip,
            range_secs: self.player.playback.range_secs(),
            speed: self.player.playback.speed(),
            loop_mode: self.player.playback.loop_mode(),
            wrap_mode: self.player.playback.wrap_mode(),
        }
    }

    pub(in crate::session) fn pose_inputs(&self) -> PoseInputs {
        PoseInputs {
            clip: self.player.clip,
            time_secs: self.player.playback.time_secs(),
            bind_weight: self.bind_weight,
        }
    }

    /// NaN is ignored; other values are clamped to 0…1.
    pub(in crate::session) fn set_bind_weight(&mut self, weight: f32) {
        if !weight.is_nan() {
            self.bind_weight = weight.clamp(0.0, 1.0);
        }
    }

    /// Brings the pose in the buffers to the clip and the time, unless they hold the pose of this revision already.
    pub(in crate::session) fn update_pose(&mut self, open: &OpenModel, revision: u64) {
        if self.posed == Some(revision) {
            return;
        }
        self.posed = Some(revision);
        let skeleton = &open.model.skeleton;
        match self.player.clip.and_then(|clip| open.compiled.get(clip)) {
            Some(clip) => {
                self.mixer
                    .pose(open, clip, self.player.playback.time_secs(), &mut self.pose);
            }
            None => self.pose.set_rest_pose(skeleton),
        }
        self.pose.bring_toward_bind(skeleton, self.bind_weight);
    }

    /// Whether a clip that played before is still seen. A fade goes on to its end when playing is paused, so that a picture that
    /// stands still is a pose of its clip and time.
    pub(in crate::session) fn is_fading(&self) -> bool {
        self.mixer.has_fades() && !self.scrubbing
    }

    /// Blends a second of `clip_count` clips into the one that plays.
    pub(in crate::session) fn set_blend(&mut self, Blend { clip, weight }: Blend, clip_count: usize) {
        if clip < clip_count && Some(clip) != self.player.clip && !weight.is_nan() {
            let weight = weight.clamp(0.0, 1.0);
            self.mixer.set_blend(Some(Blend { clip, weight }));
        }
    }

    /// Fades the clip that plays out while the `next` one plays; with `at_once` nothing fades. A blend stays with the next clip,
    /// unless the next clip is the one that was blended in.
    pub(in crate::session) fn fade_to(&mut self, next: usize, at_once: bool) {
        match self.player.clip {
            Some(clip) if self.player.playback.is_playing() && !self.scrubbing && !at_once => {
                self.mixer.fade_from(clip, &self.player.playback);
            }
            _ => self.mixer.end_fades(),
        }
        if self.mixer.blend().is_some_and(|blend| blend.clip == next) {
            self.mixer.set_blend(None);
        }
    }

    /// Whether time goes by for it, and for all other instances with it.
    pub(in crate::session) fn plays(&self) -> bool {
        self.player.playback.is_playing() && !self.scrubbing && self.player.clip.is_some()
    }

    /// Whether its time moves by itself.
    pub(in crate::session) fn is_animating(&self) -> bool {
        self.plays() && self.player.has_way()
    }

    /// Lets time pass for its clip and for what fades.
    pub(in crate::session) fn advance(&mut self, dt_secs: f32) {
        if self.is_fading() && dt_secs > 0.0 {
            self.mixer.advance_fades(&self.player.playback, dt_secs);
        }
        if self.is_animating() {
            self.player.playback.advance(dt_secs);
        }
    }

    /// Box of all that the clips in the pose reach, in the file's space; with the bind pose in it while the pose is brought there.
    pub(in crate::session) fn reach(&self, open: &OpenModel) -> Aabb {
        let of_clip = open.extent(self.player.clip).bounds;
        let of_clips = self
            .mixer
            .clips()
            .fold(of_clip, |reach, clip| reach.union(open.extent(Some(clip)).bounds));
        if self.bind_weight > 0.0 {
            of_clips.union(open.bind_bounds)
        } else {
            of_clips
        }
    }
}
