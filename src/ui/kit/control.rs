//! What controls have in common: their size, the focus ring, words that end in an ellipsis. And chips: small rounded labels.

use std::sync::Arc;

use egui::accesskit::{Action, HasPopup, Node};
use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align2, Color32, CornerRadius, FontId, Galley, Id, Painter, Popup, Pos2, Rect, RectAlign, Response, Role, Sense,
    Shape, Stroke, StrokeKind, Tooltip, Ui, Vec2, WidgetInfo, WidgetRect, vec2,
};

use crate::ui::kit::theme::{CONTROL_RADIUS, MARGIN, ROW_HEIGHT, Tokens};

/// Side of a control for a mouse.
pub(super) const MOUSE_CONTROL: f32 = 28.0;
/// Side of a control for fingers.
pub(super) const TOUCH_CONTROL: f32 = 44.0;

/// Sizes controls for fingers or for a mouse, from the next pass on.
pub(crate) fn size_for_touch(ctx: &egui::Context, touch: bool) {
    let side = if touch { TOUCH_CONTROL } else { MOUSE_CONTROL };
    if ctx.global_style().spacing.interact_size.y != side {
        ctx.all_styles_mut(|style| style.spacing.interact_size = Vec2::splat(side));
        ctx.request_repaint();
    }
}

pub(crate) fn control_size(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y
}

/// Whether controls are sized for fingers.
pub(crate) fn is_touch(ui: &Ui) -> bool {
    control_size(ui) > MOUSE_CONTROL
}

/// Whether the pointer is a finger. A touch screen may have a mouse too, and then it acts as one.
pub(crate) fn by_finger(ui: &Ui) -> bool {
    ui.input(|input| {
        if input.has_touch_screen() {
            input.any_touches()
        } else {
            is_touch(ui)
        }
    })
}

/// A key to show beside what it does. By touch none.
pub(crate) fn key_hint<'a>(ui: &Ui, key: &'a str) -> &'a str {
    if is_touch(ui) { "" } else { key }
}

/// Height of a row of a panel that can be pressed.
pub(crate) fn pressed_row_height(ui: &Ui) -> f32 {
    if is_touch(ui) { TOUCH_CONTROL } else { ROW_HEIGHT }
}

/// Gap between a control and its ring.
const RING_GAP: f32 = 1.0;

/// The place of the ring round a control, if it has the focus and its target is not what is seen. [`paint_focus_ring`] draws it.
pub(crate) fn focus_ring(ui: &Ui, rect: Rect, response: &Response) {
    if response.has_focus() {
        let clip = ui.clip_rect();
        ui.data_mut(|data| data.insert_temp(ring_id(), (response.id, rect, clip)));
    }
}

/// Draws the ring round the focused control, over all of its layer and a little over the edge of the list that it is in.
pub(crate) fn paint_focus_ring(ui: &Ui, widget: &WidgetRect) {
    let noted: Option<(Id, Rect, Rect)> = ui.data(|data| data.get_temp(ring_id()));
    let noted = noted.filter(|&(id, ..)| id == widget.id);
    let (rect, clip) = noted.map_or((widget.rect, widget.interact_rect), |(_, rect, clip)| (rect, clip));
    let tokens = Tokens::of(ui);
    let reach = RING_GAP + tokens.ring_width;
    let window = ui.ctx().content_rect();
    let ring = rect.expand(RING_GAP).intersect(window.shrink(tokens.ring_width));
    ui.ctx()
        .layer_painter(widget.layer_id)
        .with_clip_rect(clip.expand(reach))
        .rect_stroke(
            ring,
            CornerRadius::same(CONTROL_RADIUS + 1),
            Stroke::new(tokens.ring_width, tokens.accent),
            StrokeKind::Outside,
        );
}

fn ring_id() -> Id {
    Id::unique("focus ring")
}

/// Fills the ground of a control, and draws its border where there are borders.
pub(crate) fn paint_ground(ui: &Ui, rect: Rect, color: Color32) {
    let radius = CornerRadius::same(CONTROL_RADIUS);
    ui.painter().rect(rect, radius, color, border(ui), StrokeKind::Inside);
}

/// The border of a control.
pub(super) fn border(ui: &Ui) -> Stroke {
    match Tokens::of(ui).border {
        Color32::TRANSPARENT => Stroke::NONE,
        color => Stroke::new(1.0, color),
    }
}

/// Draws the ground of a row, a little wider than its contents, and the focus ring.
pub(crate) fn paint_row_ground(ui: &Ui, rect: Rect, response: &Response, selected: bool, over: bool) {
    let tokens = Tokens::of(ui);
    let around = rect.expand2(vec2(6.0, 0.0));
    if selected {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.accent_ground);
    } else if over {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.field);
    }
    focus_ring(ui, around, response);
}

