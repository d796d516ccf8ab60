//! The interface. It reads a [`Session`] and answers with [`Command`]s; what is open and shut is its own [`UiState`].

mod diagnostics_panel;
mod error_card;
mod excerpt;
mod help;
mod icons;
mod keys;
mod model_panel;
pub mod theme;
mod timeline;
mod title_bar;
mod toolbar;
mod viewport;
mod widgets;

use egui::{Align2, Area, Frame, Id, Margin, Order, Rect, Ui, Vec2, pos2, vec2};

use crate::scene::{Insets, Theme};
use crate::session::{Command, Session};
pub use keys::owns_key;

use theme::{MARGIN, NARROW_WIDTH, Tokens};
use timeline::KeyTimes;

/// Width of the panel on the left.
const SIDE_WIDTH: f32 = 246.0;
/// Height of the bars at the top.
const BAR_HEIGHT: f32 = 36.0;

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
    shown_finding: Option<usize>,
    shown_model: u64,
    key_times: KeyTimes,
    requests: Vec<Request>,
}

impl UiState {
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
        let at = window.right_top() + vec2(-MARGIN, MARGIN * 2.0 + BAR_HEIGHT);
        panel(ui, "help", Align2::RIGHT_TOP, at, Order::Foreground, 12, |ui| {
            ui.set_width(300.0_f32.min(window.width() - 2.0 * MARGIN - 26.0));
            help::show(ui, state);
        });
    }
    if let Some(error) = session.error() {
        let width = 536.0_f32.min(window.width() - 2.0 * MARGIN - 26.0);
        let at = pos2(window.center().x, window.min.y + window.height() * 0.38);
        panel(ui, "error", Align2::CENTER_CENTER, at, Order::Foreground, 12, |ui| {
            ui.set_width(width);
            error_card::show(ui, session, error, &mut commands);
        });
    }
    commands
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
    let top = (BAR_HEIGHT + MARGIN) / window.height();
    let bottom = timeline::covered_height(ui, session, narrow) / window.height();
    let insets = Insets {
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
    panel(
        ui,
        "title",
        Align2::LEFT_TOP,
        window.min + Vec2::splat(MARGIN),
        Order::Middle,
        12,
        |ui| {
            ui.set_height(BAR_HEIGHT - 14.0);
            title_bar::show(ui, session, false);
        },
    );
    let right_top = window.right_top() + vec2(-MARGIN, MARGIN);
    panel(ui, "toolbar", Align2::RIGHT_TOP, right_top, Order::Middle, 4, |ui| {
        ui.set_height(28.0);
        toolbar::show(ui, session, state, commands);
    });
    let covered = timeline::covered_height(ui, session, false);
    let side_top = window.min + vec2(MARGIN, MARGIN * 2.0 + BAR_HEIGHT);
    let side_room = window.max.y - covered.max(MARGIN) - side_top.y;
    if session.open_model().is_some() {
        panel(
            ui,
            "model",
            Align2::LEFT_TOP,
            side_top,
            Order::Middle,
            model_panel::PANEL_MARGIN as i8,
            |ui| {
                ui.set_width(SIDE_WIDTH - 2.0 * model_panel::PANEL_MARGIN);
                egui::ScrollArea::vertical()
                    .id_salt("model")
                    .max_height(side_room - 26.0)
                    .show(ui, |ui| {
                        model_panel::show(ui, session, state, commands);
                    });
            },
        );
    }
    if state.diagnostics_open {
        let at = side_top + vec2(SIDE_WIDTH + MARGIN, 0.0);
        panel(ui, "diagnostics", Align2::LEFT_TOP, at, Order::Middle, 12, |ui| {
            ui.set_width(430.0_f32.min(window.width() - SIDE_WIDTH - 4.0 * MARGIN));
            diagnostics_panel::show(ui, session, state, side_room - 80.0);
        });
    }
    if session.clip().is_some() {
        let at = pos2(window.min.x + MARGIN, window.max.y - MARGIN);
        panel(ui, "timeline", Align2::LEFT_BOTTOM, at, Order::Middle, 9, |ui| {
            ui.set_width(window.width() - 2.0 * MARGIN - 20.0);
            timeline::wide(ui, session, &mut state.key_times, commands);
        });
    }
}

/// Phones and slim windows: one bar above, one sheet below.
fn narrow_layout(ui: &Ui, session: &Session, state: &mut UiState, window: Rect, commands: &mut Vec<Command>) {
    let width = window.width() - 2.0 * MARGIN;
    panel(
        ui,
        "title",
        Align2::LEFT_TOP,
        window.min + Vec2::splat(MARGIN),
        Order::Middle,
        4,
        |ui| {
            ui.set_width(width - 10.0);
            ui.horizontal(|ui| {
                let height = widgets::control_size(ui);
                ui.set_height(height);
                ui.add_space(8.0);
                title_bar::show(ui, session, true);
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    toolbar::show_narrow(ui, session, state, commands);
                });
            });
        },
    );
    if session.open_model().is_none() {
        return;
    }
    let at = pos2(window.min.x, window.max.y);
    let frame = theme::panel_frame(&Tokens::of(ui))
        .corner_radius(egui::CornerRadius {
            nw: 14,
            ne: 14,
            sw: 0,
            se: 0,
        })
        .inner_margin(Margin {
            left: 14,
            right: 14,
            top: 0,
            bottom: 14,
        });
    let sheet_room = window.height() * 0.62;
    area(ui, "sheet", Align2::LEFT_BOTTOM, at, Order::Middle).show(ui.ctx(), |ui| {
        frame.show(ui, |ui| {
            ui.set_width(window.width() - 30.0);
            if widgets::sheet_handle(ui, state.sheet_open).clicked() {
                state.sheet_open = !state.sheet_open;
            }
            if session.clip().is_some() {
                timeline::narrow(ui, session, &mut state.key_times, commands);
            }
            if state.sheet_open {
                ui.add_space(10.0);
                egui::ScrollArea::vertical()
                    .id_salt("sheet")
                    .max_height(sheet_room)
                    .show(ui, |ui| {
                        if state.diagnostics_open {
                            diagnostics_panel::show(ui, session, state, f32::INFINITY);
                        } else {
                            model_panel::show(ui, session, state, commands);
                        }
                    });
            }
        });
    });
}

fn area(ui: &Ui, name: &str, pivot: Align2, at: egui::Pos2, order: Order) -> Area {
    Area::new(Id::unique(("panel", name)))
        .order(order)
        .pivot(pivot)
        .fixed_pos(at)
        .constrain_to(ui.max_rect())
        .fade_in(false)
}

/// A floating panel whose `pivot` corner is at a point.
fn panel(ui: &Ui, name: &str, pivot: Align2, at: egui::Pos2, order: Order, margin: i8, contents: impl FnOnce(&mut Ui)) {
    let frame: Frame = theme::panel_frame(&Tokens::of(ui)).inner_margin(Margin::same(margin));
    area(ui, name, pivot, at, order).show(ui.ctx(), |ui| frame.show(ui, contents));
}
