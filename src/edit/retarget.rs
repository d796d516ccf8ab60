//! Clips of one skeleton for another one: bones that have the same name move alike.
//!
//! Two bones have the same frame where their children have the same local positions, up to one scale for the whole skeleton. Where most bones have, the keys
//! are taken as they are. Elsewhere a motion is kept relative to the rest pose: `P · R′ · R′₀⁻¹ · P⁻¹ · R₀`, where R′ is the other's rotation, R′₀ and R₀ are
//! both at rest, and P leads from the space of the other's parent to that of ours, both at rest.

use std::collections::HashMap;

use glam::{DQuat, DVec3, Quat, Vec3};

use crate::diagnostic::Fault;
use crate::model::{Channel, Clip, JointIndex, LocalJoint, Skeleton, Track};

/// Places of children that are off by less than this part of their distance are the same.
const SAME_PLACE: f64 = 0.02;

/// Clips for another skeleton, and what did not fit.
#[derive(Debug)]
pub struct Retargeted {
    /// In the order of the given ones.
    pub clips: Vec<Clip>,
    /// Bones of the other skeleton that this one lacks.
    pub without_place: Vec<String>,
    /// Bones of this skeleton that the other one lacks; they rest.
    pub at_rest: Vec<String>,
    /// Whether the motion was kept relative to the rest pose.
    pub is_relative: bool,
}

/// The part of a bone's name that programs agree on: without anything up to the last colon, and without `mixamorig`, a number or `_` after it.
pub fn common_name(name: &str) -> &str {
    let name = name.rsplit(':').next().unwrap_or(name);
    match name.strip_prefix("mixamorig") {
        Some(rest) => rest
            .trim_start_matches(|digit: char| digit.is_ascii_digit())
            .trim_start_matches('_'),
        None => name,
    }
}

/// Whether bones of a skeleton have names, by which clips can find them.
pub fn has_names(skeleton: &Skeleton) -> bool {
    joints(skeleton).any(|joint| skeleton.name(joint).is_some())
}

fn joints(skeleton: &Skeleton) -> std::iter::Map<std::ops::Range<u32>, fn(u32) -> JointIndex> {
    (0..skeleton.joint_count() as u32).map(JointIndex)
}

/// How a skeleton's joints are at rest: rotation and mean scale of each relative to the model.
struct AtRest {
    turned: Vec<DQuat>,
    scale: Vec<f64>,
}

impl AtRest {
    fn of(skeleton: &Skeleton) -> Self {
        let mut rest = Self {
            turned: Vec::new(),
            scale: Vec::new(),
        };
        for (joint, local) in joints(skeleton).zip(skeleton.rest()) {
            let (above, scale) = rest.above(skeleton, joint);
            let own = local.scale.as_dvec3().abs();
            rest.turned.push((above * local.rotation.as_dquat()).normalize());
            rest.scale.push(scale * (own.x * own.y * own.z).cbrt());
        }
        rest
    }

    /// Of what a joint lies in.
    fn above(&self, skeleton: &Skeleton, joint: JointIndex) -> (DQuat, f64) {
        skeleton.parents()[joint.index()].map_or((DQuat::IDENTITY, 1.0), |parent| {
            (self.turned[parent.index()], self.scale[parent.index()])
        })
    }

    /// Where a joint is in its parent's frame, in the model's unit.
    fn place(&self, skeleton: &Skeleton, joint: JointIndex) -> DVec3 {
        skeleton.rest()[joint.index()].translation.as_dvec3() * self.above(skeleton, joint).1
    }
}

/// The lengths of our bones over those of theirs: the median.
fn scale(places: &[[DVec3; 2]]) -> f64 {
    let ratios = places.iter().map(|[our, their]| our.length() / their.length());
    let mut ratios: Vec<f64> = ratios.filter(|ratio| ratio.is_finite() && *ratio > 0.0).collect();
    ratios.sort_by(f64::total_cmp);
    let middle = ratios.get(ratios.len() / 2).copied().unwrap_or(1.0);
    if (middle - 1.0).abs() <= 1e-4 { 1.0 } else { middle }
}

