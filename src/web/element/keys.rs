//! Keys, as the table of actions has them. Those that ask for what this program lacks are the browser's.

use wasm_bindgen::JsValue;

use crate::actions::{self, Action, Ask};
use crate::session::{Command, FileCommand, Session};
use crate::web::field;

/// The action of a `keydown` event.
pub(super) fn action(event: &JsValue) -> Option<&'static Action> {
    let held = |name| field(event, name).is_truthy();
    let text = |name| field(event, name).as_string().unwrap_or_default();
    let words = |key: &str, shift: bool| {
        let modifiers = [
            ("Ctrl ", held("ctrlKey") || held("metaKey")),
            ("Alt ", held("altKey")),
            ("Shift ", shift),
        ];
        let held = modifiers.iter().filter(|(_, held)| *held).map(|(words, _)| *words);
        held.collect::<String>() + key
    };
    // Shift makes another sign of a key, and other alphabets have other letters on it.
    let names = [name_of_key(&text("key")), name_of_code(&text("code")).to_owned()];
    names.iter().find_map(|key| {
        let pressed = [words(key, false), words(key, true)];
        actions::of_key(held("shiftKey"), |words, shift| words == pressed[usize::from(shift)])
    })
}

/// What an action asks the session for, as far as this program can do it: it has no edits to take back.
pub(super) fn command(action: &Action, session: &Session) -> Option<Command> {
    match action.ask(session)? {
        Ask::Command(Command::History(_)) => None,
        Ask::Command(command) => Some(command),
        Ask::Close if session.is_opening() => Some(FileCommand::CancelOpening.into()),
        Ask::Close if session.error().is_some() => Some(FileCommand::DismissError.into()),
        Ask::Close => actions::let_go(session),
        _ => None,
    }
}

/// The word of the table for what a key types.
fn name_of_key(key: &str) -> String {
    match key {
        " " => "Space".to_owned(),
        "ArrowLeft" => "←".to_owned(),
        "ArrowRight" => "→".to_owned(),
        "ArrowUp" => "↑".to_owned(),
        "ArrowDown" => "↓".to_owned(),
        "Escape" => "Esc".to_owned(),
        "-" => "−".to_owned(),
        // `Home` stays, and `f` is the key F.
        _ if key.chars().count() > 1 => key.to_owned(),
        _ => key.to_uppercase(),
    }
}

/// The word of the table for a key by its place on a keyboard; empty where there is none.
fn name_of_code(code: &str) -> &str {
    match code {
        "Comma" => ",",
        "Period" => ".",
        _ => {
            let letter = code.strip_prefix("Key");
            letter.or_else(|| code.strip_prefix("Digit")).unwrap_or_default()
        }
    }
}
