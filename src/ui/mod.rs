//! The interface. It reads a [`Session`] and answers with [`Command`]s; what is open and shut is its own [`UiState`].

mod diagnostics_panel;
mod error_card;
mod excerpt;
mod help;
mod icons;
mod keys;
mod model_panel;
mod panel;
mod textures;
pub mod theme;
mod timeline;
mod title_bar;
mod toolbar;
mod viewport;
mod widgets;

use egui::{Align2, Margin, Rect, Ui, Vec2, pos2, vec2};

use crate::scene::{Insets, Theme};
use crate::session::{Command, Session};
pub use keys::owns_key;

use panel::{Panel, scrolled};
use theme::{MARGIN, NARROW_WIDTH};
use timeline::KeyTimes;

/// Width of the panel on the left.
const SIDE_WIDTH: f32 = 246.0;
/// Margin around the controls of the bars at the top.
const BAR_MARGIN: f32 = 4.0;

/// What only the page around the interface can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// Let the person pick files.
    PickFiles,
    /// Take this theme, whatever the system says.
    UseTheme(Theme),
}

/// Which panels are open. Nothing here changes the model or the picture of it.
#[derive(Debug, Default)]
pub struct UiState {
    /// The table of keys.
    pub help_open: bool,
    /// The list of findings.
    pub diagnostics_open: bool,
    /// In a narrow window: the model's facts in the bottom sheet.
    pub sheet_open: bool,
    coarse_pointer: bool,
    shown_finding: Option<usize>,
    shown_model: u64,
    key_times: KeyTimes,
    requests: Vec<Request>,
}

impl UiState {
    /// Everything shut. `coarse_pointer`: the device says that fingers are its pointer.
    pub fn new(coarse_pointer: bool) -> Self {
        Self {
            coarse_pointer,
            ..Self::default()
        }
    }

    /// What was asked of the page since the last call.
    pub fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.requests)
    }
}

/// One pass over the whole window. Returns what the person asked for, in order.
pub fn show(ui: &mut Ui, session: &Session, state: &mut UiState) -> Vec<Command> {
    let mut commands = Vec::new();
    let window = ui.max_rect();
    let narrow = window.width() < NARROW_WIDTH;
    let touch = state.coarse_pointer || ui.input(egui::InputState::has_touch_screen);
    widgets::size_for_touch(ui.ctx(), touch);
    if state.shown_model != session.model_revision() {
        state.shown_model = session.model_revision();
        state.shown_finding = None;
        state.diagnostics_open = false;
    }

    commands.push(set_theme(ui));
    commands.push(set_viewport(ui, session, window, narrow));
    viewport::show(ui, window, &mut commands);
    keys::read(ui, session, state, &mut commands);

    if narrow {
        narrow_layout(ui, session, state, window, &mut commands);
    } else {
        wide_layout(ui, session, state, window, &mut commands);
    }
    if state.help_open {
        let at = window.right_top() + vec2(-MARGIN, MARGIN * 2.0 + bar_height(ui));
        Panel::new("help", Align2::RIGHT_TOP, at).on_top().show(ui, |ui| {
            ui.set_width(300.0_f32.min(window.width() - 2.0 * MARGIN - 26.0));
            help::show(ui, state);
        });
    }
    if let Some(error) = session.error() {
        let at = pos2(window.center().x, window.min.y + window.height() * 0.38);
        Panel::new("error", Align2::CENTER_CENTER, at).on_top().show(ui, |ui| {
            ui.set_width(536.0_f32.min(window.width() - 2.0 * MARGIN - 26.0));
            error_card::show(ui, session, error, &mut commands);
        });
    }
    commands
}

/// Height of the bars at the top.
fn bar_height(ui: &Ui) -> f32 {
    widgets::control_size(ui) + 2.0 * BAR_MARGIN
}

fn set_theme(ui: &Ui) -> Command {
    Command::SetTheme(if ui.visuals().dark_mode {
        Theme::Dark
    } else {
        Theme::Light
    })
}

/// What the panels leave free is where the model is framed.
fn set_viewport(ui: &Ui, session: &Session, window: Rect, narrow: bool) -> Command {
    let top = (bar_height(ui) + MARGIN) / window.height();
    let bottom = timeline::covered_height(ui, session, narrow) / window.height();
    let left = if narrow {
        0.0
    } else {
        (MARGIN * 2.0 + SIDE_WIDTH) / window.width()
    };
    let insets = Insets {
        left,
        top: top.clamp(0.0, 0.3),
        bottom: bottom.clamp(0.0, 0.4),
        ..Insets::default()
    };
    Command::SetViewport {
        aspect: window.width() / window.height().max(1.0),
        insets,
    }
}

