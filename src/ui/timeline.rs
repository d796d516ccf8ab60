//! The strip at the bottom: transport, clip, bar with keys, read-outs, speed and loop mode.

use egui::{Align2, FontId, Popup, Rangef, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, vec2};

use super::icons::{self, Icon};
use super::panel::scrolled;
use super::theme::{self, CONTROL_RADIUS, MARGIN, Tokens};
use super::timeline_bar::KeyTimes;
use super::widgets::{TextButton, control_size, icon_button, menu_item};
use super::wording::{shortened, trimmed};
use crate::anim::LoopMode;
use crate::session::{Command, SPEEDS, Session};

/// The least width of the clip's name on a phone.
const CLIP_WIDTH_NARROW: f32 = 84.0;

/// Height of the strip's content.
pub(super) fn strip_height(ui: &Ui, narrow: bool) -> f32 {
    let control = control_size(ui);
    if narrow {
        44.0 + 8.0 + control
    } else {
        control.max(34.0)
    }
}

/// The strip in one row, for wide windows.
pub(super) fn wide(ui: &mut Ui, session: &Session, keys: &mut KeyTimes, commands: &mut Vec<Command>) {
    let height = strip_height(ui, false);
    ui.allocate_ui_with_layout(
        vec2(ui.available_width(), height),
        egui::Layout::left_to_right(egui::Align::Center),
        |ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            if icon_button(ui, Icon::SkipStart, "First frame (Home)", false).clicked() {
                commands.push(Command::SeekStart);
            }
            play_button(ui, session, 34.0, commands);
            if icon_button(ui, Icon::SkipEnd, "Last frame (End)", false).clicked() {
                commands.push(Command::SeekEnd);
            }
            ui.add_space(6.0);
            clip_menu(ui, session, Rangef::new(104.0, 200.0), commands);

            // The read-outs have fixed widths, so that nothing moves while values change.
            let right_width = 72.0 + 74.0 + 48.0 + control_size(ui) + 4.0 * 6.0;
            let bar_width = (ui.available_width() - right_width).max(60.0);
            keys.bar(ui, session, vec2(bar_width, 30.0), commands);
            time_field(ui, session, 72.0);
            frame_readout(ui, session, 74.0);
            speed_menu(ui, session, 48.0, commands);
            loop_button(ui, session, commands);
        },
    );
}

/// The strip in two rows, for phones: the bar above, large targets.
pub(super) fn narrow(ui: &mut Ui, session: &Session, keys: &mut KeyTimes, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 10.0;
        play_button(ui, session, 44.0, commands);
        keys.bar(ui, session, vec2(ui.available_width(), 44.0), commands);
    });
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        let spacing = ui.spacing().item_spacing.x;
        let others_width = 72.0 + 52.0 + control_size(ui) + 3.0 * spacing;
        // The slimmest phones have room for the time alone.
        let frame_width = 76.0 + spacing;
        let shows_frame = ui.available_width() >= CLIP_WIDTH_NARROW + others_width + frame_width;
        let right_width = others_width + if shows_frame { frame_width } else { 0.0 };
        let clip_width = Rangef::new(
            CLIP_WIDTH_NARROW,
            (ui.available_width() - right_width).max(CLIP_WIDTH_NARROW),
        );
        clip_menu(ui, session, clip_width, commands);
        ui.add_space((ui.available_width() - right_width).max(0.0));
        time_field(ui, session, 72.0);
        if shows_frame {
            frame_readout(ui, session, 76.0);
        }
        speed_menu(ui, session, 52.0, commands);
        loop_button(ui, session, commands);
    });
}

fn play_button(ui: &mut Ui, session: &Session, diameter: f32, commands: &mut Vec<Command>) {
    let playing = session.playback().is_playing();
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(diameter), Sense::click());
    let tokens = Tokens::of(ui);
    let lift = if response.hovered() { 1.0 } else { 0.92 };
    ui.painter()
        .circle_filled(rect.center(), diameter * 0.5, tokens.accent.gamma_multiply(lift));
    if response.has_focus() {
        ui.painter()
            .circle_stroke(rect.center(), diameter * 0.5 + 2.0, Stroke::new(1.5, tokens.accent));
    }
    icons::paint(
        ui.painter(),
        rect,
        if playing { Icon::Pause } else { Icon::Play },
        tokens.on_accent,
    );
    let label = if playing { "Pause (Space)" } else { "Play (Space)" };
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label));
    if response.on_hover_text(label).clicked() {
        commands.push(Command::TogglePlay);
    }
}

