//! The motion of the selected joint over time as numbers: which part of it is shown, and its samples.

pub(super) mod curve_keys;
pub(super) mod curve_plot;
pub(in crate::ui) mod value_axis;

use crate::anim::{CompiledClip, Curve, CurvePoint, CurveSpace};
use crate::model::JointIndex;
use crate::session::{OpenModel, Session};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Part {
    Translation,
    #[default]
    Rotation,
    Scale,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum RotationAs {
    #[default]
    Quaternion,
    Euler,
}

#[derive(Debug, Default)]
pub(super) struct Curves {
    pub(super) part: Part,
    pub(super) rotation: RotationAs,
    pub(super) space: CurveSpace,
    /// Channels whose lines are hidden.
    pub(super) hidden: [bool; 4],
    /// The channel that the keyboard is on.
    pub(super) channel: usize,
    of: Option<SampledOf>,
    curve: Option<Curve>,
    pub(super) points: Vec<CurvePoint>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CurveOf {
    pub(super) clips_revision: u64,
    pub(super) clip: usize,
    pub(super) joint: JointIndex,
    pub(super) space: CurveSpace,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SampledOf {
    pub(super) curve: CurveOf,
    pub(super) span_secs: [f32; 2],
    pub(super) count: usize,
}

/// The clip that plays, as curves sample it.
fn compiled_clip<'a>(session: &Session, open: &'a OpenModel) -> Option<&'a CompiledClip> {
    open.compiled.get(session.clip_index()?)
}

impl Curves {
    /// Samples the visible part, if it changed.
    pub(super) fn sample(&mut self, session: &Session, open: &OpenModel, of: SampledOf) {
        if self.of == Some(of) {
            return;
        }
        let Some(clip) = compiled_clip(session, open) else {
            return;
        };
        let (skeleton, CurveOf { joint, space, .. }) = (&open.model.skeleton, of.curve);
        let kept = self
            .curve
            .take()
            .filter(|_| self.of.is_some_and(|before| before.curve == of.curve));
        let curve = kept.unwrap_or_else(|| Curve::new(skeleton, clip, joint, space));
        self.points.resize(of.count, CurvePoint::default());
        curve.sample(skeleton, clip, of.span_secs, &mut self.points);
        self.curve = Some(curve);
        self.of = Some(of);
    }

    /// The exact values at a time, independent of the samples.
    pub(super) fn point_at(&self, session: &Session, open: &OpenModel, time_secs: f32) -> CurvePoint {
        match (&self.curve, compiled_clip(session, open)) {
            (Some(curve), Some(clip)) => curve.at(&open.model.skeleton, clip, time_secs),
            _ => CurvePoint::default(),
        }
    }

    /// The lines, by name.
    pub(super) fn channels(&self) -> &'static [&'static str] {
        match (self.part, self.rotation) {
            (Part::Rotation, RotationAs::Quaternion) => &["x", "y", "z", "w"],
            _ => &["x", "y", "z"],
        }
    }

    /// Channels whose lines are shown.
    pub(super) fn shown(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        (0..self.channels().len()).filter(|&channel| !self.hidden[channel])
    }

    /// What the lines are, in words.
    pub(super) fn part_name(&self) -> &'static str {
        match self.part {
            Part::Translation => "translation",
            Part::Rotation => "rotation",
            Part::Scale => "scale",
        }
    }

    /// A value of a channel as it is written.
    pub(super) fn written(&self, point: &CurvePoint, channel: usize) -> String {
        format!("{:.4}{}", self.value(point, channel), self.unit())
    }

    pub(super) fn value(&self, point: &CurvePoint, channel: usize) -> f32 {
        match (self.part, self.rotation) {
            (Part::Translation, _) => point.translation.to_array()[channel],
            (Part::Scale, _) => point.scale.to_array()[channel],
            (Part::Rotation, RotationAs::Quaternion) => point.rotation.to_array()[channel],
            (Part::Rotation, RotationAs::Euler) => point.euler_degrees.to_array()[channel],
        }
    }

    /// A value as it is drawn: on the line between two samples.
    pub(super) fn value_at(&self, channel: usize, time_secs: f32) -> Option<f32> {
        let [start_secs, end_secs] = self.of?.span_secs;
        let last = self.points.len().checked_sub(1)?;
        let fraction = if end_secs > start_secs {
            ((time_secs - start_secs) / (end_secs - start_secs)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let place = fraction * last as f32;
        let before = (place as usize).min(last);
        let [a, b] = [before, (before + 1).min(last)].map(|index| self.value(&self.points[index], channel));
        Some(a + (b - a) * (place - before as f32))
    }

    /// The unit written after values.
    pub(super) fn unit(&self) -> &'static str {
        match (self.part, self.rotation) {
            (Part::Rotation, RotationAs::Euler) => "°",
            _ => "",
        }
    }
}
