//! A colour picker: a square of saturation and value, a bar of hues, a field for the hexadecimal number. Painted here: egui's picker has
//! no such field, and interpolates in linear light.

use egui::accesskit::HasPopup;
use egui::ecolor::{hsv_from_rgb, rgb_from_hsv};
use egui::{
    Color32, CornerRadius, CursorIcon, Key, Mesh, Modifiers, Popup, PopupCloseBehavior, Pos2, Rangef, Rect, Response,
    Role, Sense, Shape, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, lerp, pos2, vec2,
};

use super::control::{MOUSE_CONTROL, control_size, focus_ring, hint_of_name, tell_popup};
use super::keys::{SliderNode, slider_keys};
use super::number::TypedValue;
use crate::scene::srgb8_from_linear;
use crate::ui::kit::theme::{CONTROL_RADIUS, Tokens};

const SQUARE_HEIGHT: f32 = 112.0;
/// A step of the arrow keys, as a fraction of the whole.
const KEY_STEP: f64 = 0.02;
/// Cells of the square's mesh on a side. Two triangles alone would bend the colours along the diagonal.
const SQUARE_FIELDS: u32 = 8;

/// A button in a colour (sRGB) that opens the picker. Returns a new colour.
pub(crate) fn color_button(ui: &mut Ui, label: &str, size: Vec2, srgb: [u8; 3]) -> Option<[u8; 3]> {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    ui.painter().rect_filled(rect, CONTROL_RADIUS, color32(srgb));
    // A dark colour on a dark panel still has an outline.
    let outline = if response.hovered() {
        tokens.muted
    } else {
        tokens.field_hovered
    };
    let radius = CornerRadius::same(CONTROL_RADIUS);
    ui.painter()
        .rect_stroke(rect, radius, Stroke::new(1.0, outline), StrokeKind::Inside);
    focus_ring(ui, rect, &response);
    let name = format!("{label}: {}", hex(srgb));
    response.widget_info(|| WidgetInfo::labeled(Role::ColorWell, true, &name));
    let mut chosen = None;
    tell_popup(ui, &response, HasPopup::Dialog);
    Popup::from_toggle_button_response(&response)
        .accessible_name(label)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .gap(6.0)
        .show(|ui| {
            ui.set_width(200.0);
            chosen = color_picker(ui, label, srgb);
        });
    hint_of_name(response, &name);
    chosen
}

/// The picker, over the whole width. Returns a new colour.
pub(crate) fn color_picker(ui: &mut Ui, label: &str, srgb: [u8; 3]) -> Option<[u8; 3]> {
    let id = ui.make_persistent_id(("picker", label));
    // Grey has no hue and black has no saturation, so the last chosen ones are kept.
    let kept = ui.data(|data| data.get_temp::<Hsv>(id));
    let hsv = kept
        .filter(|&kept| srgb_from_hsv(kept) == srgb)
        .unwrap_or_else(|| hsv_from_srgb(srgb));
    let mut asked = square(ui, label, hsv);
    ui.add_space(8.0);
    asked = hue_bar(ui, label, hsv).or(asked);
    if let Some(asked) = asked {
        ui.data_mut(|data| data.insert_temp(id, asked));
    }
    ui.add_space(8.0);
    let typed = ui
        .horizontal(|ui| {
            let (swatch, _) = ui.allocate_exact_size(Vec2::splat(MOUSE_CONTROL), Sense::hover());
            ui.painter().rect_filled(swatch, CONTROL_RADIUS, color32(srgb));
            // Typing changes the colour as soon as the text is one.
            let (name, text) = (format!("{label}: number"), hex(srgb));
            let field = TypedValue::new(ui, &name, &text, &text).at_once();
            let read = |typed: &str| from_hex(typed).ok_or_else(|| "Six digits 0–9, a–f: #5aa9ff".to_owned());
            field.width(ui.available_width()).show(ui, read).0
        })
        .inner;
    typed.or(asked.map(srgb_from_hsv)).filter(|&chosen| chosen != srgb)
}

