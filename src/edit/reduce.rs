//! Leaves keys out that say little.
//!
//! Each track is thinned by itself (Ramer–Douglas–Peucker), channels with times of their own one by one, in a bound of its own: its share of
//! what the joints of its chain may do together. Then the poses at all old keys and between them are compared, in the model's space; chains
//! that came too far off are thinned again in less, and what does not fit in the end keeps its keys. So the bound holds whatever the shares were.

use glam::{Affine3A, Quat, Vec3A};

use super::edited::{Change, Edited, with_tracks};
use super::error::EditError;
use crate::anim::{CompiledClip, PoseBuffers, straight};
use crate::model::{Aabb, Channel, ChannelValue, Clip, LocalJoint, Model, Skeleton, Track, Way};
use crate::slices::{Slices, Stage};

/// Errors of a chain's joints rarely point the same way, so shares begin greater than what is safe.
const FIRST_SHARE: f32 = 8.0;

/// A greater tolerance leaves nothing of a motion.
const MOST_TOLERANCE: f32 = 0.1;

/// Poses are compared at old keys and half-way between them. Elsewhere they may be so much further off.
const BETWEEN: f32 = 1.05;

/// Times that are looked at in each round, but for the last, and the most that are left out between two of them.
const FEW_TIMES: usize = 1024;
const MOST_STEP: usize = 32;

/// So often is a chain thinned anew before it keeps its keys. Where that does not help, all tracks keep theirs: tracks are sampled
/// together, so that beside huge numbers those of one chain are rounded by what is left out of another.
const MOST_ROUNDS: usize = 8;

/// Thins all clips, so that no joint and no tip is off by more than a tolerance of the bind pose's diagonal at any old key, or between them.
pub(super) async fn reduce(edited: &mut Edited, tolerance: f32, slices: &Slices) -> Result<(), EditError> {
    if !(tolerance > 0.0 && tolerance <= MOST_TOLERANCE) {
        return Err(EditError::Refused(format!(
            "The tolerance of reduced keys cannot be {tolerance}: it is a part of the model's size, above 0 and at most {MOST_TOLERANCE}."
        )));
    }
    let Edited { model, changes, .. } = edited;
    let diagonal = diagonal(model);
    let bound = tolerance * diagonal / BETWEEN;
    let tips = tip_distances(model);
    let count = model.clips.len();
    for (index, old) in model.clips.iter_mut().enumerate() {
        slices.pause_at(Stage::Editing, 1 + index, 2 + count).await;
        let (new, reached) = thinned_clip(&model.skeleton, &tips, old, bound, slices).await;
        if new.key_count == old.key_count && new.tracks == old.tracks {
            continue;
        }
        let fraction = if diagonal > 0.0 {
            BETWEEN * reached / diagonal
        } else {
            0.0
        };
        // Where one channel keeps a time that another does without, the track has its key.
        let in_channels = |clip: &Clip| clip.tracks.iter().map(Track::channel_key_count).sum();
        let (keys, [kept, of]) = match new.key_count == old.key_count {
            true => ("keys in its channels", [in_channels(&new), in_channels(old)]),
            false => ("keys", [new.key_count, old.key_count]),
        };
        changes.push(Change::new(
            "keys-reduced",
            format!(
                "\"{}\" has {kept} {keys} instead of {of}; no joint or tip is off by more than {fraction:.2e} of the model's size.",
                new.name
            ),
        ));
        *old = new;
    }
    Ok(())
}

/// Of the bind pose: its vertices, or its joints where there are none.
fn diagonal(model: &Model) -> f32 {
    let joints = model.skeleton.bind_model_from_joint().iter();
    let bounds = match model.bind_bounds() {
        bounds if bounds.is_empty() => Aabb::from_points(joints.map(|joint| joint.translation.into())),
        bounds => bounds,
    };
    bounds.size().length()
}

