//! What a running viewer hands to the page, which saves it: pictures, contact sheets, the report.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{JSON, Uint8Array};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

use super::pictures;
use crate::session::ExportedFile;
use crate::ui::{ContactSheetRequest, contact_sheet_name, picture_name, report_name};
use crate::web::picture::AppSlot;
use crate::web::shared::Shared;
use crate::web::{field, object};

/// Name and bytes of a picture, as fields of what the page is told.
type SavedPicture = [(&'static str, JsValue); 2];

/// Saves what a person or a script asks for.
pub(super) struct Saving {
    app: AppSlot,
    shared: Rc<Shared>,
    /// The picture that was saved last.
    saved: Rc<RefCell<Option<SavedPicture>>>,
}

impl Saving {
    pub(super) fn new(app: AppSlot, shared: Rc<Shared>) -> Self {
        Self {
            app,
            shared,
            saved: Rc::default(),
        }
    }

    /// Hands the last picture to the page once more, which lets the person choose where it is saved.
    pub(super) fn save_picture_as(&self) {
        if let Some([name, bytes]) = self.saved.borrow().clone() {
            let asks = ("choosesPlace", true.into());
            self.shared.emit("picture", &object([name, bytes, asks]));
        }
    }

    /// Hands the report of what was found to the page, which saves it. A message says so.
    pub(super) fn save_report(&self) {
        // The page is told when nothing is borrowed: its listener may call the viewer.
        let (name, text) = {
            let session = self.shared.session.borrow();
            let text = session.sarif().and_then(|sarif| json(&sarif));
            (report_name(&session), text)
        };
        let Some(text) = text else { return };
        self.shared.save_file(&name, text.into(), "application/sarif+json");
        if let Some(app) = self.app.borrow_mut().as_mut() {
            app.report_was_saved(&name);
        }
    }

    /// Draws a picture and hands it to the page, which saves it. A message says so.
    pub(super) fn save_picture(&self, ctx: &egui::Context, size: [u32; 2], transparent: bool, aperture: f32) {
        // The name is made now: the clip and the time may change until the picture is drawn.
        let name = picture_name(&self.shared.session.borrow());
        let drawn = pictures::of_window(Rc::clone(&self.app), size, transparent, aperture);
        self.hand_over(ctx, name, async { drawn.await.map(Some) });
    }

    pub(super) fn save_contact_sheet(&self, ctx: &egui::Context, wanted: ContactSheetRequest) {
        let name = contact_sheet_name(&self.shared.session.borrow());
        let (app, repainted) = (Rc::clone(&self.app), ctx.clone());
        let drawn = pictures::contact_sheet_of_window(Rc::clone(&app), wanted, move || repainted.request_repaint());
        self.hand_over(ctx, name, async move {
            let drawn = drawn.await;
            if let Some(app) = app.borrow_mut().as_mut() {
                app.end_contact_sheet();
            }
            drawn
        });
    }

    /// Hands a picture to the page, which saves it, once it is drawn. A message says so. `None` is one that was cancelled.
    fn hand_over(
        &self,
        ctx: &egui::Context,
        name: String,
        drawn: impl Future<Output = Result<Option<(JsValue, [u32; 2])>, JsError>> + 'static,
    ) {
        let shared = Rc::clone(&self.shared);
        let (app, saved, ctx) = (Rc::clone(&self.app), Rc::clone(&self.saved), ctx.clone());
        wasm_bindgen_futures::spawn_local(async move {
            match drawn.await {
                Ok(Some((bytes, size))) => {
                    let picture = [("name", name.as_str().into()), ("bytes", bytes)];
                    shared.emit("picture", &object(picture.clone()));
                    *saved.borrow_mut() = Some(picture);
                    if let Some(app) = app.borrow_mut().as_mut() {
                        app.picture_was_saved(&name, size);
                    }
                }
                Ok(None) => {}
                Err(error) => {
                    let message = field(&error.into(), "message");
                    shared.emit("picturefailed", &object([("message", message)]));
                }
            }
            ctx.request_repaint();
        });
    }
}

impl Shared {
    /// Hands a file, as text or bytes, to the page, which saves it.
    fn save_file(&self, name: &str, contents: JsValue, kind: &str) {
        let file = [("name", name.into()), ("contents", contents), ("type", kind.into())];
        self.emit("save", &object(file));
    }

    /// Hands a file that was exported to the page.
    pub(super) fn save_export(&self, file: &ExportedFile) {
        let bytes = Uint8Array::from(file.bytes.as_slice());
        self.save_file(&file.name, bytes.into(), file.media_type());
    }
}

/// JSON with the keys as they are, with a new line for each.
fn json(value: &impl Serialize) -> Option<String> {
    let value = value.serialize(&Serializer::json_compatible()).ok()?;
    let text = JSON::stringify_with_replacer_and_space(&value, &JsValue::NULL, &2.into()).ok()?;
    text.as_string()
}
