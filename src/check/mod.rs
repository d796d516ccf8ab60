//! What is wrong with a file that was read, and what others make of it. Its diagnostics are warnings and notes: loading does not depend on
//! them.

pub mod book;
mod exploded;
mod overflow;
pub mod report;
pub mod sarif;

use crate::anim::CompiledClip;
use crate::diagnostic::Diagnostic;
use crate::diagnostic::collect::Diagnostics;
use crate::model::Model;

/// Checks all clips of a model in motion: meshes that fly apart, numbers that overflow. `compiled` are the model's clips,
/// in its order. `clip_lines` are the clips' lines in the file; it may be empty.
pub fn motion(model: &Model, compiled: &[CompiledClip], clip_lines: &[u32]) -> Vec<Diagnostic> {
    let mut diagnostics = Diagnostics::default();
    exploded::note_exploded(model, compiled, clip_lines, &mut diagnostics);
    overflow::note_overflows(model, compiled, clip_lines, &mut diagnostics);
    diagnostics.into_vec()
}