/// How far what hangs on each joint itself reaches from it: its children at rest, and its vertices by their weights.
fn tip_distances(model: &Model) -> Vec<f32> {
    let skeleton = &model.skeleton;
    let mut tips = vec![0.0_f32; skeleton.joint_count()];
    for (joint, parent) in skeleton.parents().iter().enumerate() {
        if let Some(parent) = parent {
            tips[parent.index()] = tips[parent.index()].max(skeleton.rest()[joint].translation.length());
        }
    }
    for (position, influences) in model.mesh.positions.iter().zip(&model.mesh.influences) {
        for (&joint, &weight) in influences.joints.iter().zip(&influences.weights) {
            if weight > 0.0 {
                let in_joint = skeleton.joint_from_bind()[joint as usize].transform_point3(*position);
                tips[joint as usize] = tips[joint as usize].max(in_joint.length() * weight);
            }
        }
    }
    tips
}

/// A clip with as few keys as the bound lets it have, and how far off it is. All tracks are thinned in their shares, which become less until
/// the clip keeps to the bound.
async fn thinned_clip(skeleton: &Skeleton, tips: &[f32], clip: &Clip, bound: f32, slices: &Slices) -> (Clip, f32) {
    let limits = Limits::new(skeleton, tips, clip, bound);
    let old = CompiledClip::new(clip);
    // Where the poses are compared; with splines, those of the new clip come to them in each round.
    let mut times_secs = all_times(&[clip]);
    // Of the times one in so many is looked at, and all in the last round.
    let mut step = (times_secs.len() / FEW_TIMES).clamp(1, MOST_STEP);
    let mut shares = vec![FIRST_SHARE; clip.tracks.len()];
    let mut rounds = 0;
    loop {
        let new = with_tracks(clip, limits.thinned(clip, &shares, slices).await);
        if clip.tracks.iter().any(Track::bends) {
            times_secs = all_times(&[clip, &new]);
        }
        let compared_secs = times_secs.iter().copied().step_by(step);
        let off = greatest_errors(skeleton, tips, [&old, &CompiledClip::new(&new)], compared_secs, slices).await;
        let reached = off.iter().copied().fold(0.0, f32::max);
        let is_over = |joint: usize| off[joint] > bound;
        if !(0..off.len()).any(is_over) || shares.iter().all(|&share| share == 0.0) {
            if std::mem::replace(&mut step, 1) == 1 {
                return (new, reached);
            }
            continue;
        }
        rounds += 1;
        let mut tightened = vec![1.0_f32; shares.len()];
        for joint in (0..off.len()).rev() {
            if is_over(joint) {
                let factor = if rounds <= MOST_ROUNDS {
                    (0.8 * bound / off[joint]).clamp(0.1, 0.8)
                } else {
                    0.0
                };
                tightened[joint] = tightened[joint].min(factor);
            }
            if let Some(parent) = skeleton.parents()[joint] {
                tightened[parent.index()] = tightened[parent.index()].min(tightened[joint]);
            }
        }
        for (share, factor) in shares.iter_mut().zip(tightened) {
            *share *= if rounds <= MOST_ROUNDS + 1 { factor } else { 0.0 };
        }
    }
}

/// Every time at which some joint has a key, to the bit, or begins a straight piece of a spline; and those half-way between two.
fn all_times(clips: &[&Clip]) -> Vec<f32> {
    let tracks = clips.iter().flat_map(|clip| &clip.tracks);
    let keyed = tracks.filter(|track| track.has_keys()).map(straight);
    let mut times_secs: Vec<f32> = keyed.flat_map(|track| track.times_secs().to_vec()).collect();
    times_secs.sort_by(f32::total_cmp);
    times_secs.dedup();
    let between = times_secs.windows(2).map(|pair| pair[0].midpoint(pair[1]));
    let between: Vec<f32> = between.collect();
    times_secs.extend(between);
    times_secs
}

/// For each joint how far it, or a tip of it, is off at most.
async fn greatest_errors(
    skeleton: &Skeleton,
    tips: &[f32],
    [old, new]: [&CompiledClip; 2],
    times_secs: impl Iterator<Item = f32>,
    slices: &Slices,
) -> Vec<f32> {
    let mut poses = [PoseBuffers::for_skeleton(skeleton), PoseBuffers::for_skeleton(skeleton)];
    let mut greatest = vec![0.0_f32; skeleton.joint_count()];
    for secs in times_secs {
        slices.pause().await;
        poses[0].evaluate(skeleton, old, secs);
        poses[1].evaluate(skeleton, new, secs);
        let joints = poses[0].model.0.iter().zip(&poses[1].model.0);
        for ((greatest, (old, new)), &tip) in greatest.iter_mut().zip(joints).zip(tips) {
            *greatest = greatest.max(apart(old, new, tip));
        }
    }
    greatest
}

