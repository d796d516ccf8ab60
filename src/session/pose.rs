//! The pose on show: a clip at a time, what is mixed into it, and how far it is brought to the bind pose.

use super::Session;

/// What the pose depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OnShow {
    clips: u64,
    clip: Option<usize>,
    time_secs: f32,
    bind_share: f32,
    mix: u64,
}

impl Session {
    /// How far the pose is brought to the bind pose: 0 as the clip has it … 1 the bind pose. See
    /// [`crate::anim::blend_to_rest`].
    pub fn bind_share(&self) -> f32 {
        self.bind_share
    }

    /// Numbers that are none are left out, others brought into 0…1.
    pub(super) fn set_bind_share(&mut self, share: f32) {
        if !share.is_nan() {
            self.bind_share = share.clamp(0.0, 1.0);
        }
    }

    pub(super) fn on_show(&self) -> OnShow {
        OnShow {
            clips: self.clips_revision,
            clip: self.clip,
            time_secs: self.playback.time_secs(),
            bind_share: self.bind_share,
            mix: self.mix.revision(),
        }
    }

    /// Brings the pose to the clip and the time.
    pub(super) fn pose_now(&mut self) {
        let wanted = self.on_show();
        let Some(open) = &self.open else { return };
        if self.posed != Some(wanted) {
            let skeleton = &open.model.skeleton;
            match wanted.clip.and_then(|clip| open.model.clips.get(clip)) {
                Some(clip) => {
                    self.mix.pose(open, clip, wanted.time_secs, &mut self.pose);
                    self.pose.bring_toward_bind(skeleton, wanted.bind_share);
                }
                None => self.pose.set_bind_pose(skeleton),
            }
            self.posed = Some(wanted);
        }
    }
}
