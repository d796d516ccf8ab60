//! What is wrong with a file that was read, and what others make of it. Its diagnostics are warnings and notes: loading does not depend on
//! them.

pub mod book;
mod exploded;
mod keys;
mod mesh;
mod overflow;
mod repeated;
pub mod report;
mod rig;
pub mod sarif;
mod texture;

pub(crate) use keys::{is_still, surplus_keys};
pub(crate) use mesh::{flat_triangles, used_vertices};
pub(crate) use repeated::repeated_triangles;
pub(crate) use texture::tangents_against;

use crate::anim::CompiledClip;
use crate::diagnostic::collect::{Diagnostics, line_start};
use crate::diagnostic::{Diagnostic, Entry, Places, Subject};
use crate::model::{Mesh, Model, Submesh};
use crate::slices::{Slices, Stage, at_once};

/// Checks a model that is sound: its mesh, its maps' coordinates, its bones, and all clips in motion. `compiled` are the model's clips,
/// in its order. `places` tells where they stand in the file. The cost is that of sorting the triangles, and linear in vertices,
/// bones and keys, whatever the file holds.
pub fn model(model: &Model, compiled: &[CompiledClip], places: &dyn Places) -> Vec<Diagnostic> {
    at_once(model_in(model, compiled, places, &Slices::ENDLESS))
}

/// [`model`] in slices.
pub async fn model_in(
    model: &Model,
    compiled: &[CompiledClip],
    places: &dyn Places,
    slices: &Slices,
) -> Vec<Diagnostic> {
    let at = |done| slices.pause_at(Stage::Checking, done, 11);
    let mut diagnostics = Diagnostics::default();
    at(0).await;
    mesh::note_useless(&model.mesh, places, &mut diagnostics, slices).await;
    at(1).await;
    repeated::note_repeated(&model.mesh, places, &mut diagnostics, slices).await;
    at(2).await;
    mesh::note_turned_away(model, places, &mut diagnostics);
    at(3).await;
    texture::note_equal_coords(model, places, &mut diagnostics);
    at(4).await;
    texture::note_tangent_signs(model, places, &mut diagnostics, slices).await;
    at(5).await;
    rig::note_idle_bones(model, places, &mut diagnostics);
    at(6).await;
    rig::note_shears(model, compiled, places, &mut diagnostics);
    at(7).await;
    keys::note_still_tracks(model, places, &mut diagnostics);
    at(8).await;
    keys::note_loop_gaps(model, places, &mut diagnostics);
    at(9).await;
    exploded::note_exploded(model, compiled, places, &mut diagnostics);
    at(10).await;
    overflow::note_overflows(model, compiled, places, &mut diagnostics);
    let mut all = diagnostics.into_vec();
    all.iter_mut()
        .for_each(|diagnostic| fill_place(diagnostic, &model.mesh, places));
    all
}

/// Gives a diagnostic that has no place yet that of its part of the model. Formats that make vertices and triangles anew have no place for
/// one: then it is that of its subset.
fn fill_place(diagnostic: &mut Diagnostic, mesh: &Mesh, places: &dyn Places) {
    let has_place = diagnostic.position.is_some() || diagnostic.pointer.is_some() || diagnostic.byte_offset.is_some();
    let Some(subject) = diagnostic.subject.filter(|_| !has_place) else {
        return;
    };
    let subset_of = |triangle: usize| {
        let draws = |submesh: &Submesh| {
            let behind = triangle.checked_sub(submesh.triangle_start as usize);
            behind.is_some_and(|behind| behind < submesh.triangle_count as usize)
        };
        Some(Entry::Subset(mesh.submeshes.iter().position(draws)? as u32))
    };
    let entry = match subject {
        Subject::Material(index) => Some(Entry::Material(index)),
        Subject::Subset(index) => Some(Entry::Subset(index)),
        Subject::Bone(index) => Some(Entry::Bone(index)),
        Subject::Clip(index) => Some(Entry::Clip(index)),
        Subject::Triangle(index) => subset_of(index as usize),
        Subject::Vertex(index) => {
            let corner = mesh.indices.iter().position(|&vertex| vertex == index);
            corner.and_then(|corner| subset_of(corner / 3))
        }
        Subject::Map(_) => None,
    };
    let Some(entry) = entry else { return };
    diagnostic.pointer = places.pointer(entry);
    diagnostic.byte_offset = places.byte_offset(entry);
    diagnostic.position = places.line(entry).map(line_start);
    diagnostic.places.extend(diagnostic.position);
}