fn square(ui: &mut Ui, label: &str, [hue, saturation, value]: Hsv) -> Option<Hsv> {
    let size = vec2(ui.available_width(), SQUARE_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let response = response.on_hover_cursor(CursorIcon::Crosshair);
    let mut mesh = Mesh::default();
    let side = SQUARE_FIELDS + 1;
    for (row, column) in (0..side).flat_map(|row| (0..side).map(move |column| (row, column))) {
        let fraction = vec2(column as f32, row as f32) / SQUARE_FIELDS as f32;
        let at = rect.min + fraction * rect.size();
        mesh.colored_vertex(at, color32(srgb_from_hsv([hue, fraction.x, 1.0 - fraction.y])));
        if row > 0 && column > 0 {
            let here = row * side + column;
            mesh.add_triangle(here, here - 1, here - side);
            mesh.add_triangle(here - 1, here - side, here - side - 1);
        }
    }
    ui.painter().add(Shape::mesh(mesh));
    let at = rect.min + vec2(saturation, 1.0 - value) * rect.size();
    mark(ui, at, color32(srgb_from_hsv([hue, saturation, value])));
    focus_ring(ui, rect, &response);
    let text = format!(
        "saturation {:.0} %, brightness {:.0} %",
        saturation * 100.0,
        value * 100.0
    );
    // Up and down are of the brightness. All that is left for a slider of one value is of the saturation.
    let brighter = vertical_steps(ui, &response);
    if brighter != 0.0 {
        return Some([hue, saturation, (value + brighter * KEY_STEP as f32).clamp(0.0, 1.0)]);
    }
    let name = format!("{label}: saturation and brightness");
    if let Some(saturation) = keyed(ui, &response, &name, saturation, &text) {
        return Some([hue, saturation, value]);
    }
    let at = held(&response)?;
    Some([hue, at.x, 1.0 - at.y])
}

/// A gradient of colours from left to right.
pub(crate) fn gradient_shape(height: Rangef, colors: impl Iterator<Item = (f32, Color32)>) -> Shape {
    let mut mesh = Mesh::default();
    for (index, (x, color)) in (0u32..).zip(colors) {
        mesh.colored_vertex(pos2(x, height.min), color);
        mesh.colored_vertex(pos2(x, height.max), color);
        if index > 0 {
            let here = 2 * index;
            mesh.add_triangle(here - 2, here - 1, here);
            mesh.add_triangle(here - 1, here, here + 1);
        }
    }
    Shape::mesh(mesh)
}

fn hue_bar(ui: &mut Ui, label: &str, [hue, saturation, value]: Hsv) -> Option<Hsv> {
    let height = if control_size(ui) > MOUSE_CONTROL { 28.0 } else { 14.0 };
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click_and_drag());
    let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    let colors = (0..=6).map(|sixth| {
        let fraction = sixth as f32 / 6.0;
        (
            lerp(rect.x_range(), fraction),
            color32(srgb_from_hsv([fraction, 1.0, 1.0])),
        )
    });
    ui.painter().add(gradient_shape(rect.y_range(), colors));
    let at = pos2(lerp(rect.x_range(), hue), rect.center().y);
    mark(ui, at, color32(srgb_from_hsv([hue, 1.0, 1.0])));
    focus_ring(ui, rect, &response);
    let text = format!("{:.0}°", hue * 360.0);
    let hue = keyed(ui, &response, &format!("{label}: hue"), hue, &text).or_else(|| Some(held(&response)?.x))?;
    Some([hue, saturation, value])
}

/// Steps of the keys up and down in a focused control. They are consumed.
fn vertical_steps(ui: &Ui, response: &Response) -> f32 {
    if !response.has_focus() {
        return 0.0;
    }
    let count = |key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key)) as f32;
    count(Key::ArrowUp) - count(Key::ArrowDown)
}

/// The fraction, 0…1, that keys or a screen reader ask for.
fn keyed(ui: &Ui, response: &Response, name: &str, fraction: f32, text: &str) -> Option<f32> {
    let slider = SliderNode {
        name,
        value: f64::from(fraction),
        range: 0.0..=1.0,
        step: KEY_STEP,
        text,
    };
    slider_keys(ui, response, &slider).map(|fraction| fraction as f32)
}

/// Where the pointer presses a control, as fractions of its width and height, 0…1.
fn held(response: &Response) -> Option<Vec2> {
    let holds = response.is_pointer_button_down_on() || response.clicked();
    let at = response.interact_pointer_pos().filter(|_| holds)?;
    let fraction = (at - response.rect.min) / response.rect.size().max(Vec2::splat(1.0));
    Some(fraction.clamp(Vec2::ZERO, Vec2::splat(1.0)))
}

/// A ring that is visible on every colour.
fn mark(ui: &Ui, at: Pos2, color: Color32) {
    ui.painter()
        .circle(at, 6.0, color, Stroke::new(3.0, Color32::from_black_alpha(90)));
    ui.painter().circle_stroke(at, 6.0, Stroke::new(1.6, Color32::WHITE));
}

/// A square in a colour (linear).
pub(crate) fn paint_swatch(ui: &Ui, center: Pos2, color: [f32; 3], opacity: f32) {
    let swatch = Rect::from_center_size(center, vec2(10.0, 10.0));
    let color = color32_from_linear(color).gamma_multiply(opacity);
    ui.painter().rect_filled(swatch, 2.5, color);
    // A dark material on a dark panel still has an outline.
    let outline = Stroke::new(1.0, Tokens::of(ui).field_hovered);
    ui.painter().rect_stroke(swatch, 2.5, outline, StrokeKind::Inside);
}

/// A linear colour as egui paints it.
fn color32_from_linear(linear: [f32; 3]) -> Color32 {
    color32(linear.map(srgb8_from_linear))
}

fn color32([red, green, blue]: [u8; 3]) -> Color32 {
    Color32::from_rgb(red, green, blue)
}

pub fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Three or six hexadecimal digits, with or without the mark before them.
pub fn from_hex(text: &str) -> Option<[u8; 3]> {
    let digits = text.trim().trim_start_matches('#');
    // A sign before the digits would be read as a part of the number.
    let value = u32::from_str_radix(digits, 16)
        .ok()
        .filter(|_| digits.bytes().all(|byte| byte.is_ascii_hexdigit()))?;
    match digits.len() {
        6 => Some([16, 8, 0].map(|shift| (value >> shift) as u8)),
        3 => Some([8, 4, 0].map(|shift| (value >> shift & 0xF) as u8 * 0x11)),
        _ => None,
    }
}

type Hsv = [f32; 3];

/// Converts from sRGB. Grey has hue 0, black has saturation 0 too.
pub fn hsv_from_srgb(srgb: [u8; 3]) -> Hsv {
    hsv_from_rgb(srgb.map(|channel| f32::from(channel) / 255.0)).into()
}

/// Converts to sRGB, rounded.
pub fn srgb_from_hsv(hsv: Hsv) -> [u8; 3] {
    rgb_from_hsv(hsv.into()).map(|channel| (channel * 255.0).round() as u8)
}