/// How far apart two places of a joint are at most: its own, and all that is no more than `tip` away from it. A matrix lengthens nothing by
/// more than the root of the squares of its numbers, nor by more than that of the greatest row of its product with itself.
fn apart(old: &Affine3A, new: &Affine3A, tip: f32) -> f32 {
    let moved = new.translation - old.translation;
    let turned = new.matrix3 - old.matrix3;
    let columns = [turned.x_axis, turned.y_axis, turned.z_axis];
    let product = turned.transpose() * turned;
    let rows = [product.x_axis, product.y_axis, product.z_axis].map(|row| row.abs().element_sum());
    let all: f32 = columns.into_iter().map(Vec3A::length_squared).sum();
    let greatest_row = rows.into_iter().fold(0.0, f32::max);
    moved.length() + all.min(greatest_row).sqrt() * tip
}

/// How much each track may be off by itself.
#[derive(Clone, Debug)]
struct Limits {
    /// Its share of the bound, were all errors of a chain to add up.
    bounds: Vec<f32>,
    /// How far what hangs on the joint reaches, its whole branch stretched out.
    reaches: Vec<f32>,
}

impl Limits {
    fn new(skeleton: &Skeleton, tips: &[f32], clip: &Clip, bound: f32) -> Self {
        let parents = skeleton.parents();
        let is_thinned = |track: &Track| track.key_count() > 2;
        let own: Vec<u32> = clip.tracks.iter().map(|track| u32::from(is_thinned(track))).collect();
        let (mut above, mut below) = (own.clone(), own.clone());
        for (joint, parent) in parents.iter().enumerate() {
            if let Some(parent) = parent {
                above[joint] += above[parent.index()];
            }
        }
        let mut reaches = tips.to_vec();
        for (joint, parent) in parents.iter().enumerate().rev() {
            if let Some(parent) = parent.map(|parent| parent.index()) {
                below[parent] = below[parent].max(own[parent] + below[joint]);
                let lengths = clip.tracks[joint].translation().values().iter().map(|way| way.length());
                reaches[parent] = reaches[parent].max(reaches[joint] + lengths.fold(0.0, f32::max));
            }
        }
        let chain = |joint: usize| above[joint] + below[joint] - own[joint];
        Self {
            bounds: (0..own.len()).map(|joint| bound / chain(joint).max(1) as f32).collect(),
            reaches,
        }
    }

    async fn thinned(&self, clip: &Clip, shares: &[f32], slices: &Slices) -> Vec<Track> {
        let mut tracks = clip.tracks.clone();
        for (joint, (track, &share)) in tracks.iter_mut().zip(shares).enumerate() {
            if share > 0.0 {
                *track = thinned(track, self.reaches[joint], self.bounds[joint] * share, slices).await;
            }
        }
        tracks
    }
}

/// A track without the keys that move nothing by more than `bound`. Channels of the same times keep the same ones, so that rows stay rows.
async fn thinned(track: &Track, reach: f32, bound: f32, slices: &Slices) -> Track {
    let (translation, rotation, scale) = (track.translation(), track.rotation(), track.scale());
    if track.has_rows() && !track.holds() && !track.bends() {
        let keys: Vec<_> = track.keys().collect();
        let off = |ends: [usize; 2], key| off_by(&ends.map(|end| keys[end]), keys[key], reach);
        let kept = kept_keys(keys.len(), bound, off, slices).await;
        return Track::of_channels(
            of_rows(translation, &kept),
            of_rows(rotation, &kept),
            of_rows(scale, &kept),
        );
    }
    Track::of_channels(
        thinned_channel(translation, bound, |a, b| a.distance(b), slices).await,
        thinned_channel(rotation, bound, |a, b| 2.0 * chord(a, b) * reach, slices).await,
        thinned_channel(scale, bound, |a, b| (a - b).abs().max_element() * reach, slices).await,
    )
}

