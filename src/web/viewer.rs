//! The viewer as scripts have it. Every call acts on the session at once; the window draws it in its next frame.

use std::rc::Rc;
use std::sync::{Arc, Once};

use js_sys::{Array, Function, Promise, RangeError, TypeError, Uint8Array};
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::backend::Preference;
use super::mirror::MirrorLink;
use super::run::{self, Shared};
use super::{abort_error, field, is_absent, next_task, picture, promise, reduced_motion, state};
use crate::anim::{Direction, LoopMode, WrapMode};
use crate::scene::Pass;
use crate::script::{self, Given, Misuse};
use crate::session::{
    Command, File, FileCommand, HistoryCommand, LoadJob, LoadStep, PassChoice, PlayCommand, QualityCommand,
    QualityMode, RenderScale, Session,
};

/// Why an opening failed that was followed by another one, or by the viewer's end.
const OVERTAKEN: &str = "another opening came after this one";

/// A viewer: what is open and how it is viewed, and the canvas that it is drawn on, if any.
///
/// `free()`, or losing the handle to the garbage collector, gives the canvas, its listeners and its frames back, and forgets what is open.
/// A panic ends every viewer of the page, since they share a memory; see [`report_panics`].
#[wasm_bindgen]
pub struct Viewer {
    shared: Rc<Shared>,
}

