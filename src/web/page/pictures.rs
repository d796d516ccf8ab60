//! Pictures that the person asks for in the window, and contact sheets.

use std::rc::Rc;

use js_sys::Uint8Array;
use wasm_bindgen::prelude::*;

use crate::app::ContactSheetFailure;
use crate::scene::{Background, FrameOptions};
use crate::ui::ContactSheetRequest;
use crate::web::picture::{AppSlot, longest_side, not_running, png, whole_numbers};
use crate::web::{abort_error, field, next_task, sleep};

/// The most columns, and the most rows, of a contact sheet.
const MOST_CELLS: u32 = 100;
/// What it has where a script says nothing.
const CELLS: [u32; 2] = [4, 3];

/// The contact sheet of `Viewer::contactSheet`.
pub(super) async fn contact_sheet(app: AppSlot, canvas_size: [u32; 2], options: JsValue) -> Result<JsValue, JsValue> {
    let sides = ["width", "height"].map(|name| (name, field(&options, name)));
    let cells = ["columns", "rows"].map(|name| (name, field(&options, name)));
    let wanted = ContactSheetRequest {
        size: whole_numbers(sides, canvas_size, longest_side(&app)?)?,
        cells: whole_numbers(cells, CELLS, MOST_CELLS)?,
        turntable: field(&options, "turntable").is_truthy(),
        transparent: field(&options, "transparent").is_truthy(),
    };
    let signal = field(&options, "signal");
    let goes_on = |_| !field(&signal, "aborted").is_truthy();
    let png = sheet(app, wanted, goes_on).await?;
    png.ok_or_else(|| abort_error("the contact sheet was cancelled"))
}

/// The contact sheet that is asked for in the window, and its size. `None` when it was cancelled.
pub(super) async fn contact_sheet_of_window(
    app: AppSlot,
    wanted: ContactSheetRequest,
    repaint: impl Fn(),
) -> Result<Option<(JsValue, [u32; 2])>, JsError> {
    let size = within(wanted.size, longest_side(&app)?);
    let goes_on = |progress| {
        repaint();
        let mut app = app.borrow_mut();
        app.as_mut().is_some_and(|app| app.show_sheet_progress(progress))
    };
    let png = sheet(Rc::clone(&app), ContactSheetRequest { size, ..wanted }, goes_on).await?;
    Ok(png.map(|png| (png, size)))
}

/// Draws a contact sheet, a picture at a time. Before each it asks whether to go on, and tells how many are drawn, of how many.
///
/// # Errors
/// When the viewer is not running or another model was opened, the sheet has no room, or the GPU fails.
async fn sheet(
    app: AppSlot,
    wanted: ContactSheetRequest,
    goes_on: impl Fn([usize; 2]) -> bool,
) -> Result<Option<JsValue>, JsError> {
    let begun = app.borrow().as_ref().map(|app| app.begin_contact_sheet(&wanted));
    let mut job = begun.ok_or_else(not_running)??;
    loop {
        let progress = job.progress();
        if !goes_on(progress) {
            return Ok(None);
        }
        if progress[0] == progress[1] {
            return Ok(Some(Uint8Array::from(job.into_png()?.as_slice()).into()));
        }
        let picture = match app.borrow_mut().as_mut() {
            Some(app) => app.draw_next(&mut job)?,
            None => return Err(not_running()),
        };
        let pixels = picture.pixels(async || sleep(1).await).await;
        job.place(&pixels.map_err(ContactSheetFailure::from)?);
        // Input and the window's own frames come in between.
        next_task().await;
    }
}

/// The picture that is asked for in the window, and its size. A size beyond the device's reach is drawn as large as it can be.
pub(super) async fn of_window(
    app: AppSlot,
    size: [u32; 2],
    transparent: bool,
    aperture: f32,
) -> Result<(JsValue, [u32; 2]), JsError> {
    let size = within(size, longest_side(&app)?);
    let adjust = |options: &mut FrameOptions| {
        options.aperture = aperture;
        if transparent {
            options.background = Background::None;
        }
    };
    Ok((png(app, size, None, adjust).await?, size))
}

/// A size in the same shape with no side longer than `most`.
fn within(size: [u32; 2], most: u32) -> [u32; 2] {
    let longest = size[0].max(size[1]);
    if longest <= most {
        return size;
    }
    let scaled = |side: u32| (u64::from(side) * u64::from(most) / u64::from(longest)).max(1) as u32;
    size.map(scaled)
}