fn wide_layout(ui: &Ui, session: &Session, state: &mut UiState, window: Rect, commands: &mut Vec<Command>) {
    let left_top = window.min + Vec2::splat(MARGIN);
    Panel::new("title", Align2::LEFT_TOP, left_top)
        .margin(Margin::symmetric(12, 6))
        .show(ui, |ui| {
            ui.set_height(widgets::control_size(ui) - 6.0);
            title_bar::show(ui, session, false);
        });
    let right_top = window.right_top() + vec2(-MARGIN, MARGIN);
    Panel::new("toolbar", Align2::RIGHT_TOP, right_top)
        .margin(Margin::same(3))
        .show(ui, |ui| {
            ui.set_height(widgets::control_size(ui));
            toolbar::show(ui, session, state, commands);
        });
    let covered = timeline::covered_height(ui, session, false);
    let side_top = left_top + vec2(0.0, MARGIN + bar_height(ui));
    let side_room = window.max.y - covered.max(MARGIN) - side_top.y - 26.0;
    if session.open_model().is_some() {
        Panel::new("model", Align2::LEFT_TOP, side_top).show(ui, |ui| {
            ui.set_width(SIDE_WIDTH - 26.0);
            scrolled("model", side_room).show(ui, |ui| {
                model_panel::show(ui, session, state, commands);
            });
        });
    }
    if state.diagnostics_open {
        let at = side_top + vec2(SIDE_WIDTH + MARGIN, 0.0);
        Panel::new("diagnostics", Align2::LEFT_TOP, at).show(ui, |ui| {
            ui.set_width(430.0_f32.min(window.width() - SIDE_WIDTH - 3.0 * MARGIN - 26.0));
            diagnostics_panel::show(ui, session, state, side_room - 50.0);
        });
    }
    if session.clip().is_some() {
        let at = window.left_bottom() + vec2(MARGIN, -MARGIN);
        Panel::new("timeline", Align2::LEFT_BOTTOM, at)
            .margin(Margin::same(9))
            .show(ui, |ui| {
                ui.set_width(window.width() - 2.0 * MARGIN - 20.0);
                timeline::wide(ui, session, &mut state.key_times, commands);
            });
    }
}

/// Phones and slim windows: one bar above, one sheet below.
fn narrow_layout(ui: &Ui, session: &Session, state: &mut UiState, window: Rect, commands: &mut Vec<Command>) {
    let left_top = window.min + Vec2::splat(MARGIN);
    Panel::new("title", Align2::LEFT_TOP, left_top)
        .margin(Margin::same(4))
        .show(ui, |ui| {
            ui.set_width(window.width() - 2.0 * MARGIN - 10.0);
            ui.horizontal(|ui| {
                ui.set_height(widgets::control_size(ui));
                ui.add_space(8.0);
                title_bar::show(ui, session, true);
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    toolbar::show_narrow(ui, session, state, commands);
                });
            });
        });
    if session.open_model().is_none() {
        return;
    }
    let sheet_margin = Margin {
        left: 14,
        right: 14,
        top: 0,
        bottom: 14,
    };
    Panel::new("sheet", Align2::LEFT_BOTTOM, window.left_bottom())
        .sheet()
        .margin(sheet_margin)
        .show(ui, |ui| {
            ui.set_width(window.width() - 30.0);
            if widgets::sheet_handle(ui, state.sheet_open).clicked() {
                state.sheet_open = !state.sheet_open;
            }
            if session.clip().is_some() {
                timeline::narrow(ui, session, &mut state.key_times, commands);
            }
            if state.sheet_open {
                ui.add_space(10.0);
                let covered = bar_height(ui) + timeline::covered_height(ui, session, true) + 3.0 * MARGIN;
                let room = (window.height() * 0.5).min(window.height() - covered);
                scrolled("sheet", room).show(ui, |ui| {
                    if state.diagnostics_open {
                        diagnostics_panel::show(ui, session, state, room - 50.0);
                    } else {
                        model_panel::show(ui, session, state, commands);
                    }
                });
            }
        });
}
