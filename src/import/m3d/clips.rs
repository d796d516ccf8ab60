//! From the file's clips to tracks: one per joint, sorted, finite, of unit rotations.

use glam::{Quat, Vec3};

use crate::diagnostic::collect::{Diagnostics, Moments, Place, counted};
use crate::diagnostic::{Code, Moment, Subject, codes};
use crate::format::{BoneAnimation, ClipLines, Document, Keyframe, LineMap};
use crate::model::{Clip, LocalJoint, ModelError, Skeleton, Track, unique_names, unit_rotation};

/// A rotation whose length is off by more than this was not meant to be rounded.
const UNIT_TOLERANCE: f32 = 1e-3;

/// Thirty years: a time beyond it is no time, and its next neighbour could not be told from it.
const MAX_TIME_SECS: f32 = 1e9;

/// The dot product of two keys' quaternions below which the second lies on the other side. About 0 both sides are as near: there a bone
/// turns by half a circle, and no sign is wrong. Here it turns by less than a third of one.
const OTHER_SIDE: f32 = -0.5;

/// All clips of a document for a skeleton.
pub(super) fn clips_from_document(
    document: &Document,
    lines: &LineMap,
    skeleton: &Skeleton,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Clip>, ModelError> {
    let clip_lines = lines.clip_lines();
    let names = unique_names(
        document.clips.iter().map(|clip| clip.name.as_str()),
        "clip",
        |index, name| {
            diagnostics.add(
                &codes::DUPLICATE_CLIP_NAME,
                Place::of(Subject::Clip(index), &clip_lines),
                format!("Another clip has the same name; this one is shown as \"{name}\"."),
            );
        },
    );
    for (index, _) in (0u32..).zip(&document.clips).filter(|(_, clip)| clip.name.is_empty()) {
        diagnostics.add(
            &codes::CLIP_UNNAMED,
            Place::of(Subject::Clip(index), &clip_lines),
            codes::CLIP_UNNAMED.sentence.into(),
        );
    }
    let no_lines = ClipLines::default();
    (0u32..)
        .zip(document.clips.iter().zip(names))
        .map(|(index, (clip, name))| {
            let reader = ClipReader {
                clip: index,
                lines: lines.clips.get(index as usize).unwrap_or(&no_lines),
                skeleton,
            };
            reader.read(name, &clip.bones, diagnostics)
        })
        .collect()
}

/// What is mended in the keys of one clip, counted over its bones.
#[derive(Default)]
struct Mended {
    unsorted: Moments,
    equal_times: Moments,
    not_finite: Moments,
    not_unit: Moments,
    zero_rotation: Moments,
    other_side: Moments,
    empty: Moments,
}

struct ClipReader<'a> {
    clip: u32,
    lines: &'a ClipLines,
    skeleton: &'a Skeleton,
}

impl ClipReader<'_> {
    fn read(&self, name: String, bones: &[BoneAnimation], diagnostics: &mut Diagnostics) -> Result<Clip, ModelError> {
        let mut mended = Mended::default();
        let mut tracks = Vec::with_capacity(self.skeleton.joint_count());
        for (&bone, &rest) in self.skeleton.file_bones().iter().zip(self.skeleton.rest()) {
            let keys = bones
                .get(bone as usize)
                .map(|bone| bone.keyframes.as_slice())
                .unwrap_or_default();
            let keys = mended_keys(bone, keys, self.lines, &mut mended);
            if keys.is_empty() {
                if (bone as usize) < bones.len() {
                    mended
                        .empty
                        .add(Moment::of_bone(bone), || self.lines.bones.get(bone as usize).copied());
                }
                tracks.push(Track::at_rest(rest));
            } else {
                tracks.push(Track::new(keys.into_iter().map(|key| (key.time_secs, key.joint)))?);
            }
        }
        self.note(&mended, bones.len(), diagnostics);

        let mut clip = Clip::new(name, tracks);
        clip.key_count = bones.iter().map(|bone| bone.keyframes.len()).sum();
        Ok(clip)
    }

    fn note(&self, mended: &Mended, bone_count: usize, diagnostics: &mut Diagnostics) {
        let joint_count = self.skeleton.joint_count();
        let clip_line = Some(self.lines.clip).filter(|&line| line > 0);
        let at_clip = || Place::on(Subject::Clip(self.clip), clip_line);
        if bone_count < joint_count {
            let missing = counted(joint_count - bone_count, "bone has", "bones have");
            diagnostics.add(
                &codes::CLIP_BONES_MISSING,
                at_clip(),
                format!("{missing} no track in this clip; at rest as in the bind pose."),
            );
        }
        if bone_count > joint_count {
            let more = counted(bone_count - joint_count, "track", "tracks");
            diagnostics.add(
                &codes::CLIP_BONES_EXTRA,
                at_clip(),
                format!("The clip has {more} more than the skeleton has bones; left out."),
            );
        }
        let mut warn = |code: &Code, moments: &Moments, [one, many]: [&str; 2], what: &str, done: &str| {
            if moments.count > 0 {
                let place = Place::of_moments(Subject::Clip(self.clip), moments, clip_line);
                let (counted, first) = (counted(moments.count, one, many), moments.first_in_words());
                diagnostics.add(code, place, format!("{counted} {what}{first}; {done}."));
            }
        };
        let bones = ["bone has", "bones have"];
        let keys = ["key has", "keys have"];
        warn(
            &codes::TRACK_EMPTY,
            &mended.empty,
            bones,
            "no keys in this clip",
            "at rest as in the bind pose",
        );
        warn(
            &codes::KEYS_NOT_FINITE,
            &mended.not_finite,
            keys,
            "a number that is not finite or a time beyond 10⁹ s",
            "left out",
        );
        warn(
            &codes::KEYS_NOT_SORTED,
            &mended.unsorted,
            bones,
            "keys that are not in the order of time",
            "sorted",
        );
        warn(
            &codes::KEYS_AT_EQUAL_TIMES,
            &mended.equal_times,
            keys,
            "the time of the key before",
            "the first and the last key of a time are kept as a jump",
        );
        warn(
            &codes::ROTATION_NOT_UNIT,
            &mended.not_unit,
            keys,
            "a rotation that is not of unit length",
            "normalised",
        );
        warn(
            &codes::ROTATION_ZERO,
            &mended.zero_rotation,
            keys,
            "a rotation of length 0",
            "taken as no rotation",
        );
        warn(
            &codes::ROTATION_SIDE,
            &mended.other_side,
            keys,
            "a rotation with all signs turned against the key before",
            "turned back",
        );
    }
}

