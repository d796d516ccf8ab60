//! What stands over the view: names at the joints, a ring round the selected vertex.

use std::sync::Arc;

use egui::{Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Stroke, Ui, vec2};
use glam::Vec2;

use super::SkeletonState;
use crate::session::Session;
use crate::ui::theme::{self, Tokens};
use crate::ui::wording::shortened;

/// Characters of a name over the view: the whole is in the tree.
const MOST_CHARS: usize = 24;
/// Directions in which a word is drawn in the colour of the ground before it is drawn itself.
const HALO: [(f32, f32); 8] = [
    (-1.0, -1.0),
    (0.0, -1.2),
    (1.0, -1.0),
    (-1.2, 0.0),
    (1.2, 0.0),
    (-1.0, 1.0),
    (0.0, 1.2),
    (1.0, 1.0),
];

/// Paints them over the picture, under the panels.
pub(in crate::ui) fn show(ui: &Ui, session: &Session, state: &SkeletonState, window: Rect) {
    let tokens = Tokens::of(ui);
    let (painter, joints) = (ui.painter(), session.joints());
    // The first ones are the selected and the hovered, then the nearest.
    let mut taken: Vec<Rect> = Vec::new();
    for label in &state.reading.labels {
        let marked = joints.selected() == Some(label.joint) || joints.hovered() == Some(label.joint);
        let color = if marked { tokens.accent } else { tokens.text };
        let name = shortened(&session.numbered_joint_label(label.joint), MOST_CHARS);
        let font = if marked {
            theme::semibold(12.0)
        } else {
            FontId::proportional(11.5)
        };
        let at = in_window(window, label.position) + vec2(7.0, 0.0);
        let galley = painter.layout_no_wrap(name, font, color);
        let place = Align2::LEFT_CENTER
            .anchor_size(at, galley.size())
            .expand2(vec2(3.0, 0.0));
        if !taken.iter().any(|other| other.intersects(place)) {
            paint_with_halo(painter, place.min + vec2(3.0, 0.0), &galley, color, tokens.panel);
            taken.push(place);
        }
    }
    if let Some(at) = state.reading.vertex_at {
        let at = in_window(window, at);
        // On any skin the ring is seen: light, with a dark edge.
        painter.circle_stroke(at, 6.0, Stroke::new(3.6, Color32::from_black_alpha(150)));
        painter.circle_stroke(at, 6.0, Stroke::new(1.8, Color32::WHITE));
        painter.circle(at, 2.2, tokens.accent, Stroke::new(1.0, Color32::from_black_alpha(150)));
    }
}

/// A point of the picture (x right, y up, −1…1) in the window.
fn in_window(window: Rect, at: Vec2) -> Pos2 {
    let share = vec2(0.5 * (at.x + 1.0), 0.5 * (1.0 - at.y));
    window.min + share * window.size()
}

fn paint_with_halo(painter: &Painter, at: Pos2, galley: &Arc<Galley>, color: Color32, halo: Color32) {
    for (x, y) in HALO {
        let around = at + vec2(x, y);
        painter.galley_with_override_text_color(around, Arc::clone(galley), halo.gamma_multiply(0.8));
    }
    painter.galley(at, Arc::clone(galley), color);
}
