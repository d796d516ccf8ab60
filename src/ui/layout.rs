//! Where the panels are: around the view in a wide window, a bar and a sheet in a narrow one.

use egui::{Align2, Margin, Rect, Ui, Vec2, pos2, vec2};

use super::panel::{Panel, scrolled};
use super::skeleton::SidePage;
use super::state::{SheetPage, UiState};
use super::theme::MARGIN;
use super::{
    diagnostics_panel, free_room, inspector, light, model_panel, overlays, picture, skeleton, timeline, title_bar,
    toolbar, view_modes, widgets,
};
use crate::session::{Command, Session};

/// Width of the panel on the left.
pub(super) const SIDE_WIDTH: f32 = 246.0;
/// Width of the inspector on the right.
const INSPECTOR_WIDTH: f32 = 288.0;
/// Share of a narrow window's height that a page of the sheet has at most: the model keeps the rest.
const PAGE_SHARE: f32 = 0.47;
/// Margin around the controls of the bars at the top.
const BAR_MARGIN: f32 = 4.0;

/// Height of the bars at the top.
pub(super) fn bar_height(ui: &Ui) -> f32 {
    widgets::control_size(ui) + 2.0 * BAR_MARGIN
}

/// Wide windows.
pub(super) fn wide(ui: &Ui, session: &Session, state: &mut UiState, window: Rect, commands: &mut Vec<Command>) {
    let left_top = window.min + Vec2::splat(MARGIN);
    let right_top = window.right_top() + vec2(-MARGIN, MARGIN);
    let toolbar = Panel::new("toolbar", Align2::RIGHT_TOP, right_top)
        .margin(Margin::same(3))
        .show(ui, |ui| {
            ui.set_height(widgets::control_size(ui));
            toolbar::show(ui, session, state, commands);
        });
    Panel::new("title", Align2::LEFT_TOP, left_top)
        .margin(Margin::symmetric(12, 6))
        .show(ui, |ui| {
            ui.set_height(widgets::control_size(ui) - 6.0);
            // What the toolbar leaves, without the panel's own margins and border.
            let most = toolbar.min.x - MARGIN - left_top.x - 26.0;
            title_bar::show(ui, session, most, true);
        });
    let covered = timeline::covered_height(ui, session, &state.timeline, false);
    let side_top = left_top + vec2(0.0, MARGIN + bar_height(ui));
    let side_room = window.max.y - covered.max(MARGIN) - side_top.y - 26.0;
    let panel_room = side_room - free_room::covered_by_card(ui, session, state, window);
    if session.open_model().is_some() {
        Panel::new("model", Align2::LEFT_TOP, side_top).show(ui, |ui| {
            ui.set_width(SIDE_WIDTH - 26.0);
            side_panel(ui, "model", session, state, panel_room, commands);
        });
    }
    show_legend(ui, session, state, window, false);
    let inspects_joint = skeleton::is_inspected(session);
    let inspects = session.subsets().selected().is_some() || inspects_joint;
    if state.diagnostics_open {
        let at = side_top + vec2(SIDE_WIDTH + MARGIN, 0.0);
        let right = window.max.x - if inspects { MARGIN + INSPECTOR_WIDTH } else { 0.0 };
        Panel::new("diagnostics", Align2::LEFT_TOP, at).show(ui, |ui| {
            ui.set_width(430.0_f32.min(right - MARGIN - at.x - 26.0));
            diagnostics_panel::show(ui, session, state, side_room - 50.0);
        });
    }
    if inspects {
        let at = pos2(window.max.x - MARGIN, side_top.y);
        Panel::new("inspector", Align2::RIGHT_TOP, at).show(ui, |ui| {
            ui.set_width(INSPECTOR_WIDTH - 26.0);
            scrolled("inspector", side_room).show(ui, |ui| {
                if inspects_joint {
                    skeleton::show_inspector(ui, session, &mut state.skeleton, commands);
                } else {
                    inspector::show(ui, session, state, commands);
                }
            });
        });
    }
    if session.clip().is_some() {
        let at = window.left_bottom() + vec2(MARGIN, -MARGIN);
        Panel::new("timeline", Align2::LEFT_BOTTOM, at)
            .margin(Margin::same(9))
            .show(ui, |ui| {
                ui.set_width(window.width() - 2.0 * MARGIN - 20.0);
                timeline::wide(ui, session, state, commands);
            });
    }
}

