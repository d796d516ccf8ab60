//! What of a surface is shown: the menu of view modes.

use egui::Ui;

use super::widgets::keyed_menu_item;
use crate::scene::ViewMode;
use crate::session::{Command, LookCommand, Session};

/// A line for each mode. Whether one was chosen.
pub(super) fn items(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) -> bool {
    let in_force = session.look().view_mode;
    let mut chosen = false;
    for mode in ViewMode::ALL {
        // The key goes to the next one.
        let key = if mode == in_force.cycled(1) { "T" } else { "" };
        if keyed_menu_item(ui, mode.label(), key, mode == in_force).clicked() {
            commands.push(LookCommand::SetViewMode(mode).into());
            chosen = true;
        }
    }
    chosen
}
