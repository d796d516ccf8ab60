//! What is drawn over the view: names of joints, a ring round the selected vertex, and the legend of the skin's colours.

use std::sync::Arc;

use egui::{
    Align2, Color32, FontId, Galley, Margin, Painter, Pos2, Rangef, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo,
    pos2, vec2,
};

use super::state::SkeletonState;
use crate::actions::Control;
use crate::anim::SkinView;
use crate::scene::{LegendStop, legend};
use crate::session::Session;
use crate::ui::kit::theme::{self, Tokens};
use crate::ui::kit::wording::{shortened, trimmed};
use crate::ui::kit::{TextButton, control_size, gradient_shape, named, paint_name};

/// The most characters of a name over the view. The tree shows the whole name.
const MOST_CHARS: usize = 24;
/// A name is first drawn at these offsets in the panel's colour, as a halo.
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
/// Height of the bar of colours, without and with its values.
const BAR_HEIGHT: f32 = 8.0;
const COLORS_HEIGHT: f32 = BAR_HEIGHT + 22.0;
/// Shown instead of a legend with too many colours.
const COLORS_IN_TREE: &str = "Colours as in the skeleton's tree";
/// Font size of the values, and the least gap between two.
const VALUE_SIZE: f32 = 11.0;
const VALUE_GAP: f32 = 6.0;
/// The greatest width of a strip's contents, and the fraction of it that the colours take.
const STRIP_MOST: f32 = 336.0;
const STRIP_FRACTION: f32 = 0.55;
/// Width of a strip's title before a button.
const STRIP_TITLE: f32 = 130.0;
pub(in crate::ui) const STRIP_MARGIN: Margin = Margin {
    left: 14,
    right: 14,
    top: 7,
    bottom: 5,
};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::ui) enum LegendShape {
    /// The colours below the title, then a sentence if they need one. For a corner with room.
    Card,
    /// The colours beside the title, in a line between the model and the panel below it.
    Strip,
}

/// What the skin's colours show. None while the skin has its own.
pub(in crate::ui) fn colored_view(session: &Session) -> Option<SkinView> {
    session.look().skin_view.filter(|_| session.open_model().is_some())
}

/// The legend of the skin's colours. Without a bone whose weights are shown it offers to choose one, unless the tree is there already.
/// Returns whether the person wants to.
pub(in crate::ui) fn show_legend(
    ui: &mut Ui,
    session: &Session,
    view: SkinView,
    shape: LegendShape,
    tree_shown: bool,
) -> bool {
    let (title, hint) = words(session, view);
    // A hovered bone changes the colours, not the layout.
    let joints = session.joints();
    let lacks_bone = view == SkinView::Weight && joints.selected().is_none() && joints.selected_vertex().is_none();
    let offers = lacks_bone && !tree_shown;
    match shape {
        LegendShape::Card => {
            card(ui, view, &title, hint);
            if offers {
                ui.add_space(6.0);
            }
        }
        LegendShape::Strip if offers => {
            return ui
                .horizontal(|ui| {
                    let size = vec2(STRIP_TITLE, control_size(ui));
                    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
                    show_title(ui, rect, &title);
                    choose_bone(ui, Rangef::new(0.0, STRIP_MOST - STRIP_TITLE))
                })
                .inner;
        }
        LegendShape::Strip => strip(ui, view, &title),
    }
    offers && choose_bone(ui, Rangef::point(ui.available_width()))
}

fn choose_bone(ui: &mut Ui, width: Rangef) -> bool {
    let button = TextButton::new("Choose a bone", "Choose a bone in the tree");
    button.width(width).show(ui).clicked()
}

fn card(ui: &mut Ui, view: SkinView, title: &str, hint: Option<&str>) {
    let width = ui.available_width();
    let (rect, _) = ui.allocate_exact_size(vec2(width, 17.0), Sense::hover());
    show_title(ui, rect, title);
    let (rect, _) = ui.allocate_exact_size(vec2(width, colors_height(view)), Sense::hover());
    show_colors(ui, rect, view);
    if let Some(hint) = hint {
        ui.add_space(2.0);
        ui.label(egui::RichText::new(hint).color(Tokens::of(ui).muted).size(12.0));
    }
}

