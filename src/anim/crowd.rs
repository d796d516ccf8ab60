//! Palettes of many instances of one skeleton, in one buffer.

use glam::Affine3A;
use rustc_hash::FxHashMap;

use super::blend::blend_to_bind;
use super::compile::CompiledClip;
use super::pose::{LocalPose, ModelPose, local_to_model, palette_matrices};
use super::sample::sample;
use crate::model::Skeleton;

/// A clip at a time: equal ones have equal palettes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ClipPose {
    /// Index of the clip; `None` is the bind pose, and so is an index without a clip.
    clip: Option<u32>,
    time_bits: u32,
}

impl ClipPose {
    /// The bind pose.
    pub const BIND: Self = Self {
        clip: None,
        time_bits: 0,
    };

    /// A clip, by its index, at a time in seconds.
    pub fn new(clip: Option<usize>, time_secs: f32) -> Self {
        clip.map_or(Self::BIND, |clip| Self {
            clip: Some(clip as u32),
            time_bits: time_secs.to_bits(),
        })
    }
}

/// Palettes of one skeleton, one after another, each in a slot. Instances in equal poses share a slot.
///
/// A pose that is asked for again in the next update keeps its slot and is not computed again. Nothing is allocated after the first
/// update of as many instances.
#[derive(Clone, Debug, Default)]
pub struct CrowdPalettes {
    palettes: Vec<Affine3A>,
    joint_count: usize,
    /// One for each pose of the last update.
    slots: Vec<u32>,
    slot_of: FxHashMap<ClipPose, u32>,
    /// For each slot.
    is_used: Vec<bool>,
    bind_weight: f32,
    local: LocalPose,
    model: ModelPose,
    posed: u64,
}

impl CrowdPalettes {
    /// Brings the palettes to some poses of a skeleton and its clips. Each is the palette that
    /// [`PoseBuffers::evaluate`](super::PoseBuffers::evaluate) gives, with
    /// [`PoseBuffers::bring_toward_bind`](super::PoseBuffers::bring_toward_bind) by `bind_weight` behind it. After a change of the
    /// skeleton or of a clip, [`CrowdPalettes::clear`] comes first.
    pub fn update(&mut self, skeleton: &Skeleton, clips: &[CompiledClip], bind_weight: f32, poses: &[ClipPose]) {
        self.joint_count = skeleton.joint_count();
        if self.bind_weight != bind_weight {
            self.bind_weight = bind_weight;
            self.slot_of.clear();
        }
        // A slot for each pose is enough: those that are still shown are not more.
        if self.is_used.len() < poses.len() {
            self.is_used.resize(poses.len(), false);
            self.palettes.resize(poses.len() * self.joint_count, Affine3A::IDENTITY);
            // Twice as many: places of removed poses are then cleared where they are. A fuller table would be copied to a larger one.
            self.slot_of.reserve(2 * poses.len());
        }
        self.is_used.fill(false);
        for pose in poses {
            if let Some(&slot) = self.slot_of.get(pose) {
                self.is_used[slot as usize] = true;
            }
        }
        let is_used = &self.is_used;
        self.slot_of.retain(|_, slot| is_used[*slot as usize]);

        self.slots.clear();
        let mut free = 0;
        for &pose in poses {
            let slot = match self.slot_of.get(&pose) {
                Some(&slot) => slot,
                None => {
                    while self.is_used[free] {
                        free += 1;
                    }
                    self.is_used[free] = true;
                    self.pose(skeleton, clips, pose, free);
                    self.slot_of.insert(pose, free as u32);
                    free as u32
                }
            };
            self.slots.push(slot);
        }
    }

    /// Forgets all poses, but keeps the buffers.
    pub fn clear(&mut self) {
        self.slot_of.clear();
        self.is_used.clear();
        self.slots.clear();
    }

    /// The palettes that are in use, one after another, up to the last of them.
    pub fn palettes(&self) -> &[Affine3A] {
        let end = self.slots.iter().max().map_or(0, |&last| last as usize + 1);
        &self.palettes[..end * self.joint_count]
    }

    /// For each pose of the last update, which palette it has, counted in palettes.
    pub fn slots(&self) -> &[u32] {
        &self.slots
    }

    /// How many palettes were computed so far.
    pub fn posed(&self) -> u64 {
        self.posed
    }

    fn pose(&mut self, skeleton: &Skeleton, clips: &[CompiledClip], pose: ClipPose, slot: usize) {
        self.posed += 1;
        let palette = &mut self.palettes[slot * self.joint_count..][..self.joint_count];
        let clip = pose.clip.and_then(|clip| clips.get(clip as usize));
        if self.bind_weight >= 1.0 || (clip.is_none() && skeleton.rests_in_bind_pose()) {
            palette.fill(Affine3A::IDENTITY);
            return;
        }
        match clip {
            Some(clip) => sample(clip, f32::from_bits(pose.time_bits), &mut self.local),
            None => self.local.set_joints(skeleton.rest()),
        }
        if self.bind_weight > 0.0 {
            blend_to_bind(skeleton, self.bind_weight, &mut self.local);
        }
        local_to_model(skeleton, &self.local, &mut self.model);
        for (matrix, posed) in palette.iter_mut().zip(palette_matrices(skeleton, &self.model)) {
            *matrix = posed;
        }
    }
}
