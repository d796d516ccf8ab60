//! Triangles and vertices that add nothing to the picture, or harm it.

use std::cell::OnceCell;

use glam::DVec3;

use crate::diagnostic::collect::{Diagnostics, Tally, counted};
use crate::diagnostic::{Entry, Places, Subject, codes};
use crate::model::{Aabb, Mesh, Model};
use crate::slices::Slices;

/// A triangle lower than this fraction of the mesh's diagonal has no area: positions have about seven digits in a file and in an
/// `f32`, so a lesser height is a rounding error.
const LEAST_HEIGHT: f64 = 1e-6;

/// The triangles without area, in their order.
pub(crate) fn flat_triangles(mesh: &Mesh) -> impl Iterator<Item = u32> {
    let flatness = Flatness::of(mesh, &used_vertices(mesh));
    triangles(mesh)
        .filter(move |&(_, corners)| flatness.is_flat(mesh, corners))
        .map(|(triangle, _)| triangle)
}

/// What tells whether a triangle of a mesh has an area.
#[derive(Clone, Copy)]
struct Flatness {
    least_height: f64,
    /// A square of twice an area, in f32, that surely is one.
    surely: f32,
}

impl Flatness {
    /// That of a mesh; `used` are its [`used_vertices`].
    fn of(mesh: &Mesh, used: &[bool]) -> Self {
        let corners = mesh.positions.iter().zip(used).filter(|&(_, used)| *used);
        let diagonal = diagonal(&Aabb::from_points(corners.map(|(&position, _)| position)));
        let least_height = LEAST_HEIGHT * diagonal;
        // No side is longer than the diagonal, so twice the area of a flat triangle is a millionth of its square at most. What f32 rounds in
        // a cross product of two sides is less than that again. Four of these are sure, unless numbers are so small that f32 loses digits.
        let area = 4.0 * least_height * diagonal;
        Self {
            least_height,
            surely: ((area * area) as f32).max(1e-30),
        }
    }

    /// Whether a triangle has no area.
    #[inline]
    fn is_flat(&self, mesh: &Mesh, corners: [u32; 3]) -> bool {
        let place = |corner: usize| mesh.positions[corners[corner] as usize];
        let (a, b, c) = (place(0), place(1), place(2));
        let has_area = (b - a).cross(c - a).length_squared() > self.surely;
        !has_area && is_flat([a.as_dvec3(), b.as_dvec3(), c.as_dvec3()], self.least_height)
    }
}

/// Of each vertex, whether it is a corner of a triangle.
pub(crate) fn used_vertices(mesh: &Mesh) -> Vec<bool> {
    let mut used = vec![false; mesh.vertex_count()];
    for &vertex in &mesh.indices {
        used[vertex as usize] = true;
    }
    used
}

/// Notes triangles without area, and vertices that no triangle uses.
pub(super) async fn note_useless(mesh: &Mesh, places: &dyn Places, diagnostics: &mut Diagnostics, slices: &Slices) {
    let used = used_vertices(mesh);
    let (mut flat, mut unused) = (Tally::default(), Tally::default());
    slices.pause().await;
    let flatness = Flatness::of(mesh, &used);
    let look = |(triangle, corners)| {
        if flatness.is_flat(mesh, corners) {
            flat.add(triangle);
        }
    };
    slices.for_each(triangles(mesh), look).await;
    for (vertex, _) in (0u32..).zip(used).filter(|(_, used)| !used) {
        unused.add(vertex);
    }
    if flat.count > 0 {
        diagnostics.add(
            &codes::TRIANGLES_WITHOUT_AREA,
            places.of_rows(&flat, Subject::Triangle, Entry::Triangle),
            format!(
                "{} no area: corners coincide or lie in a line.",
                counted(flat.count, "triangle has", "triangles have")
            ),
        );
    }
    if unused.count > 0 {
        diagnostics.add(
            &codes::VERTICES_UNUSED,
            places.of_rows(&unused, Subject::Vertex, Entry::Vertex),
            format!(
                "{} of no triangle.",
                counted(unused.count, "vertex is a corner", "vertices are corners")
            ),
        );
    }
}

/// Notes triangles whose front is not the side to which the normals of all their corners point: those that are drawn from their front
/// alone, and of submeshes that are drawn from both sides those where most are so.
pub(super) fn note_turned_away(model: &Model, places: &dyn Places, diagnostics: &mut Diagnostics) {
    let mesh = &model.mesh;
    let is_turned = |corners: [u32; 3]| {
        let side = mesh.side_of(corners) * model.handedness.front_sign();
        let mut normals = corners.iter().map(|&vertex| mesh.normals[vertex as usize].as_dvec3());
        normals.all(|normal| side.dot(normal) < 0.0)
    };
    // Asked of few triangles of few models.
    let flatness = OnceCell::new();
    let is_flat = |corners: [u32; 3]| {
        let flatness = flatness.get_or_init(|| Flatness::of(mesh, &used_vertices(mesh)));
        flatness.is_flat(mesh, corners)
    };
    let (mut unseen, mut dark) = (Tally::default(), Tally::default());
    for submesh in &mesh.submeshes {
        let material = &model.materials[submesh.material as usize];
        if !material.faces_as_wound() {
            continue;
        }
        let numbered = (submesh.triangle_start..).zip(mesh.triangles_of(submesh));
        let turned = numbered.filter(|&(_, &corners)| is_turned(corners) && !is_flat(corners));
        if !material.double_sided {
            turned.for_each(|(triangle, _)| unseen.add(triangle));
        } else if 2 * turned.clone().count() > submesh.triangle_count as usize {
            turned.for_each(|(triangle, _)| dark.add(triangle));
        }
    }
    let mut note = |code, tally: &Tally, what| {
        if tally.count > 0 {
            let place = places.of_rows(tally, Subject::Triangle, Entry::Triangle);
            diagnostics.add(
                code,
                place,
                format!("{} {what}", counted(tally.count, "triangle is", "triangles are")),
            );
        }
    };
    note(
        &codes::TRIANGLES_TURNED_AWAY,
        &unseen,
        "drawn from the side that normals point away from, and not from the other.",
    );
    note(
        &codes::TRIANGLES_LIT_FROM_BEHIND,
        &dark,
        "wound against the normals, so that light falls on the other side.",
    );
}

/// Number and corners of each triangle.
pub(super) fn triangles(mesh: &Mesh) -> impl Iterator<Item = (u32, [u32; 3])> {
    let (corners, _) = mesh.indices.as_chunks::<3>();
    (0u32..).zip(corners.iter().copied())
}

/// Length of a box's diagonal; 0 for an empty one.
fn diagonal(bounds: &Aabb) -> f64 {
    if bounds.is_empty() {
        return 0.0;
    }
    bounds.min.as_dvec3().distance(bounds.max.as_dvec3())
}

/// Whether the height above the longest side is no more than `least_height`.
fn is_flat([a, b, c]: [DVec3; 3], least_height: f64) -> bool {
    let sides = [b - a, c - b, a - c].map(DVec3::length_squared);
    let longest_squared = sides.into_iter().fold(0.0, f64::max);
    // Twice the area is side times height.
    (b - a).cross(c - a).length_squared() <= least_height * least_height * longest_squared
}
