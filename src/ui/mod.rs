//! The interface. It reads a [`Session`] and answers with [`Command`]s; what is open and shut is its own [`UiState`].

mod diagnostics_panel;
mod error_card;
mod free_room;
mod help;
mod icons;
mod input;
mod inspector;
mod keys;
mod layout;
mod light;
mod model_panel;
mod overlays;
mod panel;
mod picture;
mod skeleton;
mod split;
mod state;
mod textures;
pub mod theme;
mod thumbnails;
mod timeline;
mod toolbar;
mod viewport;
mod widgets;
mod wording;

use egui::{Align2, Popup, Rect, Ui, Vec2, pos2, vec2};

pub use keys::{escape_shuts, owns_key};
pub use picture::picture_name;
pub use state::{MAX_PICTURE_SIDE, Request, SheetPage, UiState};

use crate::scene::Theme;
use crate::session::{CameraCommand, Command, LoadError, Session, SubsetCommand};
use input::{InputOrder, MOST_PASSES};
use panel::{Arrangement, PANEL_AROUND, Panel, bar_height};
use state::Framed;
use theme::MARGIN;

/// Width of the card that tells why a file was not opened, where there is room for it.
const ERROR_WIDTH: f32 = 562.0;

/// Gives a context what the interface needs: fonts, styles, and input in an order that it can act on.
pub fn install(ctx: &egui::Context) {
    theme::install(ctx);
    ctx.options_mut(|options| options.max_passes = MOST_PASSES);
    ctx.add_plugin(InputOrder::default());
}

/// One pass over the whole window. Returns what the person asked for, in order.
///
/// The session is changed by the commands alone: what it is borrowed for is to pose the model of which numbers are read.
pub fn show(ui: &mut Ui, session: &mut Session, state: &mut UiState) -> Vec<Command> {
    let mut commands = Vec::new();
    let window = ui.max_rect();
    let arrangement = Arrangement::of(window);
    let touch = state.coarse_pointer || ui.input(egui::InputState::has_touch_screen);
    widgets::size_for_touch(ui.ctx(), touch);
    if state.shown_model != session.model_revision() {
        state.shown_model = session.model_revision();
        state.shown_finding = None;
        state.diagnostics_open = false;
        state.missing_maps_open = false;
    }

    state.skeleton.read(ui, session, window);
    let session = &*session;
    commands.push(set_theme(ui));
    commands.extend(set_viewport(ui, session, state, window, arrangement));
    if std::mem::take(&mut state.frames_selection) {
        commands.push(CameraCommand::Glide(Box::new(CameraCommand::FrameSelection)).into());
    }
    // A click beside what hangs from a button shuts it and nothing else, and so does Esc.
    let popover_open = Popup::is_any_open(ui.ctx());
    let typed = state.keyboard.was_typing(ui.ctx());
    viewport::show(ui, window, &mut state.view_hold, popover_open, &mut commands);
    skeleton::show_marks(ui, session, &state.skeleton, window);
    split::show(ui, session, window, &mut commands);
    state.hovered_subset = None;
    state.timeline.update(session);

    match arrangement {
        Arrangement::Wide => layout::wide(ui, session, state, window, &mut commands),
        Arrangement::Narrow | Arrangement::Low => {
            layout::narrow(ui, session, state, window, arrangement, &mut commands);
        }
    }
    if session.subsets().hovered() != state.hovered_subset {
        commands.push(SubsetCommand::Hover(state.hovered_subset).into());
    }
    state.skeleton.hover(session, state.timeline.hovered(), &mut commands);
    if state.help_open {
        show_help(ui, session, state, arrangement, touch);
    }
    if let Some(error) = session.error() {
        show_error(ui, session, error, arrangement, &mut commands);
    }
    state.skeleton.settle_naming(ui, &mut commands);
    // Last, since a control that has the keyboard takes its keys first. Keys that were typed into a field are no shortcuts, whether
    // the field had the keyboard when the pass began or has it now.
    let typing = state.keyboard.is_typing(ui.ctx()) || state.skeleton.awaits_field();
    let escape_shuts = popover_open || (!typed && !typing && keys::escape_shuts_panel(session, state));
    if !typed && !typing {
        keys::read(ui, session, state, popover_open, &mut commands);
    }
    let escape_shut = escape_shuts && ui.input(|input| input.key_pressed(egui::Key::Escape));
    state.keyboard.give_back(ui.ctx(), popover_open, escape_shut);
    commands
}

/// The table of keys, off the panel on the left and the timeline.
fn show_help(ui: &Ui, session: &Session, state: &mut UiState, arrangement: Arrangement, touch: bool) {
    let window = ui.max_rect();
    let at = window.right_top() + vec2(-MARGIN, MARGIN * 2.0 + bar_height(ui));
    let left = free_room::free_left(window, arrangement);
    let bottom = window.max.y - free_room::covered_by_timeline(ui, session, state, arrangement).max(MARGIN);
    let most = vec2(at.x - left, bottom - at.y) - Vec2::splat(PANEL_AROUND);
    Panel::new("help", Align2::RIGHT_TOP, at).on_top().show(ui, |ui| {
        help::show(ui, session, state, most, touch);
    });
}

/// Why a file was not opened: in the middle, or so far to the right that the panel on the left can be read.
fn show_error(ui: &Ui, session: &Session, error: &LoadError, arrangement: Arrangement, commands: &mut Vec<Command>) {
    let window = ui.max_rect();
    let width = ERROR_WIDTH.min(window.width() - 2.0 * MARGIN);
    let first = free_room::free_left(window, arrangement) + 0.5 * width;
    let last = window.max.x - MARGIN - 0.5 * width;
    let at = pos2(
        window.center().x.max(first).min(last),
        window.min.y + window.height() * 0.38,
    );
    Panel::new("error", Align2::CENTER_CENTER, at).on_top().show(ui, |ui| {
        ui.set_width(width - PANEL_AROUND);
        error_card::show(ui, session, error, commands);
    });
}

fn set_theme(ui: &Ui) -> Command {
    Command::SetTheme(if ui.visuals().dark_mode {
        Theme::Dark
    } else {
        Theme::Light
    })
}

/// What the panels leave free is where the model is framed. A window of another size and another model are framed at once;
/// where a panel opened or shut the camera goes there.
fn set_viewport(
    ui: &Ui,
    session: &Session,
    state: &mut UiState,
    window: Rect,
    arrangement: Arrangement,
) -> Option<Command> {
    let insets = free_room::insets(ui, session, state, window, arrangement);
    let aspect = window.width() / window.height().max(1.0);
    let now = Framed {
        window,
        model: session.model_revision(),
        insets,
    };
    let before = state.framed.replace(now);
    if before == Some(now) {
        return None;
    }
    let command = CameraCommand::SetViewport { aspect, insets };
    let same_picture = before.is_some_and(|before| (before.window, before.model) == (window, now.model));
    Some(Command::Camera(if same_picture {
        CameraCommand::Glide(Box::new(command))
    } else {
        command
    }))
}
