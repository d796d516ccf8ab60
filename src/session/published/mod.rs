//! What programs, links and reports are told: facts of the model, verdicts of the books, the view as plain data.

pub(super) mod handing_over;
pub(super) mod link;
pub(super) mod link_fields;
pub(super) mod reporting;
pub(super) mod restoring;
pub(super) mod series;
pub mod summary;
pub(super) mod verdicts;
pub(super) mod view_state;
