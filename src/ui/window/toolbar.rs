//! The bar at the top. On the left: the title and the open file. On the right: view mode, light, overlays, directions, pictures, files,
//! help.

use egui::{
    Color32, Key, Label, Modifiers, Popup, Rangef, Rect, RectAlign, RichText, Role, Sense, TextWrapMode, Ui, Vec2,
    WidgetInfo, vec2,
};

use super::arrangement::Arrangement;
use super::panel::{popover, popover_gap, popover_menu, unscrolled_popover};
use crate::actions::{self, Action, Control};
use crate::anim::SkinView;
use crate::scene::{Theme, ViewMode, ViewPreset};
use crate::session::{CameraCommand, Command, File, FileCommand, LookCommand, OpenModel, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::icons::{self, Icon};
use crate::ui::kit::theme::{self, Tokens};
use crate::ui::kit::wording::{bytes, shortened_front};
use crate::ui::kit::{
    ICON_SIZE, MenuLine, TextButton, action_button, bare_icon_button, chip, chip_size, control_size, hint_beside,
    hint_of_name, icon_button, keyed_menu_item, menu_item, named, pressed_chip, push_action, push_button, section_name,
    tell_node, tell_open, valued_choice, valued_menu_item,
};
use crate::ui::panels::cost::SteadyCost;
use crate::ui::panels::model_panel::summary;
use crate::ui::panels::skeleton::state::{SkeletonState, has_joints};
use crate::ui::panels::{export, light, overlays, picture};
use crate::ui::state::{DrawerPage, Request, UiState};

const LIGHT: Control = Control::new("light");
/// Room between the words of the title.
const TITLE_SPACING: f32 = 10.0;
/// Width of the popover with light, background and passes.
const LIGHT_WIDTH: f32 = 288.0;
/// The light's button has one width for all lights, so that nothing beside it moves.
const LIGHT_BUTTON_WIDTH: f32 = 103.0;
/// Buttons that copy a link to what is seen: label, name, and whether it is an element for other pages.
const COPIES: [(&str, Control, bool); 2] = [
    ("Copy link", Control::new("copy-link"), false),
    ("Copy embed", Control::new("copy-embed"), true),
];
/// Width of the menus of view modes and directions.
const MENU_WIDTH: f32 = 190.0;
/// The least room for the program's name beside that of the file.
const LEAST_WITH_PROGRAM: f32 = 170.0;
const SPACING: f32 = 4.0;
/// The least width that chips leave to the name of the file.
const LEAST_NAME: f32 = 90.0;
/// Width of the menu of files, and how much of a path it shows.
const FILES_WIDTH: f32 = 330.0;
const MOST_OF_PATH: usize = 28;

/// Makes buttons that were shown a toolbar for screen readers.
fn as_toolbar(ui: &Ui) {
    let rect = ui.min_rect();
    ui.ctx().accesskit_node_builder(ui.unique_id(), |node| {
        node.set_role(Role::Toolbar);
        node.set_label("Tools");
        let [x0, y0, x1, y1] = [rect.min.x, rect.min.y, rect.max.x, rect.max.y].map(f64::from);
        node.set_bounds(egui::accesskit::Rect { x0, y0, x1, y1 });
    });
}

/// Buttons in one row.
pub(in crate::ui) fn show(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = SPACING;
        for (action, icon, label) in history(cx.session) {
            let hint = action.hint_of(&label);
            ui.add_enabled_ui(action.ask(cx.session).is_some(), |ui| {
                if named(push_button(ui, icon, &hint), action.control).clicked() {
                    cx.act(action);
                }
            });
        }
        view_mode_menu(ui, cx);
        light_button(ui, &mut cx.part(|state| &mut state.cost));
        overlays_button(ui, &mut cx.part(|state| &mut state.skeleton));
        view_from_menu(ui, cx);
        push_action(ui, cx, &actions::FRAME_MODEL, Icon::Frame);
        action_button(ui, cx, &actions::TURNTABLE, Icon::Turntable);
        let save = &actions::SAVE_PICTURE;
        let hint = format!("Picture… ({} saves one at once)", save.key());
        let camera = named(push_button(ui, Icon::Camera, &hint), Control::new("picture"));
        popover(ui, (&camera, "Picture"), 224.0, |ui| {
            section_name(ui, "Picture");
            picture::show(ui, cx.session, cx.state);
            popover_gap(ui);
            section_name(ui, "Link to this view");
            ui.horizontal(|ui| {
                for (label, control, embed) in COPIES {
                    if named(TextButton::new(label, label).show(ui), control).clicked() {
                        cx.state.requests.push(Request::CopyLink { embed });
                        ui.close();
                    }
                }
            });
        });
        export_button(ui, cx);
        theme_button(ui, cx.state);
        open_button(ui, cx.state);
        let help = icon_button(ui, Icon::Help, &actions::HELP.hint(), cx.state.help_open);
        tell_open(&help, cx.state.help_open);
        let help = named(help, actions::HELP.control);
        if help.clicked() {
            cx.state.help_open = !cx.state.help_open;
        }
        as_toolbar(ui);
    });
}

