//! The bar at the top. On the left: the title and the open file. On the right: view mode, light, overlays, directions, pictures, files,
//! help.

use egui::{Label, Rangef, RectAlign, RichText, Ui};

use super::icons::Icon;
use super::panel::{popover, popover_menu};
use super::skeleton::state::{SkeletonState, has_joints};
use super::state::{Request, SheetPage, UiState};
use super::theme::{self, LOW_HEIGHT, LOW_WIDTH, Tokens};
use super::widgets::{
    TextButton, action_button, chip, chip_size, icon_button, keyed_menu_item, menu_item, push_button, section_name,
    valued_menu_item,
};
use super::wording::dialect_name;
use super::{light, overlays, picture};
use crate::actions;
use crate::anim::SkinView;
use crate::scene::{Theme, ViewMode, ViewPreset};
use crate::session::{CameraCommand, Command, LookCommand, Session};

/// Room between the words of the title.
const TITLE_SPACING: f32 = 10.0;
/// Width of the popover with light, background and passes.
const LIGHT_WIDTH: f32 = 288.0;
/// The light's button has one width for all lights, so that nothing beside it moves.
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
        let camera = push_button(ui, Icon::Camera, &actions::SAVE_PICTURE.hint_of("Picture…"));
        popover(ui, &camera, 224.0, |ui| picture::show(ui, state));
        theme_button(ui, state);
        open_button(ui, state);
        if icon_button(ui, Icon::Help, &actions::HELP.hint(), state.help_open).clicked() {
            state.help_open = !state.help_open;
        }
    });
}

/// In a narrow window, from the right edge. The rarer buttons are in the menu behind the dots, and open pages of the sheet.
pub(super) fn show_narrow(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.x = SPACING;
    let dots = push_button(ui, Icon::Dots, "More");
    let width = if is_low(ui) { 420.0 } else { 230.0 };
    popover_menu(ui, &dots, RectAlign::BOTTOM_END, width, |ui| {
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

fn view_mode_menu(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let mode = actions::view_mode_label(session);
    let label = format!("View mode: {mode}");
    let button = TextButton::new(mode, &label).list().show(ui);
    let button = button.on_hover_text(actions::NEXT_VIEW_MODE.hint());
    popover_menu(ui, &button, RectAlign::BOTTOM_START, MENU_WIDTH, |ui| {
        if view_mode_items(ui, session, commands) {
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
    popover(ui, &button, LIGHT_WIDTH, |ui| light::show(ui, session, commands));
}

fn lighting(session: &Session) -> String {
    format!("Lighting: {}", light::label(session))
}

fn overlays_button(ui: &mut Ui, session: &Session, state: &mut SkeletonState, commands: &mut Vec<Command>) {
    let on = overlays::any_beside_the_grid(session);
    let button = icon_button(ui, Icon::Layers, "Lines over the model", on);
    popover(ui, &button, 236.0, |ui| overlays::show(ui, session, state, commands));
}

fn open_button(ui: &mut Ui, state: &mut UiState) {
    if push_button(ui, Icon::Open, "Open files…").clicked() {
        state.requests.push(Request::PickFiles);
    }
}

/// The name of the other theme, and its request.
fn other_theme(ui: &Ui) -> (&'static str, Request) {
    if ui.visuals().dark_mode {
        ("Light theme", Request::UseTheme(Theme::Light))
    } else {
        ("Dark theme", Request::UseTheme(Theme::Dark))
    }
}

fn theme_button(ui: &mut Ui, state: &mut UiState) {
    let (label, request) = other_theme(ui);
    if push_button(ui, Icon::Contrast, label).clicked() {
        state.requests.push(request);
    }
}

fn view_from_menu(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let cube = push_button(ui, Icon::Cube, "View from…");
    popover_menu(ui, &cube, RectAlign::BOTTOM_END, MENU_WIDTH, |ui| {
        if view_from_items(ui, session, commands) {
            ui.close();
        }
    });
}

/// A line for each direction, and the projection. Returns whether one was chosen.
pub(super) fn view_from_items(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) -> bool {
    let before = commands.len();
    for preset in ViewPreset::ALL {
        let command = CameraCommand::Glide(Box::new(CameraCommand::LookFrom(preset))).into();
        // Resetting the camera gives three quarters.
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

/// In one column, or in two in a window too low for one.
fn more_menu(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    if is_low(ui) {
        ui.columns_const(|[left, right]| {
            page_items(left, session, state);
            action_items(right, session, state, commands);
        });
    } else {
        page_items(ui, session, state);
        action_items(ui, session, state, commands);
    }
}

/// Whether the window is too low for all lines of the menu below each other.
fn is_low(ui: &Ui) -> bool {
    let window = ui.ctx().content_rect();
    window.height() < LOW_HEIGHT && window.width() >= LOW_WIDTH
}

fn page_items(ui: &mut Ui, session: &Session, state: &mut UiState) {
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
}

fn action_items(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
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

/// A line for each mode, then one for each view of the skin. Returns whether one was chosen.
pub(super) fn view_mode_items(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) -> bool {
    let (in_force, skin_view) = (session.look().view_mode, session.look().skin_view);
    let mut chosen = false;
    for mode in ViewMode::ALL {
        // The key chooses the next mode.
        let key = if mode == in_force.cycled(1) {
            actions::NEXT_VIEW_MODE.key()
        } else {
            ""
        };
        let on = mode == in_force && skin_view.is_none();
        if keyed_menu_item(ui, mode.label(), key, on).clicked() {
            commands.push(LookCommand::SetViewMode(mode).into());
            commands.push(LookCommand::SetSkinView(None).into());
            chosen = true;
        }
    }
    if has_joints(session) {
        ui.add_space(6.0);
        section_name(ui, "Skin");
        for view in SkinView::ALL {
            let on = skin_view == Some(view);
            let command = LookCommand::SetSkinView((!on).then_some(view)).into();
            if keyed_menu_item(ui, view.label(), actions::key_of(session, &command), on).clicked() {
                commands.push(command);
                chosen = true;
            }
        }
    }
    chosen
}

/// Title, file, dialect, no wider than what is available. A file name that is too long ends in an ellipsis.
pub(super) fn title(ui: &mut Ui, session: &Session, with_dialect: bool) {
    let tokens = Tokens::of(ui);
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = TITLE_SPACING;
        ui.label(RichText::new("Bindpose").font(theme::semibold(13.5)).color(tokens.text));
        let Some(open) = session.open_model() else { return };
        let dialect = dialect_name(open.dialect);
        let dialect_width = if with_dialect {
            TITLE_SPACING + chip_size(ui, dialect).x
        } else {
            0.0
        };
        let most = (ui.available_width() - dialect_width).max(0.0);
        ui.scope(|ui| {
            ui.set_max_width(most);
            let name = RichText::new(open.file.base_name()).color(tokens.muted);
            let name = Label::new(name).truncate().show_tooltip_when_elided(false);
            ui.add(name).on_hover_text(&open.file.path);
        });
        if with_dialect {
            chip(ui, dialect, tokens.muted);
        }
    });
}
