//! Finds clips that take a bone, or a vertex on it, further than `f32` can hold.

use glam::{DAffine3, DMat3, DVec3};

use super::notes::{Notes, Place};
use super::track_group::joint_at;
use super::{Clip, Mesh, Skeleton, Track};
use crate::diagnostic::{Subject, codes};
use crate::format::LineMap;

/// Beyond it a pose is taken to overflow. It leaves room for the sums that make a pose, each of which must fit into `f32`.
const MOST: f64 = 1e37;

/// Where the numbers of a clip overflow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overflow {
    /// Time in the clip.
    pub time_secs: f32,
    /// The file's number of the bone.
    pub bone: u32,
}

/// Sets [`Clip::overflow`] of all clips, and notes those that have one.
///
/// It is looked for at the times at which the box of a clip is made: each key time, up to a number of them.
pub(super) fn note_overflows(mesh: &Mesh, skeleton: &Skeleton, clips: &mut [Clip], lines: &LineMap, notes: &mut Notes) {
    let reaches = reaches(mesh, skeleton.joint_count());
    for (index, clip) in (0u32..).zip(clips) {
        if stays_below(skeleton, clip, &reaches) {
            continue;
        }
        clip.overflow = first_overflow(skeleton, clip, &reaches);
        if let Some(Overflow { time_secs, bone }) = clip.overflow {
            let line = lines.clips.get(index as usize).map(|lines| lines.clip);
            let message = format!(
                "At {time_secs} s of \"{}\" bone {bone}, or a vertex on it, is taken beyond 10³⁷: numbers overflow there.",
                clip.name
            );
            notes.add(&codes::POSE_OVERFLOWS, Place::on(Subject::Clip(index), line), message);
        }
    }
}

/// For each joint the greatest x, y and z, without sign, of the vertices it moves in bind space.
fn reaches(mesh: &Mesh, joint_count: usize) -> Vec<DVec3> {
    let mut reaches = vec![DVec3::ZERO; joint_count];
    for (influences, position) in mesh.influences.iter().zip(&mesh.positions) {
        let weighted = influences.joints.iter().zip(&influences.weights);
        for (&joint, _) in weighted.filter(|(_, weight)| **weight > 0.0) {
            let reach = &mut reaches[joint as usize];
            *reach = reach.max(position.abs().as_dvec3());
        }
    }
    reaches
}

/// Whether bounds of all keys alone show that nothing overflows at any time: a chain of joints scales by no more than the
/// product of their greatest scales. So it is for every sound file, which then costs one look at each key.
fn stays_below(skeleton: &Skeleton, clip: &Clip, reaches: &[DVec3]) -> bool {
    let mut bounds: Vec<Bound> = Vec::with_capacity(skeleton.joint_count());
    let joints = clip.tracks.iter().zip(skeleton.parents());
    joints
        .zip(skeleton.joint_from_bind().iter().zip(reaches))
        .all(|((track, parent), (joint_from_bind, reach))| {
            let parent = parent.map_or(Bound::IDENTITY, |parent| bounds[parent.index()]);
            let model_from_joint = parent.after(Bound::of_track(track));
            bounds.push(model_from_joint);
            let joint_from_bind = Bound::of_matrix(&joint_from_bind.as_daffine3());
            let model_from_bind = model_from_joint.after(joint_from_bind);
            let vertices = model_from_bind.translation + model_from_bind.scale * reach.length();
            // NaN is not below.
            [
                model_from_joint.scale,
                model_from_joint.translation,
                model_from_bind.scale,
                vertices,
            ]
            .iter()
            .all(|&number| number < MOST)
        })
}

/// What a matrix does at most: the factor by which it lengthens, and how far it moves.
#[derive(Clone, Copy)]
struct Bound {
    scale: f64,
    translation: f64,
}

impl Bound {
    const IDENTITY: Self = Self {
        scale: 1.0,
        translation: 0.0,
    };

    fn of_track(track: &Track) -> Self {
        let scales = track.scales().iter().map(|scale| scale.abs().max_element());
        let translations = track
            .translations()
            .iter()
            .map(|translation| translation.as_dvec3().length());
        Self {
            scale: f64::from(scales.fold(0.0, f32::max)),
            translation: translations.fold(0.0, f64::max),
        }
    }

    fn of_matrix(matrix: &DAffine3) -> Self {
        let DMat3 { x_axis, y_axis, z_axis } = matrix.matrix3;
        Self {
            // Of Frobenius, which is no less than the greatest factor.
            scale: DVec3::new(x_axis.length(), y_axis.length(), z_axis.length()).length(),
            translation: matrix.translation.length(),
        }
    }

    /// Of this matrix times another one.
    fn after(self, first: Self) -> Self {
        Self {
            scale: self.scale * first.scale,
            translation: self.translation + self.scale * first.translation,
        }
    }
}

/// The first time, and at it the first joint, at which something is beyond the limit.
fn first_overflow(skeleton: &Skeleton, clip: &Clip, reaches: &[DVec3]) -> Option<Overflow> {
    let mut model_from_joint = vec![DAffine3::IDENTITY; skeleton.joint_count()];
    let mut keys = vec![0; clip.tracks.len()];
    clip.looked_at_secs().into_iter().find_map(|time_secs| {
        for (joint, (track, parent)) in clip.tracks.iter().zip(skeleton.parents()).enumerate() {
            let key = &mut keys[joint];
            while track.times_secs().get(*key + 1).is_some_and(|&next| next <= time_secs) {
                *key += 1;
            }
            let local = joint_at(track, *key, time_secs);
            let parent_from_joint = DAffine3::from_scale_rotation_translation(
                local.scale.as_dvec3(),
                local.rotation.as_dquat(),
                local.translation.as_dvec3(),
            );
            let model_from_parent = parent.map_or(DAffine3::IDENTITY, |parent| model_from_joint[parent.index()]);
            model_from_joint[joint] = model_from_parent * parent_from_joint;
            let model_from_bind = model_from_joint[joint] * skeleton.joint_from_bind()[joint].as_daffine3();
            if !(fits(&model_from_joint[joint], DVec3::ZERO) && fits(&model_from_bind, reaches[joint])) {
                let bone = skeleton.file_bones()[joint];
                return Some(Overflow { time_secs, bone });
            }
        }
        None
    })
}

/// Whether a matrix, and where it takes all points no further from the axes than `reach`, stay below the limit.
fn fits(matrix: &DAffine3, reach: DVec3) -> bool {
    let DMat3 { x_axis, y_axis, z_axis } = matrix.matrix3;
    let moved = matrix.translation.abs() + x_axis.abs() * reach.x + y_axis.abs() * reach.y + z_axis.abs() * reach.z;
    [x_axis.abs(), y_axis.abs(), z_axis.abs(), moved]
        .iter()
        .all(|numbers| numbers.cmplt(DVec3::splat(MOST)).all())
}
