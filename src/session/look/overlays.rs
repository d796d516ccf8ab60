//! What is drawn over the model and in place of its colours: bones, trails, ghosts, colours of the skin. In buffers that are
//! filled again only when what they show is different.

use std::f32::consts::TAU;
use std::sync::Arc;

use glam::{Affine3A, Vec3};

use super::Look;
use super::skeleton_cache::{SkeletonCache, SkinColorsKey};
use crate::anim::{GhostPlan, Palette, PoseBuffers, Trails, ghost_times, palettes_at};
use crate::model::{JointIndex, Model};
use crate::scene::{
    Aabb, BoneColors, Ghosts, MarkedJoints, OverlayGeometry, Theme, VertexColors, append_bones, append_marked_bones,
    joint_colors,
};
use crate::session::changes::Revisions;
use crate::session::open::open_model::OpenModel;
use crate::session::play::actor::Actor;
use crate::session::play::mixer::Blend;

/// How opaque the nearest ghost is, and the farthest.
pub const GHOST_ALPHA: [u8; 2] = [110, 40];
/// Colours of ghosts of the past and of the future, and of the bind pose's, sRGB.
pub const GHOSTS_SRGB: [[u8; 3]; 3] = [PAST_SRGB, FUTURE_SRGB, BIND_SRGB];
const PAST_SRGB: [u8; 3] = [90, 169, 255];
const FUTURE_SRGB: [u8; 3] = [255, 180, 84];
const BIND_SRGB: [u8; 3] = [160, 170, 190];
/// Half the thickness of a trail, as a fraction of the scene's radius. A line of one pixel is hard to see on a skin.
const TRAIL_RADIUS: f32 = 0.004;

/// Sides of the ring around the selected instance, and its width as a fraction of its radius.
const RING_SEGMENTS: usize = 64;
const RING_WIDTH: f32 = 0.05;

/// Buffers, and what they were filled for.
#[derive(Debug, Default)]
pub(in crate::session) struct OverlayCache {
    geometry: OverlayGeometry,
    trails: Trails,
    trails_for: Option<TrailsKey>,
    trail_colors: Vec<[u8; 4]>,
    colors_srgb: Vec<[u8; 4]>,
    colors_for: Option<SkinColorsKey>,
    colors_revision: u64,
    /// At least one for each colour of a ghost.
    palettes: Vec<Palette>,
    ghost_colors_srgb: Vec<[u8; 4]>,
    ghosts_for: Option<GhostsKey>,
    times_secs: Vec<f32>,
    scratch: PoseBuffers,
}

#[derive(Clone, Debug, PartialEq)]
struct TrailsKey {
    clips_revision: u64,
    clip: Option<usize>,
    blend: Option<Blend>,
    joints: Arc<Vec<JointIndex>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct GhostsKey {
    pose_revision: u64,
    plan: Option<GhostPlan>,
    bind_ghost: bool,
}

impl OverlayCache {
    pub(in crate::session) fn geometry(&self) -> &OverlayGeometry {
        &self.geometry
    }

    /// None while the skin is shown as it is.
    pub(in crate::session) fn vertex_colors(&self) -> Option<VertexColors<'_>> {
        self.colors_for?;
        Some(VertexColors {
            colors_srgb: &self.colors_srgb,
            revision: self.colors_revision,
        })
    }