/// Undo and redo, with what they would do: `Undo: hide head`.
fn history(session: &Session) -> [(&'static Action, Icon, String); 2] {
    let history = session.history();
    let labelled = |action: &'static Action, icon, label: Option<&str>| {
        let label = label.map_or(action.label.to_owned(), |label| format!("{}: {label}", action.label));
        (action, icon, label)
    };
    [
        labelled(&actions::UNDO, Icon::Undo, history.undo_label()),
        labelled(&actions::REDO, Icon::Redo, history.redo_label()),
    ]
}

/// The width of the buttons of a narrow window.
pub(in crate::ui) fn narrow_width(ui: &Ui) -> f32 {
    3.0 * control_size(ui) + 2.0 * SPACING
}

/// In a narrow window. The rarer buttons are in the menu behind the dots, and open pages of the drawer.
pub(in crate::ui) fn show_narrow(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    ui.spacing_mut().item_spacing.x = SPACING;
    let shown = cx.state.drawer == Some(DrawerPage::Light);
    let lighting = lighting(cx.session);
    let button = bare_icon_button(ui, Icon::Sun, &lighting, shown);
    let icon = button.rect.center();
    let button = named(button, LIGHT);
    let button = light::mark_button(ui, cx.session, button, icon, "Light and background");
    tell_open(&button, shown);
    if button.clicked() {
        cx.state.drawer = (!shown).then_some(DrawerPage::Light);
    }
    open_button(ui, cx.state);
    let dots = named(push_button(ui, Icon::Dots, "More"), Control::new("more"));
    let is_low = Arrangement::here(ui) == Arrangement::Low;
    let width = if is_low { 420.0 } else { 230.0 };
    popover_menu(ui, &dots, RectAlign::BOTTOM_END, width, |ui| more_menu(ui, cx));
    as_toolbar(ui);
}

fn view_mode_menu<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let mode = actions::view_mode_label(cx.session);
    let label = format!("View mode: {mode}");
    let button = TextButton::new(mode, &label).list().show(ui);
    let button = named(button, Control::new("view-mode")).on_hover_text(actions::NEXT_VIEW_MODE.hint());
    popover_menu(ui, &button, RectAlign::BOTTOM_START, MENU_WIDTH, |ui| {
        if view_mode_items(ui, cx) {
            ui.close();
        }
    });
}

fn light_button(ui: &mut Ui, cx: &mut Cx<'_, SteadyCost>) {
    let session = cx.session;
    let button = TextButton::new(light::label(session), &lighting(session))
        .icon(Icon::Sun)
        .list()
        .width(Rangef::point(LIGHT_BUTTON_WIDTH))
        .show(ui);
    let button = named(button, LIGHT);
    let other = &actions::OTHER_LIGHT;
    let hint = format!("Light and background ({}: {})", other.key(), other.does);
    let icon = button.rect.left_center() + vec2(ui.spacing().button_padding.x + 0.5 * ICON_SIZE, 0.0);
    let button = light::mark_button(ui, session, button, icon, &hint);
    popover(ui, (&button, "Lighting"), LIGHT_WIDTH, |ui| {
        light::show(ui, cx);
    });
}

