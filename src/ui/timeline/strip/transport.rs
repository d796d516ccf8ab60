//! The panel of the timeline. Its strip has transport, clip, bar, read-outs, speed and loop mode. In a wide window the sheet is above.

use egui::{Align2, FontId, Rangef, Role, Sense, Ui, WidgetInfo, vec2};

use super::controls::{ReadoutWidths, Step};
use super::{bar, clips, controls, options};
use crate::actions::{self, Control};
use crate::anim::{Direction, LoopMode};
use crate::model::Clip;
use crate::ui::cx::Cx;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::{CONTROL_RADIUS, Tokens};
use crate::ui::kit::{action_button, control_size, focus_ring, icon_button, named, push_button, tell_open};
use crate::ui::state::{Chrome, DrawerPage, UiState};
use crate::ui::timeline::sheet;
use crate::ui::timeline::state::TimelineState;
use crate::ui::window::panel::{mark_transport, popover_above};

/// Side of the button that plays, in a wide window.
const PLAY_SIZE: f32 = 34.0;
const SHEET_GAP: f32 = 8.0;
/// The least width of the clip's name on a phone.
const CLIP_WIDTH_NARROW: f32 = 84.0;
/// The width of the speed on a phone.
const SPEED_WIDTH_NARROW: f32 = 52.0;
/// The least width of the bar with buttons for frames beside it.
const LEAST_BAR_WITH_FRAMES: f32 = 200.0;
/// Gap between controls, but for the large ones.
const SPACING: f32 = 6.0;
/// From this width on there are buttons that step from key to key.
const KEY_BUTTONS_WIDTH: f32 = 1060.0;

/// The panel's contents in a wide window.
pub(in crate::ui) fn wide(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    sheet::show_edge(ui, &mut cx.state.timeline);
    if let Some(height) = cx.state.timeline.sheet_height(ui.available_height()) {
        sheet::show(ui, &mut cx.part(|state| &mut state.timeline), height);
        ui.add_space(SHEET_GAP);
    }
    strip(ui, cx);
}

/// The strip in one row, for wide windows.
fn strip(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    let Some(clip) = cx.session.clip() else { return };
    let row = vec2(ui.available_width(), control_size(ui).max(PLAY_SIZE));
    let row = ui.allocate_ui_with_layout(row, egui::Layout::left_to_right(egui::Align::Center), |ui| {
        let with_keys = ui.available_width() >= KEY_BUTTONS_WIDTH;
        ui.spacing_mut().item_spacing.x = 2.0;
        let steps: &[Step] = if with_keys {
            &[Step::Frame, Step::Key, Step::End]
        } else {
            &[Step::Frame, Step::End]
        };
        for &step in steps.iter().rev() {
            controls::step_button(ui, cx, step, Direction::Backward);
        }
        action_button(ui, cx, &actions::PLAY_BACKWARD, Icon::PlayBackward);
        ui.add_space(3.0);
        controls::play_button(ui, cx, PLAY_SIZE);
        ui.add_space(3.0);
        for &step in steps {
            controls::step_button(ui, cx, step, Direction::Forward);
        }
        ui.spacing_mut().item_spacing.x = SPACING;
        ui.add_space(4.0);
        clips::button(ui, cx, Rangef::new(92.0, 200.0));

        // The read-outs have fixed widths, so that nothing moves while values change.
        let widths = ReadoutWidths::of(ui, clip);
        let right_width = widths.time_of_end + widths.frame + 48.0 + 2.0 * control_size(ui) + 5.0 * SPACING;
        let bar_width = (ui.available_width() - right_width).max(60.0);
        bar::show(ui, &mut cx.part(|state| &mut state.timeline), vec2(bar_width, 30.0));
        controls::time_readout(ui, cx, clip, (widths.time_of_end, true));
        controls::frame_readout(ui, cx, clip, widths.frame);
        speed_button(ui, &mut cx.part(|state| &mut state.timeline), 48.0, !with_keys);
        loop_button(ui, cx);
        if sheet_button(ui, cx.state.timeline.open) {
            cx.state.timeline.open = !cx.state.timeline.open;
        }
    });
    mark_transport(ui, row.response.rect);
}

