//! Where the panels are: around the view in a wide window, a bar and a sheet in a narrow one. Where a window is low, as on a phone
//! on its side, what was opened stands beside the model instead of below it.

use egui::{Align2, Margin, Rect, Ui, Vec2, pos2, vec2};

use super::free_room::{self, SHEET_MARGIN, page_width, shut_sheet_height};
use super::panel::{Arrangement, INSPECTOR_WIDTH, PANEL_AROUND, Panel, SIDE_WIDTH, bar_height, scrolled};
use super::skeleton::state::{SidePage, has_joints, is_inspected};
use super::state::{SheetPage, UiState};
use super::theme::MARGIN;
use super::{
    diagnostics_panel, inspector, light, model_panel, overlays, picture, skeleton, timeline, toolbar, widgets,
};
use crate::session::{Command, Session};

/// Fraction of a narrow window's height that a page of the sheet has at most: the model keeps the rest.
const PAGE_FRACTION: f32 = 0.47;
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
            let most = toolbar.min.x - MARGIN - left_top.x - PANEL_AROUND;
            toolbar::title(ui, session, most, true);
        });
    let covered = timeline::covered_height(ui, session, &state.timeline);
    let side_top = left_top + vec2(0.0, MARGIN + bar_height(ui));
    let side_room = window.max.y - covered.max(MARGIN) - side_top.y - PANEL_AROUND;
    let panel_room = side_room - free_room::covered_by_card(ui, session, state, window);
    if session.open_model().is_some() {
        Panel::new("model", Align2::LEFT_TOP, side_top).show(ui, |ui| {
            ui.set_width(SIDE_WIDTH - PANEL_AROUND);
            side_panel(ui, "model", session, state, panel_room, commands);
        });
    }
    show_legend(ui, session, state, window, Arrangement::Wide);
    let inspects_joint = is_inspected(session);
    let inspects = session.subsets().selected().is_some() || inspects_joint;
    if state.diagnostics_open {
        let at = side_top + vec2(SIDE_WIDTH + MARGIN, 0.0);
        let right = window.max.x - if inspects { MARGIN + INSPECTOR_WIDTH } else { 0.0 };
        Panel::new("diagnostics", Align2::LEFT_TOP, at).show(ui, |ui| {
            ui.set_width(430.0_f32.min(right - MARGIN - at.x - PANEL_AROUND));
            diagnostics_panel::show(ui, session, state, side_room - 50.0, commands);
        });
    }
    if inspects {
        let at = pos2(window.max.x - MARGIN, side_top.y);
        Panel::new("inspector", Align2::RIGHT_TOP, at).show(ui, |ui| {
            ui.set_width(INSPECTOR_WIDTH - PANEL_AROUND);
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
    if has_joints(session) {
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

/// Phones, slim and low windows: one bar above, one sheet below; in a low window what is opened stands between them.
pub(super) fn narrow(
    ui: &Ui,
    session: &Session,
    state: &mut UiState,
    window: Rect,
    arrangement: Arrangement,
    commands: &mut Vec<Command>,
) {
    let low = arrangement == Arrangement::Low;
    let left_top = window.min + Vec2::splat(MARGIN);
    Panel::new("title", Align2::LEFT_TOP, left_top)
        .margin(Margin::same(4))
        .show(ui, |ui| {
            ui.set_width(window.width() - 2.0 * MARGIN - 10.0);
            ui.horizontal(|ui| {
                ui.set_height(widgets::control_size(ui));
                ui.add_space(8.0);
                let most = ui.available_width() - toolbar::narrow_width(ui);
                toolbar::title(ui, session, most, false);
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    toolbar::show_narrow(ui, session, state, commands);
                });
            });
        });
    if session.open_model().is_some() || !matches!(state.sheet, None | Some(SheetPage::Model)) {
        let sheet = sheet(ui, session, state, window, arrangement, commands);
        if let Some(page) = state.sheet.filter(|_| low) {
            page_beside(ui, page, session, state, window, sheet.min.y, commands);
        }
    }
    show_legend(ui, session, state, window, arrangement);
}

fn show_legend(ui: &Ui, session: &Session, state: &UiState, window: Rect, arrangement: Arrangement) {
    if let Some((at, shape)) = free_room::legend_place(ui, session, state, window, arrangement) {
        skeleton::show_legend(ui, session, at, shape);
    }
}

/// The timeline, and below it what was opened, unless it stands beside the model. Where it came to be.
fn sheet(
    ui: &Ui,
    session: &Session,
    state: &mut UiState,
    window: Rect,
    arrangement: Arrangement,
    commands: &mut Vec<Command>,
) -> Rect {
    let low = arrangement == Arrangement::Low;
    let margin = Margin {
        left: SHEET_MARGIN,
        right: SHEET_MARGIN,
        top: 0,
        bottom: SHEET_MARGIN,
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
                timeline::narrow(ui, session, state, low, commands);
            }
            if let Some(page) = state.sheet.filter(|_| !low) {
                ui.add_space(10.0);
                let shut = shut_sheet_height(ui, session, arrangement);
                let covered = bar_height(ui) + shut + 3.0 * MARGIN;
                let room = (window.height() * PAGE_FRACTION).min(window.height() - covered);
                show_page(ui, page, session, state, room, commands);
            }
        })
}

/// What was opened, beside the model: from the bar to the timeline's upper edge.
fn page_beside(
    ui: &Ui,
    page: SheetPage,
    session: &Session,
    state: &mut UiState,
    window: Rect,
    bottom: f32,
    commands: &mut Vec<Command>,
) {
    let at = window.right_top() + vec2(-MARGIN, 2.0 * MARGIN + bar_height(ui));
    Panel::new("page", Align2::RIGHT_TOP, at).show(ui, |ui| {
        ui.set_width(page_width(page, window) - PANEL_AROUND);
        show_page(
            ui,
            page,
            session,
            state,
            bottom - MARGIN - at.y - PANEL_AROUND,
            commands,
        );
    });
}

/// A page of the sheet, which scrolls when it is higher than its room.
fn show_page(
    ui: &mut Ui,
    page: SheetPage,
    session: &Session,
    state: &mut UiState,
    room: f32,
    commands: &mut Vec<Command>,
) {
    if page == SheetPage::Model && is_side_page(session, state) {
        side_panel(ui, "sheet", session, state, room, commands);
    } else {
        scrolled("sheet", room).show(ui, |ui| {
            sheet_page(ui, page, session, state, room, commands);
        });
    }
}

/// Whether the sheet has room for the side panel: nothing is inspected.
fn is_side_page(session: &Session, state: &UiState) -> bool {
    let names = state.skeleton.is_naming();
    let inspects = session.subsets().selected().is_some() || is_inspected(session);
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
        SheetPage::Model if state.diagnostics_open => {
            diagnostics_panel::show(ui, session, state, room - 50.0, commands);
        }
        SheetPage::Model if session.subsets().selected().is_some() => inspector::show(ui, session, state, commands),
        SheetPage::Model => skeleton::show_inspector(ui, session, &mut state.skeleton, commands),
        SheetPage::ViewMode => {
            widgets::section_name(ui, "View mode");
            toolbar::view_mode_items(ui, session, commands);
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