fn lighting(session: &Session) -> String {
    let sky = session.sky_file().map(|file| format!(", {}", file.base_name()));
    format!("Lighting: {}{}", light::label(session), sky.unwrap_or_default())
}

fn overlays_button(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>) {
    let on = overlays::any_beside_the_grid(cx.session);
    let button = icon_button(ui, Icon::Layers, "Lines over the model", on);
    let button = named(button, Control::new("overlays"));
    popover(ui, (&button, "Lines over the model"), 236.0, |ui| {
        overlays::show(ui, cx);
    });
}

fn open_button(ui: &mut Ui, state: &mut UiState) {
    let action = &actions::OPEN_FILES;
    if named(push_button(ui, Icon::Open, &action.hint()), action.control).clicked() {
        state.requests.push(Request::PickFiles);
    }
}

fn export_button(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    let action = &actions::EXPORT;
    let button = named(push_button(ui, Icon::Export, &action.hint()), action.control);
    if std::mem::take(&mut cx.state.export.asked) {
        Popup::toggle_id(ui.ctx(), Popup::default_response_id(&button));
    }
    unscrolled_popover(ui, (&button, "Export"), export::WIDTH, |ui, most| {
        let top = ui.cursor().min.y;
        section_name(ui, "Export");
        let most = most - (ui.cursor().min.y - top);
        export::show(ui, most, cx);
    });
}

fn other_theme(ui: &Ui) -> (&'static str, Theme) {
    if ui.visuals().dark_mode {
        ("Light theme", Theme::Light)
    } else {
        ("Dark theme", Theme::Dark)
    }
}

fn theme_button(ui: &mut Ui, state: &mut UiState) {
    let (label, theme) = other_theme(ui);
    if named(push_button(ui, Icon::Contrast, label), Control::new("theme")).clicked() {
        state.theme = Some(theme);
    }
}

fn view_from_menu<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let cube = named(push_button(ui, Icon::Cube, "View from…"), Control::new("view-from"));
    popover_menu(ui, &cube, RectAlign::BOTTOM_END, MENU_WIDTH, |ui| {
        if view_from_items(ui, cx) {
            ui.close();
        }
    });
}

/// A line for each direction, and the projection. Returns whether one was chosen.
pub(in crate::ui) fn view_from_items<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) -> bool {
    let before = cx.commands.len();
    for preset in ViewPreset::ALL {
        let command = CameraCommand::Glide(Box::new(CameraCommand::LookFrom(preset))).into();
        // Resetting the camera gives three quarters.
        let key = match preset {
            ViewPreset::ThreeQuarter => actions::RESET_CAMERA.key(),
            _ => actions::key_of(cx.session, &command),
        };
        if keyed_menu_item(ui, preset.label(), key, MenuLine::Action).clicked() {
            cx.push(command);
        }
    }
    let projection = &actions::ORTHOGRAPHIC;
    let on = MenuLine::Switch(projection.is_on(cx.session));
    if keyed_menu_item(ui, projection.label, projection.key(), on).clicked() {
        cx.act(projection);
    }
    cx.commands.len() > before
}

/// In one column, or in two in a window too low for one.
fn more_menu(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    if Arrangement::here(ui) == Arrangement::Low {
        ui.columns_const(|[left, right]| {
            page_items(left, cx.session, cx.state);
            action_items(right, cx);
        });
    } else {
        page_items(ui, cx.session, cx.state);
        action_items(ui, cx);
    }
}

fn page_items(ui: &mut Ui, session: &Session, state: &mut UiState) {
    let pages = [
        ("View mode", actions::view_mode_label(session), DrawerPage::ViewMode),
        ("Light and background", light::label(session), DrawerPage::Light),
        ("Lines over the model", "", DrawerPage::Overlays),
        ("View from…", "", DrawerPage::ViewFrom),
        ("Picture…", "", DrawerPage::Picture),
        ("Export…", "", DrawerPage::Export),
    ];
    for (label, in_force, page) in pages {
        if valued_menu_item(ui, label, in_force, state.drawer == Some(page)).clicked() {
            state.drawer = Some(page);
            ui.close();
        }
    }
}

