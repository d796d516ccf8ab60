//! The motion of the selected joint as lines over time.

use egui::{Rect, Role, Sense, Ui, WidgetInfo, pos2};

use super::super::theme::{CONTROL_RADIUS, Tokens};
use super::axis::{END_ROOM, TimeAxis};
use super::curve_plot::{paint_hint, paint_keys, paint_legend, paint_lines};
use super::ruler::{self, RULER_HEIGHT};
use super::sheet::{segmented_of_width, split_x};
use super::state::TimelineState;
use super::time_area;
use crate::anim::{Curve, CurvePoint, CurveSpace};
use crate::model::JointIndex;
use crate::session::{Command, OpenModel, Session};

/// Points of the width from sample to sample.
const SAMPLE_SPACING: f32 = 2.0;
/// Samples at most: a width beyond that is of no screen.
const MOST_SAMPLES: usize = 2048;

/// Which part of the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Part {
    Translation,
    #[default]
    Rotation,
    Scale,
}

/// In which numbers a rotation is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum RotationAs {
    #[default]
    Quaternion,
    Euler,
}

/// What is shown, and its samples.
#[derive(Debug, Default)]
pub(super) struct Curves {
    part: Part,
    rotation: RotationAs,
    space: CurveSpace,
    of: Option<SampledOf>,
    curve: Option<Curve>,
    pub(super) points: Vec<CurvePoint>,
}

/// What the curve depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CurveOf {
    clips_revision: u64,
    clip: usize,
    joint: JointIndex,
    space: CurveSpace,
}

/// What the samples depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SampledOf {
    curve: CurveOf,
    span_secs: [f32; 2],
    count: usize,
}

impl Curves {
    /// What can be chosen.
    pub(super) fn controls(&mut self, ui: &mut Ui) {
        let parts = [
            (Part::Translation, "Translation"),
            (Part::Rotation, "Rotation"),
            (Part::Scale, "Scale"),
        ];
        if let Some(part) = segmented_of_width(ui, 246.0, "Part", &parts, self.part) {
            self.part = part;
        }
        if self.part == Part::Rotation {
            let kinds = [(RotationAs::Quaternion, "Quaternion"), (RotationAs::Euler, "Euler")];
            if let Some(kind) = segmented_of_width(ui, 164.0, "Rotation as", &kinds, self.rotation) {
                self.rotation = kind;
            }
        }
        let spaces = [(CurveSpace::Local, "Local"), (CurveSpace::Model, "Model")];
        if let Some(space) = segmented_of_width(ui, 124.0, "Space", &spaces, self.space) {
            self.space = space;
        }
    }

    /// Samples what is seen, when that changed.
    fn sample(&mut self, session: &Session, open: &OpenModel, of: SampledOf) {
        if self.of == Some(of) {
            return;
        }
        let Some(clip) = session.clip() else { return };
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

    /// The point at a time: its values are those of that time, whatever is seen.
    fn point_at(&self, session: &Session, open: &OpenModel, time_secs: f32) -> CurvePoint {
        match (&self.curve, session.clip()) {
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
        let share = if end_secs > start_secs {
            ((time_secs - start_secs) / (end_secs - start_secs)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let place = share * last as f32;
        let before = (place as usize).min(last);
        let [a, b] = [before, (before + 1).min(last)].map(|index| self.value(&self.points[index], channel));
        Some(a + (b - a) * (place - before as f32))
    }

    /// What stands behind values.
    pub(super) fn unit(&self) -> &'static str {
        match (self.part, self.rotation) {
            (Part::Rotation, RotationAs::Euler) => "°",
            _ => "",
        }
    }
}

/// Fills what is left of the sheet.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut TimelineState, commands: &mut Vec<Command>) {
    let (Some(open), Some(clip_index), Some(clip)) = (session.open_model(), session.clip_index(), session.clip())
    else {
        return;
    };
    let area = ui.available_rect_before_wrap();
    let split = split_x(area);
    let plot = Rect::from_min_max(pos2(split, area.min.y), area.max);
    ui.painter().rect_filled(plot, CONTROL_RADIUS, Tokens::of(ui).field);
    let Some(joint) = session.joints().selected() else {
        paint_hint(ui, plot);
        return;
    };
    let span_secs = state.window.span_secs([clip.start_secs, clip.end_secs]);
    let axis = TimeAxis::new(plot.x_range(), END_ROOM, span_secs);
    let count = (axis.points().span() / SAMPLE_SPACING).ceil().max(1.0) as usize + 1;
    let of = SampledOf {
        curve: CurveOf {
            clips_revision: session.clips_revision(),
            clip: clip_index,
            joint,
            space: state.curves.space,
        },
        span_secs,
        count: count.min(MOST_SAMPLES),
    };
    state.curves.sample(session, open, of);

    let ruler_rect = Rect::from_min_max(plot.min, pos2(plot.max.x, plot.min.y + RULER_HEIGHT));
    ruler::paint(ui, clip, &axis, ruler_rect, plot.max.y);
    let lines_rect = Rect::from_min_max(pos2(plot.min.x, ruler_rect.max.y), plot.max);
    let values = paint_lines(ui, &state.curves, &axis, lines_rect, area.min.x);
    paint_keys(
        ui,
        &state.curves,
        open.key_times(clip_index, Some(joint)),
        &axis,
        &values,
    );

    let response = ui.interact(lines_rect, ui.scope_id().with("curves"), Sense::click_and_drag());
    let label = format!("Curves of {}", session.joint_label(joint));
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &label));
    time_area::scrub(&response, &axis, commands);
    let ruler = time_area::ruler(ui, session, &axis, ruler_rect, commands);
    let read_secs = response
        .hover_pos()
        .filter(|_| !response.dragged())
        .map_or(session.playback().time_secs(), |at| axis.seen_time_at(at.x));
    let read = state.curves.point_at(session, open, read_secs);
    paint_legend(ui, session, &state.curves, joint, &read, area, split);
    time_area::paint_pointer(ui, &response, &axis, lines_rect.y_range());
    time_area::paint_head_below_ruler(ui, session, &axis, ruler_rect, plot.max.y);
    time_area::navigate(ui, &response, clip, &axis, state, false);
    time_area::navigate(ui, &ruler, clip, &axis, state, false);
}