#[wasm_bindgen]
impl Viewer {
    /// Makes a viewer with nothing open and no canvas.
    ///
    /// `options`: `{renderScale: number, quality: "auto" | "full" | "low", displaySecs: number, mirrored: boolean}`, 1, `auto` and false where
    /// they are absent; `displaySecs` is how often the display shows a picture, 60 times a second where it is absent. `on_event(type, detail)`
    /// hears of `load`, `error`, `play`, `pause`, `timeupdate` and `playbackchange`; of `devicelost` (`{reason}`); and of what only the page
    /// can do: `pickfiles`, `pickclips`, `readagain`, `picture` (`{name, bytes}`, and `choosesPlace` where the person asks where to save it),
    /// `picturefailed` (`{message}`), `report` (`{name, text}`: a SARIF file to save) and `announce` (`{text, assertive}`). A viewer that is mirrored also tells of its controls, for
    /// `web/mirror.js`: `mirror` (`{changes, view}`). The callback may call any method but `free`.
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
        Self {
            shared: Rc::new(Shared::new(
                session,
                MirrorLink::new(field(options, "mirrored").is_truthy()),
                on_event,
            )),
        }
    }

    /// Starts on a canvas that was never drawn on, instead of the canvas that it has. What is open stays.
    ///
    /// `options`: `{backend: "auto" | "webgpu" | "webgl2"}`. Resolves with `{backend, adapter}` when the first frame was drawn. Rejects when no
    /// backend works, with the reasons of each that was tried, and when another start or a stop came meanwhile.
    pub fn start(&self, canvas: HtmlCanvasElement, options: &JsValue) -> Promise {
        let preference = Preference::from_name(&field(options, "backend").as_string().unwrap_or_default());
        promise(run::start(Rc::clone(&self.shared), canvas, preference))
    }

    /// Gives the canvas back, also one on which a start is under way, with its listeners and frames. What is open stays.
    /// The canvas is free when the script that called it has come to its end.
    pub fn stop(&self) {
        self.shared.stop();
    }

    /// The session and what runs it, as one plain object.
    pub fn state(&self) -> JsValue {
        self.shared.state()
    }

    /// Does what a person did with an element of the mirror: `{node, action, value}`, where the action is `click`, `focus`, `setValue`,
    /// `increment`, `decrement`, `expand`, `collapse` or `scrollIntoView`; `{action: "blur"}` lets go of the focus within the viewer.
    pub fn act(&self, asked: &JsValue) {
        self.shared.mirror.act(asked);
        self.shared.request_repaint();
    }

    /// Takes a `keydown` or `keyup` event of an element of the mirror. Returns whether the viewer uses the key, so that the browser must not.
    pub fn press(&self, event: &JsValue) -> bool {
        let used = self.shared.mirror.press(event);
        self.shared.request_repaint();
        used
    }

    /// Hears whether an element of the mirror has the focus of the page. Then the viewer has the keyboard.
    #[wasm_bindgen(js_name = setMirrorFocused)]
    pub fn set_mirror_focused(&self, focused: bool) {
        self.shared.mirror.set_focused(focused);
        self.shared.request_repaint();
    }

    /// Opens files: an array of `{name, bytes}` with relative paths as names. The largest model opens, in steps between which the
    /// page goes on; what was open stays until then. Resolves with the state, which has a failure in its `error`. Rejects when
    /// something else was opened meanwhile, or the viewer was freed.
    ///
    /// # Errors
    /// When an entry is not of that shape.
    pub fn open(&self, files: &Array) -> Result<Promise, JsError> {
        let opening = self.shared.begin_opening(files_of(files)?);
        let shared = Rc::clone(&self.shared);
        Ok(promise(async move {
            if let Some(opening) = opening {
                shared.end_opening(opening).await?;
            }
            Ok::<_, JsValue>(shared.state())
        }))
    }

    /// Adds the clips of models with the same bones to the open one: an array as [`Viewer::open`] takes it. Without an open model it
    /// opens them. A failure is in the state's `error`. Returns the state.
    ///
    /// # Errors
    /// When an entry is not of that shape.
    #[wasm_bindgen(js_name = addClips)]
    pub fn add_clips(&self, files: &Array) -> Result<JsValue, JsError> {
        self.shared.apply(FileCommand::AddClips(files_of(files)?));
        Ok(self.state())
    }

    /// Begins anew, as a new viewer does: every choice is forgotten and these files are opened, an array as [`Viewer::open`] takes
    /// it. What the GPU has compiled stays. Returns the state.
    ///
    /// # Errors
    /// When an entry is not of that shape.
    #[wasm_bindgen(js_name = startOver)]
    pub fn start_over(&self, files: &Array) -> Result<JsValue, JsError> {
        let files = files_of(files)?;
        self.shared.session.borrow_mut().start_over(reduced_motion());
        if let Some(running) = &*self.shared.running.borrow()
            && let Some(app) = running.app.borrow_mut().as_mut()
        {
            app.start_over(&running.ctx);
        }
        self.shared.apply(FileCommand::Add(files));
        Ok(self.state())
    }

    /// A picture of the view without the interface, as the bytes of a PNG. `width` and `height` are those of the canvas where they are
    /// absent. `transparent`, `light`, `viewMode`, `background`, `split` and `overlays` (an array of names) may have it drawn in another
    /// way than the window shows; the names are those of the command line.
    ///
    /// Rejects when the viewer is not running, the size is not possible, a name is none, or the GPU fails.
    pub fn snapshot(&self, options: JsValue) -> Promise {
        let running = self.shared.running.borrow().as_ref().map(|running| {
            let canvas = &running.canvas;
            (Rc::clone(&running.app), [canvas.width(), canvas.height()])
        });
        promise(async {
            let (app, canvas_size) = running.ok_or_else(picture::not_running)?;
            picture::snapshot(app, canvas_size, options).await
        })
    }

    /// Goes to a time in seconds, clamped to the clip.
    ///
    /// # Errors
    /// When it is no finite number.
    pub fn seek(&self, secs: &JsValue) -> Result<(), JsValue> {
        let time_secs = checked(script::secs("seek", &given(secs)))?;
        self.shared.apply(PlayCommand::Seek { time_secs });
        Ok(())
    }

    /// Plays on.
    pub fn play(&self) {
        self.shared.apply(PlayCommand::Play);
    }

    /// Stops where it is.
    pub fn pause(&self) {
        self.shared.apply(PlayCommand::Pause);
    }

    /// Shows the clip with this name. Returns whether there is one.
    ///
    /// # Errors
    /// When the name is no text.
    #[wasm_bindgen(js_name = selectClip)]
    pub fn select_clip(&self, name: &JsValue) -> Result<bool, JsValue> {
        let given = given(name);
        let name = checked(script::name("selectClip", &given))?;
        let index = self.shared.session.borrow().open_model().and_then(|open| {
            let clips = &open.model.clips;
            clips.iter().position(|clip| clip.name == name)
        });
        Ok(self.shared.apply_to(index, PlayCommand::SelectClip))
    }

    /// Pauses and goes some frames on, or back where the number is below 0, to a whole frame.
    ///
    /// # Errors
    /// When it is no whole number.
    #[wasm_bindgen(js_name = stepFrames)]
    pub fn step_frames(&self, frames: &JsValue) -> Result<(), JsValue> {
        let frames = checked(script::whole("stepFrames", &given(frames)))?;
        self.shared.apply(PlayCommand::StepFrames(frames));
        Ok(())
    }

    /// Pauses and goes to the next key: of the selected bone, or of any.
    #[wasm_bindgen(js_name = nextKey)]
    pub fn next_key(&self) {
        self.shared.step_key(Direction::Forward);
    }

    /// Pauses and goes to the key before: of the selected bone, or of any.
    #[wasm_bindgen(js_name = previousKey)]
    pub fn previous_key(&self) {
        self.shared.step_key(Direction::Backward);
    }

    /// Goes to the first frame of what plays.
    #[wasm_bindgen(js_name = seekStart)]
    pub fn seek_start(&self) {
        self.shared.apply(PlayCommand::SeekStart);
    }

    /// Goes to the last frame of what plays.
    #[wasm_bindgen(js_name = seekEnd)]
    pub fn seek_end(&self) {
        self.shared.apply(PlayCommand::SeekEnd);
    }

    /// Lets playing begin at a time in seconds, clamped to the clip, or at the present one.
    ///
    /// # Errors
    /// When a time is given that is no finite number.
    #[wasm_bindgen(js_name = setRangeStart)]
    pub fn set_range_start(&self, secs: &JsValue) -> Result<(), JsValue> {
        let secs = optional_secs("setRangeStart", secs)?;
        self.shared.apply(PlayCommand::SetRangeStart(secs));
        Ok(())
    }

    /// Lets playing end at a time in seconds, clamped to the clip, or at the present one.
    ///
    /// # Errors
    /// When a time is given that is no finite number.
    #[wasm_bindgen(js_name = setRangeEnd)]
    pub fn set_range_end(&self, secs: &JsValue) -> Result<(), JsValue> {
        let secs = optional_secs("setRangeEnd", secs)?;
        self.shared.apply(PlayCommand::SetRangeEnd(secs));
        Ok(())
    }

    /// Lets the whole clip play.
    #[wasm_bindgen(js_name = clearRange)]
    pub fn clear_range(&self) {
        self.shared.apply(PlayCommand::ClearRange);
    }

    /// Sets the speed, 1 as the file has it, clamped to the limits of the viewer.
    ///
    /// # Errors
    /// When it is no finite number above 0.
    #[wasm_bindgen(js_name = setSpeed)]
    pub fn set_speed(&self, speed: &JsValue) -> Result<(), JsValue> {
        let speed = checked(script::factor("setSpeed", &given(speed)))?;
        self.shared.apply(PlayCommand::SetSpeed(speed));
        Ok(())
    }

    /// Sets what happens at the end: `once`, `loop` or `pingpong`. Returns whether the name is one of these.
    ///
    /// # Errors
    /// When the name is no text.
    #[wasm_bindgen(js_name = setLoop)]
    pub fn set_loop(&self, name: &JsValue) -> Result<bool, JsValue> {
        self.shared
            .apply_named("setLoop", name, LoopMode::from_name, PlayCommand::SetLoopMode)
    }

    /// Sets how a loop goes on: `wrap` or `book-demo`. Returns whether the name is one of these.
    ///
    /// # Errors
    /// When the name is no text.
    #[wasm_bindgen(js_name = setWrap)]
    pub fn set_wrap(&self, name: &JsValue) -> Result<bool, JsValue> {
        self.shared
            .apply_named("setWrap", name, WrapMode::from_name, PlayCommand::SetWrapMode)
    }

    /// Draws a pass or leaves it out: `shadow`, `reflections`, `contact` or `ao`. Returns whether the name is one of these.
    ///
    /// # Errors
    /// When the name is no text.
    #[wasm_bindgen(js_name = setPass)]
    pub fn set_pass(&self, name: &JsValue, drawn: bool) -> Result<bool, JsValue> {
        let choice = if drawn { PassChoice::On } else { PassChoice::Off };
        let command = |pass| QualityCommand::SetPass(pass, choice);
        self.shared.apply_named("setPass", name, Pass::from_name, command)
    }

    /// Sets how finely the picture is drawn while it moves: `auto`, `full` or `low`. Returns whether the name is one of these.
    ///
    /// # Errors
    /// When the name is no text.
    #[wasm_bindgen(js_name = setQuality)]
    pub fn set_quality(&self, name: &JsValue) -> Result<bool, JsValue> {
        self.shared
            .apply_named("setQuality", name, QualityMode::from_name, QualityCommand::SetMode)
    }

    /// Draws the view in the window with this fraction of its width and height in pixels, clamped to 0.1 … 1.
    ///
    /// # Errors
    /// When it is no finite number above 0.
    #[wasm_bindgen(js_name = setRenderScale)]
    pub fn set_render_scale(&self, fraction: &JsValue) -> Result<(), JsValue> {
        let fraction = checked(script::factor("setRenderScale", &given(fraction)))?;
        self.shared
            .apply(QualityCommand::SetRenderScale(RenderScale::new(fraction)));
        Ok(())
    }

    /// Takes the last edit back. Returns whether there was one.
    pub fn undo(&self) -> bool {
        self.shared.step_in_history(HistoryCommand::Undo)
    }

    /// Does the edit again that was undone last. Returns whether there was one.
    pub fn redo(&self) -> bool {
        self.shared.step_in_history(HistoryCommand::Redo)
    }
}