fn action_items(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    for (action, _, label) in history(cx.session) {
        if let Some(command) = action.command(cx.session)
            && menu_item(ui, &label, MenuLine::Action).clicked()
        {
            cx.push(command);
            ui.close();
        }
    }
    for (label, control, embed) in COPIES {
        if named(menu_item(ui, label, MenuLine::Action), control).clicked() {
            cx.state.requests.push(Request::CopyLink { embed });
            ui.close();
        }
    }
    let turns = MenuLine::Switch(actions::TURNTABLE.is_on(cx.session));
    for (action, line) in [(&actions::FRAME_MODEL, MenuLine::Action), (&actions::TURNTABLE, turns)] {
        if menu_item(ui, action.label, line).clicked() {
            cx.act(action);
            ui.close();
        }
    }
    let (label, theme) = other_theme(ui);
    if menu_item(ui, label, MenuLine::Action).clicked() {
        cx.state.theme = Some(theme);
        ui.close();
    }
    if menu_item(ui, actions::HELP.label, MenuLine::Action).clicked() {
        cx.state.help_open = true;
        ui.close();
    }
}

/// A line for each mode, then one for each view of the skin. Returns whether one was chosen.
pub(in crate::ui) fn view_mode_items<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) -> bool {
    let (in_force, skin_view) = (cx.session.look().view_mode, cx.session.look().skin_view);
    let mut chosen = false;
    for mode in ViewMode::ALL {
        // The key chooses the next mode. From a view of the skin it goes back to the mode.
        let key = if mode == in_force.cycled(i32::from(skin_view.is_none())) {
            actions::NEXT_VIEW_MODE.key()
        } else {
            ""
        };
        let on = mode == in_force && skin_view.is_none();
        if keyed_menu_item(ui, mode.label(), key, MenuLine::Choice(on)).clicked() {
            cx.push(LookCommand::SetViewMode(mode));
            cx.push(LookCommand::SetSkinView(None));
            chosen = true;
        }
    }
    if has_joints(cx.session) {
        ui.add_space(6.0);
        section_name(ui, "Skin");
        for view in SkinView::ALL {
            let on = skin_view == Some(view);
            let command = LookCommand::SetSkinView((!on).then_some(view)).into();
            let key = actions::key_of(cx.session, &command);
            if keyed_menu_item(ui, view.label(), key, MenuLine::Choice(on)).clicked() {
                cx.push(command);
                chosen = true;
            }
        }
    }
    chosen
}

/// Title, file, and with a state also dialect and findings; no wider than what is available. A file name that is too long ends in an
/// ellipsis.
pub(in crate::ui) fn title(ui: &mut Ui, session: &Session, state: Option<&mut UiState>, commands: &mut Vec<Command>) {
    let tokens = Tokens::of(ui);
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = TITLE_SPACING;
        // A narrow bar has no room for this and for a menu of files.
        let has_room = match state {
            Some(_) => session.open_model().is_none() || ui.available_width() >= LEAST_WITH_PROGRAM,
            None => session.models().len() < 2,
        };
        if has_room {
            ui.label(RichText::new("Bindpose").font(theme::semibold(13.5)).color(tokens.text));
        }
        let Some(open) = session.open_model() else { return };
        let mut room = ui.available_width();
        // The findings matter more than the dialect, and the name more than both.
        let mut fits = |ui: &Ui, text: &str| {
            let width = TITLE_SPACING + chip_size(ui, text).x;
            let fits = room - width >= LEAST_NAME;
            room -= if fits { width } else { 0.0 };
            fits
        };
        let is_wide = state.is_some();
        let (count, color) = summary(session, &tokens);
        let findings = state.filter(|_| session.diagnostics().next().is_some() && fits(ui, &count));
        let dialect = open.format.label();
        let with_dialect = is_wide && fits(ui, dialect);
        ui.scope(|ui| {
            ui.set_max_width(room.max(0.0));
            file_name(ui, session, open, room.max(0.0), commands);
        });
        if with_dialect {
            chip(ui, dialect, tokens.muted);
        }
        if let Some(state) = findings
            && findings_chip(ui, state.diagnostics_open, &count, color)
        {
            state.diagnostics_open = !state.diagnostics_open;
        }
    });
}

