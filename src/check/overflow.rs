//! Finds clips that take a bone, or a vertex on it, further than `f32` can hold.

use std::cell::LazyCell;

use glam::{Affine3A, DAffine3, DMat3, DVec3, Vec3A};

use crate::anim::{CompiledClip, PoseBuffers};
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::diagnostic::{Entry, Moment, Places, Subject, codes};
use crate::model::{Clip, Model, Skeleton, Track};

/// Numbers above this count as overflow. That leaves room for the sums that make a pose: each must fit into `f32`.
const MOST: f64 = 1e37;

pub(super) fn note_overflows(
    model: &Model,
    compiled: &[CompiledClip],
    places: &dyn Places,
    diagnostics: &mut Diagnostics,
) {
    let bounds = model.bind_bounds();
    let farthest = bounds.min.abs().max(bounds.max.abs()).as_dvec3().length();
    // Asked for of few models.
    let reaches = LazyCell::new(|| reaches(model));
    for (index, (clip, compiled)) in (0u32..).zip(model.clips.iter().zip(compiled)) {
        if !stays_below(&model.skeleton, clip, farthest)
            && let Some((time_secs, bone)) = first_overflow(&model.skeleton, compiled, &reaches)
        {
            let message = format!(
                "At {time_secs} s of \"{}\" bone {bone}, or a vertex on it, is taken beyond 10³⁷: numbers overflow there.",
                clip.name
            );
            diagnostics.add(
                &codes::POSE_OVERFLOWS,
                Place::on(Subject::Clip(index), places.line(Entry::Track { clip: index, bone }))
                    .at([Moment::new(time_secs, bone)]),
                message,
            );
        }
    }
}

/// For each joint the greatest |x|, |y| and |z| of the vertices that it moves, in bind space.
fn reaches(model: &Model) -> Vec<DVec3> {
    let mut reaches = vec![Vec3A::ZERO; model.skeleton.joint_count()];
    for (influences, position) in model.mesh.influences.iter().zip(&model.mesh.positions) {
        let position = Vec3A::from(*position).abs();
        let weighted = influences.joints.iter().zip(&influences.weights);
        for (&joint, _) in weighted.filter(|(_, weight)| **weight > 0.0) {
            let reach = &mut reaches[joint as usize];
            *reach = reach.max(position);
        }
    }
    reaches.into_iter().map(Vec3A::as_dvec3).collect()
}

/// Whether the bounds of the keys alone show that nothing overflows at any time: a chain of joints scales by no more than
/// the product of their greatest scales. They show it for every sound file, which then costs one look at each key. No vertex is farther
/// away than `reach` in bind space.
fn stays_below(skeleton: &Skeleton, clip: &Clip, reach: f64) -> bool {
    let mut bounds: Vec<Bound> = Vec::with_capacity(skeleton.joint_count());
    let joints = clip.tracks.iter().zip(skeleton.parents());
    joints
        .zip(skeleton.joint_from_bind())
        .all(|((track, parent), joint_from_bind)| {
            let parent = parent.map_or(Bound::IDENTITY, |parent| bounds[parent.index()]);
            let model_from_joint = parent.after(Bound::of_track(track));
            bounds.push(model_from_joint);
            let joint_from_bind = Bound::of_matrix(&joint_from_bind.as_daffine3());
            let model_from_bind = model_from_joint.after(joint_from_bind);
            let vertices = model_from_bind.translation + model_from_bind.scale * reach;
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
        let scales = track.scale().values().iter().map(|scale| scale.abs().max_element());
        let translations = track.translation().values().iter();
        let translations = translations.map(|translation| translation.as_dvec3().length());
        Self {
            scale: f64::from(scales.fold(0.0, f32::max)),
            translation: translations.fold(0.0, f64::max),
        }
    }

    fn of_matrix(matrix: &DAffine3) -> Self {
        let DMat3 { x_axis, y_axis, z_axis } = matrix.matrix3;
        Self {
            // The Frobenius norm is at least the greatest factor.
            scale: DVec3::new(x_axis.length(), y_axis.length(), z_axis.length()).length(),
            translation: matrix.translation.length(),
        }
    }

    /// The limits of this matrix times another one.
    fn after(self, first: Self) -> Self {
        Self {
            scale: self.scale * first.scale,
            translation: self.translation + self.scale * first.translation,
        }
    }
}

/// The first time, and at it the file's number of the first bone, at which something is beyond the limit. The clip is posed
/// at the times at which its box is made: each key time, up to a number of them.
fn first_overflow(skeleton: &Skeleton, compiled: &CompiledClip, reaches: &[DVec3]) -> Option<(f32, u32)> {
    let mut pose = PoseBuffers::for_skeleton(skeleton);
    compiled.probe_times_secs().into_iter().find_map(|time_secs| {
        pose.evaluate(skeleton, compiled, time_secs);
        let joints = pose.model.0.iter().zip(&pose.palette.0).zip(reaches);
        let fit = |((model_from_joint, model_from_bind), reach): ((&Affine3A, &Affine3A), &DVec3)| {
            fits(model_from_joint, DVec3::ZERO) && fits(model_from_bind, *reach)
        };
        let joint = joints.into_iter().position(|joint| !fit(joint))?;
        Some((time_secs, skeleton.file_bones()[joint]))
    })
}

/// Whether a matrix, and where it takes all points no further from the axes than `reach`, stay below the limit.
fn fits(matrix: &Affine3A, reach: DVec3) -> bool {
    let matrix = matrix.as_daffine3();
    let DMat3 { x_axis, y_axis, z_axis } = matrix.matrix3;
    let moved = matrix.translation.abs() + x_axis.abs() * reach.x + y_axis.abs() * reach.y + z_axis.abs() * reach.z;
    [x_axis.abs(), y_axis.abs(), z_axis.abs(), moved]
        .iter()
        .all(|numbers| numbers.cmplt(DVec3::splat(MOST)).all())
}
