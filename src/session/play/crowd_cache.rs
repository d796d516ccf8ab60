//! The other instances as a renderer wants them, made anew only when what they show is different.
//!
//! While the picture moves, an instance out of sight is posed anew every 8th time, and one that reaches less than 1/150 of the picture's
//! height every 4th, each at a turn of its own; in between it keeps the pose that it has. In a picture that rests, and wherever all
//! detail is asked for, all are posed.

use glam::Affine3A;

use super::instances::{CrowdState, Instances, moved};
use crate::anim::{ClipPose, CrowdPalettes};
use crate::scene::{Camera, Crowd, CrowdInstance, Sight};
use crate::session::changes::Revisions;
use crate::session::look::view::View;
use crate::session::open::open_model::OpenModel;

/// An instance out of sight is posed anew this often: at 60 poses a second nearly 8 times a second, which is enough for its shadow.
const TURNS_OUT_OF_SIGHT: u32 = 8;
/// A small one: 15 times a second.
const TURNS_OF_SMALL: u32 = 4;
/// What reaches less of the picture's height is small: 7 pixels of 1080.
const SMALL_HEIGHT: f32 = 1.0 / 150.0;

/// Buffers that are kept from frame to frame.
#[derive(Debug, Default)]
pub(in crate::session) struct CrowdCache {
    filled_for: Option<Key>,
    /// Poses so far, in which instances take turns.
    turn: u32,
    /// The pose that each instance is shown in, by its index.
    shown: Vec<ClipPose>,
    /// Indices of the instances that are drawn, those in sight first.
    order: Vec<usize>,
    out_of_sight: Vec<usize>,
    /// In the same order.
    poses: Vec<ClipPose>,
    drawn: Vec<CrowdInstance>,
    in_sight: usize,
    palettes: CrowdPalettes,
}

/// What the instances that are drawn depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Key {
    state: CrowdState,
    clips_revision: u64,
    pose_revision: u64,
    bind_weight: f32,
    camera: Camera,
    aspect: f32,
    world_from_file: Affine3A,
    poses_all: bool,
}

impl CrowdCache {
    /// Brings poses and places to now. With `poses_all` every instance is posed, whether it is seen or not.
    pub(in crate::session) fn update(
        &mut self,
        open: &OpenModel,
        instances: &Instances,
        bind_weight: f32,
        view: &View,
        revisions: Revisions,
        poses_all: bool,
    ) {
        let world_from_file = view.world_from_model(Some(open));
        let key = Key {
            state: instances.state(),
            clips_revision: revisions.clips,
            pose_revision: revisions.pose,
            bind_weight,
            camera: view.camera,
            aspect: view.aspect,
            world_from_file,
            poses_all,
        };
        if self.filled_for == Some(key) {
            return;
        }
        let before = self.filled_for.replace(key);
        let is_same_crowd =
            before.is_some_and(|before| (before.state, before.clips_revision) == (key.state, key.clips_revision));
        if !is_same_crowd {
            self.palettes.clear();
            self.shown.clear();
            self.shown.resize(instances.count(), ClipPose::BIND);
        }
        if before.is_none_or(|before| before.pose_revision != key.pose_revision) {
            self.turn = self.turn.wrapping_add(1);
        }

        let formation = instances.formation(world_from_file);
        let (center, radius) = (formation.reach.center(), formation.reach.radius());
        let sight = Sight::of(&view.camera, view.aspect);
        self.order.clear();
        self.out_of_sight.clear();
        for (index, player) in instances.others() {
            let center = center + instances.offset(&formation, index);
            let is_in_sight = sight.shows(center, radius);
            let turns = match is_in_sight {
                _ if poses_all || !is_same_crowd => 1,
                false => TURNS_OUT_OF_SIGHT,
                true if sight.height_of(center, radius) < SMALL_HEIGHT => TURNS_OF_SMALL,
                true => 1,
            };
            if self.turn.wrapping_add(index as u32).is_multiple_of(turns) {
                self.shown[index] = player.pose();
            }
            if is_in_sight {
                self.order.push(index);
            } else {
                self.out_of_sight.push(index);
            }
        }
        self.in_sight = self.order.len();
        self.order.extend_from_slice(&self.out_of_sight);

        let Self {
            order, shown, poses, ..
        } = self;
        poses.clear();
        poses.extend(order.iter().map(|&index| shown[index]));
        self.palettes
            .update(&open.model.skeleton, &open.compiled, bind_weight, &self.poses);
        self.drawn.clear();
        let drawn = self.order.iter().zip(self.palettes.slots());
        self.drawn.extend(drawn.map(|(&index, &palette)| CrowdInstance {
            world_from_model: moved(world_from_file, instances.offset(&formation, index)),
            palette,
        }));
    }

    /// The instances for a renderer.
    pub(in crate::session) fn crowd(&self) -> Crowd<'_> {
        Crowd {
            instances: &self.drawn,
            in_sight: self.in_sight,
            palettes: self.palettes.palettes(),
        }
    }

    /// Place and palette of an instance of the model, by its index; none of the selected one.
    pub(in crate::session) fn posed(&self, index: usize, joint_count: usize) -> Option<(Affine3A, &[Affine3A])> {
        let drawn = self.drawn.get(self.order.iter().position(|&drawn| drawn == index)?)?;
        let start = drawn.palette as usize * joint_count;
        Some((
            drawn.world_from_model,
            self.palettes.palettes().get(start..start + joint_count)?,
        ))
    }
}