/// The name of the open file. If there are other models to open, it opens a menu of them.
fn file_name(ui: &mut Ui, session: &Session, open: &OpenModel, most: f32, commands: &mut Vec<Command>) {
    let (name, path) = (open.file.base_name(), open.file.path.as_str());
    let models = session.models();
    let place = models.iter().position(|file| file.path == path);
    let Some(place) = place.filter(|_| models.len() > 1) else {
        let words = RichText::new(name).color(Tokens::of(ui).muted);
        let words = Label::new(words).truncate().show_tooltip_when_elided(false);
        hint_of_name(ui.add(words), path);
        return;
    };
    let text = format!("{name} · {} of {}", place + 1, models.len());
    let button = TextButton::new(&text, &format!("Open model: {text}"))
        .list()
        .width(Rangef::new(0.0, most))
        .show(ui)
        .on_hover_text(path);
    let button = named(button, Control::new("models"));
    popover_menu(ui, &button, RectAlign::BOTTOM_START, FILES_WIDTH, |ui| {
        for (index, file) in models.into_iter().enumerate() {
            file_line(ui, (index, file), file.path == path, commands);
        }
    });
}

/// A line of the menu of files: path, size, and a cross. Delete does what the cross does.
fn file_line(ui: &mut Ui, (index, file): (usize, &File), is_open: bool, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let room = ui.available_width() - control_size(ui);
        let path = shortened_front(&file.path, MOST_OF_PATH);
        let size = bytes(file.bytes.len() as u64);
        let line = ui.scope(|ui| {
            ui.set_max_width(room);
            ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
            valued_choice(ui, &path, &size, is_open)
        });
        let line = named(line.inner, Control::new("model").at(index));
        let line = hint_beside(line, None, &file.path);
        let note = format!("{size}, Delete closes it");
        tell_node(&line, |node| node.set_description(note));
        // It takes no focus, so that arrows go from line to line.
        let (rect, cross) = ui.allocate_exact_size(Vec2::splat(control_size(ui)), Sense::CLICK);
        let icon = Rect::from_center_size(rect.center(), Vec2::splat(ICON_SIZE));
        let tokens = Tokens::of(ui);
        let color = if cross.hovered() { tokens.text } else { tokens.faint };
        icons::paint(ui.painter(), icon, Icon::Close, color);
        cross.widget_info(|| WidgetInfo::labeled(Role::MenuItem, true, format!("Close {}", file.base_name())));
        let cross = cross.on_hover_text("Close (Delete)");
        let arrow = |input: &egui::InputState| input.key_pressed(Key::ArrowDown) || input.key_pressed(Key::ArrowUp);
        if is_open && ui.input(arrow) && ui.memory(|memory| memory.focused().is_none()) {
            // The menu was opened with the pointer. The arrow goes on from here.
            line.request_focus();
        }
        if line.clicked() && !is_open {
            commands.push(FileCommand::Open(file.path.clone()).into());
        }
        let deletes = line.has_focus() && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Delete));
        if cross.clicked() || deletes {
            commands.push(FileCommand::Close(file.path.clone()).into());
        }
        if line.clicked() || cross.clicked() {
            ui.close();
        }
    });
}

/// How many findings there are. Returns whether the person wants to see or to hide them.
pub(in crate::ui) fn findings_chip(ui: &mut Ui, is_open: bool, count: &str, color: Color32) -> bool {
    let response = pressed_chip(ui, count, color, is_open);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Show {count}")));
    tell_open(&response, is_open);
    let response = named(response, actions::FINDINGS.control);
    let hint = actions::FINDINGS.hint_of("What was found in the file");
    response.on_hover_text(hint).clicked()
}
