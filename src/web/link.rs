//! Links: what stands behind `#` in the page's address.

use js_sys::Uint8Array;
use wasm_bindgen::prelude::*;

use super::object;
use super::shared::Shared;
use super::state::to_js;
use super::viewer::Viewer;
use crate::session::{Command, Link, MAX_LINK_LEN, QualityCommand};

#[wasm_bindgen]
impl Viewer {
    /// What stands behind `#` in a link to what is seen, but for the model, as `{text, leftOut}`. So many bytes of the address are `taken` by what stands
    /// before it; of what has no room then the longest fields are left out, and named.
    pub fn link(&self, taken: usize) -> JsValue {
        to_js(&self.shared.link(taken))
    }

    /// Shows of the open model what a link says; what it does not say is as at a first visit, or, where it is a `change`, as it is. It is no step to undo.
    /// Returns the fields that are damaged, unknown, or not of this model, cut short.
    #[wasm_bindgen(js_name = followLink)]
    pub fn follow_link(&self, text: &str, change: Option<bool>) -> Vec<String> {
        let (linked, mut left_out) = match change {
            Some(true) => {
                let panels = self.shared.face.open_panels();
                self.shared.session.borrow().read_change(text, &panels)
            }
            _ => self.shared.session.borrow().read_link(text),
        };
        self.shared.apply(QualityCommand::SetMode(linked.quality));
        self.shared.apply(Command::Restore(Box::new(linked.view)));
        let session = self.shared.session.borrow();
        let knows_all = self.shared.face.open_these_panels(&session, &linked.panels);
        left_out.extend((!knows_all).then(|| "panel".to_owned()));
        left_out
    }

    /// The model on screen as `{path, opening}`, with the number of the opening that brought it.
    #[wasm_bindgen(js_name = modelOnScreen)]
    pub fn model_on_screen(&self) -> JsValue {
        let session = self.shared.session.borrow();
        let Some(open) = session.open_model() else {
            return JsValue::NULL;
        };
        let opening = session.shown_opening().map(|number| number as f64);
        object([("path", (&*open.file.path).into()), ("opening", opening.into())])
    }

    /// The bytes of the file that the open model was read from.
    #[wasm_bindgen(js_name = modelBytes)]
    pub fn model_bytes(&self) -> Option<Uint8Array> {
        let session = self.shared.session.borrow();
        let open = session.open_model()?;
        Some(Uint8Array::from(&open.file.bytes[..]))
    }
}

impl Shared {
    pub(super) fn link(&self, taken: usize) -> Link {
        let panels = self.face.open_panels();
        self.session.borrow().link(panels, MAX_LINK_LEN.saturating_sub(taken))
    }
}
