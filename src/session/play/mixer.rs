//! More than one clip in a pose: a crossfade from clip to clip, and two clips that a slider blends.

use crate::anim::{CompiledClip, LocalPose, Playback, PoseBuffers, blend, sample};
use crate::session::open::open_model::OpenModel;

/// How long a crossfade takes unless another length is chosen, in seconds: long enough to be seen, too short to wait for.
pub const DEFAULT_CROSSFADE_SECS: f32 = 0.3;

/// The longest crossfade, in seconds: a longer one is a blend.
pub const MAX_CROSSFADE_SECS: f32 = 10.0;

/// Fades at one time. When clips change more often within one fade, the oldest ends early.
const MOST_FADES: usize = 4;

/// A second clip in the pose, at the same fraction of its length as the clip on show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend {
    /// Index of the clip.
    pub clip: usize,
    /// Its weight in the pose, 0…1; the rest is the clip on show.
    pub weight: f32,
}

/// What is posed beside the clip on show.
#[derive(Clone, Debug)]
pub(in crate::session) struct Mixer {
    crossfade_secs: f32,
    blend: Option<Blend>,
    /// What was on show before, the oldest first; each fades into the next, the last into the clip on show.
    fades: Vec<Fade>,
    /// Whether what is mixed changed since the last [`Mixer::take_changed`].
    changed: bool,
    pose: LocalPose,
    scratch: Scratch,
}

impl Default for Mixer {
    fn default() -> Self {
        Self {
            crossfade_secs: DEFAULT_CROSSFADE_SECS,
            blend: None,
            fades: Vec::new(),
            changed: false,
            pose: LocalPose::default(),
            scratch: Scratch::default(),
        }
    }
}

#[derive(Clone, Debug)]
struct Fade {
    clip: usize,
    blend: Option<Blend>,
    playback: Playback,
    elapsed_secs: f32,
    duration_secs: f32,
}

impl Fade {
    /// How much of what comes next is seen: slow at both ends, so that neither shows a jolt.
    fn weight_of_next(&self) -> f32 {
        let part = (self.elapsed_secs / self.duration_secs).clamp(0.0, 1.0);
        part * part * (3.0 - 2.0 * part)
    }
}

/// Buffers that are kept from pose to pose.
#[derive(Clone, Debug, Default)]
struct Scratch {
    layer: LocalPose,
    second: LocalPose,
    out: LocalPose,
}

impl Mixer {
    /// One that mixes nothing, with the length of crossfades of another.
    pub(in crate::session) fn with_crossfade_of(other: &Self) -> Self {
        Self {
            crossfade_secs: other.crossfade_secs,
            ..Self::default()
        }
    }