/// The strip for phones, with large targets: in two rows with the bar above, or in one row in a `low` window.
pub(in crate::ui) fn narrow(ui: &mut Ui, cx: &mut Cx<'_, UiState>, low: bool) {
    let Some(clip) = cx.session.clip() else { return };
    let end = EndOfStrip::of(ui, clip, low);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 10.0;
        let button = control_size(ui) + ui.spacing().item_spacing.x;
        // A single row has two frame buttons if they leave the bar long enough to scrub on.
        let others = 44.0 + CLIP_WIDTH_NARROW + end.width + 4.0 * button;
        let with_frames = low && ui.available_width() - others >= LEAST_BAR_WITH_FRAMES;
        if with_frames {
            controls::step_button(ui, cx, Step::Frame, Direction::Backward);
        }
        controls::play_button(ui, cx, 44.0);
        if with_frames {
            controls::step_button(ui, cx, Step::Frame, Direction::Forward);
        }
        // A page that shows the timeline alone has no drawer for the sheet.
        let has_sheet = cx.state.chrome == Chrome::Full;
        let mut bar_width = ui.available_width() - if has_sheet { button } else { 0.0 };
        if low {
            let before = ui.available_width();
            clips::button(ui, cx, Rangef::new(CLIP_WIDTH_NARROW, 140.0));
            bar_width -= before - ui.available_width() + end.width + 10.0;
        }
        bar::show(ui, &mut cx.part(|state| &mut state.timeline), vec2(bar_width, 44.0));
        if low {
            ui.scope(|ui| end.show(ui, &mut cx.part(|state| &mut state.timeline), clip));
        }
        let open = cx.state.drawer == Some(DrawerPage::Timeline);
        if has_sheet && sheet_button(ui, open) {
            cx.state.drawer = (!open).then_some(DrawerPage::Timeline);
        }
    });
    if low {
        return;
    }
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        let most = (ui.available_width() - end.width - SPACING).max(0.0);
        clips::button(ui, cx, Rangef::new(CLIP_WIDTH_NARROW.min(most), most));
        ui.add_space((ui.available_width() - end.width).max(0.0));
        end.show(ui, &mut cx.part(|state| &mut state.timeline), clip);
    });
}

/// Read-outs, speed and loop mode on a phone.
struct EndOfStrip {
    time: f32,
    shows_end: bool,
    frame: f32,
    shows_frame: bool,
    /// Whether its popover has the buttons that step. On an upright phone the dope sheet's page has them.
    with_steps: bool,
    width: f32,
}

impl EndOfStrip {
    fn of(ui: &Ui, clip: &Clip, low: bool) -> Self {
        let widths = ReadoutWidths::of(ui, clip);
        let room = ui.available_width() - CLIP_WIDTH_NARROW - SPACING;
        let least = widths.time + SPEED_WIDTH_NARROW + control_size(ui) + 2.0 * SPACING;
        // The slimmest phones show the time without the frame. Where there is more room, the clip's end is shown.
        let with_frame = least + widths.frame + SPACING;
        let with_end = with_frame + widths.time_of_end - widths.time;
        // In a low window the bar is in the same row, with at most five buttons.
        let beside = if low {
            LEAST_BAR_WITH_FRAMES + 5.0 * (control_size(ui) + 10.0)
        } else {
            0.0
        };
        let (shows_frame, shows_end) = (room >= with_frame, room - beside >= with_end);
        Self {
            time: if shows_end { widths.time_of_end } else { widths.time },
            shows_end,
            frame: widths.frame,
            shows_frame,
            with_steps: low,
            width: match (shows_end, shows_frame) {
                (true, _) => with_end,
                (false, true) => with_frame,
                (false, false) => least,
            },
        }
    }

    fn show(&self, ui: &mut Ui, cx: &mut Cx<'_, TimelineState>, clip: &Clip) {
        ui.spacing_mut().item_spacing.x = SPACING;
        controls::time_readout(ui, cx, clip, (self.time, self.shows_end));
        if self.shows_frame {
            controls::frame_readout(ui, cx, clip, self.frame);
        }
        speed_button(ui, cx, SPEED_WIDTH_NARROW, self.with_steps);
        loop_button(ui, cx);
    }
}

/// The button with the speed. It opens all options of playing. `with_steps`: with the buttons that step.
fn speed_button(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>, width: f32, with_steps: bool) {
    let speed = cx.session.playback().speed();
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(width, control_size(ui)), Sense::click());
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field_hovered);
    }
    let text = actions::speed_label(speed);
    let color = if (speed - 1.0).abs() < 1e-4 {
        tokens.muted
    } else {
        tokens.accent
    };
    let font = FontId::proportional(13.0);
    ui.painter()
        .text(rect.center(), Align2::CENTER_CENTER, &text, font, color);
    focus_ring(ui, rect, &response);
    controls::tell_choice(&response, "Speed", &text);
    let hint = format!(
        "Speed ({} slower, {} faster, {} as the file), range and loop gap",
        actions::SLOWER.key(),
        actions::FASTER.key(),
        actions::NORMAL_SPEED.key(),
    );
    let response = named(response, Control::new("speed")).on_hover_text(hint);
    popover_above(ui, (&response, "Speed, range and loop gap"), options::WIDTH, |ui| {
        options::show(ui, cx, with_steps);
    });
}

/// The button of the dope sheet. Returns whether it was pressed.
fn sheet_button(ui: &mut Ui, open: bool) -> bool {
    let label = if open {
        "Shut the dope sheet"
    } else {
        "Dope sheet and curves"
    };
    let button = named(
        icon_button(ui, Icon::DopeSheet, label, open),
        Control::new("dope-sheet"),
    );
    tell_open(&button, open);
    button.clicked()
}

fn loop_button<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let (icon, label) = match cx.session.playback().loop_mode() {
        LoopMode::Once => (Icon::Once, "Plays once"),
        LoopMode::Loop => (Icon::Loop, "Loops"),
        LoopMode::PingPong => (Icon::PingPong, "Plays there and back"),
    };
    let action = &actions::NEXT_LOOP_MODE;
    let response = named(push_button(ui, icon, &action.hint_of(label)), action.control);
    let spoken = format!("At the end: {}", label.to_lowercase());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &spoken));
    if response.clicked() {
        cx.act(action);
    }
}
