//! The interface. It reads a [`Session`] and answers with [`Command`]s; what is open and shut is its own [`UiState`].

mod cx;
#[doc(hidden)]
pub mod for_tests;
mod input;
mod keys;
mod kit;
mod panels;
mod rim;
mod state;
mod timeline;
mod window;

use egui::{Popup, Rect, Ui};

pub use keys::owns_key;
pub use kit::theme;
pub use kit::theme::Contrast;
pub use panels::picture::{contact_sheet_name, picture_name, report_name};
pub use rim::announce::{Announcement, view_in_words};
pub use rim::mirror::{Mirror, MirrorAction, MirrorChanges, MirrorId, MirrorInput, MirrorNode};
pub use state::{Chrome, ContactSheetRequest, DrawerPage, MAX_PICTURE_SIDE, Request, UiState};
pub use window::message::Messages;

use crate::scene::{Insets, Theme};
use crate::session::{CameraCommand, Command, FileCommand, HistoryCommand, News, Session, SubmeshCommand};
use cx::Cx;
use input::{Grip, InputOrder, MOST_PASSES};
use kit::theme::MARGIN;
use kit::wording::{counted, shortened};
use panels::{export, skeleton};
use state::Framed;
use window::arrangement::Arrangement;
use window::message::Offer;
use window::{chips, layout, message, split, viewport};

/// The model is framed in at least this fraction of the window's height. Where the chips would leave less, they lie over it.
const LEAST_BELOW_CHIPS: f32 = 0.1;

/// Gives a context what the interface needs: fonts, styles, the order of input, and what watches its widgets for the page.
pub fn install(ctx: &egui::Context) {
    theme::install(ctx);
    ctx.options_mut(|options| options.max_passes = MOST_PASSES);
    ctx.add_plugin(InputOrder::default());
    ctx.add_plugin(Mirror::default());
}

/// One pass over the whole window. Returns what the person asked for, in order.
///
/// Only the commands change the session. It is borrowed mutably so that the pose can be computed for panels that show its numbers.
pub fn show(ui: &mut Ui, session: &mut Session, state: &mut UiState) -> Vec<Command> {
    let mut commands = Vec::new();
    let window = ui.max_rect();
    let touch = state.coarse_pointer || ui.input(egui::InputState::has_touch_screen);
    state.contrast.apply(ui.ctx());
    if let Some(theme) = state.theme {
        ui.ctx().set_theme(match theme {
            Theme::Dark => egui::Theme::Dark,
            Theme::Light => egui::Theme::Light,
        });
    }
    kit::size_for_touch(ui.ctx(), touch);
    state.focus.begin(ui.ctx());
    tell(session.take_news(), &mut state.messages);
    state.follow_model(session);
    state.skeleton.read(ui, session, window);
    let cx = &mut Cx {
        session,
        state,
        commands: &mut commands,
    };
    cx.commands.push(set_theme(ui));
    let grip = Grip::now(ui.ctx());
    begin_edit(cx.state, grip, cx.commands);
    // Set in an earlier pass: by now the inspector is laid out, and the camera can frame the selection beside it.
    let frames_selection = std::mem::take(&mut cx.state.frames_selection);
    // A click outside of a popover closes it and does nothing else. So does Esc.
    let popover_open = Popup::is_any_open(ui.ctx());
    let typed = cx.state.keyboard.was_typing(ui.ctx());
    let shuts_drawer = layout::drawer_covers_view(window, cx.state);
    let page_seen = layout::shows_side_page(window, cx.state);
    let picks_bones = cx.state.skeleton.picks_bones(cx.session, page_seen);
    let blocked = popover_open || shuts_drawer;
    let clicked = viewport::show(
        ui,
        window,
        &mut cx.part(|state| &mut state.view_hold),
        picks_bones,
        blocked,
    );
    if clicked && shuts_drawer && !popover_open {
        cx.state.drawer = None;
    }
    if cx.state.view_hold.is_held() {
        cx.state.offers_frame = false;
    }
    skeleton::show_marks(ui, cx.session, &cx.state.skeleton, window);
    cx.state.hovered_submesh = None;
    cx.state.timeline.update(cx.session);
    cx.state.follow_selection(cx.session);
    cx.state.offers_frame &= !cx.session.is_framed() && cx.session.open_model().is_some();
    let (mut free, uncovered) = layout::show(ui, cx);
    let export_is_open = export::settle(cx);
    split::show(ui, cx.session, window, free, cx.commands);
    if let Some(bottom) = chips::show(ui, cx, uncovered, export_is_open)
        && Arrangement::of(window) != Arrangement::Wide
        && free.max.y - bottom >= LEAST_BELOW_CHIPS * window.height()
    {
        // In a narrow window they would lie over the model's head.
        free.min.y = free.min.y.max(bottom + MARGIN);
    }
    match message::show(ui, &mut cx.state.messages, cx.session.history().undo_label(), uncovered) {
        Some(Offer::SavePicture) => cx.state.requests.push(Request::SavePictureAs),
        Some(Offer::Undo) => cx.push(HistoryCommand::Undo),
        Some(Offer::UseSky(path)) => cx.push(FileCommand::UseSky(path)),
        None => {}
    }
    if ui.ctx().will_discard() {
        cx.state.frames_selection |= frames_selection;
    } else {
        cx.commands.extend(set_viewport(cx.session, cx.state, window, free));
        if frames_selection {
            cx.push(CameraCommand::Glide(Box::new(CameraCommand::FrameSelection)));
        }
    }
    if cx.session.submeshes().hovered() != cx.state.hovered_submesh {
        cx.push(SubmeshCommand::Hover(cx.state.hovered_submesh));
    }
    cx.state
        .skeleton
        .hover(cx.session, cx.state.timeline.hovered(), cx.commands);
    cx.state.skeleton.settle_naming(ui, cx.commands);
    cx.state.skeleton.show_bones_with_tree(cx.session, cx.commands);
    // Shortcuts come last, since a focused control takes its keys first. Keys typed into a field are not shortcuts, whether the field
    // had the focus when the pass began or has it now.
    let typing = cx.state.keyboard.is_typing(ui.ctx()) || cx.state.skeleton.awaits_field();
    let escape_shuts = popover_open || (!typed && !typing && keys::escape_shuts_panel(ui, cx.session, cx.state));
    cx.state.focus.go_to_ends(ui.ctx());
    if !typed && !typing {
        keys::read(ui, cx, popover_open);
    }
    let escape_shut = escape_shuts && ui.input(|input| input.key_pressed(egui::Key::Escape));
    cx.state.focus.end(ui.ctx(), popover_open, escape_shut);
    cx.state.focus.paint(ui);
    end_edit(cx.state, grip.filter(|&grip| grip != Grip::Request), cx.commands);
    commands
}

