//! What outlives a canvas beside the session: what holds the view, and whether anybody sees it.

use std::cell::{Cell, RefCell};

use wasm_bindgen::JsValue;

use super::pointers::Pointers;
use crate::scene::Theme;
use crate::session::Session;
use crate::session::summary::Books;
use crate::web::{field, matches_media};

#[derive(Default)]
pub(in crate::web) struct Face {
    theme: Cell<Option<Theme>>,
    pub(super) pointers: RefCell<Pointers>,
    /// Since the last frame.
    had_input: Cell<bool>,
    pub(in crate::web) is_out_of_sight: Cell<bool>,
}

impl Face {
    /// With the `theme` of a viewer's options.
    pub(in crate::web) fn new(options: &JsValue) -> Self {
        let theme = field(options, "theme").as_string();
        Self {
            theme: Cell::new(theme.and_then(|name| Theme::from_name(&name))),
            ..Self::default()
        }
    }

    /// The theme that was chosen.
    pub(in crate::web) fn theme(&self) -> Option<Theme> {
        self.theme.get()
    }

    pub(super) fn choose_theme(&self, theme: Theme) {
        self.theme.set(Some(theme));
    }

    /// The one that was chosen, else the system's.
    pub(super) fn shown_theme(&self) -> Theme {
        self.theme
            .get()
            .unwrap_or_else(|| match matches_media("(prefers-color-scheme: light)") {
                true => Theme::Light,
                false => Theme::Dark,
            })
    }

    /// Nothing: there are no panels.
    pub(in crate::web) fn open_panels(&self) -> Vec<String> {
        Vec::new()
    }

    /// Leaves the panels of a link closed, which is no fault of the link.
    pub(in crate::web) fn open_these_panels(&self, _session: &Session, _names: &[String]) -> bool {
        true
    }

    pub(super) fn note_input(&self) {
        self.had_input.set(true);
    }

    pub(super) fn take_had_input(&self) -> bool {
        self.had_input.take()
    }

    /// Whether a pointer holds the view.
    pub(super) fn is_held(&self) -> bool {
        self.pointers.borrow().hold()
    }
}

/// Nothing: verdicts are the page's.
pub(in crate::web) fn books(_session: &Session) -> Option<Books<'_>> {
    None
}
