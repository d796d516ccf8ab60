//! Bones that move nothing, and scales that a bone cannot have in other programs.
//!
//! Rotations that change their side (q and −q are one rotation) are no finding: [`Track`](crate::model::Track) brings neighbours to one
//! side, and the books' `XMQuaternionSlerp` takes the shorter way by itself.

use glam::Mat3A;

use crate::anim::{CompiledClip, PoseBuffers};
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Entry, Moment, Places, Subject, codes};
use crate::model::{Clip, Model, Skeleton};

/// Notes bones in whose subtree no bone has a weight. A mesh without any weights has a finding of its own.
pub(super) fn note_idle_bones(model: &Model, places: &dyn Places, diagnostics: &mut Diagnostics) {
    let skeleton = &model.skeleton;
    let mut moves = vec![false; skeleton.joint_count()];
    for influences in &model.mesh.influences {
        for (&joint, &weight) in influences.joints.iter().zip(&influences.weights) {
            moves[joint as usize] |= weight > 0.0;
        }
    }
    if !moves.contains(&true) {
        return;
    }
    // Children come after their parents.
    for (joint, parent) in skeleton.parents().iter().enumerate().rev() {
        if let Some(parent) = parent {
            moves[parent.index()] |= moves[joint];
        }
    }
    let mut idle = Tally::default();
    for (bone, joint) in (0u32..).zip(skeleton.joint_of_bone()) {
        if !moves[joint.index()] {
            idle.add(bone);
        }
    }
    if idle.count > 0 {
        diagnostics.add(
            &codes::BONES_IDLE,
            places.of_rows(&idle, Subject::Bone, Entry::Bone),
            format!(
                "{} no vertex, nor does a bone below.",
                counted(idle.count, "bone moves", "bones move")
            ),
        );
    }
}

/// Scales along two axes that differ by more than this fraction were not meant to be equal.
const UNEVEN: f32 = 0.01;

/// The cosine of the angle between two axes of a sheared bone, at least: about three degrees off a right angle.
const SHEARED: f32 = 0.05;

/// Poses looked at for a clip, spread over its length: a motion that shears does so for a while.
const POSES_PER_CLIP: usize = 20;

/// Poses looked at for all clips together, so that thousands of clips cost no more than a few.
const POSES_IN_ALL: usize = 50 * POSES_PER_CLIP;

/// Notes clips that shear a bone: one is turned, and one above it is scaled by different factors.
pub(super) fn note_shears(
    model: &Model,
    compiled: &[CompiledClip],
    places: &dyn Places,
    diagnostics: &mut Diagnostics,
) {
    let uneven: Vec<usize> = (0..model.clips.len())
        .filter(|&clip| scales_unevenly(&model.clips[clip]))
        .collect();
    let looked_at = (POSES_IN_ALL / uneven.len().max(1)).clamp(2, POSES_PER_CLIP);
    for clip in uneven {
        if let Some((time_secs, bone)) = first_shear(&model.skeleton, &compiled[clip], looked_at) {
            diagnostics.add(
                &codes::SCALE_SHEARS,
                Place::on(Subject::Clip(clip as u32), places.line(Entry::Track { clip: clip as u32, bone })).at([Moment::new(time_secs, bone)]),
                format!(
                    "At {} s of \"{}\" bone {bone} is sheared: it is turned, and a bone above it is scaled by different factors.",
                    (time_secs * 1e3).round() / 1e3,
                    model.clips[clip].name
                ),
            );
        }
    }
}

fn scales_unevenly(clip: &Clip) -> bool {
    let mut scales = clip.tracks.iter().flat_map(|track| track.scale().values());
    scales.any(|scale| {
        let scale = scale.abs();
        scale.max_element() > scale.min_element() * (1.0 + UNEVEN)
    })
}

/// A time, and at it the file's number of the first bone that is sheared.
fn first_shear(skeleton: &Skeleton, compiled: &CompiledClip, looked_at: usize) -> Option<(f32, u32)> {
    let mut pose = PoseBuffers::for_skeleton(skeleton);
    let times_secs = compiled.probe_times_secs();
    let stride = times_secs.len().div_ceil(looked_at);
    times_secs.into_iter().step_by(stride).find_map(|time_secs| {
        pose.evaluate(skeleton, compiled, time_secs);
        let joint = pose.model.0.iter().position(|joint| shear(&joint.matrix3) > SHEARED)?;
        Some((time_secs, skeleton.file_bones()[joint]))
    })
}

/// The greatest cosine between two axes, without its sign; 0 for axes at right angles and for those without length.
fn shear(matrix: &Mat3A) -> f32 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.normalize_or_zero());
    x.dot(y).abs().max(y.dot(z).abs()).max(z.dot(x).abs())
}
