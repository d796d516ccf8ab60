//! What of a surface is shown: the menu of view modes.

use egui::Ui;

use super::skeleton;
use super::widgets::{keyed_menu_item, section_name};
use crate::actions;
use crate::anim::SkinView;
use crate::scene::ViewMode;
use crate::session::{Command, JointCommand, LookCommand, Session};

/// A line for each mode, and below them what can be seen of a skin. Whether one was chosen.
pub(super) fn items(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) -> bool {
    let (in_force, skin_view) = (session.look().view_mode, session.joints().skin_view());
    let mut chosen = false;
    for mode in ViewMode::ALL {
        // The key goes to the next one.
        let key = if mode == in_force.cycled(1) {
            actions::NEXT_VIEW_MODE.key()
        } else {
            ""
        };
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
            let on = skin_view == Some(view);
            let command = JointCommand::SetSkinView((!on).then_some(view)).into();
            if keyed_menu_item(ui, view.label(), actions::key_of(session, &command), on).clicked() {
                commands.push(command);
                chosen = true;
            }
        }
    }
    chosen
}