/// A key that is sound, with its number among those of its bone in the file.
#[derive(Clone, Copy)]
struct Key {
    number: u32,
    time_secs: f32,
    joint: LocalJoint,
}

/// The keys of a bone: finite, in strictly increasing time.
fn mended_keys(bone: u32, keys: &[Keyframe], lines: &ClipLines, mended: &mut Mended) -> Vec<Key> {
    let note = |moments: &mut Moments, number: u32, time_secs: f32| {
        let moment = Moment {
            time_secs: Some(time_secs).filter(|time_secs| time_secs.abs() <= MAX_TIME_SECS),
            bone: Some(bone),
        };
        moments.add(moment, || lines.key(bone, number));
    };
    let mut sound: Vec<Key> = Vec::with_capacity(keys.len());
    for (number, key) in (0u32..).zip(keys) {
        let stored = Quat::from_array(key.rotation);
        let joint = LocalJoint {
            rotation: stored,
            translation: Vec3::from_array(key.translation),
            scale: Vec3::from_array(key.scale),
        };
        let time_secs = key.time_secs;
        if !joint.is_finite() || time_secs.is_nan() || time_secs.abs() > MAX_TIME_SECS {
            note(&mut mended.not_finite, number, time_secs);
            continue;
        }
        let rotation = unit_rotation(stored).unwrap_or_else(|| {
            note(&mut mended.zero_rotation, number, time_secs);
            Quat::IDENTITY
        });
        if (stored.length() - 1.0).abs() > UNIT_TOLERANCE && stored.length() > 0.0 {
            note(&mut mended.not_unit, number, time_secs);
        }
        sound.push(Key {
            number,
            // Adding 0 makes −0 and 0 the same time for the sort as well.
            time_secs: time_secs + 0.0,
            joint: LocalJoint { rotation, ..joint },
        });
    }
    if let Some(early) = sound.windows(2).find(|two| two[0].time_secs > two[1].time_secs) {
        note(&mut mended.unsorted, early[1].number, early[1].time_secs);
        sound.sort_by(|a, b| a.time_secs.total_cmp(&b.time_secs));
    }
    let keys = apart(sound, |key| note(&mut mended.equal_times, key.number, key.time_secs));
    for two in keys.windows(2) {
        if two[0].joint.rotation.dot(two[1].joint.rotation) < OTHER_SIDE {
            note(&mut mended.other_side, two[1].number, two[1].time_secs);
        }
    }
    keys
}

/// Of keys at one time the first ends the motion before it and the last begins the motion after it; those between are
/// never seen. The last is moved to the next time that a number can name, and so is a key whose time was taken so. `note` is told of
/// each key at the time of one before.
fn apart(keys: Vec<Key>, mut note: impl FnMut(&Key)) -> Vec<Key> {
    if keys.is_sorted_by(|a, b| a.time_secs < b.time_secs) {
        return keys;
    }
    let mut kept: Vec<Key> = Vec::with_capacity(keys.len());
    for group in keys.chunk_by(|a, b| a.time_secs == b.time_secs) {
        group[1..].iter().for_each(&mut note);
        let last = group.last().filter(|_| group.len() > 1);
        for &key in group.first().into_iter().chain(last) {
            let free_secs = kept
                .last()
                .map_or(f32::NEG_INFINITY, |before| before.time_secs.next_up());
            kept.push(Key {
                time_secs: key.time_secs.max(free_secs),
                ..key
            });
        }
    }
    kept
}
