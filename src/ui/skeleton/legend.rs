//! What the colours of the skin mean.

use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Role, Sense, Shape, Ui, WidgetInfo, pos2, vec2};

use crate::anim::SkinView;
use crate::scene::{LegendStop, legend};
use crate::session::Session;
use crate::ui::panel::Panel;
use crate::ui::theme::{self, Tokens};
use crate::ui::wording::{shortened, trimmed};

/// Width of the legend's contents.
const WIDTH: f32 = 208.0;
const BAR_HEIGHT: f32 = 8.0;

/// A panel whose lower left corner is at a point. Nothing while the skin is shown as it is. `explained`: with a sentence
/// where the colours alone do not say all.
pub(in crate::ui) fn show(ui: &Ui, session: &Session, at: Pos2, explained: bool) {
    let Some(view) = session.joints().skin_view().filter(|_| session.open_model().is_some()) else {
        return;
    };
    Panel::new("legend", Align2::LEFT_BOTTOM, at).show(ui, |ui| {
        ui.set_width(WIDTH);
        let (title, hint) = words(session, view);
        let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, 17.0), Sense::hover());
        let tokens = Tokens::of(ui);
        let font = theme::semibold(12.0);
        ui.painter()
            .text(rect.left_center(), Align2::LEFT_CENTER, &title, font, tokens.text);
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Legend: {title}")));
        let stops = legend(view);
        match view {
            SkinView::InfluenceCount => swatches(ui, stops),
            SkinView::Weight | SkinView::Stretch => gradient(ui, stops),
            SkinView::DominantJoint => {}
        }
        if let Some(hint) = hint.filter(|_| explained) {
            ui.add_space(2.0);
            ui.label(egui::RichText::new(hint).color(tokens.muted).size(12.0));
        }
    });
}

fn words(session: &Session, view: SkinView) -> (String, Option<&'static str>) {
    match view {
        SkinView::Weight => match session.joints().selected() {
            Some(joint) => (
                format!("Weight of {}", shortened(&session.joint_label(joint), 20)),
                None,
            ),
            None => (
                view.label().to_owned(),
                Some("Select a bone in the tree, or a vertex on the skin."),
            ),
        },
        SkinView::DominantJoint => (
            view.label().to_owned(),
            Some("Each bone has its colour; it stands beside its name in the tree."),
        ),
        SkinView::Stretch => (view.label().to_owned(), Some("Edge lengths now, bind pose = 1.")),
        SkinView::InfluenceCount => (view.label().to_owned(), None),
    }
}

fn color_of(stop: &LegendStop) -> Color32 {
    let [red, green, blue, _] = stop.color_srgb;
    Color32::from_rgb(red, green, blue)
}

/// Values where their colours stand: as far apart as they differ.
fn gradient(ui: &mut Ui, stops: &[LegendStop]) {
    let (Some(first), Some(last)) = (stops.first(), stops.last()) else {
        return;
    };
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, BAR_HEIGHT + 22.0), Sense::hover());
    let bar = Rect::from_min_size(rect.min + vec2(0.0, 5.0), vec2(WIDTH, BAR_HEIGHT));
    let x_of = |value: f32| bar.min.x + (value - first.value) / (last.value - first.value) * bar.width();
    let mut mesh = Mesh::default();
    for (index, stop) in (0u32..).zip(stops) {
        let (x, color) = (x_of(stop.value), color_of(stop));
        mesh.colored_vertex(pos2(x, bar.min.y), color);
        mesh.colored_vertex(pos2(x, bar.max.y), color);
        if index > 0 {
            let here = 2 * index;
            mesh.add_triangle(here - 2, here - 1, here);
            mesh.add_triangle(here - 1, here, here + 1);
        }
    }
    ui.painter().add(Shape::mesh(mesh));
    for (index, stop) in stops.iter().enumerate() {
        let anchor = match index {
            0 => Align2::LEFT_TOP,
            index if index + 1 == stops.len() => Align2::RIGHT_TOP,
            _ => Align2::CENTER_TOP,
        };
        let at = pos2(x_of(stop.value), bar.max.y + 3.0);
        value(ui, at, anchor, stop.value);
    }
    let range = format!("{} to {}", trimmed(first.value), trimmed(last.value));
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Colours from {range}")));
}

/// A field for each value, since there is nothing between them.
fn swatches(ui: &mut Ui, stops: &[LegendStop]) {
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, BAR_HEIGHT + 22.0), Sense::hover());
    let width = WIDTH / stops.len().max(1) as f32;
    for (index, stop) in stops.iter().enumerate() {
        let left = rect.min + vec2(index as f32 * width, 5.0);
        let field = Rect::from_min_size(left, vec2(width - 3.0, BAR_HEIGHT));
        ui.painter().rect_filled(field, 2.5, color_of(stop));
        let at = pos2(field.center().x, field.max.y + 3.0);
        value(ui, at, Align2::CENTER_TOP, stop.value);
    }
    let count = stops.len().saturating_sub(1);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Colours of 0 to {count} bones")));
}

fn value(ui: &Ui, at: Pos2, anchor: Align2, value: f32) {
    let font = FontId::proportional(11.0);
    ui.painter()
        .text(at, anchor, trimmed(value), font, Tokens::of(ui).muted);
}
