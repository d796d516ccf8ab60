//! What bar, dope sheet and curves share: the ruler, the play head, scrubbing, zooming and panning in time.

use egui::{Align2, FontId, Key, PointerButton, Rangef, Rect, Response, Sense, Stroke, Ui, UiBuilder, pos2, vec2};

use super::axis::{END_ROOM, TimeAxis};
use super::state::{KeyBox, TimelineState};
use crate::anim::Direction;
use crate::model::Clip;
use crate::session::{Command, OpenModel, PlayCommand, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{CONTROL_RADIUS, Tokens};
use crate::ui::kit::{SliderNode, by_finger, choose, control_size, focus_ring, focused_keys, is_touch};

pub(super) const RULER_HEIGHT: f32 = 24.0;
/// Width of a label with the gap to the next one.
const LABEL_SPACING: f32 = 92.0;
/// The least distance of ticks of single frames.
const TICK_SPACING: f32 = 5.0;
/// Width of the column of names, and where it is slim.
const NAMES_WIDTH: f32 = 196.0;
const SLIM_NAMES_WIDTH: f32 = 124.0;
/// The least width of all of it in which that column is not slim.
const LEAST_WITH_NAMES: f32 = 600.0;

/// Where dope sheet and curves are: a ruler over times, right of a column of names.
pub(super) struct TimeArea<'a> {
    pub(super) session: &'a Session,
    pub(super) open: &'a OpenModel,
    pub(super) clip_index: usize,
    pub(super) clip: &'a Clip,
    pub(super) whole: Rect,
    /// All of it but the names.
    pub(super) times: Rect,
    pub(super) ruler: Rect,
    pub(super) axis: TimeAxis,
}

impl<'a> TimeArea<'a> {
    /// The rest of what is available, with its ground. None without a clip.
    pub(super) fn new(ui: &Ui, cx: &Cx<'a, TimelineState>) -> Option<Self> {
        let (session, clip) = (cx.session, cx.session.clip()?);
        let whole = ui.available_rect_before_wrap();
        let names = if whole.width() < LEAST_WITH_NAMES {
            SLIM_NAMES_WIDTH
        } else {
            NAMES_WIDTH
        };
        let times = whole.with_min_x(whole.min.x + names);
        let span_secs = cx.state.seen.span_secs([clip.start_secs, clip.end_secs]);
        ui.painter().rect_filled(times, CONTROL_RADIUS, Tokens::of(ui).field);
        Some(Self {
            session,
            open: session.open_model()?,
            clip_index: session.clip_index()?,
            clip,
            whole,
            times,
            ruler: times.with_max_y(times.min.y + RULER_HEIGHT),
            axis: TimeAxis::new(times.x_range(), END_ROOM, span_secs),
        })
    }

    /// The ruler as a control: a press or drag moves the time.
    pub(super) fn show_ruler(&self, ui: &Ui, cx: &mut Cx<'_, TimelineState>) -> Response {
        let response = ui.interact(self.ruler, ui.scope_id().with("ruler"), Sense::click_and_drag());
        scrub(&response, &self.axis, cx.commands);
        time_slider(ui, cx, self.clip, "Ruler", &response);
        focus_ring(ui, self.ruler, &response);
        response
    }

    /// The time span of chosen keys, on the ruler.
    pub(super) fn paint_chosen(&self, ui: &Ui, key_box: &KeyBox) {
        let x = key_box
            .span_secs
            .map(|secs| self.axis.points().clamp(self.axis.x_of(secs)));
        let band = Rect::from_x_y_ranges(x[0]..=x[1], self.ruler.y_range());
        ui.painter().rect_filled(band, 0.0, Tokens::of(ui).accent_ground);
    }

    /// The play head with a handle in the ruler.
    pub(super) fn paint_head(&self, ui: &Ui) {
        let top = self.ruler.max.y - 6.0;
        paint_head(ui, self.session, &self.axis, Rangef::new(top, self.times.max.y));
        let x = self.axis.x_of(self.session.playback().time_secs());
        if self.axis.points().expand(1.0).contains(x) {
            let handle = Rect::from_center_size(pos2(x, top), vec2(9.0, 9.0));
            ui.painter().rect_filled(handle, 2.5, Tokens::of(ui).accent);
        }
    }

