//! From the file's clips to tracks: one per joint, sorted, finite, of unit rotations.

use glam::{Quat, Vec3};

use crate::diagnostic::collect::{Diagnostics, Moments, Place, counted};
use crate::diagnostic::{Code, Fault, Moment, Subject, codes};
use crate::format::{BoneAnimation, ClipLines, Document, Keyframe, LineMap};
use crate::import::keys::{self, Mended};
use crate::model::{Clip, LocalJoint, Skeleton, Track, unique_names};
use crate::slices::Slices;

/// The dot product of two keys' quaternions below which the second lies on the other side. About 0 both sides are as near: there a bone
/// turns by half a circle, and no sign is wrong. Here it turns by less than a third of one.
const OTHER_SIDE: f32 = -0.5;

/// All clips of a document for a skeleton.
pub(super) async fn clips_from_document(
    document: &Document,
    lines: &LineMap,
    skeleton: &Skeleton,
    diagnostics: &mut Diagnostics,
    slices: &Slices,
) -> Result<Vec<Clip>, Fault> {
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
    let mut clips = Vec::with_capacity(document.clips.len());
    for (index, (clip, name)) in (0u32..).zip(document.clips.iter().zip(names)) {
        let reader = ClipReader {
            clip: index,
            lines: lines.clips.get(index as usize).unwrap_or(&no_lines),
            skeleton,
        };
        clips.push(reader.read(name, &clip.bones, diagnostics, slices).await?);
    }
    Ok(clips)
}

/// What is noted of one clip, counted over its bones.
#[derive(Default)]
struct Noted {
    mended: Mended,
    other_side: Moments,
    empty: Moments,
}

struct ClipReader<'a> {
    clip: u32,
    lines: &'a ClipLines,
    skeleton: &'a Skeleton,
}

impl ClipReader<'_> {
    async fn read(
        &self,
        name: String,
        bones: &[BoneAnimation],
        diagnostics: &mut Diagnostics,
        slices: &Slices,
    ) -> Result<Clip, Fault> {
        let mut noted = Noted::default();
        let mut tracks = Vec::with_capacity(self.skeleton.joint_count());
        for (&bone, &rest) in self.skeleton.file_bones().iter().zip(self.skeleton.rest()) {
            let keys = bones
                .get(bone as usize)
                .map(|bone| bone.keyframes.as_slice())
                .unwrap_or_default();
            let keys = mended_keys(bone, keys, self.lines, &mut noted, slices).await;
            slices.pause().await;
            if keys.is_empty() {
                if (bone as usize) < bones.len() {
                    noted
                        .empty
                        .add(Moment::of_bone(bone), || self.lines.bones.get(bone as usize).copied());
                }
                tracks.push(Track::at_rest(rest));
            } else {
                tracks.push(Track::new(
                    keys.into_iter().map(|(time_secs, (_, joint))| (time_secs, joint)),
                )?);
            }
        }
        self.note(&noted, bones.len(), diagnostics);

        let mut clip = Clip::new(name, tracks);
        clip.key_count = bones.iter().map(|bone| bone.keyframes.len()).sum();
        Ok(clip)
    }

    fn note(&self, noted: &Noted, bone_count: usize, diagnostics: &mut Diagnostics) {
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
        let mut tell = |code: &Code, moments: &Moments, message| {
            diagnostics.add(
                code,
                Place::of_moments(Subject::Clip(self.clip), moments, clip_line),
                message,
            );
        };
        let bones = ["bone has", "bones have"];
        if noted.empty.count > 0 {
            let message = keys::in_words(
                &noted.empty,
                bones,
                "no keys in this clip",
                "at rest as in the bind pose",
            );
            tell(&codes::TRACK_EMPTY, &noted.empty, message);
        }
        noted.mended.tell(bones, &mut tell);
        if noted.other_side.count > 0 {
            let (who, what) = (
                ["key has", "keys have"],
                "a rotation with all signs turned against the key before",
            );
            let message = keys::in_words(&noted.other_side, who, what, "turned back");
            tell(&codes::ROTATION_SIDE, &noted.other_side, message);
        }
    }
}

/// A key that is sound: its time, and its number among those of its bone in the file.
type Key = (f32, (u32, LocalJoint));

/// The keys of a bone: finite, in strictly increasing time.
async fn mended_keys(bone: u32, keys: &[Keyframe], lines: &ClipLines, noted: &mut Noted, slices: &Slices) -> Vec<Key> {
    let add = |moments: &mut Moments, number: u32, time_secs: f32| {
        keys::add(moments, bone, time_secs, || lines.key(bone, number));
    };
    let Noted { mended, other_side, .. } = noted;
    let mut sound: Vec<Key> = Vec::with_capacity(keys.len());
    let mend = |(number, key): (u32, &Keyframe)| {
        let joint = LocalJoint {
            rotation: Quat::from_array(key.rotation),
            translation: Vec3::from_array(key.translation),
            scale: Vec3::from_array(key.scale),
        };
        let time_secs = key.time_secs;
        if !joint.is_finite() || !keys::is_time(time_secs) {
            return add(&mut mended.not_finite, number, time_secs);
        }
        let rotation = mended.rotation(joint.rotation, |moments| add(moments, number, time_secs));
        // Adding 0 makes −0 and 0 the same time for the sort as well.
        sound.push((time_secs + 0.0, (number, LocalJoint { rotation, ..joint })));
    };
    slices.for_each((0..).zip(keys), mend).await;
    let keys = mended.in_order(sound, |moments, &(time_secs, (number, _))| {
        add(moments, number, time_secs);
    });
    slices.pause().await;
    for two in keys.windows(2) {
        let (time_secs, (number, joint)) = two[1];
        if two[0].1.1.rotation.dot(joint.rotation) < OTHER_SIDE {
            add(other_side, number, time_secs);
        }
    }
    keys
}
