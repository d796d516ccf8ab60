//! The instances of the open model: what each of them plays, and where it stands.

use glam::{Affine3A, Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::player::Player;
use crate::scene::Aabb;
use crate::session::open::open_model::OpenModel;

/// The most instances in a crowd.
pub const MAX_CROWD: usize = 1_000;

/// How far an instance may stand off its place, in spaces between two: not in rank and file, and not on its neighbour's feet.
pub const JITTER: f32 = 0.2;
/// Instances are at least this far apart, in sizes of the model: one that is flat, or has only bones, has room too.
const LEAST_SPACING: f32 = 0.25;

/// How many instances there are, and which is selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct CrowdState {
    /// Instances; 1 is the model alone.
    pub count: usize,
    /// What clips, times and places come from.
    pub seed: u32,
    /// The one that timeline, skeleton and read-outs are of.
    pub selected: usize,
}

impl Default for CrowdState {
    fn default() -> Self {
        Self {
            count: 1,
            seed: 1,
            selected: 0,
        }
    }
}

/// The instances of the open model.
#[derive(Clone, Debug)]
pub(in crate::session) struct Instances {
    /// Never empty. What the selected one plays is the actor's; here is what it played when it was selected.
    all: Vec<Instance>,
    selected: usize,
    seed: u32,
    /// Box of all that the clips reach, in the file's space, and of all that is seen: the bind pose too.
    of_clips: Aabb,
    of_all: Aabb,
    least_spacing: f32,
    /// Since the last [`Instances::take_changed`].
    changed: bool,
}

#[derive(Clone, Debug, Default)]
struct Instance {
    player: Player,
    /// Where it stands beside the first, to the right and to the back, in spaces between two.
    place: Vec2,
}

impl Default for Instances {
    fn default() -> Self {
        Self {
            all: vec![Instance::default()],
            selected: 0,
            seed: CrowdState::default().seed,
            of_clips: Aabb::EMPTY,
            of_all: Aabb::EMPTY,
            least_spacing: 0.0,
            changed: false,
        }
    }
}

/// How the instances stand in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::session) struct Formation {
    /// Box of all that an instance at the first one's place reaches.
    pub(in crate::session) reach: Aabb,
    /// Between two places, along x and z.
    spacing: Vec2,
}

impl Formation {
    fn offset(&self, place: Vec2) -> Vec3 {
        let Vec2 { x, y: z } = place * self.spacing;
        Vec3::new(x, 0.0, z)
    }
}

impl Instances {
    pub(in crate::session) fn state(&self) -> CrowdState {
        CrowdState {
            count: self.all.len(),
            seed: self.seed,
            selected: self.selected,
        }
    }

    /// Whether there are others beside the first.
    pub(in crate::session) fn are_many(&self) -> bool {
        self.all.len() > 1
    }

    pub(in crate::session) fn count(&self) -> usize {
        self.all.len()
    }