fn clip_menu(ui: &mut Ui, session: &Session, width: Rangef, commands: &mut Vec<Command>) {
    let Some(open) = session.open_model() else { return };
    let name = session.clip().map_or("", |clip| clip.name.as_str());
    let label = format!("Clip {name}");
    let response = TextButton::new(name, &label).list().width(width).show(ui);
    let response = response.on_hover_text(format!("{name}\nNext clip: C"));
    Popup::menu(&response).show(|ui| {
        ui.set_width(240.0);
        scrolled("clips", 360.0_f32.min(ui.ctx().content_rect().height() * 0.5)).show(ui, |ui| {
            for (index, clip) in open.model.clips.iter().enumerate() {
                let text = format!("{}   {:.2} s", shortened(&clip.name, 40), clip.duration_secs());
                if menu_item(ui, &text, session.clip_index() == Some(index)).clicked() {
                    commands.push(Command::SelectClip(index));
                    ui.close();
                }
            }
        });
    });
}

fn time_field(ui: &mut Ui, session: &Session, width: f32) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(width, 28.0), Sense::hover());
    let text = format!("{:.3} s", session.playback().time_secs());
    ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field);
    let right = rect.right_center() - vec2(7.0, 0.0);
    ui.painter()
        .text(right, Align2::RIGHT_CENTER, &text, theme::mono(12.0), tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Time {text}")));
}

fn frame_readout(ui: &mut Ui, session: &Session, width: f32) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(width, 28.0), Sense::hover());
    let Some(clip) = session.clip() else { return };
    let frame = clip.frame_at(session.playback().time_secs());
    let text = format!("{frame} of {}", clip.last_frame());
    ui.painter().text(
        rect.left_center() + vec2(2.0, 0.0),
        Align2::LEFT_CENTER,
        &text,
        FontId::proportional(13.0),
        tokens.muted,
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Frame {text}")));
    response.on_hover_text(format!("Frame at {} keys a second", trimmed(clip.keys_per_sec)));
}

fn speed_menu(ui: &mut Ui, session: &Session, width: f32, commands: &mut Vec<Command>) {
    let speed = session.playback().speed();
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(width, control_size(ui)), Sense::click());
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field_hovered);
    }
    let text = format!("{}×", trimmed(speed));
    let color = if (speed - 1.0).abs() < 1e-4 {
        tokens.muted
    } else {
        tokens.accent
    };
    ui.painter().text(
        rect.center(),
        Align2::CENTER_CENTER,
        &text,
        FontId::proportional(13.0),
        color,
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Speed {text}")));
    let response = response.on_hover_text("Speed: [ slower, ] faster, \\ as the file");
    Popup::menu(&response).show(|ui| {
        ui.set_width(72.0);
        for choice in SPEEDS {
            if menu_item(ui, &format!("{}×", trimmed(choice)), (choice - speed).abs() < 1e-4).clicked() {
                commands.push(Command::SetSpeed(choice));
                ui.close();
            }
        }
    });
}

fn loop_button(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let (icon, label) = match session.playback().loop_mode() {
        LoopMode::Once => (Icon::Once, "Plays once (L)"),
        LoopMode::Loop => (Icon::Loop, "Loops (L)"),
        LoopMode::PingPong => (Icon::PingPong, "Plays there and back (L)"),
    };
    if icon_button(ui, icon, label, false).clicked() {
        commands.push(Command::CycleLoopMode);
    }
}

/// Room that the strip takes from the window's lower edge.
pub(super) fn covered_height(ui: &Ui, session: &Session, narrow: bool) -> f32 {
    if session.clip().is_none() {
        0.0
    } else {
        strip_height(ui, narrow) + 2.0 * 9.0 + MARGIN * 2.0
    }
}
