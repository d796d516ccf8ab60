//! The canvas with what eframe does to it: its size, and the focus beside it.

use wasm_bindgen::prelude::*;
use web_sys::{HtmlCanvasElement, HtmlElement};

/// Gives the canvas as many pixels as it has on the display. A browser that emulates a device reports them without the device's scale, and
/// eframe believes that.
pub(super) fn fit_canvas(canvas: &HtmlCanvasElement, input: &mut egui::RawInput) {
    let scale = web_sys::window().map_or(1.0, |window| window.device_pixel_ratio()) as f32;
    let points = egui::vec2(canvas.client_width() as f32, canvas.client_height() as f32);
    let wanted = (points * scale).round();
    let off = (wanted - egui::vec2(canvas.width() as f32, canvas.height() as f32)).abs();
    // The points are whole ones, so that the browser's pixels may be some more or less.
    if points.min_elem() > 0.0 && off.max_elem() > 2.0 * scale.max(1.0) {
        canvas.set_width(wanted.x as u32);
        canvas.set_height(wanted.y as u32);
        input.screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, points));
    }
}

/// The element that has the focus; `None` when that is nothing but the page itself.
pub(super) fn focused_element() -> Option<HtmlElement> {
    let document = web_sys::window()?.document()?;
    let element = document.active_element()?.dyn_into::<HtmlElement>().ok()?;
    (document.body().as_ref() != Some(&element)).then_some(element)
}

/// Gives the focus back to another viewer or a field of the page: eframe takes it when it starts on a canvas, for the hidden input that it
/// puts behind the canvas.
pub(super) fn leave_focus(canvas: &HtmlCanvasElement, element: &HtmlElement) {
    let taken_by = focused_element().map(web_sys::Element::from);
    if taken_by.is_some() && taken_by == canvas.next_element_sibling() {
        let options = web_sys::FocusOptions::new();
        options.set_prevent_scroll(true);
        let _ = element.focus_with_options(&options);
    }
}
