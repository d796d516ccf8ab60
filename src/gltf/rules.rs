//! Rules of glTF that a file can break without being unreadable.

use super::json::Root;
use crate::diagnostic::{Diagnostic, codes};

/// Notes which rules the document breaks.
pub fn note_broken_rules(root: &Root, diagnostics: &mut Vec<Diagnostic>) {
    let _ = (root, diagnostics, codes::GLTF_RULE_BROKEN);
}