    /// Whether what is mixed is different since the last call.
    pub(in crate::session) fn take_changed(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    pub(in crate::session) fn crossfade_secs(&self) -> f32 {
        self.crossfade_secs
    }

    /// NaN, infinity and negative lengths are ignored; others are clamped to [`MAX_CROSSFADE_SECS`].
    pub(in crate::session) fn set_crossfade(&mut self, secs: f32) {
        if secs.is_finite() && secs >= 0.0 {
            self.crossfade_secs = secs.min(MAX_CROSSFADE_SECS);
        }
    }

    pub(in crate::session) fn blend(&self) -> Option<Blend> {
        self.blend
    }

    /// Whether clips that played before are still seen.
    pub(in crate::session) fn has_fades(&self) -> bool {
        !self.fades.is_empty()
    }

    /// Fades a clip out. When crossfades have no length, all fades end.
    pub(in crate::session) fn fade_from(&mut self, clip: usize, playback: &Playback) {
        if self.crossfade_secs <= 0.0 {
            return self.end_fades();
        }
        if self.fades.len() == MOST_FADES {
            self.fades.remove(0);
        }
        self.fades.push(Fade {
            clip,
            blend: self.blend,
            playback: playback.clone(),
            elapsed_secs: 0.0,
            duration_secs: self.crossfade_secs,
        });
        self.changed = true;
    }

    /// Lets time pass for what fades; the clips in it move on as `playback` does.
    pub(in crate::session) fn advance_fades(&mut self, playback: &Playback, dt_secs: f32) {
        for fade in &mut self.fades {
            fade.elapsed_secs += dt_secs;
            if playback.is_playing() {
                fade.playback.set_speed(playback.speed());
                fade.playback.advance(dt_secs);
            }
        }
        // What is behind a fade that has ended is not seen either.
        let ended = |fade: &Fade| fade.elapsed_secs >= fade.duration_secs;
        let ended = self.fades.iter().rposition(ended);
        self.fades.drain(..ended.map_or(0, |last| last + 1));
        self.changed = true;
    }

    /// Shows the clip on show alone, but for a blend.
    pub(in crate::session) fn end_fades(&mut self) {
        if !self.fades.is_empty() {
            self.fades.clear();
            self.changed = true;
        }
    }

    pub(in crate::session) fn set_blend(&mut self, blend: Option<Blend>) {
        if self.blend != blend {
            self.blend = blend;
            self.changed = true;
        }
    }

    /// The clips in the pose beside the one on show.
    pub(in crate::session) fn clips(&self) -> impl Iterator<Item = usize> {
        let of_fades = self
            .fades
            .iter()
            .flat_map(|fade| [Some(fade.clip), fade.blend.map(|blend| blend.clip)]);
        of_fades.chain([self.blend.map(|blend| blend.clip)]).flatten()
    }

    /// The pose of all that is mixed, in `buffers`.
    pub(in crate::session) fn pose(
        &mut self,
        open: &OpenModel,
        shown: &CompiledClip,
        time_secs: f32,
        buffers: &mut PoseBuffers,
    ) {
        let clips = &open.compiled;
        let Self { scratch, pose, .. } = self;
        let mut next_weight = None;
        for fade in &self.fades {
            if let Some(clip) = clips.get(fade.clip) {
                scratch.pose_layer(clips, clip, fade.blend, fade.playback.time_secs());
                scratch.put_over(pose, next_weight);
                next_weight = Some(fade.weight_of_next());
            }
        }
        scratch.pose_layer(clips, shown, self.blend, time_secs);
        scratch.put_over(pose, next_weight);
        std::mem::swap(pose, &mut buffers.local);
        buffers.place(&open.model.skeleton);
    }
}

impl Mixer {
    /// The pose of the clip on show with what is blended into it, in `buffers`: of another time than now, at which nothing fades.
    pub(in crate::session) fn pose_unfaded(
        &mut self,
        open: &OpenModel,
        shown: &CompiledClip,
        time_secs: f32,
        buffers: &mut PoseBuffers,
    ) {
        self.scratch.pose_layer(&open.compiled, shown, self.blend, time_secs);
        std::mem::swap(&mut self.scratch.layer, &mut buffers.local);
        buffers.place(&open.model.skeleton);
    }
}

impl Scratch {
    /// A clip and what is blended into it, in `layer`.
    fn pose_layer(&mut self, clips: &[CompiledClip], clip: &CompiledClip, with: Option<Blend>, time_secs: f32) {
        sample(clip, time_secs, &mut self.layer);
        if let Some(Blend { clip: index, weight }) = with
            && let Some(other) = clips.get(index)
        {
            sample(other, time_in_step(clip, time_secs, other), &mut self.second);
            blend(&self.layer, &self.second, weight, &mut self.out);
            std::mem::swap(&mut self.layer, &mut self.out);
        }
    }

    /// Blends the layer over a pose with a weight, or puts it in its place.
    fn put_over(&mut self, pose: &mut LocalPose, weight: Option<f32>) {
        if let Some(weight) = weight {
            blend(pose, &self.layer, weight, &mut self.out);
            std::mem::swap(pose, &mut self.out);
        } else {
            std::mem::swap(pose, &mut self.layer);
        }
    }
}

/// The time of `other` at the fraction of its length that `time_secs` is of `clip`'s; its start when `clip` has no length.
fn time_in_step(clip: &CompiledClip, time_secs: f32, other: &CompiledClip) -> f32 {
    let start_secs = f64::from(clip.start_secs());
    let length_secs = f64::from(clip.end_secs()) - start_secs;
    if length_secs <= 0.0 {
        return other.start_secs();
    }
    let phase = (f64::from(time_secs) - start_secs) / length_secs;
    let other_start_secs = f64::from(other.start_secs());
    (other_start_secs + phase * (f64::from(other.end_secs()) - other_start_secs)) as f32
}
