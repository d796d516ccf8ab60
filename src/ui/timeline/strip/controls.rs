//! Controls of the time: buttons to play and step, time and frame as numbers that can be typed.

use egui::{Align, FontId, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};

use super::typed::{self, Unit};
use crate::actions;
use crate::anim::Direction;
use crate::model::Clip;
use crate::ui::cx::Cx;
use crate::ui::kit::icons::{self, Icon};
use crate::ui::kit::theme::{self, Tokens};
use crate::ui::kit::wording::trimmed;
use crate::ui::kit::{
    TypedValue, action_button, control_size, hint_of_name, named, push_action, push_button, tell_node,
};

/// The round button that plays and pauses.
pub(in crate::ui::timeline) fn play_button<S>(ui: &mut Ui, cx: &mut Cx<'_, S>, diameter: f32) {
    let playing = cx.session.playback().is_playing();
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(diameter), Sense::click());
    let (tokens, painter, center) = (Tokens::of(ui), ui.painter(), rect.center());
    let lift = if response.hovered() { 1.0 } else { 0.92 };
    painter.circle_filled(center, diameter * 0.5, tokens.accent.gamma_multiply(lift));
    if response.has_focus() {
        painter.circle_stroke(center, diameter * 0.5 + 2.0, Stroke::new(1.5, tokens.accent));
    }
    let icon = if playing { Icon::Pause } else { Icon::Play };
    icons::paint(painter, rect, icon, tokens.on_accent);
    let label = if playing {
        actions::PLAY.hint_of("Pause")
    } else {
        actions::PLAY.hint()
    };
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    if hint_of_name(named(response, actions::PLAY.control), &label).clicked() {
        cx.act(&actions::PLAY);
    }
}

/// How far a button goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::ui::timeline) enum Step {
    /// By one frame. With Shift, or by a long touch, by ten.
    Frame,
    /// To the next key of the selected joint, or of any.
    Key,
    /// To an end of the range that plays.
    End,
}

/// A button that moves the time.
pub(in crate::ui::timeline) fn step_button<S>(ui: &mut Ui, cx: &mut Cx<'_, S>, step: Step, direction: Direction) {
    let (icon, action) = match (step, direction) {
        (Step::Frame, Direction::Backward) => (Icon::StepBack, &actions::FRAME_BACK),
        (Step::Frame, Direction::Forward) => (Icon::StepForward, &actions::FRAME_ON),
        (Step::Key, Direction::Backward) => (Icon::KeyBack, &actions::PREVIOUS_KEY),
        (Step::Key, Direction::Forward) => (Icon::KeyForward, &actions::NEXT_KEY),
        (Step::End, Direction::Backward) => (Icon::SkipStart, &actions::FIRST_FRAME),
        (Step::End, Direction::Forward) => (Icon::SkipEnd, &actions::LAST_FRAME),
    };
    if step != Step::Frame {
        push_action(ui, cx, action, icon);
        return;
    }
    let label = format!("{} ({}, with Shift ten)", action.label, action.key());
    let response = named(push_button(ui, icon, &label), action.control);
    // A long touch stands for Shift.
    let long = response.long_touched();
    if response.clicked() || long {
        let many = long || ui.input(|input| input.modifiers.shift);
        cx.act(match direction {
            _ if !many => action,
            Direction::Backward => &actions::TEN_FRAMES_BACK,
            Direction::Forward => &actions::TEN_FRAMES_ON,
        });
    }
}

/// All buttons that move the time but play, spread over the width. For where the strip has no room for them.
pub(in crate::ui::timeline) fn all_steps<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    // The slimmest phones have no buttons for the ends, only the bar.
    let steps: &[Step] = if ui.available_width() >= 7.0 * control_size(ui) {
        &[Step::Frame, Step::Key, Step::End]
    } else {
        &[Step::Frame, Step::Key]
    };
    let count = 1.0 + 2.0 * steps.len() as f32;
    ui.horizontal(|ui| {
        let free = ui.available_width() - count * control_size(ui);
        ui.spacing_mut().item_spacing.x = (free / (count - 1.0)).clamp(0.0, 24.0);
        for &step in steps.iter().rev() {
            step_button(ui, cx, step, Direction::Backward);
        }
        action_button(ui, cx, &actions::PLAY_BACKWARD, Icon::PlayBackward);
        for &step in steps {
            step_button(ui, cx, step, Direction::Forward);
        }
    });
}

