//! Keys to commands. Only what the viewer owns: the browser keeps its own.

use egui::{Context, Event, Key, Modifiers, Popup, Ui};

use super::UiState;
use super::flight::FLIGHT_KEYS;
use super::skeleton;
use crate::anim::Direction;
use crate::scene::{Overlay, ViewPreset};
use crate::session::{Command, LookCommand, Session, SubsetCommand};

/// Reads the keys of a pass in which no field is typed into. `popover_open`: Esc has shut something that hung from a button.
pub(super) fn read(ui: &Ui, session: &Session, state: &mut UiState, popover_open: bool, commands: &mut Vec<Command>) {
    let events = ui.input(|input| input.events.clone());
    // Space and Enter belong to a focused control.
    let control_focused = ui.memory(|memory| memory.focused().is_some());
    let mut held = false;
    for event in events {
        match event {
            Event::Key {
                key,
                pressed: true,
                repeat,
                modifiers,
                ..
            } => {
                held = repeat;
                // A key that is held steps on; what it switches or asks for is meant once.
                if held && !command_for(key, modifiers).is_some_and(|command| steps(&command)) {
                    continue;
                }
                if control_focused && matches!(key, Key::Space | Key::Enter) {
                    continue;
                }
                commands.extend(command_for(key, modifiers).map(|command| of_selection(command, session)));
                // The key that flies forward while the view is held.
                let flies = key == Key::W && ui.input(|input| input.pointer.secondary_down());
                if !flies {
                    commands.extend(skeleton::keys::command_for(session, key, modifiers));
                }
                match key {
                    Key::F2 => state.skeleton.rename_selected(ui, session),
                    Key::Escape if !popover_open => escape(session, state, commands),
                    Key::R if modifiers.is_none() => state.read_again(),
                    Key::P if !modifiers.command && !modifiers.alt => state.save_picture(ui, modifiers.shift),
                    _ => {}
                }
            }
            // The question mark is on different keys of different keyboards.
            Event::Text(text) if text == "?" && !held => state.help_open = !state.help_open,
            _ => {}
        }
    }
}

/// Whether it goes on a little way, so that doing it again goes on farther.
fn steps(command: &Command) -> bool {
    matches!(
        command,
        Command::StepFrames(_) | Command::StepKey { .. } | Command::Slower | Command::Faster
    )
}

/// Steps from key to key are of the joint that was chosen.
fn of_selection(command: Command, session: &Session) -> Command {
    match command {
        Command::StepKey { direction, joint: None } => Command::StepKey {
            direction,
            joint: session.joints().selected(),
        },
        command => command,
    }
}

/// What Esc takes away.
enum OnTop {
    Error,
    Help,
    Diagnostics,
    ChosenKeys,
    Selection(Command),
}

/// What lies on top, apart from what hangs from a button.
fn on_top(session: &Session, state: &UiState) -> Option<OnTop> {
    if session.error().is_some() {
        Some(OnTop::Error)
    } else if state.help_open {
        Some(OnTop::Help)
    } else if state.diagnostics_open {
        Some(OnTop::Diagnostics)
    } else if state.timeline.has_chosen_keys() {
        Some(OnTop::ChosenKeys)
    } else {
        let_go(session).map(OnTop::Selection)
    }
}

/// Takes away what lies on top.
fn escape(session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    match on_top(session, state) {
        Some(OnTop::Error) => commands.push(Command::DismissError),
        Some(OnTop::Help) => state.help_open = false,
        Some(OnTop::Diagnostics) => state.diagnostics_open = false,
        Some(OnTop::ChosenKeys) => state.timeline.let_go_of_keys(),
        Some(OnTop::Selection(command)) => commands.push(command),
        None => {}
    }
}

/// Whether Esc would shut a panel or let go of a selection.
pub(super) fn escape_shuts_panel(session: &Session, state: &UiState) -> bool {
    on_top(session, state).is_some()
}

/// Whether Esc would shut something, end what is being typed or let go of a selection. When it would not, it lets Tab leave the page's
/// canvas.
pub fn escape_shuts(ctx: &Context, session: &Session, state: &UiState) -> bool {
    Popup::is_any_open(ctx)
        || ctx.text_edit_focused()
        || state.skeleton.is_naming()
        || escape_shuts_panel(session, state)
}

/// Takes the selection away.
fn let_go(session: &Session) -> Option<Command> {
    skeleton::keys::escape(session).or_else(|| {
        let subset = session.subsets().selected();
        subset.map(|_| SubsetCommand::Select(None).into())
    })
}

