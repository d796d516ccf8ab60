//! The viewer as scripts have it: its life on a page. Every call acts on the session at once; the window draws it in its next frame. The
//! calls about opening, playing and drawing are in files of their own, and so are those of one rim alone.

use std::rc::Rc;
use std::sync::Once;

use js_sys::{Function, Promise};
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::arguments::{checked, given};
use super::backend::Preference;
use super::picture::{AppSlot, Drawn};
use super::rim::Face;
use super::shared::Shared;
use super::{field, picture, promise, reduced_motion, start, state};
use crate::scene::Light;
use crate::script;
use crate::session::{Command, LookCommand, QualityCommand, QualityMode, RenderScale, Session};

/// A viewer: what is open and how it is viewed, and the canvas that it is drawn on, if any.
///
/// `free()`, or losing the handle to the garbage collector, gives the canvas, its listeners and its frames back, and forgets what is open.
/// A panic ends every viewer of the page, since they share a memory; see [`report_panics`].
#[wasm_bindgen]
pub struct Viewer {
    pub(super) shared: Rc<Shared>,
}

#[wasm_bindgen]
impl Viewer {
    /// Makes a viewer with nothing open and no canvas.
    ///
    /// `options`: `{renderScale: number, quality: "auto" | "full" | "low", samples: number, displaySecs: number}`, 1 and
    /// `auto` where they are absent; `samples` is as `setQuality` takes it; `displaySecs` is how often the display shows a picture, 60 times a
    /// second where it is absent. `theme`, `light` and `split` are as the state has them; `ui` is `none`, `transport` or `full`, in the program that has panels.
    ///
    /// `on_event(type, detail)` hears of `load`, `error`, `play`, `pause`, `timeupdate` and `playbackchange`; of `devicelost` (`{reason}`);
    /// and of frames after which a link may be another: `settling`, and `moving` once while that goes on by itself or something is held.
    /// The callback may call any method but `free`.
    ///
    /// The program with panels also tells of what only the page can do: `pickfiles`, `pickclips`, `readagain`, `picture` (`{name, bytes}`, and
    /// `choosesPlace` where the person asks where to save it), `picturefailed` (`{message}`), `greetingclosed` after `greet`, `save`
    /// (`{name, contents, type}`: a file to save, as text or bytes), `explain` (`{code}`: its place on the page of codes), `copylink`
    /// (`{embed}`: whether as an element) and `announce` (`{text, assertive}`); and of its controls, for `web/mirror.js`: `mirror` (`{changes, view}`).
    #[wasm_bindgen(constructor)]
    pub fn new(options: &JsValue, on_event: Function) -> Self {
        report_panics();
        let mut session = Session::new(reduced_motion());
        let scale = field(options, "renderScale").as_f64().unwrap_or(1.0);
        session.apply(QualityCommand::SetRenderScale(RenderScale::new(scale as f32)));
        if let Some(secs) = field(options, "displaySecs").as_f64() {
            session.apply(QualityCommand::SetDisplayInterval(secs as f32));
        }
        let named = field(options, "quality").as_string();
        if let Some(mode) = named.and_then(|name| QualityMode::from_name(&name)) {
            session.apply(QualityCommand::SetMode(mode));
        }
        if let Some(samples) = field(options, "samples").as_f64() {
            session.apply(QualityCommand::SetSamples(
                Some(samples as u32).filter(|&samples| samples > 0),
            ));
        }
        session.apply(QualityCommand::SetSparing(reduced_motion()));
        let named = field(options, "light").as_string();
        if let Some(light) = named.and_then(|name| Light::from_name(&name)) {
            session.apply(LookCommand::SetLight(light));
        }
        if let Some(split) = field(options, "split").as_f64() {
            session.apply(LookCommand::SetSplit(Some(split as f32)));
        }
        Self {
            shared: Rc::new(Shared::new(session, Face::new(options), on_event)),
        }
    }

    /// Starts on a canvas that was never drawn on, instead of the canvas that it has. What is open stays.
    ///
    /// `options`: `{backend: "auto" | "webgpu" | "webgl2"}`. Resolves with `{backend, adapter}` when the first frame was drawn. Rejects when no
    /// backend works, with the reasons of each that was tried, and when another start or a stop came meanwhile. The error is called `WebGl2Missing`
    /// where WebGL2 would be next and this program is the one without it; the canvas was not drawn on then.
    pub fn start(&self, canvas: HtmlCanvasElement, options: &JsValue) -> Promise {
        let preference = Preference::from_name(&field(options, "backend").as_string().unwrap_or_default());
        promise(start::start(Rc::clone(&self.shared), canvas, preference))
    }

