//! The few controls that panels are made of.

use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align2, Color32, CornerRadius, FontId, Rangef, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};

use super::icons::{self, Icon};
use super::theme::{self, CONTROL_RADIUS, ROW_HEIGHT, Tokens};

/// Side of a control where a mouse is the pointer.
const MOUSE_CONTROL: f32 = 28.0;
/// Side of a control where fingers are.
const TOUCH_CONTROL: f32 = 44.0;

/// Sizes controls for fingers or for a mouse, from the next pass on.
pub(super) fn size_for_touch(ctx: &egui::Context, touch: bool) {
    let side = if touch { TOUCH_CONTROL } else { MOUSE_CONTROL };
    if ctx.global_style().spacing.interact_size.y != side {
        ctx.all_styles_mut(|style| style.spacing.interact_size = Vec2::splat(side));
        ctx.request_repaint();
    }
}

/// Side of a control, in points.
pub(super) fn control_size(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y
}

/// Whether controls are sized for fingers.
pub(super) fn is_touch(ui: &Ui) -> bool {
    control_size(ui) > MOUSE_CONTROL
}

/// A square button with an icon. `on` marks a switch that is on.
pub(super) fn icon_button(ui: &mut Ui, icon: Icon, label: &str, on: bool) -> Response {
    let size = Vec2::splat(control_size(ui));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let tokens = Tokens::of(ui);
    let fill = match (on, response.hovered() || response.has_focus()) {
        (true, _) => tokens.accent_ground,
        (false, true) => tokens.field_hovered,
        (false, false) => Color32::TRANSPARENT,
    };
    ui.painter().rect_filled(rect, CONTROL_RADIUS, fill);
    focus_ring(ui, rect, &response);
    icons::paint(
        ui.painter(),
        rect,
        icon,
        if on {
            tokens.accent
        } else {
            tokens.muted_to_text(response.hovered())
        },
    );
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, on, label));
    response.on_hover_text(label)
}

/// A button with words on a quiet ground, as wide as they need within `width`; what is longer ends in an ellipsis.
/// `opens_list` adds the chevron of a drop-down.
pub(super) fn text_button(ui: &mut Ui, text: &str, label: &str, opens_list: bool, width: Rangef) -> Response {
    let tokens = Tokens::of(ui);
    let chevron_width = if opens_list { 18.0 } else { 0.0 };
    let around = 16.0 + chevron_width;
    let mut job = LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(13.0), tokens.text);
    job.wrap = TextWrapping::truncate_at_width(width.max - around);
    let galley = ui.painter().layout_job(job);
    let width = width.clamp(galley.size().x + around);
    let (rect, response) = ui.allocate_exact_size(vec2(width, control_size(ui)), Sense::click());
    let fill = if response.hovered() || response.has_focus() {
        tokens.field_hovered
    } else {
        tokens.field
    };
    ui.painter().rect_filled(rect, CONTROL_RADIUS, fill);
    focus_ring(ui, rect, &response);
    let clip = Rect::from_min_max(rect.min, pos2(rect.max.x - chevron_width, rect.max.y));
    let text_at = pos2(rect.min.x + 8.0, rect.center().y - galley.size().y * 0.5);
    ui.painter()
        .with_clip_rect(clip.intersect(ui.clip_rect()))
        .galley(text_at, galley, tokens.text);
    if opens_list {
        let chevron = Rect::from_center_size(pos2(rect.max.x - 12.0, rect.center().y), Vec2::splat(16.0));
        icons::paint(ui.painter(), chevron, Icon::ChevronDown, tokens.muted);
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label));
    response
}

/// A line of a menu; `on` marks the one in force.
pub(super) fn menu_item(ui: &mut Ui, text: &str, on: bool) -> Response {
    let tokens = Tokens::of(ui);
    let color = if on { tokens.accent } else { tokens.text };
    let galley = ui
        .painter()
        .layout_no_wrap(text.to_owned(), FontId::proportional(13.0), color);
    let width = ui.available_width().max(galley.size().x + 20.0);
    let height = if is_touch(ui) { TOUCH_CONTROL } else { 26.0 };
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::click());
    if on {
        ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.accent_ground);
    } else if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field_hovered);
    }
    ui.painter().galley(
        pos2(rect.min.x + 10.0, rect.center().y - galley.size().y * 0.5),
        galley,
        color,
    );
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, on, text));
    response
}

/// A small rounded label.
pub(super) fn chip(ui: &mut Ui, text: &str, color: Color32) -> Response {
    let tokens = Tokens::of(ui);
    let galley = ui
        .painter()
        .layout_no_wrap(text.to_owned(), FontId::proportional(11.5), color);
    let (rect, response) = ui.allocate_exact_size(galley.size() + vec2(14.0, 5.0), Sense::hover());
    ui.painter().rect_filled(rect, rect.height() * 0.5, tokens.field);
    ui.painter().galley(rect.min + vec2(7.0, 2.5), galley, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    response
}

/// A row of a panel: a quiet label and a value at the right edge.
pub(super) fn value_row(ui: &mut Ui, label: &str, value: &str) -> Response {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), Sense::hover());
    let font = FontId::proportional(13.0);
    ui.painter().text(
        rect.left_center(),
        Align2::LEFT_CENTER,
        label,
        font.clone(),
        tokens.muted,
    );
    ui.painter()
        .text(rect.right_center(), Align2::RIGHT_CENTER, value, font, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{label} {value}")));
    response
}

