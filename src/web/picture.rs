//! What was drawn on the canvas, and pictures of the view as PNG files.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{Array, Uint8Array};
use wasm_bindgen::prelude::*;

use super::rim::App;
use super::{field, is_absent, sleep};
use crate::scene::{Background, FrameOptions, Light, Overlay, ViewMode};
use crate::session::MOST_SAMPLES;

pub(super) type AppSlot = Rc<RefCell<Option<App>>>;

/// What was drawn on a canvas until now.
#[derive(Clone, Copy)]
pub(super) struct Drawn {
    pub(super) frames: u64,
    /// Of how many pictures the one in the window is the mean.
    pub(super) samples: u32,
    /// Whether what lights the model is as fine as it will be: idle moments see to that, and then it is drawn once more.
    pub(super) refined: bool,
}

impl Drawn {
    pub(super) const NOTHING: Self = Self {
        frames: 0,
        samples: 1,
        refined: false,
    };

    pub(super) fn by(app: &App) -> Self {
        Self {
            frames: app.frames_rendered(),
            samples: app.samples(),
            refined: app.is_refined(),
        }
    }
}

/// The picture of `Viewer::snapshot`. It has `canvas_size` where the options have no size.
pub(super) async fn snapshot(app: AppSlot, canvas_size: [u32; 2], options: JsValue) -> Result<JsValue, JsError> {
    // Options are read before anything is borrowed: a getter is a script, and may call the viewer.
    let wanted = PictureOptions::read(|name| field(&options, name))?;
    let sides = ["width", "height"].map(|name| (name, field(&options, name)));
    let size = whole_numbers(sides, canvas_size, longest_side(&app)?)?;
    let samples =
        number(&field(&options, "samples"), "samples", [1.0, f64::from(MOST_SAMPLES)])?.map(|samples| samples as u32);
    png(app, size, samples, |options| wanted.apply(options)).await
}

/// Two numbers from 1 to a greatest one; where one is absent, that of the default.
pub(super) fn whole_numbers(given: [(&str, JsValue); 2], default: [u32; 2], most: u32) -> Result<[u32; 2], JsError> {
    let mut numbers = default;
    for (number, (name, given)) in numbers.iter_mut().zip(given) {
        let given = if is_absent(&given) {
            Some(f64::from(*number))
        } else {
            given.as_f64()
        };
        *number = match given {
            Some(given) if (1.0..=f64::from(most)).contains(&given) => given as u32,
            _ => return Err(JsError::new(&format!("{name} must be a number from 1 to {most}"))),
        };
    }
    Ok(numbers)
}

/// The bytes of a PNG of the view, without the interface: the mean of so many pictures, else of as many as the session says.
///
/// # Errors
/// When the viewer is not running or the GPU fails.
pub(super) async fn png(
    app: AppSlot,
    size: [u32; 2],
    samples: Option<u32>,
    adjust: impl FnOnce(&mut FrameOptions),
) -> Result<JsValue, JsError> {
    let picture = match app.borrow_mut().as_mut() {
        Some(app) => app.draw_snapshot(size, samples, adjust)?,
        None => return Err(not_running()),
    };
    let [width, height] = size;
    let pixels = picture.pixels(async || sleep(1).await).await?;
    let png = crate::image::encode_png(&pixels, width, height).map_err(|error| JsError::new(&error.to_string()))?;
    Ok(Uint8Array::from(png.as_slice()).into())
}

pub(super) fn longest_side(app: &AppSlot) -> Result<u32, JsError> {
    let app = app.borrow();
    app.as_ref().map(App::longest_picture_side).ok_or_else(not_running)
}

pub(super) fn not_running() -> JsError {
    JsError::new("the viewer is not running")
}

/// How a script wants a picture to be drawn, where that differs from what the window shows.
struct PictureOptions {
    light: Option<Light>,
    view_mode: Option<ViewMode>,
    background: Option<Background>,
    split: Option<f32>,
    overlays: Option<Vec<Overlay>>,
    aperture: f32,
}

impl PictureOptions {
    /// Reads the fields of an object. `transparent` overrules `background`.
    ///
    /// # Errors
    /// When a name is none, or a field is of another type.
    fn read(field: impl Fn(&str) -> JsValue) -> Result<Self, JsError> {
        let background = if field("transparent").is_truthy() {
            Some(Background::None)
        } else {
            named(&field, "background", Background::from_name)?
        };
        Ok(Self {
            light: named(&field, "light", Light::from_name)?,
            view_mode: named(&field, "viewMode", ViewMode::from_name)?,
            background,
            split: number(&field("split"), "split", [0.0, 1.0])?.map(|fraction| fraction as f32),
            overlays: overlays(&field("overlays"))?,
            aperture: number(
                &field("aperture"),
                "aperture",
                [0.0, f64::from(FrameOptions::WIDEST_APERTURE)],
            )?
            .unwrap_or(0.0) as f32,
        })
    }

    fn apply(&self, options: &mut FrameOptions) {
        if let Some(light) = self.light {
            (options.light, options.split) = (light, None);
        }
        if self.split.is_some() {
            options.split = self.split;
        }
        options.aperture = self.aperture;
        options.view_mode = self.view_mode.unwrap_or(options.view_mode);
        options.background = self.background.unwrap_or(options.background);
        if let Some(overlays) = &self.overlays {
            for overlay in Overlay::ALL {
                options.overlays.set(overlay, overlays.contains(&overlay));
            }
        }
    }
}

/// A number within a range, if there is one.
fn number(value: &JsValue, name: &str, [least, most]: [f64; 2]) -> Result<Option<f64>, JsError> {
    match value.as_f64() {
        Some(number) if (least..=most).contains(&number) => Ok(Some(number)),
        None if is_absent(value) => Ok(None),
        _ => Err(JsError::new(&format!("{name} must be a number from {least} to {most}"))),
    }
}

fn named<T>(
    field: impl Fn(&str) -> JsValue,
    name: &str,
    from_name: impl Fn(&str) -> Option<T>,
) -> Result<Option<T>, JsError> {
    let value = field(name);
    if is_absent(&value) {
        return Ok(None);
    }
    let found = value.as_string().and_then(|text| from_name(&text));
    found
        .map(Some)
        .ok_or_else(|| JsError::new(&format!("{name} has no such value")))
}

fn overlays(value: &JsValue) -> Result<Option<Vec<Overlay>>, JsError> {
    if is_absent(value) {
        return Ok(None);
    }
    let unknown = || JsError::new("overlays must be an array of names");
    let names = value.dyn_ref::<Array>().ok_or_else(unknown)?;
    let overlay = |name: JsValue| Overlay::from_name(&name.as_string()?);
    names
        .iter()
        .map(|name| overlay(name).ok_or_else(unknown))
        .collect::<Result<_, _>>()
        .map(Some)
}