/// Draws the ground of a row of a list that is no wider than its contents.
pub(crate) fn paint_list_ground(ui: &Ui, rect: Rect, selected: bool, over: bool) {
    let tokens = Tokens::of(ui);
    if selected {
        ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.accent_ground);
    } else if over {
        ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field_hovered);
    }
}

/// Draws words from a point at their left centre. Words wider than `most` end in an ellipsis.
pub(crate) fn paint_elided(painter: &Painter, at: Pos2, text: &str, font: FontId, color: Color32, most: f32) {
    let mut job = LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = TextWrapping::truncate_at_width(most.max(0.0));
    let galley = painter.layout_job(job);
    painter.galley(at - Vec2::new(0.0, galley.size().y * 0.5), galley, color);
}

/// The part of the room that the end of a name has at least, where its middle is left out. Names of one rig often begin alike.
const END_OF_NAME: f32 = 0.55;

/// Draws a name that the file gives from a point at its left centre, as [`elided_name`] has it.
pub(crate) fn paint_name(painter: &Painter, at: Pos2, name: &str, font: FontId, color: Color32, most: f32) {
    let galley = elided_name(painter, name, font, color, most);
    painter.galley(at - Vec2::new(0.0, galley.size().y * 0.5), galley, color);
}

/// Lays a name out. One wider than `most` has an ellipsis in its middle, since names of bones and of maps differ at their ends.
pub(crate) fn elided_name(painter: &Painter, name: &str, font: FontId, color: Color32, most: f32) -> Arc<Galley> {
    let most = most.max(0.0);
    let whole = painter.layout_job(LayoutJob::simple_singleline(name.to_owned(), font.clone(), color));
    // A room that was measured by this name is off by rounding.
    if whole.size().x <= most + 0.5 {
        return whole;
    }
    let ellipsis = painter.fonts_mut(|fonts| fonts.glyph_width(&font, '…'));
    let short = without_middle(&whole, most - ellipsis);
    painter.layout_job(LayoutJob::simple_singleline(short, font, color))
}

/// The beginning and the end of a line, as much as is `room` wide, with an ellipsis between them.
fn without_middle(line: &Galley, room: f32) -> String {
    let glyphs = line.rows.first().map_or(&[][..], |row| &row.glyphs);
    let end_x = glyphs.last().map_or(0.0, |glyph| glyph.max_x());
    // What has no width of its own, as accents, stays with the character before it.
    let tail = glyphs
        .iter()
        .rposition(|glyph| end_x - glyph.pos.x > END_OF_NAME * room);
    let tail = tail.map_or(0, |before| before + 1);
    let accents = glyphs[tail..].iter().take_while(|glyph| glyph.advance_width == 0.0);
    let tail = tail + accents.count();
    let tail_width = glyphs.get(tail).map_or(0.0, |first| end_x - first.pos.x);
    let head = glyphs[..tail]
        .iter()
        .take_while(|glyph| glyph.max_x() <= room - tail_width);
    let tail = glyphs[tail..].iter().map(|glyph| glyph.chr);
    head.map(|glyph| glyph.chr).chain(['…']).chain(tail).collect()
}

/// A tooltip that repeats the control's name, for eyes alone: a screen reader has said it already.
pub(crate) fn hint_of_name(response: Response, name: &str) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(ui.spacing().tooltip_width);
        ui.label(name);
    })
}

/// Tells screen readers more about a widget than its role and its name.
pub(crate) fn tell_node<R>(response: &Response, tell: impl FnOnce(&mut Node) -> R) -> Option<R> {
    response.ctx.accesskit_node_builder(response.id, tell)
}

/// Tells screen readers that a button shows and hides something, and whether that is shown.
pub(crate) fn tell_open(response: &Response, is_open: bool) {
    tell_node(response, |node| {
        node.clear_toggled();
        node.set_expanded(is_open);
    });
}

/// Tells screen readers that a button is no switch, though it may be drawn as one that is on.
pub(crate) fn tell_push(response: &Response) {
    tell_node(response, |node| node.clear_toggled());
}

/// A tooltip at the side of a row of a panel, so that it covers no other row. `row` is the row that the widget is in, if it is not one
/// itself.
pub(crate) fn hint_beside(response: Response, row: Option<Rect>, words: &str) -> Response {
    let row = row.unwrap_or(response.rect);
    let mut tooltip = Tooltip::for_enabled(&response);
    tooltip.popup = tooltip
        .popup
        .anchor(row.expand2(vec2(MARGIN, 0.0)))
        .align(RectAlign::RIGHT)
        .align_alternatives(&[RectAlign::LEFT, RectAlign::BOTTOM_START, RectAlign::TOP_START]);
    tooltip.show(|ui| {
        ui.set_max_width(ui.spacing().tooltip_width);
        ui.label(words);
    });
    response
}

