//! Maps keys to actions: those of the table and those that fly. All others are the browser's.

use egui::{Event, Key, Modifiers, Ui};

use super::cx::Cx;
use super::input::is_arrow;
use super::state::{Request, UiState};
use crate::actions::{self, Action, Ask};
use crate::session::{Command, FileCommand, Session};
use crate::ui::panels::export;
use crate::ui::panels::findings;
use crate::ui::window::viewport::{self, FLIGHT_KEYS};

/// Reads the keys of a pass in which nobody types into a field. `popover_open`: Esc closes the popover and nothing else.
pub(super) fn read(ui: &Ui, cx: &mut Cx<'_, UiState>, popover_open: bool) {
    let events = ui.input(|input| input.events.clone());
    // Space and Enter belong to a focused control. The view has no use for them.
    let focused = ui.memory(|memory| memory.focused());
    let control_focused = focused.is_some_and(|id| id != viewport::id(ui));
    let mut held = false;
    for event in events {
        let asked = match event {
            Event::Key {
                key,
                pressed: true,
                repeat,
                modifiers,
                ..
            } => {
                held = repeat;
                let is_controls = control_focused && matches!(key, Key::Space | Key::Enter);
                let has_shut = popover_open && key == Key::Escape;
                let is_menus = popover_open && control_focused && is_arrow(key);
                // These keys fly while the view is held.
                let flies = is_flight_key(key) && ui.input(|input| input.pointer.secondary_down());
                action_of(key, modifiers)
                    // A held key goes on stepping, but switches or asks only once.
                    .filter(|action| (action.repeats || !held) && !is_controls && !is_menus && !has_shut && !flies)
            }
            // The question mark is on different keys of different keyboards.
            Event::Text(text) if text == actions::HELP.key() && !held => Some(&actions::HELP),
            _ => None,
        };
        if let Some(ask) = asked.and_then(|action| action.ask(cx.session)) {
            cx.state.announcer.by_key |= asked.is_some_and(|action| action.announced);
            carry_out(ask, ui, cx);
        }
    }
}

fn is_flight_key(key: Key) -> bool {
    FLIGHT_KEYS.iter().any(|&(flight_key, _)| flight_key == key)
}

/// The action of a key that is pressed.
pub fn action_of(key: Key, modifiers: Modifiers) -> Option<&'static Action> {
    // The Mac's Command and Y are the browser's.
    if modifiers.mac_cmd && key == Key::Y {
        return None;
    }
    actions::of_key(modifiers.shift, |words, shift| {
        let pressed = Shortcut {
            shift,
            ctrl: modifiers.command,
            alt: modifiers.alt,
            key,
        };
        shortcut(words) == Some(pressed)
    })
}

/// A key with what is held beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shortcut {
    shift: bool,
    /// Ctrl, or the Mac's Command.
    ctrl: bool,
    alt: bool,
    key: Key,
}

/// A key of the table, `Ctrl Shift Z`. None for `?`, which is typed as a text.
pub fn shortcut(words: &str) -> Option<Shortcut> {
    let (modifiers, key) = words.rsplit_once(' ').unwrap_or(("", words));
    let key = match key {
        "←" => Key::ArrowLeft,
        "→" => Key::ArrowRight,
        "↑" => Key::ArrowUp,
        "↓" => Key::ArrowDown,
        "?" => return None,
        name => Key::from_name(name)?,
    };
    let has = |modifier: &str| modifiers.split(' ').any(|word| word == modifier);
    Some(Shortcut {
        shift: has("Shift"),
        ctrl: has("Ctrl"),
        alt: has("Alt"),
        key,
    })
}

/// Does what a key or a button asks for.
pub(super) fn carry_out(ask: Ask, ui: &Ui, cx: &mut Cx<'_, UiState>) {
    match ask {
        Ask::Command(command) => cx.push(command),
        Ask::Help => cx.state.help_open = !cx.state.help_open,
        Ask::Close => escape(ui, cx),
        Ask::NameBone => cx.state.skeleton.rename_selected(ui, cx.session),
        Ask::OpenFiles => cx.state.requests.push(Request::PickFiles),
        Ask::ReadAgain => cx.state.read_again(),
        Ask::SavePicture { transparent } => cx.state.save_picture(ui, transparent),
        Ask::Findings => findings::toggle(ui, cx.state),
        Ask::Export => export::ask(ui, cx.state),
    }
}

/// What Esc closes or clears.
enum OnTop {
    /// What is being opened.
    Opening,
    Error,
    Help,
    Diagnostics,
    ChosenKeys,
    Selection(Command),
}

/// What lies on top, apart from popovers.
fn on_top(ui: &Ui, session: &Session, state: &UiState) -> Option<OnTop> {
    // A key of the first pass that has the opening in it can have been pressed before the file came: it is meant for what was seen then.
    let now_secs = ui.input(|input| input.time);
    if state.opening_since.is_some_and(|since_secs| since_secs < now_secs) {
        Some(OnTop::Opening)
    } else if session.error().is_some() {
        Some(OnTop::Error)
    } else if state.help_open {
        Some(OnTop::Help)
    } else if state.diagnostics_open {
        Some(OnTop::Diagnostics)
    } else if state.timeline.has_chosen_keys() {
        Some(OnTop::ChosenKeys)
    } else {
        actions::let_go(session).map(OnTop::Selection)
    }
}

/// Closes or clears what lies on top.
fn escape(ui: &Ui, cx: &mut Cx<'_, UiState>) {
    match on_top(ui, cx.session, cx.state) {
        Some(OnTop::Opening) => cx.push(FileCommand::CancelOpening),
        Some(OnTop::Error) => cx.push(FileCommand::DismissError),
        Some(OnTop::Help) => cx.state.help_open = false,
        Some(OnTop::Diagnostics) => cx.state.diagnostics_open = false,
        Some(OnTop::ChosenKeys) => cx.state.timeline.let_go_of_keys(),
        Some(OnTop::Selection(command)) => cx.push(command),
        None => {}
    }
}

/// Whether Esc would close a panel or clear a selection.
pub(super) fn escape_shuts_panel(ui: &Ui, session: &Session, state: &UiState) -> bool {
    on_top(ui, session, state).is_some()
}

/// Whether the viewer uses a key, so that the browser must not act on it too.
pub fn owns_key(key: Key, modifiers: Modifiers) -> bool {
    let plain = !modifiers.command && !modifiers.alt;
    key == Key::Escape || (plain && is_flight_key(key)) || action_of(key, modifiers).is_some()
}
