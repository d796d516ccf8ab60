//! The jump that is seen where a loop begins again: how far its last pose is from its first.

use super::activity::JointChange;
use super::buffers::PoseBuffers;
use super::compile::CompiledClip;
use super::sample::sample_joint;
use crate::model::{JointIndex, Skeleton};
use crate::sorting;

/// A jump of the surface by less than this fraction of the model's size is not seen: two pixels where the model fills a
/// picture a thousand pixels high. A moving edge is blurred by as much.
pub const VISIBLE_FRACTION: f32 = 1.0 / 500.0;

/// The jump of one joint from the last pose of a loop to the first, relative to its parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointGap {
    /// Distance of the joint's place, in model units.
    pub translation: f32,
    /// Angle of its turn, degrees, 0…180.
    pub rotation_degrees: f32,
    /// Greatest change of scale along an axis, as a fraction of the greater one.
    pub scale: f32,
    /// How far the joint itself jumps in the model, all that its ancestors do included, in model units.
    pub travel: f32,
    /// The jump of its surface as a multiple of what can just be seen ([`VISIBLE_FRACTION`]). The surface is taken to reach a
    /// tenth of the model's size from its joint, so that a turn by 1.15° and a scale by 2 % can just be seen too.
    pub visibility: f32,
}

/// The gap of a loop, joint by joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoopGap {
    /// In the skeleton's order.
    pub joints: Vec<JointGap>,
    /// The joint whose own keys jump most; `None` when none jumps.
    pub worst: Option<JointIndex>,
    /// Whether it is seen: some joint's own jump is large enough, or the sum with its ancestors'.
    pub visible: bool,
    /// The least travel that is seen, in model units: [`VISIBLE_FRACTION`] of the model's size.
    pub visible_travel: f32,
}

impl LoopGap {
    /// All joints, the farthest travelled first. Of equal ways the greater turn is first, then the greater change of scale, then
    /// the skeleton's order.
    pub fn by_travel(&self) -> Vec<JointIndex> {
        let mut order: Vec<JointIndex> = (0..self.joints.len() as u32).map(JointIndex).collect();
        sorting::sort_by(&mut order, |a, b| {
            let [a, b] = [a, b].map(|joint| &self.joints[joint.index()]);
            let by_turn = b.rotation_degrees.total_cmp(&a.rotation_degrees);
            let by_scale = b.scale.total_cmp(&a.scale);
            b.travel.total_cmp(&a.travel).then(by_turn).then(by_scale)
        });
        order
    }
}

/// The gap of a loop through a clip of a skeleton, from `first_secs` to `last_secs` of the clip's time; `size` is the
/// length of the model's diagonal in its own units. A loop without length has none.
pub fn loop_gap(skeleton: &Skeleton, clip: &CompiledClip, [first_secs, last_secs]: [f32; 2], size: f32) -> LoopGap {
    let mut pose = PoseBuffers::default();
    let mut places = |time_secs| {
        pose.evaluate(skeleton, clip, time_secs);
        pose.model.0.iter().map(|joint| joint.translation).collect::<Vec<_>>()
    };
    let (last, first) = (places(last_secs), places(first_secs));
    let visible_travel = VISIBLE_FRACTION * size.max(f32::MIN_POSITIVE);
    let joints: Vec<JointGap> = (0u32..)
        .map(JointIndex)
        .zip(last.into_iter().zip(first))
        .map(|(joint, (last, first))| {
            let [from, to] = [last_secs, first_secs].map(|secs| sample_joint(skeleton, clip, joint, secs));
            let change = JointChange::between(skeleton, joint, &from, &to);
            JointGap {
                translation: change.translation,
                rotation_degrees: change.rotation_radians.to_degrees(),
                scale: change.scale,
                travel: last.distance(first),
                visibility: change.surface_way(size) / visible_travel,
            }
        })
        .collect();
    let worst = joints
        .iter()
        .enumerate()
        .filter(|(_, joint)| joint.visibility > 0.0)
        // Of equal ones `max_by` gives the last, and ancestors come first.
        .max_by(|(a_index, a), (b_index, b)| a.visibility.total_cmp(&b.visibility).then(b_index.cmp(a_index)))
        .map(|(index, _)| JointIndex(index as u32));
    let visible = joints
        .iter()
        .any(|joint| joint.visibility >= 1.0 || joint.travel >= visible_travel);
    LoopGap {
        joints,
        worst,
        visible,
        visible_travel,
    }
}