/// A row of a panel whose value opens a menu.
pub(super) fn choice_row(ui: &mut Ui, label: &str, value: &str, how: &str) -> Response {
    let tokens = Tokens::of(ui);
    let height = if is_touch(ui) { 44.0 } else { ROW_HEIGHT };
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click());
    if response.hovered() || response.has_focus() {
        ui.painter()
            .rect_filled(rect.expand2(vec2(6.0, 0.0)), CONTROL_RADIUS, tokens.field);
    }
    let font = FontId::proportional(13.0);
    ui.painter().text(
        rect.left_center(),
        Align2::LEFT_CENTER,
        label,
        font.clone(),
        tokens.muted,
    );
    let chevron = Rect::from_center_size(pos2(rect.max.x - 5.0, rect.center().y), Vec2::splat(16.0));
    icons::paint(ui.painter(), chevron, Icon::ChevronDown, tokens.muted);
    let mut right = rect.max.x - 15.0;
    for (text, color) in [(how, tokens.muted), (value, tokens.text)] {
        let drawn = ui.painter().text(
            pos2(right, rect.center().y),
            Align2::RIGHT_CENTER,
            text,
            font.clone(),
            color,
        );
        right = drawn.min.x - 4.0;
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{label}: {value} {how}")));
    response
}

/// The title of a panel with a button that closes it. Whether it was clicked.
pub(super) fn closable_heading(ui: &mut Ui, title: &str) -> bool {
    ui.horizontal(|ui| {
        let width = ui.available_width() - control_size(ui) - 6.0;
        let (heading, _) = ui.allocate_exact_size(vec2(width, MOUSE_CONTROL), Sense::hover());
        let (at, color) = (heading.left_center(), Tokens::of(ui).text);
        ui.painter()
            .text(at, Align2::LEFT_CENTER, title, theme::semibold(13.0), color);
        icon_button(ui, Icon::Close, "Close", false).clicked()
    })
    .inner
}

/// The name of a part of a panel: 11 points, capitals.
pub(super) fn section_name(ui: &mut Ui, name: &str) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 20.0), Sense::hover());
    let font = theme::semibold(11.0);
    ui.painter().text(
        rect.left_center(),
        Align2::LEFT_CENTER,
        name.to_uppercase(),
        font,
        tokens.muted,
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, name));
}

/// A hairline across a panel, from border to border.
pub(super) fn rule(ui: &mut Ui, panel_margin: f32) {
    let tokens = Tokens::of(ui);
    ui.add_space(7.0);
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 1.0), Sense::hover());
    let rect = rect.expand2(vec2(panel_margin, 0.0));
    ui.painter()
        .hline(rect.x_range(), rect.center().y, Stroke::new(1.0, tokens.hairline));
    ui.add_space(7.0);
}

/// The grip of the bottom sheet.
pub(super) fn sheet_handle(ui: &mut Ui, open: bool) -> Response {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 24.0), Sense::hover());
    // A finger may also take hold of it a little above the sheet.
    let above = (control_size(ui) - rect.height()).max(0.0);
    let target = Rect::from_min_max(pos2(rect.min.x, rect.min.y - above), rect.max);
    let response = ui.interact(target, response.id.with("grip"), Sense::click());
    let grip = Rect::from_center_size(rect.center(), vec2(38.0, 4.0));
    ui.painter().rect_filled(
        grip,
        2.0,
        if response.hovered() {
            tokens.faint
        } else {
            tokens.hairline
        },
    );
    let label = if open { "Close the sheet" } else { "Model facts" };
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label));
    response
}

/// Shows which control has the keyboard.
pub(super) fn focus_ring(ui: &Ui, rect: Rect, response: &Response) {
    if response.has_focus() {
        let stroke = Stroke::new(1.5, Tokens::of(ui).accent);
        ui.painter()
            .rect_stroke(rect, CornerRadius::same(CONTROL_RADIUS), stroke, StrokeKind::Inside);
    }
}

impl Tokens {
    /// The colour of an icon: muted, and full under the pointer.
    pub fn muted_to_text(&self, hovered: bool) -> Color32 {
        if hovered { self.text } else { self.muted }
    }
}

/// A whole number with its thousands grouped by narrow spaces: `13 748`.
pub(super) fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3 * 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// A length with about three significant digits: `73.4`, `0.0123`, `13 748`.
pub(super) fn measured(length: f32) -> String {
    match length.abs() {
        _ if !length.is_finite() => "–".to_owned(),
        0.0 => "0".to_owned(),
        size if !(1e-3..1e7).contains(&size) => format!("{length:.2e}"),
        size if size >= 1000.0 => {
            let sign = if length < 0.0 { "−" } else { "" };
            format!("{sign}{}", grouped(size.round() as usize))
        }
        size if size >= 100.0 => format!("{length:.0}"),
        size if size >= 10.0 => format!("{length:.1}"),
        size if size >= 1.0 => format!("{length:.2}"),
        size if size >= 0.1 => format!("{length:.3}"),
        size if size >= 0.01 => format!("{length:.4}"),
        _ => format!("{length:.5}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_grouped() {
        let cases = [
            (0, "0"),
            (999, "999"),
            (1000, "1\u{2009}000"),
            (13_748, "13\u{2009}748"),
            (1_234_567, "1\u{2009}234\u{2009}567"),
        ];
        for (number, text) in cases {
            assert_eq!(grouped(number), text);
        }
    }

    #[test]
    fn lengths_keep_about_three_digits() {
        let cases = [
            (0.0, "0"),
            (73.42, "73.4"),
            (1.8, "1.80"),
            (0.437_6, "0.438"),
            (0.012_34, "0.0123"),
            (1e9, "1.00e9"),
            (-2000.0, "−2\u{2009}000"),
            (f32::NAN, "–"),
        ];
        for (length, text) in cases {
            assert_eq!(measured(length), text);
        }
    }
}