    pub(in crate::session) fn ghosts(&self) -> Ghosts<'_> {
        Ghosts {
            palettes: &self.palettes[..self.ghost_colors_srgb.len()],
            colors_srgb: &self.ghost_colors_srgb,
        }
    }

    /// Colours the vertices for a key, unless they have these colours already. `positions` are those of the pose for a key that
    /// needs them.
    pub(in crate::session) fn update_colors(
        &mut self,
        key: Option<SkinColorsKey>,
        model: Option<&Model>,
        positions: &[Vec3],
        skeleton: &mut SkeletonCache,
    ) {
        if self.colors_for == key {
            return;
        }
        self.colors_for = key;
        self.colors_revision += 1;
        self.colors_srgb.clear();
        if let (Some(key), Some(model)) = (key, model) {
            skeleton.skin_colors(model, key, positions, &mut self.colors_srgb);
        }
    }

    /// Draws bones and trails anew, in the world.
    pub(in crate::session) fn update_geometry(
        &mut self,
        open: Option<&OpenModel>,
        actor: &mut Actor,
        (look, marked): (&Look, MarkedJoints),
        skeleton: &SkeletonCache,
        (theme, world_from_model): (Theme, Affine3A),
        revisions: Revisions,
    ) {
        self.geometry.clear();
        let bone_colors = BoneColors::of(theme);
        let (bones, style, geometry) = (skeleton.bones(), look.bone_style, &mut self.geometry);
        if look.bones_visible {
            append_bones(bones, style, marked, bone_colors, geometry);
        } else if look.skin_view.is_none() {
            // Colours of the skin tell by themselves which bone they are of.
            append_marked_bones(bones, style, marked, bone_colors, geometry);
        }
        let Some(open) = open else { return };
        if look.trails.is_empty() || actor.player.clip.is_none() {
            return;
        }
        self.update_trails(open, actor, look, revisions);
        let radius = TRAIL_RADIUS * skeleton.bones().scene_radius();
        for (&[red, green, blue, _], points) in self.trail_colors.iter().zip(self.trails.polylines()) {
            for step in points.windows(2) {
                let [from, to] = [step[0], step[1]].map(|point| world_from_model.transform_point3(point));
                self.geometry.line(from, to, [red, green, blue, 255]);
                self.geometry.tube(from, to, radius, [red, green, blue, 255]);
            }
        }
    }

    /// Draws a ring on the ground around the instance that is selected, whose box is `bounds`. After [`OverlayCache::update_geometry`].
    pub(in crate::session) fn mark_place(&mut self, bounds: &Aabb, ground_height: f32, color_srgb: [u8; 4]) {
        let (center, size) = (bounds.center(), bounds.size());
        let radius = 0.5 * size.x.max(size.z);
        let at = |segment: usize, radius: f32| {
            let (sin, cos) = (segment as f32 / RING_SEGMENTS as f32 * TAU).sin_cos();
            Vec3::new(center.x + radius * cos, ground_height, center.z + radius * sin)
        };
        for segment in 0..RING_SEGMENTS {
            let [inner, outer] =
                [1.0 - RING_WIDTH, 1.0].map(|part| [segment, segment + 1].map(|end| at(end, radius * part)));
            self.geometry.triangle([inner[0], outer[1], outer[0]], color_srgb);
            self.geometry.triangle([inner[0], inner[1], outer[1]], color_srgb);
        }
    }

    /// Poses the ghosts, unless they are those of the last call.
    pub(in crate::session) fn update_ghosts(
        &mut self,
        open: Option<&OpenModel>,
        actor: &mut Actor,
        look: &Look,
        revisions: Revisions,
    ) {
        let wanted = GhostsKey {
            pose_revision: revisions.pose,
            plan: look.ghosts,
            bind_ghost: look.bind_ghost,
        };
        if self.ghosts_for == Some(wanted) {
            return;
        }
        self.ghosts_for = Some(wanted);
        self.ghost_colors_srgb.clear();
        self.times_secs.clear();
        let Some(open) = open else { return };
        let skeleton = &open.model.skeleton;
        let clip = actor.player.clip.and_then(|clip| open.clip(clip));
        let with_bind = look.bind_ghost && skeleton.joint_count() > 0;
        let now_secs = actor.player.playback.time_secs();
        if let (Some(plan), Some((clip, _))) = (look.ghosts, clip) {
            ghost_times(clip, now_secs, plan, &mut self.times_secs);
        }
        let times_secs = &self.times_secs;
        let count = times_secs.len() + usize::from(with_bind);
        self.palettes
            .resize_with(count.max(self.palettes.len()), Palette::default);
        if let Some((_, compiled)) = clip {
            let mixer = &mut actor.mixer;
            palettes_at(times_secs, &mut self.scratch, &mut self.palettes, |time_secs, pose| {
                mixer.pose_unfaded(open, compiled, time_secs, pose);
            });
            let past = times_secs.iter().filter(|&&time_secs| time_secs < now_secs).count();
            let colors = (0..times_secs.len()).map(|ghost| ghost_color(ghost, past, times_secs.len()));
            self.ghost_colors_srgb.extend(colors);
        }
        if with_bind {
            self.scratch.set_bind_pose(skeleton);
            self.palettes[count - 1].0.clone_from(&self.scratch.palette.0);
            let [red, green, blue] = BIND_SRGB;
            self.ghost_colors_srgb.push([red, green, blue, GHOST_ALPHA[0]]);
        }
    }

    /// Finds the paths of joints through the clip and what is blended into it, unless they are those of the last call.
    fn update_trails(&mut self, open: &OpenModel, actor: &mut Actor, look: &Look, revisions: Revisions) {
        let joints = &look.trails;
        let wanted = TrailsKey {
            clips_revision: revisions.clips,
            clip: actor.player.clip,
            blend: actor.mixer.blend(),
            joints: Arc::clone(joints),
        };
        if self.trails_for.as_ref() == Some(&wanted) {
            return;
        }
        self.trails_for = Some(wanted);
        let colors = joint_colors(&open.model.skeleton);
        self.trail_colors = joints
            .iter()
            .filter_map(|joint| colors.get(joint.index()).copied())
            .collect();
        let mixer = &mut actor.mixer;
        match actor.player.clip.and_then(|clip| open.clip(clip)) {
            Some((clip, compiled)) => self.trails.follow(clip, joints, &mut self.scratch, |time_secs, pose| {
                mixer.pose_unfaded(open, compiled, time_secs, pose);
            }),
            None => self.trails = Trails::default(),
        }
    }
}

/// Nearer ghosts are more opaque. The first `past` of `count` come before now, the farthest first.
pub fn ghost_color(ghost: usize, past: usize, count: usize) -> [u8; 4] {
    let (steps_away, most, [red, green, blue]) = if ghost < past {
        (past - ghost, past, PAST_SRGB)
    } else {
        (ghost - past + 1, count - past, FUTURE_SRGB)
    };
    let [near, far] = GHOST_ALPHA.map(f32::from);
    let fraction = (steps_away - 1) as f32 / most.max(1) as f32;
    [red, green, blue, (near + (far - near) * fraction) as u8]
}
