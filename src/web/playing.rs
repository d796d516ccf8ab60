//! Playing: where in the clip, which clip, and how it plays.

use wasm_bindgen::prelude::*;

use super::arguments::{checked, given, optional};
use super::viewer::Viewer;
use crate::anim::{Direction, LoopMode, WrapMode};
use crate::script;
use crate::session::PlayCommand;

#[wasm_bindgen]
impl Viewer {
    /// Goes to a time in seconds, clamped to the clip.
    ///
    /// # Errors
    /// When it is no finite number.
    pub fn seek(&self, secs: &JsValue) -> Result<(), JsValue> {
        let time_secs = checked(script::secs("seek", &given(secs)))?;
        self.shared.apply(PlayCommand::Seek { time_secs });
        Ok(())
    }

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

    /// The books' toRoot of a bone in the pose on show: 16 numbers, row by row for row vectors, so that the translation is at 12 to 14. The bone goes by its number in
    /// the file, and the space is the file's. Nothing where there is no such bone.
    ///
    /// # Errors
    /// When it is no whole number from 0.
    #[wasm_bindgen(js_name = boneToRoot)]
    pub fn bone_to_root(&self, bone: &JsValue) -> Result<Option<Vec<f32>>, JsValue> {
        let bone = checked(script::natural("boneToRoot", &given(bone)))?;
        let session = &mut *self.shared.session.borrow_mut();
        let joint = session.open_model().and_then(|open| {
            let joints = open.model.skeleton.joint_of_bone();
            joints.get(bone as usize).copied()
        });
        let readout = joint.and_then(|joint| session.inspect_joint(joint));
        Ok(readout.map(|readout| readout.to_root.0.concat()))
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
        self.step_key(Direction::Forward);
    }

    /// Pauses and goes to the key before: of the selected bone, or of any.
    #[wasm_bindgen(js_name = previousKey)]
    pub fn previous_key(&self) {
        self.step_key(Direction::Backward);
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
        let secs = optional(secs, |secs| script::secs("setRangeStart", secs))?;
        self.shared.apply(PlayCommand::SetRangeStart(secs));
        Ok(())
    }

    /// Lets playing end at a time in seconds, clamped to the clip, or at the present one.
    ///
    /// # Errors
    /// When a time is given that is no finite number.
    #[wasm_bindgen(js_name = setRangeEnd)]
    pub fn set_range_end(&self, secs: &JsValue) -> Result<(), JsValue> {
        let secs = optional(secs, |secs| script::secs("setRangeEnd", secs))?;
        self.shared.apply(PlayCommand::SetRangeEnd(secs));
        Ok(())
    }

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
}

impl Viewer {
    fn step_key(&self, direction: Direction) {
        let joint = self.shared.session.borrow().joints().selected();
        self.shared.apply(PlayCommand::StepKey { direction, joint });
    }
}