    /// Draws ticks and labels, and faint lines down to the end of the area.
    pub(super) fn paint_ruler(&self, ui: &Ui) {
        let Self {
            clip,
            axis,
            times,
            ruler: rect,
            ..
        } = self;
        let (tokens, bottom) = (Tokens::of(ui), times.max.y);
        let painter = ui.painter().with_clip_rect(*times);
        let last_frame = clip.last_frame();
        let points_per_frame = axis.points_per_sec() / clip.keys_per_sec;
        if points_per_frame >= TICK_SPACING {
            for frame in seen_frames(clip, axis, 1) {
                let x = axis.x_of(clip.time_of_frame(frame));
                painter.vline(x, rect.max.y - 4.0..=rect.max.y, Stroke::new(1.0, tokens.hairline));
            }
        }
        let step = label_step(
            clip.keys_per_sec,
            LABEL_SPACING / points_per_frame.max(f32::MIN_POSITIVE),
            last_frame,
        );
        for frame in seen_frames(clip, axis, step) {
            let time_secs = clip.time_of_frame(frame);
            let x = axis.x_of(time_secs);
            painter.vline(x, rect.max.y - 7.0..=rect.max.y, Stroke::new(1.0, tokens.faint));
            painter.vline(x, rect.max.y..=bottom, Stroke::new(1.0, tokens.hairline));
            let at = pos2(x + 4.0, rect.center().y - 1.0);
            let secs = format!("{} s", seconds(time_secs));
            let drawn = painter.text(at, Align2::LEFT_CENTER, secs, FontId::proportional(11.0), tokens.muted);
            let at = pos2(drawn.max.x + 6.0, at.y);
            painter.text(at, Align2::LEFT_CENTER, frame, FontId::proportional(11.0), tokens.faint);
        }
    }
}

/// Moves the time with a drag. Two fingers pan and zoom instead.
pub(super) fn scrub(response: &Response, axis: &TimeAxis, commands: &mut Vec<Command>) {
    if response.drag_started_by(PointerButton::Primary) {
        commands.push(PlayCommand::BeginScrub.into());
    }
    let two_fingers = response.ctx.input(egui::InputState::multi_touch).is_some();
    if let Some(pointer) = response.interact_pointer_pos()
        && !two_fingers
        && (response.dragged_by(PointerButton::Primary) || response.clicked_by(PointerButton::Primary))
    {
        let time_secs = axis.seen_time_at(pointer.x);
        commands.push(PlayCommand::Seek { time_secs }.into());
    }
    if response.drag_stopped_by(PointerButton::Primary) {
        commands.push(PlayCommand::EndScrub.into());
    }
}

/// A hairline under the pointer.
pub(super) fn paint_pointer(ui: &Ui, response: &Response, axis: &TimeAxis, height: Rangef) {
    if let Some(pointer) = response.hover_pos()
        && !is_touch(ui)
    {
        let x = axis.points().clamp(pointer.x);
        ui.painter().vline(x, height, Stroke::new(1.0, Tokens::of(ui).faint));
    }
}

/// The time as a line, if it is in view.
pub(super) fn paint_head(ui: &Ui, session: &Session, axis: &TimeAxis, height: Rangef) {
    let x = axis.x_of(session.playback().time_secs());
    if axis.points().expand(1.0).contains(x) {
        ui.painter().vline(x, height, Stroke::new(2.0, Tokens::of(ui).accent));
    }
}

/// The time as a slider for keyboards and screen readers: arrows go by a frame, with Shift by ten; Page Up and Page Down from key to key.
pub(super) fn time_slider(ui: &Ui, cx: &mut Cx<'_, TimelineState>, clip: &Clip, name: &str, response: &Response) {
    let time_secs = cx.session.playback().time_secs();
    let node = SliderNode {
        name,
        value: f64::from(time_secs),
        range: f64::from(clip.start_secs)..=f64::from(clip.end_secs),
        step: 1.0 / f64::from(clip.keys_per_sec),
        text: &spoken(clip, time_secs),
    };
    let (steps, value) = node.tell(ui, response);
    if steps != 0 {
        cx.push(PlayCommand::StepFrames(steps));
    }
    if let Some(secs) = value {
        cx.pause_at(secs as f32);
    }
    for (key, shift) in focused_keys(ui, response, SLIDER_KEYS) {
        let frames = if shift { 10 } else { 1 };
        let joint = cx.session.joints().selected();
        let step_key = |direction| PlayCommand::StepKey { direction, joint };
        cx.commands.push(Command::Play(match key {
            Key::ArrowRight | Key::ArrowUp => PlayCommand::StepFrames(frames),
            Key::ArrowLeft | Key::ArrowDown => PlayCommand::StepFrames(-frames),
            Key::PageUp => step_key(Direction::Forward),
            Key::PageDown => step_key(Direction::Backward),
            Key::Home => PlayCommand::SeekStart,
            _ => PlayCommand::SeekEnd,
        }));
    }
}

/// A time in words.
fn spoken(clip: &Clip, time_secs: f32) -> String {
    format!(
        "{time_secs:.2} of {:.2} seconds, frame {} of {}",
        clip.end_secs,
        clip.frame_at(time_secs),
        clip.last_frame(),
    )
}