    /// Whether others are there, show something else or stand elsewhere since the last call.
    pub(in crate::session) fn take_changed(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    /// Those that are not selected, with their indices.
    pub(in crate::session) fn others(&self) -> impl Iterator<Item = (usize, &Player)> {
        let all = self.all.iter().enumerate();
        all.filter(|&(index, _)| index != self.selected)
            .map(|(index, instance)| (index, &instance.player))
    }

    fn others_mut(&mut self) -> impl Iterator<Item = &mut Player> {
        let all = self.all.iter_mut().enumerate();
        all.filter(|&(index, _)| index != self.selected)
            .map(|(_, instance)| &mut instance.player)
    }

    pub(in crate::session) fn formation(&self, world_from_file: Affine3A) -> Formation {
        let size = self.of_clips.transformed(world_from_file).size();
        Formation {
            reach: self.of_all.transformed(world_from_file),
            spacing: Vec2::new(size.x, size.z).max(Vec2::splat(self.least_spacing)),
        }
    }

    /// How far an instance stands from the first one's place, world space.
    pub(in crate::session) fn offset(&self, formation: &Formation, instance: usize) -> Vec3 {
        formation.offset(self.all[instance].place)
    }

    /// Box of all that they reach, world space.
    pub(in crate::session) fn bounds(&self, formation: &Formation) -> Aabb {
        let places = self.all.iter().map(|instance| instance.place);
        let (least, greatest) = places.fold((Vec2::ZERO, Vec2::ZERO), |(least, greatest), place| {
            (least.min(place), greatest.max(place))
        });
        if formation.reach.is_empty() {
            return formation.reach;
        }
        Aabb {
            min: formation.reach.min + formation.offset(least),
            max: formation.reach.max + formation.offset(greatest),
        }
    }

    /// Learns how much room the clips of the model take.
    pub(in crate::session) fn measure(&mut self, open: &OpenModel) {
        if !self.are_many() {
            return;
        }
        let clips = 0..open.model.clips.len();
        self.of_clips = clips.fold(Aabb::EMPTY, |reach, clip| reach.union(open.extent(Some(clip)).bounds));
        self.of_all = self.of_clips.union(open.bind_bounds);
        if self.of_clips.is_empty() {
            self.of_clips = self.of_all;
        }
        self.least_spacing = open.size() * LEAST_SPACING;
        self.changed = true;
    }

    /// Keeps the first ones, and gives the others clips, times and places by the seed. Their times are as far on as the `lead`'s is, so
    /// that going to a time before gives the same as going there afterwards.
    pub(in crate::session) fn set(
        &mut self,
        open: &OpenModel,
        kept: usize,
        (count, seed): (usize, u32),
        lead: &Player,
    ) {
        self.seed = seed;
        self.all.truncate(kept);
        for index in self.all.len()..count {
            self.all.push(Instance {
                player: Player::default(),
                place: place(seed, index),
            });
        }
        self.give_clips(open, kept, lead);
        self.measure(open);
        self.changed = true;
    }

    /// Makes all but the selected one anew.
    pub(in crate::session) fn restore(&mut self, open: &OpenModel, state: CrowdState, lead: &Player) {
        let count = state.count.clamp(1, MAX_CROWD);
        self.selected = state.selected.min(count - 1);
        self.set(open, 0, (count, state.seed), lead);
    }

    /// What an instance plays that is not selected.
    pub(in crate::session) fn player(&self, instance: usize) -> Option<&Player> {
        self.all.get(instance).map(|instance| &instance.player)
    }

    /// Gives clips and times to the instances from one on.
    pub(in crate::session) fn give_clips(&mut self, open: &OpenModel, from: usize, lead: &Player) {
        let lead_secs = f64::from(lead.playback.time_secs()) - f64::from(lead.playback.start_secs());
        for (index, Instance { player, .. }) in self.all.iter_mut().enumerate().skip(from) {
            player.play_as(&lead.playback);
            let clips = open.model.clips.len() as u32;
            let clip = noise(self.seed, index, 0).checked_rem(clips);
            if clip.is_some_and(|clip| player.show_clip(open, clip as usize)) {
                let played_secs = player.playback.duration_secs() * fraction(noise(self.seed, index, 1));
                player.playback.seek(player.playback.start_secs() + played_secs);
                player.playback.shift(lead_secs);
            }
            player.set_playing(lead.playback.is_playing());
        }
    }

    /// Exchanges what the actor plays for what an instance plays.
    pub(in crate::session) fn select(&mut self, instance: usize, playing: &mut Player) {
        for index in [self.selected, instance] {
            std::mem::swap(&mut self.all[index].player, playing);
        }
        self.selected = instance;
        self.changed = true;
    }

    /// Lets time pass for the others.
    pub(in crate::session) fn advance(&mut self, dt_secs: f32) {
        let mut moved = false;
        for player in self.others_mut() {
            moved |= player.playback.advance(dt_secs);
        }
        self.changed |= moved;
    }

    /// Moves the others' times.
    pub(in crate::session) fn shift(&mut self, secs: f64) {
        self.others_mut().for_each(|player| player.playback.shift(secs));
        self.changed |= self.are_many();
    }

    /// Lets the others play as the actor does: as fast, in its direction, with its ends.
    pub(in crate::session) fn play_as(&mut self, actor: &Player) {
        self.others_mut().for_each(|player| player.play_as(&actor.playback));
    }

    pub(in crate::session) fn set_playing(&mut self, playing: bool) {
        self.others_mut().for_each(|player| player.set_playing(playing));
        // One that begins again is elsewhere at once.
        self.changed |= self.are_many();
    }

    /// Lets each of the others find its clip, by the name it had, in a way.
    pub(in crate::session) fn find_clips(
        &mut self,
        open: &OpenModel,
        names: &[Option<String>],
        find: impl Fn(&mut Player, &OpenModel, Option<&str>),
    ) {
        for (player, name) in self.others_mut().zip(names) {
            find(player, open, name.as_deref());
        }
        self.measure(open);
    }

    /// The model has no clips any more.
    pub(in crate::session) fn show_no_clips(&mut self, open: &OpenModel) {
        for player in self.others_mut() {
            player.show_no_clip();
            player.playback.pause();
        }
        self.measure(open);
    }
}

/// A transform into the world, and on by a way.
pub(in crate::session) fn moved(world_from_model: Affine3A, way: Vec3) -> Affine3A {
    Affine3A {
        translation: world_from_model.translation + glam::Vec3A::from(way),
        ..world_from_model
    }
}

/// Where an instance stands, in spaces between two: the others stand in rings beside and behind the first, each ring half a square and
/// 4 places longer than the one inside it. It is filled from both front ends to the middle of the back.
pub fn place(seed: u32, index: usize) -> Vec2 {
    // Ring r begins with index r (2 r − 1).
    let mut ring = 0;
    while (ring + 1) * (2 * ring + 1) <= index {
        ring += 1;
    }
    if ring == 0 {
        return Vec2::ZERO;
    }
    let of_ring = index - ring * (2 * ring - 1);
    let side = if of_ring.is_multiple_of(2) { -1.0 } else { 1.0 };
    let pair = of_ring / 2;
    let (aside, behind) = if pair <= ring {
        (ring, pair)
    } else {
        (2 * ring - pair, ring)
    };
    let jitter = |what| (fraction(noise(seed, index, what)) * 2.0 - 1.0) * JITTER;
    Vec2::new(side * aside as f32 + jitter(2), behind as f32 + jitter(3))
}

/// A number that looks like any other, the same on every platform. The steps are those of lowbias32 (Wellons 2018).
pub fn noise(seed: u32, instance: usize, what: u32) -> u32 {
    let mix = |bits: u32| {
        let bits = (bits ^ bits >> 16).wrapping_mul(0x7feb_352d);
        let bits = (bits ^ bits >> 15).wrapping_mul(0x846c_a68b);
        bits ^ bits >> 16
    };
    [instance as u32, what]
        .into_iter()
        .fold(mix(seed.wrapping_add(0x9e37_79b9)), |bits, more| {
            mix(bits ^ mix(more.wrapping_add(0x9e37_79b9)))
        })
}

/// Noise as a number from 0 to below 1.
pub fn fraction(noise: u32) -> f32 {
    (noise >> 8) as f32 / (1 << 24) as f32
}
