//! What scripts can ask for. Every call acts on the session at once; the window draws it in its next frame.

use js_sys::{Array, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;

use super::picture::{longest_side, picture};
use super::picture_look::PictureLook;
use super::{PAGE, state, tell_events};
use crate::scene::Pass;
use crate::session::{Command, File, PassChoice, RenderScale, Session};

/// Applies a command and asks for a frame.
pub(super) fn apply(command: Command) {
    PAGE.with_borrow(|page| {
        let Some(page) = page else { return };
        page.session.borrow_mut().apply(command);
        if let Some(running) = &page.running {
            running.ctx.request_repaint();
        }
    });
    let session = PAGE.with_borrow(|page| page.as_ref().map(|page| page.session.clone()));
    if let Some(session) = session {
        tell_events(&session);
    }
}

/// Something of the session, when there is one.
pub(super) fn of_session<T>(read: impl FnOnce(&Session) -> Option<T>) -> Option<T> {
    PAGE.with_borrow(|page| read(&page.as_ref()?.session.borrow()))
}

/// The session and what runs it, as one plain object.
#[wasm_bindgen]
pub fn state() -> JsValue {
    PAGE.with_borrow(|page| {
        let running = page.as_ref().and_then(|page| page.running.as_ref());
        let view = state::View {
            backend: running.map(|running| running.backend),
            adapter: running.map(|running| running.adapter.as_str()),
            frames_rendered: running.map_or(0, |running| running.frames_rendered.get()),
        };
        match page {
            Some(page) => state::state(&page.session.borrow(), &view),
            None => state::state(&Session::new(false), &view),
        }
    })
}

/// Whether Esc would shut something in the viewer, end what is being typed or let go of a selection. Then it does not mean that Tab
/// should leave the canvas.
#[wasm_bindgen(js_name = escapeShuts)]
pub fn escape_shuts() -> bool {
    PAGE.with_borrow(|page| {
        let running = page.as_ref().and_then(|page| page.running.as_ref());
        running.is_some_and(|running| {
            let app = running.app.try_borrow();
            app.is_ok_and(|app| app.as_ref().is_some_and(|app| app.escape_shuts(&running.ctx)))
        })
    })
}

/// Opens files: an array of `{name, bytes}` with relative paths as names. The largest model opens; a failure is in the
/// state's `error`. Returns the state.
///
/// # Errors
/// When an entry is not of that shape.
#[wasm_bindgen]
pub fn open(files: &Array) -> Result<JsValue, JsError> {
    apply(Command::AddFiles(files_of(files)?));
    Ok(state())
}

/// Adds the clips of models with the same bones to the open one: an array as [`open`] takes it. Without an open model it
/// opens them; a failure is in the state's `error`. Returns the state.
///
/// # Errors
/// When an entry is not of that shape.
#[wasm_bindgen(js_name = addClips)]
pub fn add_clips(files: &Array) -> Result<JsValue, JsError> {
    apply(Command::AddClips(files_of(files)?));
    Ok(state())
}

/// Begins anew, as a visit of the page does: every choice is forgotten and these files are opened, an array as [`open`] takes
/// it. What the GPU has compiled stays. Returns the state.
///
/// # Errors
/// When an entry is not of that shape.
#[wasm_bindgen(js_name = startOver)]
pub fn start_over(files: &Array) -> Result<JsValue, JsError> {
    let files = files_of(files)?;
    PAGE.with_borrow(|page| {
        let Some(page) = page else { return };
        page.session.borrow_mut().start_over(super::reduced_motion());
        if let Some(running) = &page.running
            && let Some(app) = running.app.borrow_mut().as_mut()
        {
            app.start_over(&running.ctx);
        }
    });
    apply(Command::AddFiles(files));
    Ok(state())
}

/// Files of `{name, bytes}` records.
fn files_of(files: &Array) -> Result<Vec<File>, JsError> {
    let mut given = Vec::new();
    for entry in files.iter() {
        let field = |name: &str| Reflect::get(&entry, &name.into()).unwrap_or(JsValue::UNDEFINED);
        let name = field("name")
            .as_string()
            .ok_or_else(|| JsError::new("a file needs a name"))?;
        let bytes: Uint8Array = field("bytes")
            .dyn_into()
            .map_err(|_| JsError::new(&format!("{name} needs its bytes as Uint8Array")))?;
        given.push(File::new(&name, bytes.to_vec()));
    }
    Ok(given)
}

/// Goes to a time in seconds, clamped to the clip.
#[wasm_bindgen]
pub fn seek(secs: f32) {
    apply(Command::Seek { time_secs: secs });
}

/// Plays on.
#[wasm_bindgen]
pub fn play() {
    apply(Command::Play);
}

/// Stops where it is.
#[wasm_bindgen]
pub fn pause() {
    apply(Command::Pause);
}

/// Shows the clip with this name. Returns whether there is one.
#[wasm_bindgen(js_name = selectClip)]
pub fn select_clip(name: &str) -> bool {
    let index = of_session(|session| {
        let clips = &session.open_model()?.model.clips;
        clips.iter().position(|clip| clip.name == name)
    });
    if let Some(index) = index {
        apply(Command::SelectClip(index));
    }
    index.is_some()
}

/// Draws a pass or leaves it out: `shadow`, `reflections`, `contact` or `ao`. Returns whether the name is one of these.
#[wasm_bindgen(js_name = setPass)]
pub fn set_pass(name: &str, drawn: bool) -> bool {
    let pass = Pass::from_name(name);
    if let Some(pass) = pass {
        let choice = if drawn { PassChoice::On } else { PassChoice::Off };
        apply(Command::SetPass(pass, choice));
    }
    pass.is_some()
}

/// Draws the view in the window with this fraction of its width and height in pixels, from 0.1 to 1.
#[wasm_bindgen(js_name = setRenderScale)]
pub fn set_render_scale(fraction: f32) {
    apply(Command::SetRenderScale(RenderScale::new(fraction)));
}

/// A picture of the view without the interface: `{width, height}` to the bytes of a PNG. `transparent`, `light`, `viewMode`,
/// `background`, `split` and `overlays` (an array of names) may have it looked at in another way than the window shows; the names are those
/// of the command line.
///
/// # Errors
/// When the viewer is not running, the size is not possible, a name is none, or the GPU fails.
#[wasm_bindgen]
pub async fn snapshot(options: JsValue) -> Result<Uint8Array, JsError> {
    let field = |name: &str| Reflect::get(&options, &name.into()).unwrap_or(JsValue::UNDEFINED);
    // Read before anything is borrowed: a getter is a script, and may call back.
    let look = PictureLook::read(field)?;
    let sides = [("width", field("width").as_f64()), ("height", field("height").as_f64())];
    let most = longest_side()?;
    let mut size = [0; 2];
    for (pixels, (name, side)) in size.iter_mut().zip(sides) {
        *pixels = match side {
            Some(side) if (1.0..=f64::from(most)).contains(&side) => side as u32,
            _ => return Err(JsError::new(&format!("{name} must be a number from 1 to {most}"))),
        };
    }
    picture(size, |options| look.apply(options)).await
}
