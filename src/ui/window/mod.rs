//! How the window is shared: panels and their pages, drawer, toolbar, chips and messages over the view, and where the focus goes.

pub(super) mod arrangement;
pub(super) mod chips;
pub(super) mod drawer;
pub(super) mod focus;
pub(super) mod layout;
pub(super) mod message;
mod pages;
pub(super) mod panel;
pub(super) mod split;
pub(super) mod toolbar;
pub(super) mod viewport;
