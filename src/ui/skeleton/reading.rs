//! What is read of the pose on show before the panels are laid out, which only look.

use glam::Vec2;

use super::digits::Digits;
use crate::anim::{JointReadout, SkinView, VertexExplanation};
use crate::scene::{LabelPlace, joint_colors};
use crate::session::Session;

/// Least distance between the names of two joints, in points.
const LABEL_SPACING: f32 = 22.0;

/// Numbers and places, in buffers that are kept.
#[derive(Debug, Default)]
pub(super) struct Reading {
    pub(super) labels: Vec<LabelPlace>,
    pub(super) joint: Option<JointReadout>,
    pub(super) vertex: Option<VertexExplanation>,
    /// How the numbers of joint and vertex are shown.
    pub(super) digits: Digits,
    /// Where the vertex is in the picture: x right, y up, −1…1.
    pub(super) vertex_at: Option<Vec2>,
    /// Colour of each joint (sRGB), while the skin shows the strongest one of each vertex.
    pub(super) colors_srgb: Vec<[u8; 4]>,
    colors_of: Option<u64>,
}

impl Reading {
    /// Reads a session whose picture is this high, in points.
    pub(super) fn take(&mut self, session: &mut Session, height: f32) {
        session.joint_labels(LABEL_SPACING / height.max(1.0), &mut self.labels);
        let bounds = session.open_model().map(|open| &open.bind_bounds);
        self.digits = bounds.map_or_else(Digits::default, Digits::for_bounds);
        let selected = session.joints().selected();
        self.joint = selected.and_then(|joint| session.inspect_joint(joint));
        self.vertex = session.explain_vertex();
        let position = self.vertex.as_ref().map(|explained| explained.position);
        self.vertex_at = position.and_then(|position| session.place_in_picture(position));

        let shown = session.joints().skin_view() == Some(SkinView::DominantJoint);
        let wanted = shown.then_some(session.model_revision());
        if self.colors_of != wanted {
            self.colors_of = wanted;
            self.colors_srgb = match session.open_model().filter(|_| shown) {
                Some(open) => joint_colors(&open.model.skeleton),
                None => Vec::new(),
            };
        }
    }
}
