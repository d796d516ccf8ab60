//! How a script wants a picture to be looked at, where that differs from what the window shows.

use js_sys::Array;
use wasm_bindgen::prelude::*;

use crate::scene::{Background, FrameOptions, Light, Overlay, ViewMode};

/// What was given; the rest stays as the window has it.
pub(super) struct PictureLook {
    light: Option<Light>,
    view_mode: Option<ViewMode>,
    background: Option<Background>,
    split: Option<f32>,
    overlays: Option<Vec<Overlay>>,
}

impl PictureLook {
    /// Reads the fields of an object.
    ///
    /// # Errors
    /// When a name is none, or a field is of another type.
    pub(super) fn read(field: impl Fn(&str) -> JsValue) -> Result<Self, JsError> {
        let background = if field("transparent").is_truthy() {
            Some(Background::None)
        } else {
            named(&field, "background", Background::from_name)?
        };
        let split = field("split");
        Ok(Self {
            light: named(&field, "light", Light::from_name)?,
            view_mode: named(&field, "viewMode", ViewMode::from_name)?,
            background,
            split: match split.as_f64() {
                Some(share) if (0.0..=1.0).contains(&share) => Some(share as f32),
                None if is_absent(&split) => None,
                _ => return Err(JsError::new("split must be a number from 0 to 1")),
            },
            overlays: overlays(&field("overlays"))?,
        })
    }

    pub(super) fn apply(&self, options: &mut FrameOptions) {
        if let Some(light) = self.light {
            (options.light, options.split) = (light, None);
        }
        if self.split.is_some() {
            options.split = self.split;
        }
        options.view_mode = self.view_mode.unwrap_or(options.view_mode);
        options.background = self.background.unwrap_or(options.background);
        if let Some(overlays) = &self.overlays {
            for overlay in Overlay::ALL {
                options.overlays.set(overlay, overlays.contains(&overlay));
            }
        }
    }
}

fn is_absent(value: &JsValue) -> bool {
    value.is_undefined() || value.is_null()
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
