//! The loop gap, where the last pose of a loop meets its first, in numbers and words. It is read again when the loop changed.

use crate::anim::{JointGap, LoopGap, LoopMode};
use crate::model::JointIndex;
use crate::session::Session;

/// Distances below this fraction of the model's size count as zero, since files round to about six digits.
const NO_FRACTION: f32 = 1e-5;
/// Smaller angles are 0 with two decimals.
const LEAST_DEGREES: f32 = 0.005;
/// Smaller changes are 0 % with one decimal.
const LEAST_SCALE: f32 = 5e-4;

#[derive(Debug, Default)]
pub(super) struct LoopGapReading {
    of: Option<ReadOf>,
    gap: LoopGap,
    loops: bool,
    /// All joints, the farthest travelled first.
    order: Vec<JointIndex>,
    words: Option<String>,
    /// The least distance that does not count as zero, and the decimals of distances.
    least: f32,
    decimals: usize,
    jumps: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct ReadOf {
    clips: u64,
    names: u64,
    clip: Option<usize>,
    span_secs: Option<[f32; 2]>,
}

impl LoopGapReading {
    /// Reads the gap if the loop changed.
    pub(super) fn update(&mut self, session: &Session) {
        self.loops = session.playback().loop_mode() == LoopMode::Loop;
        let of = Some(ReadOf {
            clips: session.clips_revision(),
            names: session.joint_names_revision(),
            clip: session.clip_index(),
            span_secs: session.playback().loop_gap_secs(),
        });
        if self.of == of {
            return;
        }
        self.of = of;
        self.gap = session.loop_gap().map(|gap| gap.into_owned()).unwrap_or_default();
        self.order = self.gap.by_travel();
        let size = session.open_model().map_or(1.0, |open| open.size());
        (self.least, self.decimals) = precision(size);
        self.jumps = self.gap.joints.iter().any(|joint| {
            joint.travel >= self.least || joint.rotation_degrees >= LEAST_DEGREES || joint.scale >= LEAST_SCALE
        });
        self.words = self.told(session);
    }

    pub(super) fn loops(&self) -> bool {
        self.loops && self.could_loop()
    }

    /// Whether there are two poses to go between.
    pub(super) fn could_loop(&self) -> bool {
        self.of.is_some_and(|of| of.span_secs.is_some())
    }

    /// Where the loop ends, in seconds, if its gap is visible.
    pub(super) fn seen_at_secs(&self) -> Option<f32> {
        let [_, last_secs] = self.of?.span_secs?;
        (self.loops && self.gap.visible).then_some(last_secs)
    }

    /// The gap in words, if it is visible.
    pub(super) fn words(&self) -> Option<&str> {
        self.words.as_deref()
    }

    /// Whether any joint has a jump that is not zero.
    pub(super) fn any_jumps(&self) -> bool {
        self.jumps
    }

    /// All joints, the farthest travelled first.
    pub(super) fn order(&self) -> &[JointIndex] {
        &self.order
    }

    /// The jump of a joint. No jump for a joint that is not there.
    pub(super) fn of_joint(&self, joint: JointIndex) -> JointGap {
        self.gap.joints.get(joint.index()).copied().unwrap_or_default()
    }

    /// Whether a joint's travel alone makes the gap visible.
    pub(super) fn travel_is_seen(&self, joint: &JointGap) -> bool {
        joint.travel >= self.gap.visible_travel
    }

    /// A distance with the model's decimals. None if it rounds to zero.
    pub(super) fn distance(&self, distance: f32) -> Option<String> {
        distance_told(distance, (self.least, self.decimals))
    }

    /// The joint that jumps most relative to its parent, and the one that jumps farthest in the model. Numbers are as in the list.
    fn told(&self, session: &Session) -> Option<String> {
        let worst = self.gap.worst.filter(|_| self.gap.visible)?;
        let jump = self.of_joint(worst);
        let own = [
            angle(jump.rotation_degrees).map(|angle| format!("turns by {angle}")),
            self.distance(jump.translation)
                .map(|distance| format!("moves by {distance}")),
            scale(jump.scale).map(|scale| format!("scales by {scale}")),
        ];
        let own: Vec<String> = own.into_iter().flatten().collect();
        let name = session.joint_label(worst);
        let own = (!own.is_empty()).then(|| format!("{name} {} relative to its parent", own.join(", ")));
        let farthest = self.order.first().and_then(|&joint| {
            let distance = self.distance(self.of_joint(joint).travel)?;
            let name = session.joint_label(joint);
            Some(format!("{name} moves by {distance} in the model"))
        });
        let poses = if session.playback().range_secs().is_some() {
            "the range's last pose to its first"
        } else {
            "the last pose to the first"
        };
        let joints: Vec<String> = own.into_iter().chain(farthest).collect();
        Some(format!(
            "The loop has a visible gap from {poses}: {}.",
            joints.join("; ")
        ))
    }
}

/// A distance with decimals. None below the least that counts.
pub fn distance_told(distance: f32, (least, decimals): (f32, usize)) -> Option<String> {
    (distance >= least).then(|| format!("{distance:.decimals$}"))
}

/// The least distance that counts in a model of a size, and decimals that show it.
pub fn precision(size: f32) -> (f32, usize) {
    let least = size * NO_FRACTION;
    (least, (-least.log10()).ceil().clamp(0.0, 9.0) as usize)
}

/// A change of scale in per cent. None if it rounds to zero.
pub(super) fn scale(fraction: f32) -> Option<String> {
    (fraction >= LEAST_SCALE).then(|| format!("{:.1} %", fraction * 100.0))
}

/// An angle in degrees. None if it rounds to zero.
pub(super) fn angle(degrees: f32) -> Option<String> {
    (degrees >= LEAST_DEGREES).then(|| format!("{degrees:.2}°"))
}
