//! The canvas that a viewer runs on: its size, the focus beside it, its device and WebGL context.

use std::sync::mpsc;

use wasm_bindgen::prelude::*;
use web_sys::{HtmlCanvasElement, HtmlElement, WebGl2RenderingContext, WebglLoseContext};

use super::text_of;

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

/// Logs the errors of a device that nobody waits for, and has the next frame hear of its loss: the callback may not hold what belongs to
/// one thread.
pub(super) fn watch_device(device: &egui_wgpu::wgpu::Device, ctx: &egui::Context, tell_of_loss: mpsc::Sender<String>) {
    device.on_uncaptured_error(std::sync::Arc::new(|error: egui_wgpu::wgpu::Error| {
        web_sys::console::error_1(&format!("GPU error: {error}").into());
    }));
    let ctx = ctx.clone();
    device.set_device_lost_callback(move |reason, message| {
        let by_us = reason == egui_wgpu::wgpu::DeviceLostReason::Destroyed && message.is_empty();
        if !by_us && tell_of_loss.send(message).is_ok() {
            ctx.request_repaint();
        }
    });
}

/// Frees what WebGL holds for a canvas. A browser lets few contexts live, 16 in Chromium, and loses the oldest for a further one.
pub(super) fn lose_context(canvas: &HtmlCanvasElement) {
    // A canvas of WebGPU has none.
    if let Ok(Some(context)) = canvas.get_context("webgl2")
        && let Ok(Some(extension)) = context
            .unchecked_into::<WebGl2RenderingContext>()
            .get_extension("WEBGL_lose_context")
    {
        extension.unchecked_into::<WebglLoseContext>().lose_context();
    }
}

/// Tells of a lost WebGL context of a canvas, until it is dropped.
pub(super) struct ContextWatch {
    canvas: HtmlCanvasElement,
    on_lost: Closure<dyn FnMut(web_sys::Event)>,
}

impl ContextWatch {
    const EVENT: &str = "webglcontextlost";

    pub(super) fn new(canvas: &HtmlCanvasElement, tell: impl Fn() + 'static) -> Result<Self, JsError> {
        let on_lost = Closure::<dyn FnMut(web_sys::Event)>::new(move |event: web_sys::Event| {
            event.prevent_default();
            tell();
        });
        canvas
            .add_event_listener_with_callback(Self::EVENT, on_lost.as_ref().unchecked_ref())
            .map_err(|error| JsError::new(&text_of(&error)))?;
        Ok(Self {
            canvas: canvas.clone(),
            on_lost,
        })
    }
}

impl Drop for ContextWatch {
    fn drop(&mut self) {
        let listener = self.on_lost.as_ref().unchecked_ref();
        let _ = self.canvas.remove_event_listener_with_callback(Self::EVENT, listener);
    }
}
