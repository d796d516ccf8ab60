//! The device and the WebGL context of the canvas that a viewer runs on: their loss, and giving them back.

use std::sync::{Arc, mpsc};
use std::task::Waker;

use js_sys::Function;
use wasm_bindgen::prelude::*;
use web_sys::{HtmlCanvasElement, WebGl2RenderingContext, WebglLoseContext};

use super::{field, text_of};

/// Logs the errors of a device that nobody waits for, and tells of its loss: then the waker is woken, since the callback may not hold what
/// belongs to one thread.
pub(super) fn watch_device(device: &wgpu::Device, waker: Waker, tell_of_loss: mpsc::Sender<String>) {
    device.on_uncaptured_error(Arc::new(|error: wgpu::Error| {
        web_sys::console::error_1(&format!("GPU error: {error}").into());
    }));
    device.set_device_lost_callback(move |reason, message| {
        let by_us = reason == wgpu::DeviceLostReason::Destroyed && message.is_empty();
        if !by_us && tell_of_loss.send(message).is_ok() {
            waker.wake_by_ref();
        }
    });
}

/// Frees what the browser holds for a canvas, before its device is destroyed. It lets few contexts of WebGL live, 16 in Chromium, and loses the oldest for a
/// further one.
pub(super) fn lose_context(canvas: &HtmlCanvasElement) {
    // A canvas has a context of one kind.
    if let Ok(Some(context)) = canvas.get_context("webgl2")
        && let Ok(Some(extension)) = context
            .unchecked_into::<WebGl2RenderingContext>()
            .get_extension("WEBGL_lose_context")
    {
        extension.unchecked_into::<WebglLoseContext>().lose_context();
    } else if let Ok(Some(context)) = canvas.get_context("webgpu")
        && let Ok(unconfigure) = field(&context, "unconfigure").dyn_into::<Function>()
    {
        let _ = unconfigure.call0(&context);
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
