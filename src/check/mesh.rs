//! Triangles and vertices that add nothing to the picture, or harm it.

use glam::DVec3;

use crate::diagnostic::collect::{Diagnostics, Tally, counted};
use crate::diagnostic::{Entry, Places, Subject, codes};
use crate::model::{Aabb, Mesh, Model};

/// A triangle lower than this fraction of the mesh's diagonal has no area: positions have about seven digits in a file and in an
/// `f32`, so a lesser height is a rounding error.
const LEAST_HEIGHT: f64 = 1e-6;

/// The triangles without area, in their order.
pub(crate) fn flat_triangles(mesh: &Mesh) -> impl Iterator<Item = u32> {
    let is_flat = flatness(mesh);
    triangles(mesh)
        .filter(move |(_, corners)| is_flat(*corners))
        .map(|(triangle, _)| triangle)
}

/// Whether a triangle has no area.
fn flatness(mesh: &Mesh) -> impl Fn([u32; 3]) -> bool {
    let corners = mesh.indices.iter().map(|&vertex| mesh.positions[vertex as usize]);
    let least_height = LEAST_HEIGHT * diagonal(&Aabb::from_points(corners));
    move |corners| {
        let corners = corners.map(|vertex| mesh.positions[vertex as usize].as_dvec3());
        is_flat(corners, least_height)
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
pub(super) fn note_useless(mesh: &Mesh, places: &dyn Places, diagnostics: &mut Diagnostics) {
    let used = used_vertices(mesh);
    let (mut flat, mut unused) = (Tally::default(), Tally::default());
    flat_triangles(mesh).for_each(|triangle| flat.add(triangle));
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
        let normals = corners.map(|vertex| mesh.normals[vertex as usize].as_dvec3());
        normals.into_iter().all(|normal| side.dot(normal) < 0.0)
    };
    let is_flat = flatness(mesh);
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
fn triangles(mesh: &Mesh) -> impl Iterator<Item = (u32, [u32; 3])> {
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

/// Notes triangles of the same three vertices, and edges of more than two triangles. Both come from sorted lists, so a vertex or an
/// edge with any number of triangles costs hardly more than others. Vertices count as the same by their number, not by their place: a mesh
/// may well be sewn together of sheets that touch.
pub(super) fn note_repeated(mesh: &Mesh, places: &dyn Places, diagnostics: &mut Diagnostics) {
    let mut by_corners = by_corners(mesh);
    let repeated: Vec<u32> = repeated(&by_corners).map(|(_, triangle)| triangle).collect();
    note_same_corners(repeated, places, diagnostics);
    by_corners.dedup_by_key(|(corners, _)| *corners);
    note_crowded_edges(by_corners, mesh.vertex_count(), places, diagnostics);
}

/// Each triangle that has the vertices of another one before, after that one.
pub(crate) fn repeated_triangles(mesh: &Mesh) -> Vec<(u32, u32)> {
    repeated(&by_corners(mesh)).collect()
}

/// Triangles with their corners in order, sorted by these. One with equal corners is no triangle; it is told of elsewhere.
fn by_corners(mesh: &Mesh) -> Vec<([u32; 3], u32)> {
    let with_area: Vec<([u32; 3], u32)> = triangles(mesh)
        .map(|(triangle, mut corners)| {
            corners.sort_unstable();
            (corners, triangle)
        })
        .filter(|([a, b, c], _)| a != b && b != c)
        .collect();
    sorted_by_vertex(
        &with_area,
        mesh.vertex_count(),
        |&([a, ..], _)| a,
        |&([_, b, c], triangle)| (b, c, triangle),
    )
}

/// Sorts by a vertex, and what has the same vertex by a key. The first is done by counting: a mesh has few triangles at each vertex.
fn sorted_by_vertex<T: Copy, K: Ord>(
    items: &[T],
    vertex_count: usize,
    vertex_of: impl Fn(&T) -> u32,
    key_of: impl Fn(&T) -> K,
) -> Vec<T> {
    // Where the items of each vertex end; filled from the back, where they begin.
    let mut places = vec![0_usize; vertex_count + 1];
    for item in items {
        places[vertex_of(item) as usize] += 1;
    }
    let mut end = 0;
    for place in &mut places {
        end += *place;
        *place = end;
    }
    let mut sorted = items.to_vec();
    for &item in items {
        let place = &mut places[vertex_of(&item) as usize];
        *place -= 1;
        sorted[*place] = item;
    }
    for ends in places.windows(2) {
        sorted[ends[0]..ends[1]].sort_unstable_by_key(&key_of);
    }
    sorted
}

fn repeated(by_corners: &[([u32; 3], u32)]) -> impl Iterator<Item = (u32, u32)> {
    let pairs = by_corners.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    pairs.map(|pair| (pair[0].1, pair[1].1))
}

fn note_same_corners(mut repeated: Vec<u32>, places: &dyn Places, diagnostics: &mut Diagnostics) {
    if repeated.is_empty() {
        return;
    }
    repeated.sort_unstable();
    let mut tally = Tally::default();
    repeated.into_iter().for_each(|triangle| tally.add(triangle));
    diagnostics.add(
        &codes::TRIANGLES_REPEATED,
        places.of_rows(&tally, Subject::Triangle, Entry::Triangle),
        format!(
            "{} the same three vertices as another one before.",
            counted(tally.count, "triangle has", "triangles have")
        ),
    );
}

/// Takes different triangles with their corners in order.
fn note_crowded_edges(
    mut triangles: Vec<([u32; 3], u32)>,
    vertex_count: usize,
    places: &dyn Places,
    diagnostics: &mut Diagnostics,
) {
    let edges: Vec<[u32; 2]> = triangles.iter().flat_map(|(corners, _)| edges_of(*corners)).collect();
    let edges = sorted_by_vertex(&edges, vertex_count, |&[from, _]| from, |&[_, to]| to);
    let mut crowded: Vec<[u32; 2]> = edges
        .windows(3)
        .filter(|three| three[0] == three[2])
        .map(|three| three[0])
        .collect();
    crowded.dedup();
    if crowded.is_empty() {
        return;
    }
    // The place of each edge is the first triangle too many.
    let mut met = vec![0_u32; crowded.len()];
    let mut third = Tally::default();
    triangles.sort_unstable_by_key(|(_, triangle)| *triangle);
    for (corners, triangle) in triangles {
        for edge in edges_of(corners)
            .iter()
            .filter_map(|edge| crowded.binary_search(edge).ok())
        {
            met[edge] += 1;
            if met[edge] == 3 {
                third.add(triangle);
            }
        }
    }
    diagnostics.add(
        &codes::EDGES_CROWDED,
        places.of_rows(&third, Subject::Triangle, Entry::Triangle),
        format!(
            "{} to more than two triangles.",
            counted(third.count, "edge belongs", "edges belong")
        ),
    );
}

/// The edges of corners in order, each from its lesser end.
fn edges_of([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [a, c]]
}