    /// Gives the canvas back, also one on which a start is under way, with its listeners and frames. What is open stays.
    /// The canvas is free when the script that called it has come to its end.
    pub fn stop(&self) {
        self.shared.stop();
    }

    /// Learns whether anybody can see the canvas. Nothing is drawn while nobody can.
    #[wasm_bindgen(js_name = setVisible)]
    pub fn set_visible(&self, visible: bool) {
        self.shared.face.is_out_of_sight.set(!visible);
        self.shared.request_repaint();
    }

    /// The session and what runs it, as one plain object.
    pub fn state(&self) -> JsValue {
        self.shared.state()
    }

    /// A picture of the view without the interface, as the bytes of a PNG. `width` and `height` are those of the canvas where they are
    /// absent. `transparent`, `light`, `viewMode`, `background`, `split` and `overlays` (an array of names) may have it drawn in another
    /// way than the window shows; the names are those of the command line. It is the mean of so many `samples`, 1 to 4096, where they are
    /// given; `aperture`, 0 to 0.5, is the lens' diameter as a part of the distance to what is in focus.
    ///
    /// Rejects when the viewer is not running, the size is not possible, a name is none, or the GPU fails.
    pub fn snapshot(&self, options: JsValue) -> Promise {
        let running = self.shared.app_and_size();
        promise(async {
            let (app, canvas_size) = running.ok_or_else(picture::not_running)?;
            picture::snapshot(app, canvas_size, options).await
        })
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        self.shared.silence();
        self.shared.stop();
    }
}

impl Shared {
    /// The app while it runs, and the size of its canvas in pixels.
    pub(super) fn app_and_size(&self) -> Option<(AppSlot, [u32; 2])> {
        let running = self.running.borrow();
        let running = running.as_ref()?;
        let canvas = &running.canvas;
        Some((Rc::clone(&running.app), [canvas.width(), canvas.height()]))
    }

    /// See [`Viewer::state`].
    pub(super) fn state(&self) -> JsValue {
        let running = self.running.borrow();
        let running = running.as_ref();
        let link = self.link(0).text;
        state::to_js(&state::State::new(
            &self.session.borrow(),
            running.map(|running| running.backend),
            running.map(|running| running.adapter.as_str()),
            running.map_or(Drawn::NOTHING, |running| running.drawn.get()),
            (self.face.theme(), link),
            self.timings.millis(),
        ))
    }

    /// Applies a command, asks for a frame and tells of what happened.
    pub(super) fn apply(&self, command: impl Into<Command>) {
        self.session.borrow_mut().apply(command);
        self.tell_of_changes();
    }

    pub(super) fn tell_of_changes(&self) {
        self.request_repaint();
        self.emit_events();
    }

    pub(super) fn request_repaint(&self) {
        if let Some(running) = &*self.running.borrow() {
            running.frames.request();
        }
    }

    /// Applies a command with the value of this name. Returns whether there is one.
    pub(super) fn apply_named<T, C: Into<Command>>(
        &self,
        call: &str,
        name: &JsValue,
        value: impl FnOnce(&str) -> Option<T>,
        command: impl FnOnce(T) -> C,
    ) -> Result<bool, JsValue> {
        let given = given(name);
        let name = checked(script::name(call, &given))?;
        Ok(self.apply_to(value(name), command))
    }

    /// Applies a command with a value, if there is one. Returns whether there is.
    pub(super) fn apply_to<T, C: Into<Command>>(&self, value: Option<T>, command: impl FnOnce(T) -> C) -> bool {
        let is_there = value.is_some();
        if let Some(value) = value {
            self.apply(command(value));
        }
        is_there
    }
}

/// Has every panic reported as an uncaught error of the page, with the name `Panic` and the panic's words as message.
///
/// A panic ends the whole program, so the page is told once, as browsers tell of uncaught errors, and not each viewer. A `RuntimeError`
/// follows. It is all that a browser without `reportError` tells.
fn report_panics() {
    static INSTALLED: Once = Once::new();
    // This hook must be older than those of eframe: each runner installs one, which logs, stops that runner and calls the hook before it.
    INSTALLED.call_once(|| {
        std::panic::set_hook(Box::new(|info| {
            let error = js_sys::Error::new(&info.to_string());
            error.set_name("Panic");
            let global = js_sys::global();
            if let Ok(report) = field(&global, "reportError").dyn_into::<Function>() {
                let _ = report.call1(&global, &error);
            }
        }));
    });
}