/// Begins a step to undo if something else holds a value than in the pass before.
fn begin_edit(state: &mut UiState, grip: Option<Grip>, commands: &mut Vec<Command>) {
    if grip.is_some() && state.grip != grip {
        end_edit(state, None, commands);
        commands.push(HistoryCommand::BeginEdit.into());
        state.grip = grip;
    }
}

/// Ends the step if nothing holds a value any more. The pass in which the pointer is released may still change it.
fn end_edit(state: &mut UiState, grip: Option<Grip>, commands: &mut Vec<Command>) {
    if grip.is_none() && state.grip.take().is_some() {
        commands.push(HistoryCommand::EndEdit.into());
    }
}

/// Says in one message what a drop did that is not seen on the model.
fn tell(news: Vec<News>, messages: &mut Messages) {
    let mut offer = None;
    let words = news.into_iter().map(|news| match news {
        News::OpenedLargest(name, count) => format!("Opened {}, the largest of {count}", shortened(&name, 40)),
        News::ModelsClosed(count) => format!("{} closed, the oldest, to make room", counted(count, "model")),
        News::SkyUsed(name) => {
            offer = Some(Offer::Undo);
            format!("{} is the sky", shortened(&name, 40))
        }
        News::SkyFound(path) => {
            let words = format!(
                "{} is a cube map",
                shortened(path.rsplit('/').next().unwrap_or_default(), 40)
            );
            offer = Some(Offer::UseSky(path));
            words
        }
    });
    let words = words.collect::<Vec<_>>().join(" · ");
    match offer {
        Some(offer) => messages.offer(words, offer),
        None if words.is_empty() => {}
        None => messages.say(words),
    }
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
    if before.is_some_and(|before| before.model == now.model) && !session.is_framed() {
        // The person moved the camera, so it stays. A button offers to frame the model.
        state.offers_frame = true;
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
        top: (top / window.height()).clamp(0.0, 0.4),
        bottom: (bottom / window.height()).clamp(0.0, 0.75),
    }
}
