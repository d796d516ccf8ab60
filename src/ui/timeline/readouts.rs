//! Time and frame as numbers that can be typed.

use egui::{Align, FontId, Ui};

use super::super::theme::{self, Tokens};
use super::super::widgets::{TypedValue, typed_number};
use super::super::wording::trimmed;
use crate::model::Clip;
use crate::session::{Command, Session};

/// Widths of the read-outs of a clip: as its longest numbers need, so that nothing moves while they change.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReadoutWidths {
    pub(super) time: f32,
    pub(super) frame: f32,
}

impl ReadoutWidths {
    /// Those of a clip.
    pub(super) fn of(ui: &Ui, clip: &Clip) -> Self {
        let width = |text: String, font: FontId| {
            let galley = ui.painter().layout_no_wrap(text, font, egui::Color32::WHITE);
            galley.size().x.ceil()
        };
        // Tabular figures: as wide as the last number in eights.
        let eights = |text: String| text.replace(|letter: char| letter.is_ascii_digit(), "8");
        let most_secs = clip.start_secs.abs().max(clip.end_secs.abs());
        let time = width(eights(format!("{most_secs:.3} s")), theme::mono(12.0)) + 16.0;
        let last = clip.last_frame();
        let frame = width(eights(format!("{last} of {last}")), FontId::proportional(13.0)) + 10.0;
        Self {
            time: time.max(72.0),
            frame: frame.max(72.0),
        }
    }
}

/// The time in seconds.
pub(super) fn time(ui: &mut Ui, session: &Session, width: f32, commands: &mut Vec<Command>) {
    let secs = session.playback().time_secs();
    let typed = format!("{secs:.3}");
    let text = format!("{typed} s");
    let (entered, response) = TypedValue::new(ui, "Time", &text, &typed).width(width).show(ui);
    response.on_hover_text("Click to type a time in seconds");
    if let Some(secs) = entered.and_then(|typed| typed_number(&typed)) {
        commands.push(Command::Seek { time_secs: secs as f32 });
    }
}

/// The frame nearest to the time, of how many.
pub(super) fn frame(ui: &mut Ui, session: &Session, clip: &Clip, width: f32, commands: &mut Vec<Command>) {
    let frame = clip.frame_at(session.playback().time_secs());
    let text = format!("{frame} of {}", clip.last_frame());
    let muted = Tokens::of(ui).muted;
    let (entered, response) = TypedValue::new(ui, "Frame", &text, &frame.to_string())
        .width(width)
        .quiet(muted, Align::Min)
        .show(ui);
    let rate = trimmed(clip.keys_per_sec);
    response.on_hover_text(format!("Frame at {rate} keys a second\nClick to type one"));
    if let Some(frame) = entered.and_then(|typed| typed_number(&typed)) {
        commands.push(Command::SeekFrame(frame));
    }
}
