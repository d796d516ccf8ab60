//! What of a surface is shown: the menu of view modes.

use egui::Ui;

use super::skeleton;
use super::widgets::{keyed_menu_item, section_name};
use crate::anim::SkinView;
use crate::scene::ViewMode;
use crate::session::{Command, JointCommand, LookCommand, Session};

/// The name of what is shown: colours of the skin stand in place of the view mode's.
pub(super) fn shown(session: &Session) -> &'static str {
    match session.joints().skin_view() {
        Some(view) => view.label(),
        None => session.look().view_mode.label(),
    }
}

/// A line for each mode, and below them what can be seen of a skin. Whether one was chosen.
pub(super) fn items(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) -> bool {
    let (in_force, skin_view) = (session.look().view_mode, session.joints().skin_view());
    let mut chosen = false;
    for mode in ViewMode::ALL {
        // The key goes to the next one.
        let key = if mode == in_force.cycled(1) { "T" } else { "" };
        let on = mode == in_force && skin_view.is_none();
        if keyed_menu_item(ui, mode.label(), key, on).clicked() {
            commands.push(LookCommand::SetViewMode(mode).into());
            commands.push(JointCommand::SetSkinView(None).into());
            chosen = true;
        }
    }
    if skeleton::has_joints(session) {
        ui.add_space(6.0);
        section_name(ui, "Skin");
        for view in SkinView::ALL {
            let key = if view == SkinView::Weight { "W" } else { "" };
            let on = skin_view == Some(view);
            if keyed_menu_item(ui, view.label(), key, on).clicked() {
                commands.push(JointCommand::SetSkinView((!on).then_some(view)).into());
                chosen = true;
            }
        }
    }
    chosen
}
