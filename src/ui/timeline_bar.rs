//! The bar of the timeline: every key a diamond, the time a line that follows the pointer.

use egui::{CursorIcon, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::theme::{CONTROL_RADIUS, Tokens};
use super::widgets::{focus_ring, is_touch};
use crate::model::Clip;
use crate::session::{Command, Session};

/// Keys closer than this are drawn as ticks, and closer still not at all.
const DIAMOND_SPACING: f32 = 7.0;
const TICK_SPACING: f32 = 2.5;

/// Time stamps of a clip's keys, found once per clip.
#[derive(Clone, Debug, Default)]
pub(super) struct KeyTimes {
    of: Option<(u64, usize)>,
    times_secs: Vec<f32>,
}

/// A clip's time along the bar.
#[derive(Clone, Copy)]
struct Track {
    rect: Rect,
    start_secs: f32,
    duration_secs: f32,
}

impl Track {
    fn x_of(&self, time_secs: f32) -> f32 {
        let share = if self.duration_secs > 0.0 {
            (time_secs - self.start_secs) / self.duration_secs
        } else {
            0.0
        };
        self.rect.min.x + share.clamp(0.0, 1.0) * self.rect.width()
    }

    fn time_at(&self, pointer: Pos2) -> f32 {
        let share = ((pointer.x - self.rect.min.x) / self.rect.width()).clamp(0.0, 1.0);
        self.start_secs + share * self.duration_secs
    }
}

impl KeyTimes {
    fn update(&mut self, session: &Session) {
        let (Some(index), Some(clip)) = (session.clip_index(), session.clip()) else {
            return;
        };
        let of = Some((session.model_revision(), index));
        if self.of != of {
            self.of = of;
            self.times_secs = merged_key_times(clip);
        }
    }

    /// Shows the bar of the clip on show.
    pub(super) fn bar(&mut self, ui: &mut Ui, session: &Session, size: Vec2, commands: &mut Vec<Command>) {
        self.update(session);
        let tokens = Tokens::of(ui);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        let response = response.on_hover_cursor(CursorIcon::PointingHand);
        let Some(clip) = session.clip() else { return };
        ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field);
        focus_ring(ui, rect, &response);

        let track = Track {
            rect: rect.shrink2(vec2(8.0, 0.0)),
            start_secs: clip.start_secs,
            duration_secs: clip.duration_secs(),
        };
        self.paint_keys(ui, &track);
        let x = track.x_of(session.playback().time_secs());
        ui.painter().vline(x, rect.y_range(), Stroke::new(2.0, tokens.accent));
        scrub(&response, &track, commands);
        if let Some(pointer) = response.hover_pos()
            && !response.dragged()
            && !is_touch(ui)
        {
            let x = pointer.x.clamp(track.rect.min.x, track.rect.max.x);
            ui.painter().vline(x, rect.y_range(), Stroke::new(1.0, tokens.faint));
        }
        let time_secs = f64::from(session.playback().time_secs());
        response.widget_info(|| WidgetInfo::slider(true, time_secs, "Time in seconds"));
    }

    fn paint_keys(&self, ui: &Ui, track: &Track) {
        let tokens = Tokens::of(ui);
        let (painter, y) = (ui.painter(), track.rect.center().y);
        let count = self.times_secs.len();
        let spacing = track.rect.width() / count.saturating_sub(1).max(1) as f32;
        for &time_secs in &self.times_secs {
            let x = track.x_of(time_secs);
            if spacing >= DIAMOND_SPACING || count == 1 {
                let r = if spacing >= 11.0 { 4.2 } else { 3.2 };
                let corners = vec![pos2(x, y - r), pos2(x + r, y), pos2(x, y + r), pos2(x - r, y)];
                painter.add(Shape::convex_polygon(corners, tokens.muted, Stroke::NONE));
            } else if spacing >= TICK_SPACING {
                painter.vline(x, y - 4.0..=y + 4.0, Stroke::new(1.0, tokens.faint));
            }
        }
        if spacing < TICK_SPACING {
            let band = Rect::from_x_y_ranges(track.rect.x_range(), y - 1.5..=y + 1.5);
            painter.rect_filled(band, 1.5, tokens.faint);
        }
    }
}

fn scrub(response: &Response, track: &Track, commands: &mut Vec<Command>) {
    if response.drag_started() {
        commands.push(Command::BeginScrub);
    }
    if let Some(pointer) = response.interact_pointer_pos()
        && (response.dragged() || response.clicked())
    {
        let time_secs = track.time_at(pointer);
        commands.push(Command::Seek { time_secs });
    }
    if response.drag_stopped() {
        commands.push(Command::EndScrub);
    }
}

/// Times at which any joint has a key, in order; times closer than a twentieth of a frame count once.
fn merged_key_times(clip: &Clip) -> Vec<f32> {
    let mut times: Vec<f32> = clip
        .tracks
        .iter()
        .flat_map(|track| track.times_secs().iter().copied())
        .collect();
    times.sort_by(f32::total_cmp);
    let same_secs = 0.05 / clip.keys_per_sec;
    times.dedup_by(|later, earlier| *later - *earlier < same_secs);
    times
}