/// Widths of a clip's read-outs. They fit its longest numbers, so that nothing moves while these change.
#[derive(Clone, Copy, Debug)]
pub(in crate::ui::timeline) struct ReadoutWidths {
    /// Of the time alone.
    pub(in crate::ui::timeline) time: f32,
    /// Of the time and the clip's end.
    pub(in crate::ui::timeline) time_of_end: f32,
    pub(in crate::ui::timeline) frame: f32,
}

impl ReadoutWidths {
    pub(in crate::ui::timeline) fn of(ui: &Ui, clip: &Clip) -> Self {
        let width = |text: String, font: FontId| {
            let galley = ui.painter().layout_no_wrap(text, font, egui::Color32::WHITE);
            galley.size().x.ceil()
        };
        // Figures are tabular, so eights are as wide as any digits.
        let eights = |text: String| text.replace(|letter: char| letter.is_ascii_digit(), "8");
        let most_secs = clip.start_secs.abs().max(clip.end_secs.abs());
        let time = eights(format!("{most_secs:.3}"));
        let last = clip.last_frame();
        let frame = width(eights(format!("{last} / {last}")), FontId::proportional(13.0)) + 10.0;
        Self {
            time: (width(format!("{time} s"), theme::mono(12.0)) + 16.0).max(72.0),
            time_of_end: width(format!("{time} / {time} s"), theme::mono(12.0)) + 16.0,
            frame: frame.max(60.0),
        }
    }
}

/// The time in seconds, of how many if `with_end`.
pub(in crate::ui::timeline) fn time_readout<S>(
    ui: &mut Ui,
    cx: &mut Cx<'_, S>,
    clip: &Clip,
    (width, with_end): (f32, bool),
) {
    let typed = format!("{:.3}", cx.session.playback().time_secs());
    let text = if with_end {
        format!("{typed} / {:.3} s", clip.end_secs)
    } else {
        format!("{typed} s")
    };
    let (time_secs, response) = TypedValue::new(ui, "Time", &text, &typed)
        .width(width)
        .show(ui, |typed| typed::time(typed, clip, Unit::Secs));
    response.on_hover_text("Time, and where the clip ends\nClick to type seconds, 0.33, or a frame, f20");
    if let Some(time_secs) = time_secs {
        cx.pause_at(time_secs);
    }
}

/// The frame nearest to the time, of how many.
pub(in crate::ui::timeline) fn frame_readout<S>(ui: &mut Ui, cx: &mut Cx<'_, S>, clip: &Clip, width: f32) {
    let frame = clip.frame_at(cx.session.playback().time_secs());
    let text = format!("{frame} / {}", clip.last_frame());
    let muted = Tokens::of(ui).muted;
    let (time_secs, response) = TypedValue::new(ui, "Frame", &text, &frame.to_string())
        .width(width)
        .quiet(muted, Align::Min)
        .show(ui, |typed| typed::time(typed, clip, Unit::Frames));
    let rate = trimmed(clip.keys_per_sec);
    response.on_hover_text(format!(
        "Frame at {rate} keys a second\nClick to type a frame, 20, or seconds, 0.33 s"
    ));
    if let Some(time_secs) = time_secs {
        cx.pause_at(time_secs);
    }
}

/// Tells screen readers of a button that opens choices, and which one is in force.
pub(in crate::ui::timeline) fn tell_choice(response: &Response, name: &str, value: &str) {
    response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, name));
    tell_node(response, |node| node.set_value(value));
}
