//! What a file will have otherwise than what is open.

use crate::edit::Change;
use crate::export::Loss;

/// What will be otherwise in a file, known before it is written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ExportPlan {
    /// What was edited, in the order of the edits.
    pub changes: Vec<Change>,
    /// What the format does not hold, or holds otherwise.
    pub losses: Vec<Loss>,
    /// Pictures that are written beside it; the page packs both into an archive.
    pub maps: usize,
}
