//! Top right: where to look from, what to show, opening files, help.

use egui::{Popup, Ui};

use super::icons::Icon;
use super::widgets::{icon_button, menu_item};
use super::{Request, UiState};
use crate::scene::{Overlay, Projection, Theme, ViewPreset};
use crate::session::{Command, LookCommand, Session};

/// Buttons in one row.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        open_button(ui, state);
        view_menu(ui, session, commands);
        if icon_button(ui, Icon::Frame, "Frame the model (F)", false).clicked() {
            commands.push(Command::FrameModel);
        }
        if icon_button(ui, Icon::Grid, "Ground grid (G)", session.grid_visible()).clicked() {
            commands.push(Command::Look(LookCommand::ToggleOverlay(Overlay::Grid)));
        }
        theme_button(ui, state);
        if icon_button(ui, Icon::Help, "Keys (?)", state.help_open).clicked() {
            state.help_open = !state.help_open;
        }
    });
}

/// In a narrow window, from the right edge: the rarer buttons wait behind dots.
pub(super) fn show_narrow(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.x = 4.0;
    let dots = icon_button(ui, Icon::Dots, "More", false);
    Popup::menu(&dots).show(|ui| more_menu(ui, session, state, commands));
    open_button(ui, state);
}

fn open_button(ui: &mut Ui, state: &mut UiState) {
    if icon_button(ui, Icon::Open, "Open files…", false).clicked() {
        state.requests.push(Request::PickFiles);
    }
}

fn theme_button(ui: &mut Ui, state: &mut UiState) {
    let (icon, label, other) = match ui.visuals().dark_mode {
        true => (Icon::Sun, "Light surroundings", Theme::Light),
        false => (Icon::Moon, "Dark surroundings", Theme::Dark),
    };
    if icon_button(ui, icon, label, false).clicked() {
        state.requests.push(Request::UseTheme(other));
    }
}

fn view_menu(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let cube = icon_button(ui, Icon::Cube, "View from…", false);
    Popup::menu(&cube).show(|ui| {
        ui.set_width(190.0);
        view_items(ui, session, commands);
    });
}

fn view_items(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    for preset in ViewPreset::ALL {
        if menu_item(ui, preset.label(), false).clicked() {
            commands.push(Command::LookFrom(preset));
            ui.close();
        }
    }
    let orthographic = session.camera().projection == Projection::Orthographic;
    if menu_item(ui, "Orthographic", orthographic).clicked() {
        commands.push(Command::ToggleProjection);
        ui.close();
    }
}

fn more_menu(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    ui.set_width(200.0);
    if menu_item(ui, "Frame the model", false).clicked() {
        commands.push(Command::FrameModel);
        ui.close();
    }
    if menu_item(ui, "Ground grid", session.grid_visible()).clicked() {
        commands.push(Command::Look(LookCommand::ToggleOverlay(Overlay::Grid)));
        ui.close();
    }
    let (label, other) = if ui.visuals().dark_mode {
        ("Light surroundings", Theme::Light)
    } else {
        ("Dark surroundings", Theme::Dark)
    };
    if menu_item(ui, label, false).clicked() {
        state.requests.push(Request::UseTheme(other));
        ui.close();
    }
    if menu_item(ui, "Keys", false).clicked() {
        state.help_open = true;
        ui.close();
    }
    view_items(ui, session, commands);
}
