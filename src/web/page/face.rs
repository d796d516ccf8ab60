//! What outlives a canvas of what lies over the picture: the panels, and the elements that mirror their controls.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use wasm_bindgen::JsValue;

use super::mirror::MirrorLink;
use crate::scene::Theme;
use crate::session::Session;
use crate::session::summary::Books;
use crate::ui::{Chrome, UiState};
use crate::web::field;

#[derive(Default)]
pub(in crate::web) struct Face {
    pub(super) ui: Rc<RefCell<UiState>>,
    pub(super) mirror: MirrorLink,
    /// Other names were kept for a model elsewhere; the next frame reads them.
    pub(super) names_changed: Cell<bool>,
    pub(in crate::web) is_out_of_sight: Cell<bool>,
}

impl Face {
    /// With the `theme` and the `ui` of a viewer's options.
    pub(in crate::web) fn new(options: &JsValue) -> Self {
        let face = Self::default();
        {
            let named = |name| field(options, name).as_string();
            let mut ui = face.ui.borrow_mut();
            ui.theme = named("theme").and_then(|name| Theme::from_name(&name));
            ui.chrome = named("ui")
                .and_then(|name| Chrome::from_name(&name))
                .unwrap_or_default();
        }
        face
    }

    /// The theme that a person chose.
    pub(in crate::web) fn theme(&self) -> Option<Theme> {
        self.ui.borrow().theme
    }

    /// What a link says of the panels.
    pub(in crate::web) fn open_panels(&self) -> Vec<String> {
        self.ui.borrow().open_panels()
    }

    /// Opens the panels of a link, and no others. Returns whether it knows all of them.
    pub(in crate::web) fn open_these_panels(&self, session: &Session, names: &[String]) -> bool {
        self.ui.borrow_mut().open_these_panels(session, names).is_empty()
    }
}

/// What the books' programs make of the open file.
pub(in crate::web) fn books(session: &Session) -> Option<Books<'_>> {
    let open = session.open_model();
    open.map(|_| Books::of(session.verdicts(), session.limits_once_converted()))
}
