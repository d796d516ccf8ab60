//! The interface. It reads a [`Session`] and answers with [`Command`]s; what is open and shut is its own [`UiState`].

mod announce;
mod diagnostics_panel;
mod error_card;
mod help;
mod icons;
mod input;
mod inspector;
mod keys;
mod layout;
mod light;
mod mirror;
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

use egui::{Popup, Rect, Ui};

pub use announce::{Announcement, view_in_words};
pub use keys::owns_key;
pub use mirror::{Mirror, MirrorAction, MirrorChanges, MirrorId, MirrorNode};
pub use picture::picture_name;
pub use state::{MAX_PICTURE_SIDE, Request, SheetPage, UiState};
pub use theme::Contrast;

use crate::scene::{Insets, Theme};
use crate::session::{CameraCommand, Command, Session, SubmeshCommand};
use input::{InputOrder, MOST_PASSES};
use state::Framed;
use theme::MARGIN;

/// Gives a context what the interface needs: fonts, styles, and the order of input.
pub fn install(ctx: &egui::Context) {
    theme::install(ctx);
    ctx.options_mut(|options| options.max_passes = MOST_PASSES);
    ctx.add_plugin(InputOrder::default());
}

/// One pass over the whole window. Returns what the person asked for, in order.
///
/// Only the commands change the session. It is borrowed mutably so that the pose can be computed for panels that show its numbers.
pub fn show(ui: &mut Ui, session: &mut Session, state: &mut UiState) -> Vec<Command> {
    let mut commands = Vec::new();
    let window = ui.max_rect();
    let touch = state.coarse_pointer || ui.input(egui::InputState::has_touch_screen);
    widgets::size_for_touch(ui.ctx(), touch);
    if state.shown_model != session.model_revision() {
        state.shown_model = session.model_revision();
        state.shown_diagnostic = None;
        state.diagnostics_open = false;
        state.missing_maps_open = false;
    }

    state.skeleton.read(ui, session, window);
    let session = &*session;
    commands.push(set_theme(ui));
    // It was set in an earlier pass. By now the panels about the selection are open.
    let frames_selection = std::mem::take(&mut state.frames_selection);
    // A click outside of a popover closes it and does nothing else. So does Esc.
    let popover_open = Popup::is_any_open(ui.ctx());
    let typed = state.keyboard.was_typing(ui.ctx());
    viewport::show(ui, window, &mut state.view_hold, popover_open, &mut commands);
    skeleton::show_marks(ui, session, &state.skeleton, window);
    state.hovered_submesh = None;
    state.timeline.update(session);
    let free = layout::show(ui, session, state, &mut commands).rect;
    split::show(ui, session, window, free, &mut commands);
    if ui.ctx().will_discard() {
        state.frames_selection |= frames_selection;
    } else {
        commands.extend(set_viewport(session, state, window, free));
        if frames_selection {
            commands.push(CameraCommand::Glide(Box::new(CameraCommand::FrameSelection)).into());
        }
    }
    if session.submeshes().hovered() != state.hovered_submesh {
        commands.push(SubmeshCommand::Hover(state.hovered_submesh).into());
    }
    state.skeleton.hover(session, state.timeline.hovered(), &mut commands);
    state.skeleton.settle_naming(ui, &mut commands);
    // Shortcuts come last, since a focused control takes its keys first. Keys typed into a field are not shortcuts, whether the field
    // had the focus when the pass began or has it now.
    let typing = state.keyboard.is_typing(ui.ctx()) || state.skeleton.awaits_field();
    let escape_shuts = popover_open || (!typed && !typing && keys::escape_shuts_panel(session, state));
    if !typed && !typing {
        keys::read(ui, session, state, popover_open, &mut commands);
    }
    let escape_shut = escape_shuts && ui.input(|input| input.key_pressed(egui::Key::Escape));
    state.keyboard.give_back(ui.ctx(), popover_open, escape_shut);
    commands
}

fn set_theme(ui: &Ui) -> Command {
    Command::SetTheme(if ui.visuals().dark_mode {
        Theme::Dark
    } else {
        Theme::Light
    })
}

/// Frames the model in what the panels leave free: at once in a resized window or for another model, with a glide when a panel
/// opened or closed.
fn set_viewport(session: &Session, state: &mut UiState, window: Rect, free: Rect) -> Option<Command> {
    let insets = insets(window, free);
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

/// Fractions of the window that are covered. A figure may reach up to the bars.
fn insets(window: Rect, free: Rect) -> Insets {
    let [left, bottom] = [free.min.x - window.min.x, window.max.y - free.max.y];
    let [right, top] = [window.max.x - free.max.x, free.min.y - MARGIN - window.min.y];
    Insets {
        left: left / window.width(),
        right: right / window.width(),
        top: (top / window.height()).clamp(0.0, 0.3),
        bottom: (bottom / window.height()).clamp(0.0, 0.75),
    }
}
