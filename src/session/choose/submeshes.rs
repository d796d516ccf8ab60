//! Which submeshes of the model are drawn, and which one is selected or hovered.

use std::sync::Arc;

use crate::scene::Hit;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::session) struct Visibility {
    /// For each whether it was hidden by itself.
    pub(in crate::session) hidden: Vec<bool>,
    /// The one that is shown alone.
    pub(in crate::session) solo: Option<usize>,
}

impl Visibility {
    /// For each whether it is left out of the picture.
    pub(in crate::session) fn left_out(&self) -> Vec<bool> {
        let left_out = |(submesh, &hidden): (usize, &bool)| self.solo.map_or(hidden, |solo| solo != submesh);
        self.hidden.iter().enumerate().map(left_out).collect()
    }
}

/// The submeshes of the open model, as they are looked at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Submeshes {
    /// Shared with the steps that can be undone.
    visibility: Arc<Visibility>,
    /// Those that are not drawn.
    left_out: Vec<bool>,
    selected: Option<usize>,
    selected_at: Option<Hit>,
    hovered: Option<usize>,
    /// Other submeshes are drawn, and stand out, since the last [`Submeshes::take_redraw`].
    redraw: [bool; 2],
}

impl Submeshes {
    /// How many the model has.
    pub fn count(&self) -> usize {
        self.visibility.hidden.len()
    }

    /// Whether one is drawn.
    pub fn is_visible(&self, submesh: usize) -> bool {
        self.left_out.get(submesh) == Some(&false)
    }

    /// Whether one was hidden by itself, whatever is shown alone now.
    pub fn is_hidden(&self, submesh: usize) -> bool {
        self.visibility.hidden.get(submesh) == Some(&true)
    }

    /// For each whether it is left out of the picture.
    pub fn left_out(&self) -> &[bool] {
        &self.left_out
    }

    /// The one that is shown alone.
    pub fn solo(&self) -> Option<usize> {
        self.visibility.solo
    }

    /// The one that was selected.
    pub fn selected(&self) -> Option<usize> {
        self.selected
    }

    /// Where the selected one was met, when the pointer selected it: a position in the pose at the time of the click.
    pub fn selected_at(&self) -> Option<&Hit> {
        self.selected_at.as_ref()
    }

    /// The one that the pointer is over, in the picture or in a list.
    pub fn hovered(&self) -> Option<usize> {
        self.hovered
    }

    /// The one that stands out in the picture: hovered and drawn. A selected one does not, so that its colours
    /// can be seen as they are.
    pub fn highlighted(&self) -> Option<usize> {
        self.hovered.filter(|&submesh| self.is_visible(submesh))
    }

    /// Whether other submeshes are drawn, and whether others stand out, since the last call.
    pub(in crate::session) fn take_redraw(&mut self) -> [bool; 2] {
        std::mem::take(&mut self.redraw)
    }

    /// Resets to the submeshes of another model. With `keeps` set and as many submeshes as before, all stays as it is.
    pub(in crate::session) fn reset_for_model(&mut self, count: usize, keeps: bool) {
        if keeps && count == self.count() {
            // The place belongs to the vertices of the old file.
            self.selected_at = None;
            return;
        }
        *self = Self {
            visibility: Arc::new(Visibility {
                hidden: vec![false; count],
                solo: None,
            }),
            left_out: vec![false; count],
            ..Self::default()
        };
    }

    pub(in crate::session) fn visibility(&self) -> &Arc<Visibility> {
        &self.visibility
    }

    pub(in crate::session) fn set_visibility(&mut self, visibility: Arc<Visibility>) {
        self.visibility = visibility;
        self.update();
    }

    pub(in crate::session) fn set_visible(&mut self, submesh: usize, visible: bool) {
        if submesh < self.count() {
            let visibility = Arc::make_mut(&mut self.visibility);
            if visibility.solo.take().is_some() {
                visibility.hidden.clone_from(&self.left_out);
            }
            visibility.hidden[submesh] = !visible;
            self.update();
        }
    }

    pub(in crate::session) fn toggle_solo(&mut self, submesh: usize) {
        if submesh < self.count() {
            let visibility = Arc::make_mut(&mut self.visibility);
            visibility.solo = if visibility.solo == Some(submesh) {
                None
            } else {
                Some(submesh)
            };
            self.update();
        }
    }

    pub(in crate::session) fn show_all(&mut self) {
        let visibility = Arc::make_mut(&mut self.visibility);
        visibility.hidden.fill(false);
        visibility.solo = None;
        self.update();
    }

    pub(in crate::session) fn select(&mut self, submesh: Option<usize>, at: Option<Hit>) {
        if submesh.is_none_or(|submesh| submesh < self.count()) {
            (self.selected, self.selected_at) = (submesh, at);
        }
    }

    pub(in crate::session) fn hover(&mut self, submesh: Option<usize>) {
        if submesh.is_none_or(|submesh| submesh < self.count()) && submesh != self.hovered {
            let before = self.highlighted();
            self.hovered = submesh;
            self.redraw[1] |= self.highlighted() != before;
        }
    }

    fn update(&mut self) {
        let left_out = self.visibility.left_out();
        if left_out != self.left_out {
            self.left_out = left_out;
            self.redraw[0] = true;
        }
    }
}
