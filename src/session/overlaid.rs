//! What is drawn over the model and in place of its colours: bones, trails, ghosts, colours of the skin. In buffers that are
//! filled again only when what they show is another thing.

use super::Session;
use super::mixing::Blend;
use super::pose::OnShow;
use super::skeleton_view::SkinColorsKey;
use crate::anim::{GhostPlan, Palette, PoseBuffers, Trails, ghost_times, palettes_at};
use crate::model::JointIndex;
use crate::scene::{BoneColors, Ghosts, OverlayGeometry, VertexColors, joint_colors};

/// How opaque the nearest ghost is, and the farthest.
const GHOST_ALPHA: [u8; 2] = [110, 40];
/// Ghosts of the past and of the future, and the bind pose's, sRGB.
const PAST_SRGB: [u8; 3] = [90, 169, 255];
const FUTURE_SRGB: [u8; 3] = [255, 180, 84];
const BIND_SRGB: [u8; 4] = [160, 170, 190, 110];

/// Buffers, and what they were filled for.
#[derive(Clone, Debug, Default)]
pub(super) struct Overlaid {
    ghost_plan: Option<GhostPlan>,
    bind_ghost: bool,

    geometry: OverlayGeometry,
    trails: Trails,
    trails_for: Option<TrailsKey>,
    colors_srgb: Vec<[u8; 4]>,
    colors_for: Option<SkinColorsKey>,
    colors_revision: u64,
    palettes: Vec<Palette>,
    ghost_colors_srgb: Vec<[u8; 4]>,
    ghosts_for: Option<(OnShow, Option<GhostPlan>, bool)>,
    times_secs: Vec<f32>,
    scratch: PoseBuffers,
}

#[derive(Clone, Debug, PartialEq)]
struct TrailsKey {
    clips: u64,
    clip: Option<usize>,
    blend: Option<Blend>,
    joints: Vec<JointIndex>,
}

impl Overlaid {
    pub(super) fn ghost_plan(&self) -> Option<GhostPlan> {
        self.ghost_plan
    }

    pub(super) fn set_ghosts(&mut self, plan: Option<GhostPlan>) {
        self.ghost_plan = plan.filter(|plan| plan.before > 0 || plan.after > 0);
    }

    pub(super) fn bind_ghost(&self) -> bool {
        self.bind_ghost
    }

    pub(super) fn set_bind_ghost(&mut self, visible: bool) {
        self.bind_ghost = visible;
    }

    pub(super) fn geometry(&self) -> &OverlayGeometry {
        &self.geometry
    }

    /// None while the skin is shown as it is.
    pub(super) fn vertex_colors(&self) -> Option<VertexColors<'_>> {
        self.colors_for?;
        Some(VertexColors {
            colors_srgb: &self.colors_srgb,
            revision: self.colors_revision,
        })
    }

    pub(super) fn ghosts(&self) -> Ghosts<'_> {
        Ghosts {
            palettes: &self.palettes,
            colors_srgb: &self.ghost_colors_srgb,
        }
    }
}

impl Session {
    /// Poses beside that of now.
    pub fn ghost_plan(&self) -> Option<GhostPlan> {
        self.overlaid.ghost_plan()
    }

    /// Whether the bind pose is seen as a veil.
    pub fn bind_ghost(&self) -> bool {
        self.overlaid.bind_ghost()
    }

    /// Fills the buffers for the picture of now.
    pub(super) fn fill_overlaid(&mut self) {
        let mut overlaid = std::mem::take(&mut self.overlaid);
        self.fill_colors(&mut overlaid);
        self.fill_ghosts(&mut overlaid);
        self.draw_bones(&mut overlaid.geometry);
        self.fill_trails(&mut overlaid);
        self.overlaid = overlaid;
    }

    fn fill_colors(&mut self, overlaid: &mut Overlaid) {
        let wanted = self.skin_colors_key();
        if overlaid.colors_for != wanted {
            self.skin_colors(&mut overlaid.colors_srgb);
            overlaid.colors_for = wanted;
            overlaid.colors_revision += 1;
        }
    }