/// A drop that is being opened, and its number among the openings of its session.
struct Opening {
    job: LoadJob,
    number: u64,
}

impl Drop for Viewer {
    fn drop(&mut self) {
        self.shared.silence();
        self.shared.stop();
    }
}

impl Shared {
    /// See [`Viewer::state`].
    fn state(&self) -> JsValue {
        let running = self.running.borrow();
        let running = running.as_ref();
        state::to_js(&state::State::new(
            &self.session.borrow(),
            running.map(|running| running.backend),
            running.map(|running| running.adapter.as_str()),
            running.map_or(0, |running| running.frames_rendered.get()),
        ))
    }

    /// Begins to open a drop, at once. A drop without a model is taken whole, and nothing is left to do.
    fn begin_opening(&self, files: Vec<File>) -> Option<Opening> {
        let job = self.session.borrow_mut().begin_opening(files.clone());
        if job.is_none() {
            self.apply(FileCommand::Add(files));
        }
        let number = self.session.borrow().openings();
        job.map(|job| Opening { job, number })
    }

    /// Does the steps of an opening, each in a task of its own. The session is borrowed only for a moment, never across a step.
    async fn end_opening(&self, Opening { mut job, number }: Opening) -> Result<(), JsValue> {
        let outcome = loop {
            next_task().await;
            if self.is_silenced() || self.session.borrow().openings() != number {
                return Err(abort_error(OVERTAKEN));
            }
            match job.step() {
                LoadStep::Working(next) => job = *next,
                LoadStep::Ended(outcome) => break outcome,
            }
        };
        self.session.borrow_mut().end_opening(outcome);
        self.tell_of_changes();
        Ok(())
    }