/// The joint of theirs for each of ours: by whole names, else by common ones.
fn matched(ours: &Skeleton, theirs: &Skeleton) -> Vec<Option<JointIndex>> {
    let mut whole = HashMap::new();
    let mut common = HashMap::new();
    for joint in joints(theirs) {
        if let Some(name) = theirs.name(joint) {
            whole.entry(name).or_insert(joint);
            common.entry(common_name(name)).or_insert(joint);
        }
    }
    let mut is_taken = vec![false; theirs.joint_count()];
    let found = joints(ours).map(|joint| {
        let name = ours.name(joint)?;
        let found = *whole.get(name).or_else(|| common.get(common_name(name)))?;
        (!std::mem::replace(&mut is_taken[found.index()], true)).then_some(found)
    });
    found.collect()
}

/// Clips of another skeleton for this one; `None` where fewer than half of the bones that they move have a name that is known here.
///
/// # Errors
/// When a number of a clip overflows.
pub fn retarget(ours: &Skeleton, theirs: &Skeleton, clips: &[Clip]) -> Result<Option<Retargeted>, Fault> {
    let pairs = matched(ours, theirs);
    let mut of_theirs = vec![None; theirs.joint_count()];
    for (joint, found) in joints(ours).zip(&pairs) {
        if let Some(found) = found {
            of_theirs[found.index()] = Some(joint);
        }
    }
    let moves = |joint: JointIndex| clips.iter().any(|clip| clip.tracks[joint.index()].has_keys());
    let without: Vec<JointIndex> = joints(theirs)
        .filter(|joint| of_theirs[joint.index()].is_none())
        .collect();
    let lost = without.iter().filter(|&&joint| moves(joint)).count();
    if pairs.iter().flatten().next().is_none() || 2 * lost > joints(theirs).filter(|&joint| moves(joint)).count() {
        return Ok(None);
    }
    let rests = [AtRest::of(ours), AtRest::of(theirs)];
    // Only a bone whose parent is found too has a length to compare.
    let is_inner = |&(joint, found): &(JointIndex, JointIndex)| {
        let parents = [ours.parents()[joint.index()], theirs.parents()[found.index()]];
        matches!(parents, [Some(our), Some(their)] if pairs[our.index()] == Some(their))
    };
    let both = joints(ours)
        .zip(&pairs)
        .filter_map(|(joint, found)| Some((joint, (*found)?)));
    let places: Vec<[DVec3; 2]> = both
        .filter(is_inner)
        .map(|(joint, found)| [rests[0].place(ours, joint), rests[1].place(theirs, found)])
        .collect();
    let scale = scale(&places);
    // Hips stand elsewhere in each motion, and a few bones may be of another length.
    let are_same = |[our, their]: &&[DVec3; 2]| our.distance(*their * scale) <= SAME_PLACE * our.length();
    let have_same_frames = 4 * places.iter().filter(are_same).count() >= 3 * places.len();
    let mut of_clips = Vec::with_capacity(clips.len());
    for clip in clips {
        let mut tracks = Vec::with_capacity(ours.joint_count());
        for ((joint, found), &rest) in joints(ours).zip(&pairs).zip(ours.rest()) {
            let Some(found) = *found else {
                tracks.push(Track::at_rest(rest));
                continue;
            };
            let (our_turn, our_scale) = rests[0].above(ours, joint);
            let (their_turn, their_scale) = rests[1].above(theirs, found);
            let map = BoneMap {
                // Parents with the same frame may rest in another pose.
                from_theirs: match have_same_frames && is_inner(&(joint, found)) {
                    true => DQuat::IDENTITY,
                    false => (our_turn.inverse() * their_turn).normalize(),
                },
                scale: Some(scale * their_scale / our_scale)
                    .filter(|scale| scale.is_finite())
                    .unwrap_or(scale),
                rests: [rest, theirs.rest()[found.index()]],
                is_relative: !have_same_frames,
            };
            tracks.push(map.track(&clip.tracks[found.index()], clip.start_secs)?);
        }
        of_clips.push(Clip::new(clip.name.clone(), tracks));
    }
    let name = |skeleton: &Skeleton, joint: JointIndex| {
        skeleton.name(joint).map_or_else(
            || format!("bone {}", skeleton.file_bones()[joint.index()]),
            str::to_owned,
        )
    };
    Ok(Some(Retargeted {
        clips: of_clips,
        without_place: without.into_iter().map(|joint| name(theirs, joint)).collect(),
        at_rest: joints(ours)
            .zip(&pairs)
            .filter(|(_, found)| found.is_none())
            .map(|(joint, _)| name(ours, joint))
            .collect(),
        is_relative: !have_same_frames,
    }))
}

