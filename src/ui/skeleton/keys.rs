//! Keys about bones and skin.

use egui::{Key, Modifiers};

use crate::anim::SkinView;
use crate::session::{Command, JointCommand, Session};

/// What a key asks for; nothing in a model without bones.
pub(in crate::ui) fn command_for(session: &Session, key: Key, modifiers: Modifiers) -> Option<Command> {
    if !owns(key, modifiers) || !super::has_joints(session) {
        return None;
    }
    let joints = session.joints();
    match key {
        Key::B if modifiers.shift => Some(JointCommand::SetLabelsVisible(!joints.labels_visible()).into()),
        Key::B => Some(JointCommand::SetBonesVisible(!joints.bones_visible()).into()),
        Key::W => {
            let shown = joints.skin_view() == Some(SkinView::Weight);
            Some(JointCommand::SetSkinView((!shown).then_some(SkinView::Weight)).into())
        }
        Key::K => Some(Command::ToggleBindPose),
        _ => None,
    }
}

/// Whether a key is about bones. F2, which names one, asks for no command.
pub(in crate::ui) fn owns(key: Key, modifiers: Modifiers) -> bool {
    let plain = !modifiers.command && !modifiers.alt;
    plain && matches!(key, Key::B | Key::W | Key::K | Key::F2)
}

/// What Esc lets go of the skeleton: the vertex before the joint.
pub(in crate::ui) fn escape(session: &Session) -> Option<Command> {
    let joints = session.joints();
    if joints.selected_vertex().is_some() {
        Some(JointCommand::SelectVertex(None).into())
    } else if joints.selected().is_some() {
        Some(JointCommand::Select(None).into())
    } else {
        None
    }
}