    /// Applies a command, asks for a frame and tells of what happened.
    fn apply(&self, command: impl Into<Command>) {
        self.session.borrow_mut().apply(command);
        self.tell_of_changes();
    }

    fn tell_of_changes(&self) {
        self.request_repaint();
        self.emit_events();
    }

    fn request_repaint(&self) {
        if let Some(running) = &*self.running.borrow() {
            running.ctx.request_repaint();
        }
    }

    fn step_key(&self, direction: Direction) {
        let joint = self.session.borrow().joints().selected();
        self.apply(PlayCommand::StepKey { direction, joint });
    }

    /// Applies a command with the value of this name. Returns whether there is one.
    fn apply_named<T, C: Into<Command>>(
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
    fn apply_to<T, C: Into<Command>>(&self, value: Option<T>, command: impl FnOnce(T) -> C) -> bool {
        let is_there = value.is_some();
        if let Some(value) = value {
            self.apply(command(value));
        }
        is_there
    }

    /// Undoes or redoes. Returns whether there was a step.
    fn step_in_history(&self, command: HistoryCommand) -> bool {
        let revision = || self.session.borrow().history().revision();
        let before = revision();
        self.apply(command);
        revision() != before
    }
}

/// What a script gave, to be checked.
fn given(value: &JsValue) -> Given {
    if let Some(number) = value.as_f64() {
        Given::Number(number)
    } else if let Some(text) = value.as_string() {
        Given::Text(text)
    } else if value.is_object() {
        Given::Other("an object".to_owned())
    } else {
        // Such as `JsValue(undefined)`.
        let words = format!("{value:?}");
        let inner = words.strip_prefix("JsValue(").and_then(|words| words.strip_suffix(')'));
        Given::Other(inner.unwrap_or(&words).to_owned())
    }
}

fn optional_secs(call: &str, secs: &JsValue) -> Result<Option<f32>, JsValue> {
    if is_absent(secs) {
        return Ok(None);
    }
    checked(script::secs(call, &given(secs))).map(Some)
}

/// The value, or the error that the call throws.
fn checked<T>(value: Result<T, Misuse>) -> Result<T, JsValue> {
    value.map_err(|misuse| match misuse {
        Misuse::Type(message) => TypeError::new(&message).into(),
        Misuse::Range(message) => RangeError::new(&message).into(),
    })
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

/// Copies bytes of the page into the program's memory, once.
fn copied(bytes: &Uint8Array) -> Arc<[u8]> {
    let mut copy: Arc<[u8]> = std::iter::repeat_n(0, bytes.length() as usize).collect();
    if let Some(copy) = Arc::get_mut(&mut copy) {
        bytes.copy_to(copy);
    }
    copy
}

/// Files of `{name, bytes}` records.
fn files_of(records: &Array) -> Result<Vec<File>, JsError> {
    let mut files = Vec::new();
    for record in records.iter() {
        let name = field(&record, "name")
            .as_string()
            .ok_or_else(|| JsError::new("a file needs a name"))?;
        let bytes: Uint8Array = field(&record, "bytes")
            .dyn_into()
            .map_err(|_| JsError::new(&format!("{name} needs its bytes as Uint8Array")))?;
        files.push(File::new(&name, copied(&bytes)));
    }
    Ok(files)
}
