//! The paths of joints through a clip, and the times of its ghosts.

use glam::Vec3;

use super::buffers::PoseBuffers;
use super::pose::Palette;
use crate::model::{Clip, JointIndex};

/// The most points of a trail: a clip of more frames is sampled evenly over its span instead.
const MOST_POINTS: u32 = 2_000;

/// Paths of joints' origins through a clip, model space: one point a frame, from the first to the last.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trails {
    points: Vec<Vec3>,
    point_count: usize,
}

impl Trails {
    /// Number of points of each trail.
    pub fn point_count(&self) -> usize {
        self.point_count
    }

    /// One polyline for each joint, in the order in which the joints were given.
    pub fn polylines(&self) -> impl ExactSizeIterator<Item = &[Vec3]> {
        self.points.chunks_exact(self.point_count.max(1))
    }

    /// Follows joints through a clip: `pose_at` puts the pose at a time of the clip into the buffer `pose`, which is left at
    /// the clip's end. The trail of a joint that the pose lacks stays at the origin.
    pub fn follow(
        &mut self,
        clip: &Clip,
        joints: &[JointIndex],
        pose: &mut PoseBuffers,
        mut pose_at: impl FnMut(f32, &mut PoseBuffers),
    ) {
        let last = clip.last_frame();
        let steps = last.min(MOST_POINTS - 1);
        self.point_count = steps as usize + 1;
        self.points.clear();
        self.points.resize(self.point_count * joints.len(), Vec3::ZERO);
        if joints.is_empty() {
            return;
        }
        for step in 0..=steps {
            let time_secs = if steps == last {
                clip.time_of_frame(step)
            } else {
                clip.start_secs + clip.duration_secs() * (step as f32 / steps as f32)
            };
            pose_at(time_secs, pose);
            for (trail, joint) in joints.iter().enumerate() {
                if let Some(model_from_joint) = pose.model.0.get(joint.index()) {
                    self.points[trail * self.point_count + step as usize] = model_from_joint.translation.into();
                }
            }
        }
    }
}

/// Which poses are shown beside that of now.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct GhostPlan {
    /// How many before.
    pub before: u32,
    /// How many after.
    pub after: u32,
    /// Frames from one to the next, 1 or more.
    pub step_frames: u32,
}

impl Default for GhostPlan {
    fn default() -> Self {
        Self {
            before: 0,
            after: 0,
            step_frames: 1,
        }
    }
}

/// The most ghosts on either side.
pub const MOST_GHOSTS: u32 = 32;
/// Frames from one ghost to the next where nothing else is chosen: nearer ones hide each other.
pub const GHOST_STEP_FRAMES: u32 = 5;

/// Times of ghosts, in order: those before `time_secs` and those after, without `time_secs` itself and without what lies
/// outside the clip. At most 32 on either side.
pub fn ghost_times(clip: &Clip, time_secs: f32, plan: GhostPlan, times_secs: &mut Vec<f32>) {
    times_secs.clear();
    let step_secs = f64::from(plan.step_frames.max(1)) / f64::from(clip.keys_per_sec);
    let (before, after) = (plan.before.min(MOST_GHOSTS), plan.after.min(MOST_GHOSTS));
    let steps = (1..=before)
        .rev()
        .map(|step| -f64::from(step))
        .chain((1..=after).map(f64::from));
    let times = steps.map(|step| (f64::from(time_secs) + step * step_secs) as f32);
    times_secs.extend(times.filter(|time| (clip.start_secs..=clip.end_secs).contains(time)));
}

/// A palette for each time, in the first palettes of the caller's. `pose_at` puts the pose of a time into the buffer.
pub fn palettes_at(
    times_secs: &[f32],
    pose: &mut PoseBuffers,
    palettes: &mut [Palette],
    mut pose_at: impl FnMut(f32, &mut PoseBuffers),
) {
    for (&time_secs, palette) in times_secs.iter().zip(palettes) {
        pose_at(time_secs, pose);
        palette.0.clone_from(&pose.palette.0);
    }
}
