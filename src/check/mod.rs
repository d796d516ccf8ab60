//! What is wrong with a file that was read, and what others make of it. Its diagnostics are warnings and notes: loading does not depend on
//! them.

pub mod book;
mod exploded;
mod keys;
mod mesh;
mod overflow;
pub mod report;
mod rig;
pub mod sarif;
mod texture;

pub(crate) use keys::{is_still, surplus_keys};
pub(crate) use mesh::{flat_triangles, repeated_triangles, used_vertices};
pub(crate) use texture::tangents_against;

use crate::anim::CompiledClip;
use crate::diagnostic::Diagnostic;
use crate::diagnostic::collect::Diagnostics;
use crate::format::LineMap;
use crate::model::Model;

/// Checks a model that is sound: its mesh, its maps' coordinates, its bones, and all clips in motion. `compiled` are the model's clips,
/// in its order. `lines` has the lines of the file; it may be empty. The cost is that of sorting the triangles, and linear in vertices,
/// bones and keys, whatever the file holds.
pub fn model(model: &Model, compiled: &[CompiledClip], lines: &LineMap) -> Vec<Diagnostic> {
    let mut diagnostics = Diagnostics::default();
    mesh::note_useless(&model.mesh, lines, &mut diagnostics);
    mesh::note_repeated(&model.mesh, lines, &mut diagnostics);
    mesh::note_turned_away(model, lines, &mut diagnostics);
    texture::note_equal_coords(model, lines, &mut diagnostics);
    texture::note_tangent_signs(model, lines, &mut diagnostics);
    rig::note_idle_bones(model, lines, &mut diagnostics);
    let clip_lines = lines.clip_lines();
    rig::note_shears(model, compiled, lines, &mut diagnostics);
    keys::note_still_tracks(model, lines, &mut diagnostics);
    keys::note_loop_gaps(model, lines, &mut diagnostics);
    exploded::note_exploded(model, compiled, &clip_lines, &mut diagnostics);
    overflow::note_overflows(model, compiled, lines, &mut diagnostics);
    diagnostics.into_vec()
}