    fn fill_ghosts(&mut self, overlaid: &mut Overlaid) {
        let wanted = (self.on_show(), overlaid.ghost_plan, overlaid.bind_ghost);
        if overlaid.ghosts_for == Some(wanted) {
            return;
        }
        overlaid.ghosts_for = Some(wanted);
        overlaid.ghost_colors_srgb.clear();
        overlaid.times_secs.clear();
        let Self { open, mix, .. } = self;
        let Some(open) = open else {
            overlaid.palettes.clear();
            return;
        };
        let skeleton = &open.model.skeleton;
        let clip = self.clip.and_then(|clip| open.model.clips.get(clip));
        if let (Some(plan), Some(clip)) = (overlaid.ghost_plan, clip) {
            let now_secs = self.playback.time_secs();
            ghost_times(clip, now_secs, plan, &mut overlaid.times_secs);
            let times_secs = &overlaid.times_secs;
            let (scratch, palettes) = (&mut overlaid.scratch, &mut overlaid.palettes);
            palettes_at(times_secs, scratch, palettes, |time_secs, pose| {
                mix.pose_unfaded(open, clip, time_secs, pose);
            });
            let past = times_secs.iter().filter(|&&time_secs| time_secs < now_secs).count();
            let colors = (0..times_secs.len()).map(|ghost| ghost_color(ghost, past, times_secs.len()));
            overlaid.ghost_colors_srgb.extend(colors);
        } else {
            overlaid.palettes.clear();
        }
        if overlaid.bind_ghost && skeleton.joint_count() > 0 {
            overlaid.scratch.set_bind_pose(skeleton);
            overlaid.palettes.push(overlaid.scratch.palette.clone());
            overlaid.ghost_colors_srgb.push(BIND_SRGB);
        }
    }

    fn fill_trails(&mut self, overlaid: &mut Overlaid) {
        if self.joints.trails().is_empty() || self.clip.is_none() {
            return;
        }
        let wanted = TrailsKey {
            clips: self.clips_revision,
            clip: self.clip,
            blend: self.blend(),
            joints: self.joints.trails().to_vec(),
        };
        if overlaid.trails_for.as_ref() != Some(&wanted) {
            self.follow_trails(&mut overlaid.trails, &mut overlaid.scratch);
            overlaid.trails_for = Some(wanted);
        }
        let Some(open) = &self.open else { return };
        let world_from_model = self.world_from_model();
        let colors = joint_colors(&open.model.skeleton);
        for (joint, points) in self.joints.trails().iter().zip(overlaid.trails.polylines()) {
            let [red, green, blue, _] = colors
                .get(joint.index())
                .copied()
                .unwrap_or(BoneColors::of(self.theme).plain);
            for step in points.windows(2) {
                let [from, to] = [step[0], step[1]].map(|point| world_from_model.transform_point3(point));
                overlaid.geometry.line(from, to, [red, green, blue, 255]);
            }
        }
    }
}

/// Nearer ghosts are more opaque. The first `past` of `count` come before now, the farthest first.
fn ghost_color(ghost: usize, past: usize, count: usize) -> [u8; 4] {
    let (steps_away, most, [red, green, blue]) = if ghost < past {
        (past - ghost, past, PAST_SRGB)
    } else {
        (ghost - past + 1, count - past, FUTURE_SRGB)
    };
    let [near, far] = GHOST_ALPHA.map(f32::from);
    let share = (steps_away - 1) as f32 / most.max(1) as f32;
    [red, green, blue, (near + (far - near) * share) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ghosts_fade_away_from_now_on_both_sides() {
        let alphas: Vec<u8> = (0..5).map(|ghost| ghost_color(ghost, 2, 5)[3]).collect();
        assert!(alphas[0] < alphas[1] && alphas[2] > alphas[3] && alphas[3] > alphas[4]);
        assert_eq!((alphas[1], alphas[2]), (GHOST_ALPHA[0], GHOST_ALPHA[0]));
        assert_eq!(ghost_color(0, 2, 5)[..3], PAST_SRGB);
        assert_eq!(ghost_color(4, 2, 5)[..3], FUTURE_SRGB);
    }
}