/// Some rows of a channel; one that keeps still has fewer keys.
fn of_rows<T: ChannelValue>(channel: &Channel<T>, kept: &[usize]) -> Channel<T> {
    if channel.times_secs().len() > 1 {
        channel.with_keys(kept)
    } else {
        channel.clone()
    }
}

/// A channel by itself. `apart` measures how far apart two of its values bring what hangs on the joint.
async fn thinned_channel<T: ChannelValue>(
    channel: &Channel<T>,
    bound: f32,
    apart: impl Fn(T, T) -> f32,
    slices: &Slices,
) -> Channel<T> {
    let (times_secs, values) = (channel.times_secs(), channel.values());
    if times_secs.len() <= 2 {
        return channel.clone();
    }
    let last = values.len() - 1;
    let kept = match channel.way() {
        Way::Straight => {
            let off = |[from, to]: [usize; 2], key: usize| {
                let part = part_of_way([times_secs[from], times_secs[to]], times_secs[key]);
                apart(T::between([values[from], values[to]], part), values[key])
            };
            kept_keys(values.len(), bound, off, slices).await
        }
        Way::Held => (1..=last).fold(vec![0], |mut kept, key| {
            if key == last || apart(values[kept[kept.len() - 1]], values[key]) > bound {
                kept.push(key);
            }
            kept
        }),
        Way::Spline(slopes) => {
            let off = |ends: [usize; 2], key: usize| {
                let longer = channel.with_keys(&ends);
                let (value, [slope, _]) = (longer.value_at(times_secs[key]), longer.slopes_at(times_secs[key]));
                // Between two keys the error is a cubic as well, and leaves the hull of its control points nowhere.
                let [before, after] = [key - 1, key + 1].map(|next| (times_secs[next] - times_secs[key]) / 3.0);
                let control = |third: f32, own: T| apart(value + slope * third, values[key] + own * third);
                control(0.0, slope)
                    .max(control(before, slopes[key][0]))
                    .max(control(after, slopes[key][1]))
            };
            kept_keys(values.len(), bound, off, slices).await
        }
    };
    channel.with_keys(&kept)
}

/// Keys between which no other one is off by more than `bound`; `off` says by how much one is between two. A part that is halved often at
/// its ends is halved in its middle, so that the time stays near linear.
async fn kept_keys(count: usize, bound: f32, off: impl Fn([usize; 2], usize) -> f32, slices: &Slices) -> Vec<usize> {
    let last = count - 1;
    let mut kept = vec![false; count];
    (kept[0], kept[last]) = (true, true);
    let mut open = vec![(0, last, 0)];
    while let Some((from, to, depth)) = open.pop() {
        let mut worst = None;
        // Of keys that are equally far off it is the last one.
        let further = |key| {
            let error = off([from, to], key);
            if worst.is_none_or(|(_, most): (usize, f32)| error.total_cmp(&most).is_ge()) {
                worst = Some((key, error));
            }
        };
        slices.for_each(from + 1..to, further).await;
        let Some((worst, error)) = worst else { continue };
        if error <= bound {
            continue;
        }
        let at = if depth < 48 { worst } else { from.midpoint(to) };
        kept[at] = true;
        open.extend([(from, at, depth + 1), (at, to, depth + 1)]);
    }
    (0..=last).filter(|&key| kept[key]).collect()
}

/// How far what hangs on a joint is off where a key is left out between two others.
fn off_by(ends: &[(f32, LocalJoint); 2], (secs, key): (f32, LocalJoint), reach: f32) -> f32 {
    let [(from_secs, from), (to_secs, to)] = ends;
    let part = part_of_way([*from_secs, *to_secs], secs) as f32;
    let translation = from.translation.lerp(to.translation, part);
    let rotation = from.rotation.slerp(to.rotation, part);
    let scale = from.scale.lerp(to.scale, part);
    let stretch = (scale - key.scale).abs().max_element();
    translation.distance(key.translation) + (2.0 * chord(rotation, key.rotation) + stretch) * reach
}

fn chord(a: Quat, b: Quat) -> f32 {
    (a - b).length().min((a + b).length())
}

fn part_of_way([from_secs, to_secs]: [f32; 2], secs: f32) -> f64 {
    let [from_secs, to_secs, secs] = [from_secs, to_secs, secs].map(f64::from);
    (secs - from_secs) / (to_secs - from_secs)
}