/// Facts or the tree of joints; each scrolls by itself.
fn side_panel(
    ui: &mut Ui,
    id: &'static str,
    session: &Session,
    state: &mut UiState,
    room: f32,
    commands: &mut Vec<Command>,
) {
    let top = ui.cursor().min.y;
    if skeleton::has_joints(session) {
        skeleton::show_pages(ui, &mut state.skeleton);
        ui.add_space(8.0);
    }
    let room = room - (ui.cursor().min.y - top);
    if state.skeleton.page == SidePage::Skeleton {
        skeleton::show_tree(ui, session, &mut state.skeleton, room, commands);
    } else {
        scrolled(id, room).show(ui, |ui| model_panel::show(ui, session, state, commands));
    }
}

/// Phones and slim windows: one bar above, one sheet below.
pub(super) fn narrow(ui: &Ui, session: &Session, state: &mut UiState, window: Rect, commands: &mut Vec<Command>) {
    let left_top = window.min + Vec2::splat(MARGIN);
    Panel::new("title", Align2::LEFT_TOP, left_top)
        .margin(Margin::same(4))
        .show(ui, |ui| {
            ui.set_width(window.width() - 2.0 * MARGIN - 10.0);
            ui.horizontal(|ui| {
                ui.set_height(widgets::control_size(ui));
                ui.add_space(8.0);
                let most = ui.available_width() - toolbar::narrow_width(ui);
                title_bar::show(ui, session, most, false);
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    toolbar::show_narrow(ui, session, state, commands);
                });
            });
        });
    if session.open_model().is_some() || !matches!(state.sheet, None | Some(SheetPage::Model)) {
        sheet(ui, session, state, window, commands);
    }
    show_legend(ui, session, state, window, true);
}

fn show_legend(ui: &Ui, session: &Session, state: &UiState, window: Rect, narrow: bool) {
    if let Some((at, shape)) = free_room::legend_place(ui, session, state, window, narrow) {
        skeleton::show_legend(ui, session, at, shape);
    }
}

/// The timeline, and below it what was opened.
fn sheet(ui: &Ui, session: &Session, state: &mut UiState, window: Rect, commands: &mut Vec<Command>) {
    let margin = Margin {
        left: 14,
        right: 14,
        top: 0,
        bottom: 14,
    };
    Panel::new("sheet", Align2::LEFT_BOTTOM, window.left_bottom())
        .sheet()
        .margin(margin)
        .show(ui, |ui| {
            ui.set_width(window.width() - 30.0);
            if widgets::sheet_handle(ui, state.sheet.is_some()).clicked() {
                state.sheet = match state.sheet {
                    None => Some(SheetPage::Model),
                    Some(_) => None,
                };
            }
            if session.clip().is_some() {
                timeline::narrow(ui, session, state, commands);
            }
            if let Some(page) = state.sheet {
                ui.add_space(10.0);
                let covered =
                    bar_height(ui) + timeline::covered_height(ui, session, &state.timeline, true) + 3.0 * MARGIN;
                let room = (window.height() * PAGE_SHARE).min(window.height() - covered);
                if page == SheetPage::Model && is_side_page(session, state) {
                    side_panel(ui, "sheet", session, state, room, commands);
                } else {
                    scrolled("sheet", room).show(ui, |ui| {
                        sheet_page(ui, page, session, state, room, commands);
                    });
                }
            }
        });
}

/// Whether the sheet has room for the side panel: nothing is inspected.
fn is_side_page(session: &Session, state: &UiState) -> bool {
    let names = state.skeleton.is_naming();
    let inspects = session.subsets().selected().is_some() || skeleton::is_inspected(session);
    !state.diagnostics_open && (!inspects || names)
}

fn sheet_page(
    ui: &mut Ui,
    page: SheetPage,
    session: &Session,
    state: &mut UiState,
    room: f32,
    commands: &mut Vec<Command>,
) {
    match page {
        SheetPage::Model if state.diagnostics_open => diagnostics_panel::show(ui, session, state, room - 50.0),
        SheetPage::Model if session.subsets().selected().is_some() => inspector::show(ui, session, state, commands),
        SheetPage::Model => skeleton::show_inspector(ui, session, &mut state.skeleton, commands),
        SheetPage::ViewMode => {
            widgets::section_name(ui, "View mode");
            view_modes::items(ui, session, commands);
        }
        SheetPage::Light => light::show(ui, session, commands),
        SheetPage::Overlays => overlays::show(ui, session, &mut state.skeleton, commands),
        SheetPage::ViewFrom => {
            widgets::section_name(ui, "View from");
            toolbar::view_from_items(ui, session, commands);
        }
        SheetPage::Picture => picture::show(ui, state),
        SheetPage::Timeline => timeline::page(ui, session, state, room, commands),
    }
}