fn strip(ui: &mut Ui, view: SkinView, title: &str) {
    let width = ui.available_width().min(STRIP_MOST);
    let (rect, _) = ui.allocate_exact_size(vec2(width, COLORS_HEIGHT), Sense::hover());
    let (left, right) = rect.split_left_right_at_fraction(1.0 - STRIP_FRACTION);
    show_title(ui, left, title);
    if view == SkinView::DominantJoint {
        let (font, color) = (FontId::proportional(12.0), Tokens::of(ui).muted);
        ui.painter()
            .text(right.right_center(), Align2::RIGHT_CENTER, COLORS_IN_TREE, font, color);
    } else {
        show_colors(ui, right, view);
    }
}

fn show_title(ui: &mut Ui, rect: Rect, title: &str) {
    let color = Tokens::of(ui).text;
    let room = rect.width() - 8.0;
    paint_name(
        ui.painter(),
        rect.left_center(),
        title,
        theme::semibold(12.0),
        color,
        room,
    );
    let response = ui.interact(rect, ui.scope_id().with("legend title"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Legend: {title}")));
}

/// The joints' own colours are in the tree.
fn colors_height(view: SkinView) -> f32 {
    match view {
        SkinView::DominantJoint => 0.0,
        SkinView::InfluenceCount | SkinView::Weight | SkinView::Stretch => COLORS_HEIGHT,
    }
}

fn show_colors(ui: &mut Ui, rect: Rect, view: SkinView) {
    match view {
        SkinView::InfluenceCount => swatches(ui, rect, legend(view)),
        SkinView::Weight | SkinView::Stretch => gradient(ui, rect, legend(view)),
        SkinView::DominantJoint => {}
    }
}

/// The title, and a sentence if the colours need one.
fn words(session: &Session, view: SkinView) -> (String, Option<&'static str>) {
    match view {
        SkinView::Weight => {
            let title = match session.weighed_joint() {
                Some(joint) => format!("Weight of {}", session.joint_label(joint)),
                None => view.label().to_owned(),
            };
            // The hint stays while another joint is hovered, so that the card keeps its height.
            let joints = session.joints();
            let hint = match (joints.selected(), joints.selected_vertex()) {
                (Some(_), _) => None,
                (None, Some(_)) => Some("The strongest bone of the vertex. Choose another there or in the tree."),
                (None, None) => Some("Choose a bone in the Skeleton tab: in its tree, or on the skin."),
            };
            (title, hint)
        }
        SkinView::DominantJoint => (view.label().to_owned(), Some(COLORS_IN_TREE)),
        SkinView::Stretch => (view.label().to_owned(), Some("Edge lengths now, bind pose = 1.")),
        SkinView::InfluenceCount => (view.label().to_owned(), None),
    }
}

fn color_of(stop: &LegendStop) -> Color32 {
    let [red, green, blue, _] = stop.color_srgb;
    Color32::from_rgb(red, green, blue)
}

/// A colour gradient with its values below, each where it is on the scale.
fn gradient(ui: &Ui, rect: Rect, stops: &[LegendStop]) {
    let (Some(first), Some(last)) = (stops.first(), stops.last()) else {
        return;
    };
    let bar = Rect::from_min_size(rect.min + vec2(0.0, 5.0), vec2(rect.width(), BAR_HEIGHT));
    let x_of = |value: f32| bar.min.x + (value - first.value) / (last.value - first.value) * bar.width();
    let colors = stops.iter().map(|stop| (x_of(stop.value), color_of(stop)));
    ui.painter().add(gradient_shape(bar.y_range(), colors));
    // The values at the ends are always shown, those between them where there is room.
    let end = value(ui, pos2(bar.max.x, bar.max.y + 3.0), Align2::RIGHT_TOP, last.value);
    let mut taken = value(ui, bar.left_bottom() + vec2(0.0, 3.0), Align2::LEFT_TOP, first.value);
    for stop in &stops[1..stops.len() - 1] {
        let at = pos2(x_of(stop.value), bar.max.y + 3.0);
        let place = Align2::CENTER_TOP.anchor_size(at, value_size(ui, stop.value));
        if place.min.x >= taken.max.x + VALUE_GAP && place.max.x <= end.min.x - VALUE_GAP {
            taken = value(ui, at, Align2::CENTER_TOP, stop.value);
        }
    }
    let response = ui.interact(rect, ui.scope_id().with("legend colours"), Sense::hover());
    let range = format!("{} to {}", trimmed(first.value), trimmed(last.value));
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Colours from {range}")));
    named(response, Control::new("legend-colours"));
}

/// A swatch for each value: counts have nothing between them.
fn swatches(ui: &Ui, rect: Rect, stops: &[LegendStop]) {
    let width = rect.width() / stops.len().max(1) as f32;
    for (index, stop) in stops.iter().enumerate() {
        let left = rect.min + vec2(index as f32 * width, 5.0);
        let field = Rect::from_min_size(left, vec2(width - 3.0, BAR_HEIGHT));
        ui.painter().rect_filled(field, 2.5, color_of(stop));
        let at = pos2(field.center().x, field.max.y + 3.0);
        value(ui, at, Align2::CENTER_TOP, stop.value);
    }
    let response = ui.interact(rect, ui.scope_id().with("legend colours"), Sense::hover());
    let count = stops.len().saturating_sub(1);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Colours of 0 to {count} bones")));
}

/// Writes a value and returns its rect.
fn value(ui: &Ui, at: Pos2, anchor: Align2, value: f32) -> Rect {
    let color = Tokens::of(ui).muted;
    ui.painter()
        .text(at, anchor, trimmed(value), FontId::proportional(VALUE_SIZE), color)
}

fn value_size(ui: &Ui, value: f32) -> Vec2 {
    let font = FontId::proportional(VALUE_SIZE);
    ui.painter()
        .layout_no_wrap(trimmed(value), font, Color32::PLACEHOLDER)
        .size()
}

/// Paints names at the joints, and a ring round the selected vertex or the sides of the selected triangle, over the picture, under the panels.
pub(in crate::ui) fn show_marks(ui: &Ui, session: &Session, state: &SkeletonState, window: Rect) {
    let tokens = Tokens::of(ui);
    let (painter, joints) = (ui.painter(), session.joints());
    // In order of importance: selected, hovered, then the nearest.
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
    if let Some(corners) = state.reading.corners_at {
        let corners = corners.map(|at| in_window(window, at));
        let dark = Stroke::new(3.6, Color32::from_black_alpha(150));
        for stroke in [dark, Stroke::new(1.8, tokens.accent)] {
            painter.add(egui::Shape::closed_line(corners.to_vec(), stroke));
        }
        for corner in corners {
            painter.circle(corner, 3.4, Color32::WHITE, dark);
        }
    } else if let Some(at) = state.reading.vertex_at {
        let at = in_window(window, at);
        // A light ring with a dark edge is visible on any skin.
        painter.circle_stroke(at, 6.0, Stroke::new(3.6, Color32::from_black_alpha(150)));
        painter.circle_stroke(at, 6.0, Stroke::new(1.8, Color32::WHITE));
        painter.circle(at, 2.2, tokens.accent, Stroke::new(1.0, Color32::from_black_alpha(150)));
    }
}

/// A point of the picture (x right, y up, −1…1) in the window.
fn in_window(window: Rect, at: glam::Vec2) -> Pos2 {
    let fraction = vec2(0.5 * (at.x + 1.0), 0.5 * (1.0 - at.y));
    window.min + fraction * window.size()
}

fn paint_with_halo(painter: &Painter, at: Pos2, galley: &Arc<Galley>, color: Color32, halo: Color32) {
    for (x, y) in HALO {
        let around = at + vec2(x, y);
        painter.galley_with_override_text_color(around, Arc::clone(galley), halo.gamma_multiply(0.8));
    }
    painter.galley(at, Arc::clone(galley), color);
}
