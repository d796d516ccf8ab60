//! What the page gets of the interface: its controls as plain records, and sentences for screen readers.

pub(super) mod announce;
pub(super) mod mirror;
