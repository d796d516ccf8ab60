//! Keys that say nothing, and loops that jump.

use crate::anim::JointChange;
use crate::diagnostic::collect::{Diagnostics, Moments, Place, counted};
use crate::diagnostic::{Entry, Moment, Places, Subject, codes};
use crate::model::{Clip, JointIndex, Model, Track};

/// Up to this many equal keys of a bone are none too many: the first and the last are a common way to say how long it keeps still.
const FEW_KEYS: usize = 2;

/// From this fraction of a clip's keys on it is worth while to leave out those of still bones. The books' soldier could lose 2 %.
const WORTH_WHILE: f64 = 0.1;

/// Notes clips of which a good part are equal keys of bones that keep still.
pub(super) fn note_still_tracks(model: &Model, places: &dyn Places, diagnostics: &mut Diagnostics) {
    for (index, clip) in (0u32..).zip(&model.clips) {
        let of_bones = model.skeleton.file_bones().iter().zip(&clip.tracks);
        let mut still = Moments::default();
        for (&bone, _) in of_bones.filter(|(_, track)| is_still(track)) {
            still.add(Moment::of_bone(bone), || {
                places.line(Entry::Track { clip: index, bone })
            });
        }
        let keys: usize = clip.tracks.iter().map(Track::key_count).sum();
        if let Some(surplus) = surplus_keys(clip) {
            diagnostics.add(
                &codes::KEYS_ALL_EQUAL,
                Place::of_moments(Subject::Clip(index), &still, None),
                format!(
                    "{} still in \"{}\", each with equal keys: {surplus} of its {keys} keys could be left out.",
                    counted(still.count, "bone keeps", "bones keep"),
                    clip.name
                ),
            );
        }
    }
}

/// How many keys of still bones could be left out of a clip, where that is worth while.
pub(crate) fn surplus_keys(clip: &Clip) -> Option<usize> {
    let still = clip.tracks.iter().filter(|track| is_still(track));
    let surplus: usize = still.map(|track| track.key_count() - 1).sum();
    let keys: usize = clip.tracks.iter().map(Track::key_count).sum();
    (surplus > 0 && surplus as f64 >= WORTH_WHILE * keys as f64).then_some(surplus)
}

/// Whether all keys of a track are equal, and they are more than a few.
pub(crate) fn is_still(track: &Track) -> bool {
    let first = track.key(0);
    let is_straight = !track.holds() && !track.bends();
    track.key_count() > FEW_KEYS && is_straight && track.keys().all(|(_, key)| key == first)
}

/// A clip is meant to loop when it ends, all bones together, within this fraction of the way that they come from their first keys. A
/// walk that leads elsewhere, or a fall, ends far from where it began.
const MEANT_TO_LOOP: f32 = 0.1;

/// A jump of the surface by this fraction of the model's size is told: five times what can just be seen
/// ([`VISIBLE_FRACTION`](crate::anim::VISIBLE_FRACTION)), since the timeline tells of lesser ones.
const JUMP_FRACTION: f32 = 0.01;

/// A jump is no jump when the bone moves as far in this time anyway, as where the last key is one frame before the first.
const FRAME_SECS: f32 = 1.0 / 30.0;

/// Notes clips that look meant to loop, but whose last pose is off from the first.
pub(super) fn note_loop_gaps(model: &Model, places: &dyn Places, diagnostics: &mut Diagnostics) {
    let bounds = model.bind_bounds();
    let size = bounds.min.distance(bounds.max);
    if bounds.is_empty() || size <= 0.0 {
        return;
    }
    for (index, clip) in (0u32..).zip(&model.clips) {
        if let Some((joint, jump)) = loop_jump(model, clip, size) {
            let bone = model.skeleton.file_bones()[joint.index()];
            diagnostics.add(
                &codes::LOOP_JUMPS,
                Place::on(Subject::Clip(index), places.line(Entry::Track { clip: index, bone })).at([Moment::new(clip.end_secs, bone)]),
                format!(
                    "\"{}\" ends near its first pose, but bone {bone} jumps by {:.1} % of the model's size where it begins again.",
                    clip.name,
                    jump / size * 100.0
                ),
            );
        }
    }
}

/// The bone that jumps most where a clip begins again, and how far its surface does; `None` when none does or the clip is not meant to
/// loop.
fn loop_jump(model: &Model, clip: &Clip, size: f32) -> Option<(JointIndex, f32)> {
    let tracks = || (0u32..).map(JointIndex).zip(&clip.tracks);
    let way = |joint: JointIndex, track: &Track, from: usize, to: usize| {
        JointChange::between(&model.skeleton, joint, &track.key(from), &track.key(to)).surface_way(size)
    };
    let gaps: Vec<f32> = tracks()
        .map(|(joint, track)| way(joint, track, 0, track.key_count() - 1))
        .collect();
    // Most clips end here, with a look at two keys of each bone.
    if gaps.iter().all(|&gap| gap < JUMP_FRACTION * size) {
        return None;
    }
    let (mut reached, mut worst) = (0.0, None);
    for ((joint, track), &gap) in tracks().zip(&gaps) {
        let keys = 1..track.key_count();
        reached += keys.clone().map(|key| way(joint, track, 0, key)).fold(0.0, f32::max);
        let speed = keys.map(|key| {
            let step_secs = track.times_secs()[key] - track.times_secs()[key - 1];
            way(joint, track, key - 1, key) / step_secs
        });
        let is_jump = gap >= JUMP_FRACTION * size && gap > speed.fold(0.0, f32::max) * FRAME_SECS;
        if is_jump && worst.is_none_or(|(_, most)| gap > most) {
            worst = Some((joint, gap));
        }
    }
    worst.filter(|_| gaps.iter().sum::<f32>() <= MEANT_TO_LOOP * reached)
}
