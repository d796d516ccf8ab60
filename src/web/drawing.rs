//! Drawing: what it may cost, and how many instances there are.

use wasm_bindgen::prelude::*;

use super::arguments::{checked, given, optional};
use super::viewer::Viewer;
use super::{field, is_absent, reduced_motion};
use crate::scene::Pass;
use crate::script::{self, Misuse};
use crate::session::{CrowdCommand, PassChoice, QualityCommand, QualityMode, RenderScale};

#[wasm_bindgen]
impl Viewer {
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
    /// `options`: `{samples: number}`, of how many pictures one at rest is the mean, however long they take; 0 for as many as the device
    /// draws in a second, where it has a GPU.
    ///
    /// # Errors
    /// When the name is no text, or the number no whole one from 0.
    #[wasm_bindgen(js_name = setQuality)]
    pub fn set_quality(&self, name: &JsValue, options: &JsValue) -> Result<bool, JsValue> {
        let samples = field(options, "samples");
        if !is_absent(&samples) {
            let samples = checked(script::natural("setQuality", &given(&samples)))?;
            self.shared
                .apply(QualityCommand::SetSamples((samples > 0).then_some(samples)));
        }
        self.shared
            .apply_named("setQuality", name, QualityMode::from_name, QualityCommand::SetMode)
    }

    /// Learns whether energy is to be saved: pictures at rest are then the means of fewer.
    #[wasm_bindgen(js_name = setSparing)]
    pub fn set_sparing(&self, sparing: bool) {
        self.shared
            .apply(QualityCommand::SetSparing(sparing || reduced_motion()));
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

    /// Shows several instances of the model: `{count, seed, selected}`. The count is clamped to 1 … 1000, and the same seed gives the same
    /// crowd; timeline, skeleton and read-outs are of the selected instance, a number from 0. What is absent stays, and an instance that is
    /// not there is ignored.
    ///
    /// # Errors
    /// When it is no object, or a field is no whole number; a seed and an instance are not below 0. Nothing changes then.
    #[wasm_bindgen(js_name = setCrowd)]
    pub fn set_crowd(&self, crowd: &JsValue) -> Result<(), JsValue> {
        if !crowd.is_object() {
            let message = format!("setCrowd takes an object, not {}", given(crowd));
            return checked(Err(Misuse::Type(message)));
        }
        // All fields are read first: a getter is a script, and may call the viewer.
        let [count, seed, selected] = ["count", "seed", "selected"].map(|name| field(crowd, name));
        let count = optional(&count, |count| script::whole("setCrowd({count})", count))?;
        let seed = optional(&seed, |seed| script::natural("setCrowd({seed})", seed))?;
        let selected = optional(&selected, |selected| script::natural("setCrowd({selected})", selected))?;
        let now = self.shared.session.borrow().crowd();
        if count.is_some() || seed.is_some() {
            self.shared.apply(CrowdCommand::Set {
                count: count.map_or(now.count, |count| count.max(1) as usize),
                seed: seed.unwrap_or(now.seed),
            });
        }
        if let Some(selected) = selected {
            self.shared.apply(CrowdCommand::Select(selected as usize));
        }
        Ok(())
    }
}
