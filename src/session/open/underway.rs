//! What a session is opening.

use std::collections::VecDeque;

use super::files::File;
use super::wish::{Ready, Wish};
use crate::slices::{Sliced, Slices};

/// What is being opened, and what waits for that. A copy of a session opens nothing.
#[derive(Debug, Default)]
pub(in crate::session) struct Opening {
    pub(super) now: Option<Underway>,
    pub(super) waiting: VecDeque<Wish>,
    /// What is read to be opened: its name, bytes that are read, all of them.
    pub(super) fetching: Option<(String, [usize; 2])>,
    /// Those that the session was given.
    pub(super) slices: Slices,
}

#[derive(Debug)]
pub(super) struct Underway {
    pub(super) work: Sliced<Ready>,
    pub(super) name: String,
    /// The cube map, where it is to be the sky.
    pub(super) sky: Option<File>,
    /// Whether the session begins anew when it is shown, and motion is reduced from then on.
    pub(super) begins_anew: Option<bool>,
    /// The model that leaves the list once this one is shown.
    pub(super) closes: Option<String>,
}

impl Clone for Opening {
    fn clone(&self) -> Self {
        Self {
            slices: self.slices.clone(),
            ..Self::default()
        }
    }
}
