//! What is open goes from a viewer of one program to one of another: the one without WebGL2 gives way where WebGPU is gone for good.

use js_sys::{Array, Uint8Array};
use wasm_bindgen::prelude::*;

use crate::session::File;
use crate::web::object;
use crate::web::viewer::Viewer;

#[wasm_bindgen]
impl Viewer {
    /// All that another viewer needs to go on with what is open: `{openings, model, clips, sky, rest}`. In this order it opens each of `openings`, then
    /// `model`, adds each of `clips`, opens `sky` (an array of one file or none), and takes `rest` with [`Viewer::go_on_from`]. The steps to undo stay behind.
    #[wasm_bindgen(js_name = handOver)]
    pub fn hand_over(&self) -> JsValue {
        let panels = self.shared.face.open_panels();
        let handed = self.shared.session.borrow().handed_over(panels);
        let lists = |lists: &[Vec<File>]| lists.iter().map(|files| records(files)).collect::<Array>();
        object([
            ("openings", lists(&handed.openings).into()),
            ("model", handed.model.into()),
            ("clips", lists(&handed.clips).into()),
            ("sky", records(handed.sky.as_slice()).into()),
            ("rest", handed.rest.into()),
        ])
    }

    /// Takes the edits and the view that another viewer has handed over, once its files are open.
    #[wasm_bindgen(js_name = goOnFrom)]
    pub fn go_on_from(&self, rest: &str) {
        let panels = self.shared.session.borrow_mut().go_on_from(rest);
        self.shared
            .face
            .open_these_panels(&self.shared.session.borrow(), &panels);
        self.shared.tell_of_changes();
    }
}

/// `{name, bytes}` of each file.
fn records(files: &[File]) -> Array {
    let record = |file: &File| {
        object([
            ("name", (&*file.path).into()),
            ("bytes", Uint8Array::from(&file.bytes[..]).into()),
        ])
    };
    files.iter().map(record).collect()
}