/// Zooms (Ctrl wheel, pinch) and pans (Shift wheel, middle drag, two fingers). With `finger_pans` a drag of one finger pans too.
pub(super) fn navigate(
    ui: &Ui,
    response: &Response,
    clip: &Clip,
    axis: &TimeAxis,
    state: &mut TimelineState,
    finger_pans: bool,
) {
    let whole_secs = [clip.start_secs, clip.end_secs];
    let frame_secs = 1.0 / clip.keys_per_sec;
    let pans = response.dragged_by(PointerButton::Middle) || (finger_pans && by_finger(ui) && response.dragged());
    let mut pan_points = if pans { response.drag_delta().x } else { 0.0 };
    let fingers = ui
        .input(egui::InputState::multi_touch)
        .filter(|_| response.dragged() && !pans);
    pan_points += fingers.map_or(0.0, |fingers| fingers.translation_delta.x);
    let pointer = response.hover_pos().or(response.interact_pointer_pos());
    if let Some(pointer) = pointer.filter(|_| response.contains_pointer() || response.dragged()) {
        let (zoom, scroll) = ui.input(|input| (input.zoom_delta(), input.smooth_scroll_delta().x));
        if zoom != 1.0 {
            let around_secs = axis.seen_time_at(pointer.x);
            state.seen.zoom(whole_secs, frame_secs, zoom, around_secs);
        }
        pan_points += scroll;
    }
    if pan_points != 0.0 && axis.points_per_sec() > 0.0 {
        let by_secs = -pan_points / axis.points_per_sec();
        state.seen.pan(whole_secs, frame_secs, by_secs);
    }
}

/// The keys that the dope sheet and the curves take while they are focused.
pub(super) const GRID_KEYS: [Key; 10] = [
    Key::ArrowLeft,
    Key::ArrowRight,
    Key::ArrowUp,
    Key::ArrowDown,
    Key::PageUp,
    Key::PageDown,
    Key::Home,
    Key::End,
    Key::Enter,
    Key::Space,
];
/// The keys of a slider of time: those that move.
pub(super) const SLIDER_KEYS: &[Key] = GRID_KEYS.split_at(8).0;

/// Pans so that a time is seen.
pub(super) fn bring_into_view(clip: &Clip, secs: f32, state: &mut TimelineState) {
    let whole_secs = [clip.start_secs, clip.end_secs];
    let [start_secs, end_secs] = state.seen.span_secs(whole_secs);
    let by_secs = (secs - end_secs).max(0.0) + (secs - start_secs).min(0.0);
    if by_secs != 0.0 {
        state.seen.pan(whole_secs, 1.0 / clip.keys_per_sec, by_secs);
    }
}

/// A switch with a width, for a row with other controls.
pub(super) fn segmented_of_width<T: Copy + PartialEq>(
    ui: &mut Ui,
    width: f32,
    name: &str,
    choices: &[(T, &str)],
    value: &mut T,
) {
    let (rect, _) = ui.allocate_exact_size(vec2(width, control_size(ui)), Sense::hover());
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).id_salt(name));
    choose(&mut child, name, choices, value);
}

/// Every `step`th frame in view, and one more on the left whose label reaches into view.
fn seen_frames(clip: &Clip, axis: &TimeAxis, step: u32) -> impl Iterator<Item = u32> {
    let points = axis.points();
    let left = clip.frame_at(axis.time_at(points.min - LABEL_SPACING)) / step * step;
    let right = clip.frame_at(axis.time_at(points.max)).min(clip.last_frame());
    (left..=right).step_by(step as usize)
}

/// Frames from label to label: the least round number that leaves room. If the rate is whole, round in seconds.
pub fn label_step(keys_per_sec: f32, least_frames: f32, last_frame: u32) -> u32 {
    let rate = keys_per_sec.round().max(1.0);
    let is_whole = (keys_per_sec - rate).abs() < 0.01 * rate;
    let rate = rate as u32;
    let parts = (1..rate).filter(|part| {
        if is_whole {
            rate.is_multiple_of(*part)
        } else {
            is_round(*part)
        }
    });
    let whole = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600]
        .into_iter()
        .map(|secs| rate.saturating_mul(secs));
    let mut steps = parts.chain(whole).filter(|&step| step as f32 >= least_frames);
    steps.next().unwrap_or(last_frame).max(1)
}

/// One, two or five times a power of ten.
fn is_round(number: u32) -> bool {
    let power = 10_u32.pow(number.max(1).ilog10());
    number.is_multiple_of(power) && matches!(number / power, 1 | 2 | 5)
}

/// Seconds to the thousandth, without trailing zeros.
pub fn seconds(time_secs: f32) -> String {
    let text = format!("{time_secs:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