/// A sentence about what a widget shows: on hover, and for screen readers.
pub(crate) fn explained(response: Response, sentence: &str) -> Response {
    tell_node(&response, |node| node.set_description(sentence));
    response.on_hover_text(sentence)
}

/// The mark before something that folds. It points right while folded, otherwise down.
pub(crate) fn paint_fold_mark(painter: &Painter, center: Pos2, folded: bool, color: Color32) {
    let corners = if folded {
        [Vec2::new(-1.7, -3.4), Vec2::new(1.7, 0.0), Vec2::new(-1.7, 3.4)]
    } else {
        [Vec2::new(-3.4, -1.7), Vec2::new(0.0, 1.7), Vec2::new(3.4, -1.7)]
    };
    let corners = corners.map(|corner| center + corner).to_vec();
    painter.add(Shape::line(corners, Stroke::new(1.4, color)));
}

/// Tells programs that read the screen what hangs from a button and whether it is open, and does as they ask. Returns the button's name.
pub(crate) fn tell_popup(ui: &Ui, button: &Response, kind: HasPopup) -> String {
    let id = Popup::default_response_id(button);
    let asked = |action| ui.input(|input| input.has_accesskit_action_request(button.id, action));
    if asked(Action::Expand) {
        Popup::open_id(ui.ctx(), id);
    } else if asked(Action::Collapse) {
        Popup::close_id(ui.ctx(), id);
    }
    let open = Popup::is_id_open(ui.ctx(), id);
    tell_open(button, open);
    let name = tell_node(button, |node| {
        node.set_has_popup(kind);
        node.add_action(if open { Action::Collapse } else { Action::Expand });
        node.label().map(str::to_owned)
    });
    name.flatten().unwrap_or_default()
}

/// Margins of a chip: left and right together, top and bottom together.
const AROUND: Vec2 = vec2(14.0, 5.0);

/// A chip in a row.
pub(crate) fn chip(ui: &mut Ui, text: &str, color: Color32) -> Response {
    let ground = Tokens::of(ui).field;
    let galley = layout(ui.painter(), text, color);
    let (rect, response) = ui.allocate_exact_size(galley.size() + AROUND, Sense::hover());
    paint_chip(ui.painter(), rect.min, Align2::LEFT_TOP, text, color, ground);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    response
}

/// A chip in a row that can be pressed. Its target is as high as a control. `on`: it is in force, or what it opens is open.
pub(crate) fn pressed_chip(ui: &mut Ui, text: &str, color: Color32, on: bool) -> Response {
    let tokens = Tokens::of(ui);
    let size = vec2(chip_size(ui, text).x, control_size(ui));
    let (place, response) = ui.allocate_exact_size(size, Sense::click());
    let lit = on || response.hovered();
    let ground = if lit { tokens.field_hovered } else { tokens.field };
    let chip = paint_chip(ui.painter(), place.center(), Align2::CENTER_CENTER, text, color, ground);
    if on {
        let edge = Stroke::new(1.0, color);
        ui.painter()
            .rect_stroke(chip, chip.height() * 0.5, edge, StrokeKind::Inside);
    }
    focus_ring(ui, chip, &response);
    response
}

pub(crate) fn chip_size(ui: &Ui, text: &str) -> Vec2 {
    layout(ui.painter(), text, Color32::WHITE).size() + AROUND
}

/// Draws a chip whose `anchor` is at a point. Returns its rect.
pub(crate) fn paint_chip(
    painter: &Painter,
    at: Pos2,
    anchor: Align2,
    text: &str,
    color: Color32,
    ground: Color32,
) -> Rect {
    let galley = layout(painter, text, color);
    let rect = anchor.anchor_size(at, galley.size() + AROUND);
    painter.rect_filled(rect, rect.height() * 0.5, ground);
    painter.galley(rect.min + AROUND * 0.5, galley, color);
    rect
}

fn layout(painter: &Painter, text: &str, color: Color32) -> std::sync::Arc<egui::Galley> {
    painter.layout_no_wrap(text.to_owned(), FontId::proportional(11.5), color)
}

/// Notes that this is the choice in force of a menu: the focus begins with it when the menu opens.
pub(super) fn note_in_force(ui: &Ui, id: Id) {
    let pass = ui.ctx().cumulative_pass_nr();
    ui.data_mut(|data| data.insert_temp(in_force_id(), (pass, ui.layer_id().id, id)));
}

/// The choice in force of a menu that is shown in this pass.
pub(crate) fn in_force(ctx: &egui::Context, key: Id) -> Option<Id> {
    let (pass, layer, id) = ctx.data(|data| data.get_temp::<(u64, Id, Id)>(in_force_id()))?;
    (pass == ctx.cumulative_pass_nr() && layer == key).then_some(id)
}

fn in_force_id() -> Id {
    Id::unique("the choice in force")
}
