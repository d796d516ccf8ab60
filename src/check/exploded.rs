//! Finds clips whose keys do not belong to the offsets: the mesh flies apart.

use crate::anim::{CompiledClip, Palette, PoseBuffers, skin_position};
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::diagnostic::{Entry, Moment, Places, Subject, codes};
use crate::model::{Mesh, Model};

/// Triangles looked at for a clip, spread over the mesh: enough to estimate a fraction.
const TRIANGLES_PER_CLIP: usize = 4_000;

/// Triangles looked at for all clips together, so that thousands of clips do not look at the mesh thousands of times.
const TRIANGLES_IN_ALL: usize = 100 * TRIANGLES_PER_CLIP;

/// The least number of triangles looked at for a clip.
const LEAST_TRIANGLES: usize = 50;

/// An edge is torn when it grew this many times more than the median edge of the pose.
const TORN: f32 = 4.0;

/// From this fraction of torn edges on, the mesh has flown apart. A run of the books' soldier tears none.
const TORN_FRACTION: f64 = 0.05;

/// Compares edge lengths at the first key of each track with the bind pose. Keys in model space, or offsets of another
/// skeleton, tear the edges between parts that follow different joints; a clip that only scales tears none.
pub(super) fn note_exploded(
    model: &Model,
    compiled: &[CompiledClip],
    places: &dyn Places,
    diagnostics: &mut Diagnostics,
) {
    if model.mesh.influences.is_empty() {
        return;
    }
    let looked_at = (TRIANGLES_IN_ALL / compiled.len().max(1)).clamp(LEAST_TRIANGLES, TRIANGLES_PER_CLIP);
    let mut pose = PoseBuffers::default();
    for (index, (clip, compiled)) in (0u32..).zip(model.clips.iter().zip(compiled)) {
        // Before its start every track holds its first key.
        pose.evaluate(&model.skeleton, compiled, f32::NEG_INFINITY);
        let torn = torn_fraction(&model.mesh, looked_at, &pose.palette);
        if torn > TORN_FRACTION {
            diagnostics.add(
                &codes::EXPLODED,
                Place::on(Subject::Clip(index), places.line(Entry::Clip(index))).at([Moment {
                    time_secs: Some(clip.start_secs),
                    bone: None,
                }]),
                format!(
                    "{:.0} % of the edges are torn at the first key of \"{}\": its keys do not belong to the bone offsets \
                     (perhaps they are relative to the model, not to the parent).",
                    torn * 100.0,
                    clip.name
                ),
            );
        }
    }
}

/// Fraction of the edges that grew far more, from the bind pose to this one, than the median edge. 0 where they are clearly no more than
/// [`TORN_FRACTION`].
fn torn_fraction(mesh: &Mesh, looked_at: usize, palette: &Palette) -> f64 {
    let stride = (mesh.triangle_count() / looked_at).max(1);
    let mut ratios = Vec::with_capacity(looked_at * 3);
    for &corners in mesh.indices.as_chunks::<3>().0.iter().step_by(stride) {
        add_ratios(mesh, corners, palette, &mut ratios);
    }
    if ratios.is_empty() || is_whole(&ratios) {
        return 0.0;
    }
    let middle = ratios.len() / 2;
    let (_, &mut median, _) = ratios.select_nth_unstable_by(middle, f32::total_cmp);
    let torn = ratios
        .iter()
        .filter(|&&ratio| ratio > TORN * median.max(f32::MIN_POSITIVE))
        .count();
    torn as f64 / ratios.len() as f64
}

/// By how much the edges of a triangle grew.
fn add_ratios(mesh: &Mesh, corners: [u32; 3], palette: &Palette, ratios: &mut Vec<f32>) {
    let influences = corners.map(|vertex| &mesh.influences[vertex as usize]);
    let bind = corners.map(|vertex| mesh.positions[vertex as usize]);
    // `from_fn` is not inlined.
    let posed = |corner: usize| skin_position(palette, influences[corner], bind[corner]);
    let posed = [posed(0), posed(1), posed(2)];
    let weighted = influences.map(|influences| influences.weights != [0.0; 4]);
    for (a, b) in [(0, 1), (1, 2), (2, 0)] {
        let bind_length = bind[a].distance(bind[b]);
        let ratio = posed[a].distance(posed[b]) / bind_length;
        if bind_length > 0.0 && ratio.is_finite() && weighted[a] && weighted[b] {
            ratios.push(ratio);
        }
    }
}

/// Whether so many edges kept half their length that the median did too, and so few are longer than the torn ones would be then that
/// nothing is torn: that spares most clips the search for the median.
fn is_whole(ratios: &[f32]) -> bool {
    const HALF: f32 = 0.5;
    let kept = ratios.iter().filter(|&&ratio| ratio >= HALF).count();
    let long = ratios.iter().filter(|&&ratio| ratio > TORN * HALF).count();
    2 * kept > ratios.len() && long as f64 / ratios.len() as f64 <= TORN_FRACTION
}