/// How the keys of a bone become those of ours.
struct BoneMap {
    /// From the space of the other's parent to that of ours, at rest: P.
    from_theirs: DQuat,
    /// Of lengths, on that way.
    scale: f64,
    /// Ours and theirs.
    rests: [LocalJoint; 2],
    is_relative: bool,
}

impl BoneMap {
    /// Whether keys stay as they are.
    fn is_plain(&self) -> bool {
        !self.is_relative && self.from_theirs.w.abs() >= 1.0 - 1e-12 && (self.scale - 1.0).abs() <= 1e-5
    }

    /// A channel that the other's clip leaves at rest has a key where our bone rests elsewhere.
    fn track(&self, track: &Track, start_secs: f32) -> Result<Track, Fault> {
        let [our, their] = &self.rests;
        let of_channels = |translation: Channel<Vec3>, rotation: Channel<Quat>, scale: Channel<Vec3>| {
            Track::of_channels(
                translation.resting_at(our.translation, start_secs),
                rotation.resting_at(our.rotation, start_secs),
                scale.resting_at(our.scale, start_secs),
            )
        };
        if self.is_plain() {
            return Ok(of_channels(
                track.translation().clone(),
                track.rotation().clone(),
                track.scale().clone(),
            ));
        }
        let before = self.from_theirs;
        let after = match self.is_relative {
            true => their.rotation.as_dquat().inverse() * before.inverse() * our.rotation.as_dquat(),
            // Its frame is ours: only what lies above turns it.
            false => DQuat::IDENTITY,
        };
        let rotation = |rotation: Quat| {
            // Slopes are no unit quaternions; the product is linear all the same.
            let [x, y, z, w] = rotation.as_dquat().to_array();
            (before * DQuat::from_xyzw(x, y, z, w) * after).as_quat()
        };
        let place = |place: Vec3| before.mul_vec3(place.as_dvec3() * self.scale).as_vec3();
        let ratio = |our: f32, their: f32| {
            let ratio = f64::from(our) / f64::from(their);
            // Far from 1 it is of another unit; a stretched pose is not.
            let is_unit = !(0.5..2.0).contains(&ratio.abs());
            if ratio.is_finite() && (self.is_relative || is_unit) {
                ratio
            } else {
                1.0
            }
        };
        let (our_scale, their_scale) = (our.scale.to_array(), their.scale.to_array());
        let sizes = DVec3::from_array(std::array::from_fn(|axis| ratio(our_scale[axis], their_scale[axis])));
        let offset = match self.is_relative {
            true => our.translation - place(their.translation),
            false => Vec3::ZERO,
        };
        Ok(of_channels(
            track.translation().mapped(place)?.moved(offset)?,
            track.rotation().mapped(rotation)?,
            track.scale().mapped(|scale| (scale.as_dvec3() * sizes).as_vec3())?,
        ))
    }
}