/// What a key asks for.
pub(super) fn command_for(key: Key, modifiers: Modifiers) -> Option<Command> {
    let Modifiers {
        shift,
        command: ctrl,
        alt,
        ..
    } = modifiers;
    if alt || (ctrl && !matches!(key, Key::Num1 | Key::Num3 | Key::Num7)) {
        return None;
    }
    let glide = |command| Some(Command::Glide(Box::new(command)));
    let opposite = |preset, other| glide(Command::LookFrom(if ctrl { other } else { preset }));
    let overlay = |overlay| Some(LookCommand::ToggleOverlay(overlay).into());
    let step_key = |direction| Some(Command::StepKey { direction, joint: None });
    let frames = if shift { 10 } else { 1 };
    match key {
        Key::Space if shift => Some(Command::TogglePlayBackward),
        Key::Space => Some(Command::TogglePlay),
        Key::ArrowLeft | Key::Comma => Some(Command::StepFrames(-frames)),
        Key::ArrowRight | Key::Period => Some(Command::StepFrames(frames)),
        Key::ArrowUp => step_key(Direction::Forward),
        Key::ArrowDown => step_key(Direction::Backward),
        Key::I if shift => Some(Command::ClearRange),
        Key::I => Some(Command::SetRangeStart(None)),
        Key::O if !shift => Some(Command::SetRangeEnd(None)),
        Key::Home => Some(Command::SeekStart),
        Key::End => Some(Command::SeekEnd),
        Key::OpenBracket => Some(Command::Slower),
        Key::CloseBracket => Some(Command::Faster),
        Key::Backslash => Some(Command::SetSpeed(1.0)),
        Key::L => Some(Command::CycleLoopMode),
        Key::C => Some(Command::CycleClip(if shift { -1 } else { 1 })),
        Key::F if shift => glide(Command::FrameModel),
        Key::F => glide(Command::FrameSelection),
        Key::G => overlay(Overlay::Grid),
        Key::Z => overlay(Overlay::Wireframe),
        Key::N => overlay(Overlay::Normals),
        Key::X => overlay(Overlay::Axes),
        Key::T => Some(LookCommand::CycleViewMode(if shift { -1 } else { 1 }).into()),
        Key::V => Some(LookCommand::ToggleLight.into()),
        Key::Num1 => opposite(ViewPreset::Front, ViewPreset::Back),
        Key::Num3 => opposite(ViewPreset::Right, ViewPreset::Left),
        Key::Num7 => opposite(ViewPreset::Top, ViewPreset::Bottom),
        Key::Num5 => Some(Command::ToggleProjection),
        Key::Num9 => glide(Command::LookFrom(ViewPreset::Isometric)),
        Key::Num0 => glide(Command::ResetCamera),
        _ => None,
    }
}

/// Whether a key is the viewer's, so that the browser must not act on it too.
pub fn owns_key(key: Key, modifiers: Modifiers) -> bool {
    let plain = !modifiers.command && !modifiers.alt;
    let flies = FLIGHT_KEYS.iter().any(|&(flight_key, _)| flight_key == key);
    key == Key::Escape
        || skeleton::keys::owns(key, modifiers)
        || (plain && (flies || key == Key::P))
        || (modifiers.is_none() && key == Key::R)
        || command_for(key, modifiers).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_of_the_browser_are_left_alone() {
        let keys = [
            Key::L,
            Key::F,
            Key::C,
            Key::W,
            Key::T,
            Key::N,
            Key::P,
            Key::V,
            Key::X,
            Key::Z,
            Key::Num5,
            Key::ArrowLeft,
        ];
        for key in keys {
            for modifiers in [Modifiers::COMMAND, Modifiers::ALT] {
                assert_eq!(command_for(key, modifiers), None, "{key:?}");
                assert!(!owns_key(key, modifiers), "{key:?}");
            }
        }
    }

    #[test]
    fn shift_makes_ten_frames_of_one() {
        assert_eq!(
            command_for(Key::ArrowLeft, Modifiers::NONE),
            Some(Command::StepFrames(-1))
        );
        assert_eq!(
            command_for(Key::ArrowRight, Modifiers::SHIFT),
            Some(Command::StepFrames(10))
        );
    }

    #[test]
    fn ctrl_looks_from_the_opposite_side() {
        assert_eq!(
            command_for(Key::Num1, Modifiers::NONE),
            Some(Command::Glide(Box::new(Command::LookFrom(ViewPreset::Front))))
        );
        assert_eq!(
            command_for(Key::Num1, Modifiers::COMMAND),
            Some(Command::Glide(Box::new(Command::LookFrom(ViewPreset::Back))))
        );
    }
}
