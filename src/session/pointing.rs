//! What a click in the picture means, by what is shown there; and where a point of the model is in the picture.

use glam::{Vec2, Vec3};

use super::{JointCommand, Session, SubsetCommand};

impl Session {
    /// Selects what is shown at a point of the picture (x right, y up, −1…1): a bone while bones are drawn, a vertex while the
    /// skin is coloured, else a subset. Beside all of them nothing is selected, but for the bone whose weights are shown.
    pub(super) fn select_at(&mut self, pointer: Vec2) {
        let bone = self.joints.bones_visible().then(|| self.joint_at(pointer)).flatten();
        if bone.is_some() {
            self.perform(JointCommand::Select(bone).into());
        } else if self.joints.skin_view().is_some() {
            self.perform(JointCommand::SelectVertexAt(pointer).into());
        } else {
            self.apply_to_subsets(SubsetCommand::SelectAt(pointer));
            self.joints.let_go();
        }
    }

    /// Where a point of the model (model space) is in the picture: x right, y up, −1…1. None outside of it and behind the
    /// eye.
    pub fn place_in_picture(&mut self, position: Vec3) -> Option<Vec2> {
        let world = self.world_from_model().transform_point3(position);
        self.screen().place(world).map(Vec3::truncate)
    }
}
