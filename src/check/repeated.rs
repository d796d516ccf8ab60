//! Triangles of the same three vertices, and edges of more than two triangles.
//!
//! Nearly no mesh has one of either, and that is proved in one pass over the edges. Where it does not hold, sorted lists tell which they are.
//! In both a vertex or an edge with any number of triangles costs hardly more than others.

use super::mesh::triangles;
use crate::diagnostic::collect::{Diagnostics, Tally, counted};
use crate::diagnostic::{Entry, Places, Subject, codes};
use crate::model::Mesh;
use crate::slices::{Slices, at_once};

/// Notes triangles of the same three vertices, and edges of more than two triangles. Vertices count as the same by their number, not by
/// their place: a mesh may well be sewn together of sheets that touch.
pub(super) async fn note_repeated(mesh: &Mesh, places: &dyn Places, diagnostics: &mut Diagnostics, slices: &Slices) {
    if has_neither(mesh, slices).await {
        return;
    }
    let mut by_corners = by_corners(mesh);
    let repeated: Vec<u32> = repeated(&by_corners).map(|(_, triangle)| triangle).collect();
    note_same_corners(repeated, places, diagnostics);
    by_corners.dedup_by_key(|(corners, _)| *corners);
    note_crowded_edges(by_corners, mesh.vertex_count(), places, diagnostics);
}

/// Each triangle that has the vertices of another one before, after that one.
pub(crate) fn repeated_triangles(mesh: &Mesh) -> Vec<(u32, u32)> {
    if at_once(has_neither(mesh, &Slices::ENDLESS)) {
        return Vec::new();
    }
    repeated(&by_corners(mesh)).collect()
}

/// An edge as its lesser vertex has it: the other end, the third corner of the triangle, and the number of the next one there. One with an
/// even number is of the triangle's least vertex, and stands for the edge to the third corner too.
type HalfEdge = [u32; 3];

/// No vertex, no corner and no edge.
const NONE: u32 = u32::MAX;

/// Whether no triangle has the vertices of another one, and no edge more than two triangles. False says nothing.
///
/// Two triangles with the same vertices share an edge, and their third corner there. So a look at the first two triangles of each edge is
/// enough to find them, and a third one ends the proof.
async fn has_neither(mesh: &Mesh, slices: &Slices) -> bool {
    if mesh.indices.len() >= NONE as usize {
        return false;
    }
    let (first, edges) = by_lesser_vertex(mesh, slices).await;
    // Of each vertex: at which lesser vertex it was met last, and the third corner of that triangle; none where two were met.
    let mut met = vec![[NONE; 2]; first.len()];
    let mut is_proven = true;
    let mut meet = |from: u32, to: u32, third: u32| {
        let met = &mut met[to as usize];
        if met[0] != from {
            *met = [from, third];
        } else {
            is_proven &= met[1] != third && met[1] != NONE;
            met[1] = NONE;
        }
    };
    let look = |(from, &first): (u32, &u32)| {
        let mut next = first;
        while let Some(&[to, third, behind]) = edges.get(next as usize) {
            meet(from, to, third);
            if next.is_multiple_of(2) {
                meet(from, third, to);
            }
            next = behind;
        }
    };
    slices.for_each((0..).zip(&first), look).await;
    is_proven
}

/// The edges of all triangles with three vertices, and the first one of each vertex.
async fn by_lesser_vertex(mesh: &Mesh, slices: &Slices) -> (Vec<u32>, Vec<HalfEdge>) {
    let mut first = vec![NONE; mesh.vertex_count()];
    let mut edges = Vec::with_capacity(mesh.triangle_count() * 2);
    let take = |(_, corners)| {
        let [a, b, c] = sorted(corners);
        if a == b || b == c {
            return;
        }
        let number = edges.len() as u32;
        let at_a = std::mem::replace(&mut first[a as usize], number);
        let at_b = std::mem::replace(&mut first[b as usize], number + 1);
        edges.extend_from_slice(&[[b, c, at_a], [c, a, at_b]]);
    };
    slices.for_each(triangles(mesh), take).await;
    (first, edges)
}

/// Three numbers in order.
fn sorted([a, b, c]: [u32; 3]) -> [u32; 3] {
    let (low, high) = (a.min(b), a.max(b));
    [low.min(c), high.min(c.max(low)), high.max(c)]
}

/// Triangles with their corners in order, sorted by these. One with equal corners is no triangle; it is told of elsewhere.
fn by_corners(mesh: &Mesh) -> Vec<([u32; 3], u32)> {
    let with_area: Vec<([u32; 3], u32)> = triangles(mesh)
        .map(|(triangle, corners)| (sorted(corners), triangle))
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
