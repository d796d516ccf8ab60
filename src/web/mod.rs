//! The browser: viewers as handles, their interface for scripts, panics and lost devices. The only module with web code.
//!
//! A script makes a [`viewer::Viewer`], starts it on a canvas and calls its methods. A viewer owns what is open, and for each start its canvas'
//! listeners and frames; several may run on one page. It knows no id of the page and adds listeners only to its canvas. After a lost GPU
//! the page gives the viewer a fresh canvas, which shows what was open.
//!
//! There are two rims, of which a program has one. [`page`] has the panels: eframe brings frames and input. It adds listeners to document and window too, for drags,
//! the clipboard and the colour scheme, and acts on those that are meant for its canvas or its hidden input. [`element`] is without egui: scripts
//! hand it the input. A rim gives an `App`, its `Frames`, a `Face` and `run`; what scripts call is one class over either.

mod arguments;
mod backend;
mod canvas;
mod drawing;
#[cfg(not(feature = "viewer"))]
mod element;
mod link;
mod opening;
#[cfg(feature = "viewer")]
mod page;
mod picture;
mod playing;
mod shared;
mod start;
mod state;
mod timings;
mod viewer;

use js_sys::{Object, Promise, Reflect};
use wasm_bindgen::prelude::*;

#[cfg(not(feature = "viewer"))]
use element as rim;
#[cfg(feature = "viewer")]
use page as rim;

/// The promise of what `work` gives.
fn promise<E: Into<JsValue>>(work: impl Future<Output = Result<JsValue, E>> + 'static) -> Promise {
    wasm_bindgen_futures::future_to_promise(async { work.await.map_err(Into::into) })
}

/// The error of what was ended because something newer took its place, with the name that browsers give it.
fn abort_error(message: &str) -> JsValue {
    named_error("AbortError", message)
}

/// An error that is told from others by its name.
fn named_error(name: &str, message: &str) -> JsValue {
    let error = js_sys::Error::new(message);
    error.set_name(name);
    error.into()
}

/// A field of an object; `undefined` where there is none.
fn field(object: &JsValue, name: &str) -> JsValue {
    Reflect::get(object, &name.into()).unwrap_or(JsValue::UNDEFINED)
}

fn is_absent(value: &JsValue) -> bool {
    value.is_undefined() || value.is_null()
}

fn object<const COUNT: usize>(fields: [(&str, JsValue); COUNT]) -> JsValue {
    let object = Object::new();
    for (name, value) in fields {
        // Setting a field of a fresh plain object cannot fail.
        let _ = Reflect::set(&object, &name.into(), &value);
    }
    object.into()
}

fn text_of(value: &JsValue) -> String {
    value.as_string().unwrap_or_else(|| format!("{value:?}"))
}

/// Whether the person asks the browser for reduced motion.
fn reduced_motion() -> bool {
    matches_media("(prefers-reduced-motion: reduce)")
}

/// Whether the main pointer is a finger.
fn coarse_pointer() -> bool {
    matches_media("(pointer: coarse)")
}

/// Seconds since the page began; 0 where the browser has no such clock.
fn now_secs() -> f64 {
    let clock = web_sys::window().and_then(|window| window.performance());
    clock.map_or(0.0, |clock| clock.now() * 1e-3)
}

fn matches_media(query: &str) -> bool {
    media_query(query).is_some_and(|query| query.matches())
}

fn media_query(query: &str) -> Option<web_sys::MediaQueryList> {
    web_sys::window()?.match_media(query).ok()?
}

/// Waits for a task of its own, so that input and frames that are due come first. A message is used since timers wait longer, and
/// up to a minute in a hidden tab.
async fn next_task() {
    let Ok(channel) = web_sys::MessageChannel::new() else {
        return sleep(0).await;
    };
    let promise = Promise::new(&mut |resolve, _| {
        channel.port1().set_onmessage(Some(&resolve));
        if channel.port2().post_message(&JsValue::NULL).is_err() {
            let _ = resolve.call0(&JsValue::NULL);
        }
    });
    let _ = wasm_bindgen_futures::JsFuture::from(promise).await;
    channel.port1().close();
}

/// Waits without holding the page up.
async fn sleep(milliseconds: i32) {
    let promise = Promise::new(&mut |resolve, _| {
        let window = web_sys::window();
        let asked = window.map(|w| w.set_timeout_with_callback_and_timeout_and_arguments_0(&resolve, milliseconds));
        if !matches!(asked, Some(Ok(_))) {
            let _ = resolve.call0(&JsValue::NULL);
        }
    });
    let _ = wasm_bindgen_futures::JsFuture::from(promise).await;
}
