//! From the file's clips to tracks: one per joint, sorted, finite, of unit rotations.

use glam::{Quat, Vec3};

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Code, Subject, codes};
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
    unsorted: Tally,
    equal_times: Tally,
    not_finite: Tally,
    not_unit: Tally,
    zero_rotation: Tally,
    other_side: Tally,
    empty: Tally,
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
            let keys = mended_keys(bone, keys, &mut mended);
            if keys.is_empty() {
                if (bone as usize) < bones.len() {
                    mended.empty.add(bone);
                }
                tracks.push(Track::at_rest(rest));
            } else {
                tracks.push(Track::new(keys)?);
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
        let mut warn = |code: &Code, tally: Tally, one: &str, many: &str, rule: &str| {
            if tally.count > 0 {
                let place = Place::of_rows_in(Subject::Clip(self.clip), &tally, &self.lines.bones, clip_line);
                diagnostics.add(code, place, format!("{} {rule}", counted(tally.count, one, many)));
            }
        };
        let bones = ("bone has", "bones have");
        let keys = ("key has", "keys have");
        warn(
            &codes::TRACK_EMPTY,
            mended.empty,
            bones.0,
            bones.1,
            "no keys in this clip; at rest as in the bind pose.",
        );
        warn(
            &codes::KEYS_NOT_FINITE,
            mended.not_finite,
            keys.0,
            keys.1,
            "a number that is not finite or a time beyond 10⁹ s; left out.",
        );
        warn(
            &codes::KEYS_NOT_SORTED,
            mended.unsorted,
            bones.0,
            bones.1,
            "keys that are not in the order of time; sorted.",
        );
        warn(
            &codes::KEYS_AT_EQUAL_TIMES,
            mended.equal_times,
            keys.0,
            keys.1,
            "the time of the key before; the first and the last key of a time are kept as a jump.",
        );
        warn(
            &codes::ROTATION_NOT_UNIT,
            mended.not_unit,
            keys.0,
            keys.1,
            "a rotation that is not of unit length; normalised.",
        );
        warn(
            &codes::ROTATION_ZERO,
            mended.zero_rotation,
            keys.0,
            keys.1,
            "a rotation of length 0; taken as no rotation.",
        );
        warn(
            &codes::ROTATION_SIDE,
            mended.other_side,
            keys.0,
            keys.1,
            "a rotation with all signs turned against the key before; turned back.",
        );
    }
}

/// The keys of a bone: finite, in strictly increasing time.
fn mended_keys(bone: u32, keys: &[Keyframe], mended: &mut Mended) -> Vec<(f32, LocalJoint)> {
    let mut sound = Vec::with_capacity(keys.len());
    for key in keys {
        let stored = Quat::from_array(key.rotation);
        let joint = LocalJoint {
            rotation: stored,
            translation: Vec3::from_array(key.translation),
            scale: Vec3::from_array(key.scale),
        };
        if !joint.is_finite() || key.time_secs.is_nan() || key.time_secs.abs() > MAX_TIME_SECS {
            mended.not_finite.add(bone);
            continue;
        }
        let rotation = unit_rotation(stored).unwrap_or_else(|| {
            mended.zero_rotation.add(bone);
            Quat::IDENTITY
        });
        if (stored.length() - 1.0).abs() > UNIT_TOLERANCE && stored.length() > 0.0 {
            mended.not_unit.add(bone);
        }
        // Adding 0 makes −0 and 0 the same time for the sort as well.
        sound.push((key.time_secs + 0.0, LocalJoint { rotation, ..joint }));
    }
    if !sound.is_sorted_by(|a, b| a.0 <= b.0) {
        mended.unsorted.add(bone);
        sound.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let keys = apart(bone, sound, mended);
    for two in keys.windows(2) {
        if two[0].1.rotation.dot(two[1].1.rotation) < OTHER_SIDE {
            mended.other_side.add(bone);
        }
    }
    keys
}

/// Of keys at one time the first ends the motion before it and the last begins the motion after it; those between are
/// never seen. The last is moved to the next time that a number can name.
fn apart(bone: u32, keys: Vec<(f32, LocalJoint)>, mended: &mut Mended) -> Vec<(f32, LocalJoint)> {
    if keys.is_sorted_by(|a, b| a.0 < b.0) {
        return keys;
    }
    let mut kept: Vec<(f32, LocalJoint)> = Vec::with_capacity(keys.len());
    for group in keys.chunk_by(|a, b| a.0 == b.0) {
        let (time_secs, first) = group[0];
        let (_, last) = group[group.len() - 1];
        (1..group.len()).for_each(|_| mended.equal_times.add(bone));
        if kept.last().is_none_or(|before| before.0 < time_secs) {
            kept.push((time_secs, first));
        }
        if group.len() > 1 {
            kept.push((time_secs.next_up(), last));
        }
    }
    kept
}
