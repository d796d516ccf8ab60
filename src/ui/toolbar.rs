//! Top right: what of the model is shown and in which light, from where, pictures, opening files, help.

use egui::{Rangef, RectAlign, Ui};

use super::icons::Icon;
use super::skeleton::SkeletonState;
use super::state::{Request, SheetPage, UiState};
use super::widgets::{
    TextButton, action_button, control_size, icon_button, keyed_menu_item, menu_item, valued_menu_item,
};
use super::{light, overlays, picture, popover, view_modes};
use crate::actions;
use crate::scene::{Theme, ViewPreset};
use crate::session::{Command, Session};

/// Width of the popover with light, background and passes.
const LIGHT_WIDTH: f32 = 288.0;
/// The light's button is as wide for either light, so that nothing beside it moves.
const LIGHT_BUTTON_WIDTH: f32 = 103.0;
/// Width of the menus of view modes and directions.
const MENU_WIDTH: f32 = 190.0;
/// Room between buttons.
const SPACING: f32 = 4.0;

/// Buttons in one row.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = SPACING;
        view_mode_menu(ui, session, commands);
        light_button(ui, session, commands);
        overlays_button(ui, session, &mut state.skeleton, commands);
        view_from_menu(ui, session, commands);
        action_button(ui, session, &actions::FRAME_MODEL, Icon::Frame, commands);
        action_button(ui, session, &actions::TURNTABLE, Icon::Turntable, commands);
        let camera = icon_button(ui, Icon::Camera, &actions::SAVE_PICTURE.hint_of("Picture…"), false);
        popover::show(ui, &camera, 224.0, |ui| picture::show(ui, state));
        theme_button(ui, state);
        open_button(ui, state);
        if icon_button(ui, Icon::Help, &actions::HELP.hint(), state.help_open).clicked() {
            state.help_open = !state.help_open;
        }
    });
}

/// In a narrow window, from the right edge: the rarer buttons wait behind dots, and what they open is in the sheet.
pub(super) fn show_narrow(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.x = SPACING;
    let dots = icon_button(ui, Icon::Dots, "More", false);
    popover::menu(ui, &dots, RectAlign::BOTTOM_END, 230.0, |ui| {
        more_menu(ui, session, state, commands);
    });
    open_button(ui, state);
    let shown = state.sheet == Some(SheetPage::Light);
    let button = icon_button(ui, Icon::Sun, &lighting(session), shown);
    light::mark_button(ui, session, &button);
    if button.clicked() {
        state.sheet = (!shown).then_some(SheetPage::Light);
    }
}

/// Width of the buttons of a narrow window.
pub(super) fn narrow_width(ui: &Ui) -> f32 {
    3.0 * (control_size(ui) + SPACING)
}

fn view_mode_menu(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let mode = actions::view_mode_label(session);
    let label = format!("View mode: {mode}");
    let button = TextButton::new(mode, &label).list().show(ui);
    let button = button.on_hover_text(actions::NEXT_VIEW_MODE.hint());
    popover::menu(ui, &button, RectAlign::BOTTOM_START, MENU_WIDTH, |ui| {
        if view_modes::items(ui, session, commands) {
            ui.close();
        }
    });
}

fn light_button(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let button = TextButton::new(light::label(session), &lighting(session))
        .icon(Icon::Sun)
        .list()
        .width(Rangef::point(LIGHT_BUTTON_WIDTH))
        .show(ui);
    light::mark_button(ui, session, &button);
    let other = &actions::OTHER_LIGHT;
    let hint = format!("Light and background ({}: {})", other.key(), other.does);
    let button = button.on_hover_text(hint);
    popover::show(ui, &button, LIGHT_WIDTH, |ui| light::show(ui, session, commands));
}

fn lighting(session: &Session) -> String {
    format!("Lighting: {}", light::label(session))
}

fn overlays_button(ui: &mut Ui, session: &Session, state: &mut SkeletonState, commands: &mut Vec<Command>) {
    let on = overlays::any_beside_the_grid(session);
    let button = icon_button(ui, Icon::Layers, "Lines over the model", on);
    popover::show(ui, &button, 236.0, |ui| overlays::show(ui, session, state, commands));
}

fn open_button(ui: &mut Ui, state: &mut UiState) {
    if icon_button(ui, Icon::Open, "Open files…", false).clicked() {
        state.requests.push(Request::PickFiles);
    }
}

/// The name of the other surroundings, and what asks for them.
fn other_theme(ui: &Ui) -> (&'static str, Request) {
    if ui.visuals().dark_mode {
        ("Light surroundings", Request::UseTheme(Theme::Light))
    } else {
        ("Dark surroundings", Request::UseTheme(Theme::Dark))
    }
}

fn theme_button(ui: &mut Ui, state: &mut UiState) {
    let (label, request) = other_theme(ui);
    if icon_button(ui, Icon::Contrast, label, false).clicked() {
        state.requests.push(request);
    }
}

fn view_from_menu(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let cube = icon_button(ui, Icon::Cube, "View from…", false);
    popover::menu(ui, &cube, RectAlign::BOTTOM_END, MENU_WIDTH, |ui| {
        if view_from_items(ui, session, commands) {
            ui.close();
        }
    });
}

/// A line for each direction, and the projection. Whether one was chosen.
pub(super) fn view_from_items(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) -> bool {
    let before = commands.len();
    for preset in ViewPreset::ALL {
        let command = Command::Glide(Box::new(Command::LookFrom(preset)));
        // A model opens with the camera at three quarters.
        let key = match preset {
            ViewPreset::ThreeQuarter => actions::RESET_CAMERA.key(),
            _ => actions::key_of(session, &command),
        };
        if keyed_menu_item(ui, preset.label(), key, false).clicked() {
            commands.push(command);
        }
    }
    let projection = &actions::ORTHOGRAPHIC;
    if keyed_menu_item(ui, projection.label, projection.key(), projection.is_on(session)).clicked() {
        commands.extend(projection.command(session));
    }
    commands.len() > before
}

fn more_menu(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    let pages = [
        ("View mode", actions::view_mode_label(session), SheetPage::ViewMode),
        ("Light and background", light::label(session), SheetPage::Light),
        ("Lines over the model", "", SheetPage::Overlays),
        ("View from…", "", SheetPage::ViewFrom),
        ("Picture…", "", SheetPage::Picture),
    ];
    for (label, in_force, page) in pages {
        if valued_menu_item(ui, label, in_force, state.sheet == Some(page)).clicked() {
            state.sheet = Some(page);
            ui.close();
        }
    }
    for action in [&actions::FRAME_MODEL, &actions::TURNTABLE] {
        if menu_item(ui, action.label, action.is_on(session)).clicked() {
            commands.extend(action.command(session));
            ui.close();
        }
    }
    let (label, request) = other_theme(ui);
    if menu_item(ui, label, false).clicked() {
        state.requests.push(request);
        ui.close();
    }
    if menu_item(ui, actions::HELP.label, false).clicked() {
        state.help_open = true;
        ui.close();
    }
}
