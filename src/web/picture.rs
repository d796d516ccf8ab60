//! Pictures of the view as PNG files.

use js_sys::{Reflect, Uint8Array};
use wasm_bindgen::prelude::*;

use super::{PAGE, Running, detail, emit, text_of};
use crate::scene::{Background, FrameOptions};
use crate::ui::{MAX_PICTURE_SIDE, picture_name};

fn not_running() -> JsError {
    JsError::new("the viewer is not running")
}

/// Calls something with what runs.
fn with_running<T>(call: impl FnOnce(&Running) -> Result<T, JsError>) -> Result<T, JsError> {
    PAGE.with_borrow(|page| {
        let running = page.as_ref().and_then(|page| page.running.as_ref());
        call(running.ok_or_else(not_running)?)
    })
}

/// The longest side that this device can draw.
///
/// # Errors
/// When the viewer is not running.
pub(super) fn longest_side() -> Result<u32, JsError> {
    with_running(|running| {
        let of_device = running.gpu.device.limits().max_texture_dimension_2d;
        Ok(of_device.min(MAX_PICTURE_SIDE))
    })
}

/// The view without the interface, as the bytes of a PNG.
///
/// # Errors
/// When the viewer is not running or the GPU fails.
pub(super) async fn picture(size: [u32; 2], adjust: impl FnOnce(&mut FrameOptions)) -> Result<Uint8Array, JsError> {
    let picture = with_running(|running| {
        let mut app = running.app.borrow_mut();
        let app = app.as_mut().ok_or_else(not_running)?;
        Ok(app.draw_snapshot(size, adjust)?)
    })?;
    let [width, height] = size;
    let pixels = picture.pixels(async || super::sleep(1).await).await?;
    let png = crate::image::encode_png(&pixels, width, height).map_err(|error| JsError::new(&error.to_string()))?;
    Ok(Uint8Array::from(png.as_slice()))
}

/// Draws a picture and hands it to the page, which saves it: `picture` with `{name, bytes}`, or `picturefailed` with
/// `{message}`. A size beyond the device's reach is drawn as large as it can be.
pub(super) fn save(size: [u32; 2], transparent: bool) {
    // The name is that of the moment when the picture was asked for.
    let name = PAGE.with_borrow(|page| page.as_ref().map(|page| picture_name(&page.session.borrow())));
    let Some(name) = name else { return };
    wasm_bindgen_futures::spawn_local(async move {
        let drawn = match longest_side() {
            Ok(most) => {
                let adjust = |options: &mut FrameOptions| {
                    if transparent {
                        options.background = Background::None;
                    }
                };
                picture(within(size, most), adjust).await
            }
            Err(error) => Err(error),
        };
        match drawn {
            Ok(bytes) => {
                let file = detail("name", &name);
                let _ = Reflect::set(&file, &"bytes".into(), &bytes);
                emit("picture", &file);
            }
            Err(error) => {
                let error = JsValue::from(error);
                let message = Reflect::get(&error, &"message".into()).unwrap_or(error);
                emit("picturefailed", &detail("message", &text_of(&message)));
            }
        }
    });
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
