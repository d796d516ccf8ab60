//! What controls are called: words for people, and a stable name for programs.

use egui::Response;

use super::control::tell_node;
use crate::actions::Control;

/// Gives a widget its stable name.
pub(crate) fn named(response: Response, control: Control) -> Response {
    tell_node(&response, |node| node.set_author_id(control.to_string()));
    response
}

/// The words of a control, and its stable name if it has one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Label<'a> {
    pub(crate) words: &'a str,
    pub(crate) control: Option<Control>,
}

impl Label<'_> {
    /// Gives a widget the stable name.
    pub(super) fn name(&self, response: &Response) {
        if let Some(control) = self.control {
            tell_node(response, |node| node.set_author_id(control.to_string()));
        }
    }
}

impl<'a> From<&'a str> for Label<'a> {
    fn from(words: &'a str) -> Self {
        Self { words, control: None }
    }
}

impl<'a> From<&'a String> for Label<'a> {
    fn from(words: &'a String) -> Self {
        words.as_str().into()
    }
}

impl<'a> From<(&'a str, Control)> for Label<'a> {
    fn from((words, control): (&'a str, Control)) -> Self {
        Self {
            words,
            control: Some(control),
        }
    }
}
