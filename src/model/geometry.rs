//! From the file's vertices and triangles to streams: finite, unit where they must be, every index in range.

use glam::{Vec2, Vec3};

use super::influences::influences_from_document;
use super::normals::{handedness_of, mended_normals};
use super::tangents::mended_tangents;
use super::{Handedness, Mesh, ModelError, ModelErrorKind, Skeleton};
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Subject, codes};
use crate::format::{Document, LineMap, Vertex};

/// Vertices that the books' 16-bit indices can name.
const BOOK_VERTEX_LIMIT: usize = 65_535;

/// The mesh, still without submeshes, and the handedness of its space.
pub(super) fn mesh_from_document(
    document: &Document,
    lines: &LineMap,
    skeleton: &Skeleton,
    diagnostics: &mut Diagnostics,
) -> Result<(Mesh, Handedness), ModelError> {
    let vertices = &document.vertices;
    let indices = indices(&document.triangles, vertices.len(), lines)?;
    if vertices.len() > BOOK_VERTEX_LIMIT {
        let count = vertices.len();
        let message = format!("There are {count} vertices; the books' 16-bit indices name {BOOK_VERTEX_LIMIT}.");
        diagnostics.add(&codes::MANY_VERTICES, Place::default(), message);
    }
    let positions = finite_stream(vertices, lines, diagnostics, "position", |vertex| vertex.position);
    let tex_coords = finite_stream(vertices, lines, diagnostics, "texture coordinate", |vertex| {
        vertex.tex_coords
    });
    let positions: Vec<Vec3> = positions.into_iter().map(Vec3::from_array).collect();
    let tex_coords: Vec<Vec2> = tex_coords.into_iter().map(Vec2::from_array).collect();
    let stored_normals: Vec<Vec3> = vertices.iter().map(|vertex| Vec3::from_array(vertex.normal)).collect();

    let handedness = handedness_of(&positions, &stored_normals, &indices, diagnostics);
    let normals = mended_normals(stored_normals, &positions, &indices, handedness, lines, diagnostics);
    let mut mesh = Mesh {
        positions,
        normals,
        tangents: Vec::new(),
        tex_coords,
        influences: influences_from_document(document, lines, skeleton, diagnostics)?,
        indices,
        submeshes: Vec::new(),
    };
    mesh.tangents = mended_tangents(vertices.iter().map(|vertex| vertex.tangent), &mesh, lines, diagnostics);
    Ok((mesh, handedness))
}

/// Triangles as one list, each index a vertex.
fn indices(triangles: &[[u32; 3]], vertex_count: usize, lines: &LineMap) -> Result<Vec<u32>, ModelError> {
    for (triangle, corners) in (0u32..).zip(triangles) {
        if let Some(&vertex) = corners.iter().find(|&&vertex| vertex as usize >= vertex_count) {
            return Err(ModelErrorKind::VertexOutOfRange {
                triangle,
                vertex,
                vertex_count: vertex_count as u32,
            }
            .on_line(lines.triangles.get(triangle as usize).copied()));
        }
    }
    Ok(triangles.as_flattened().to_vec())
}

/// One field of all vertices, with 0 for what is not a number.
fn finite_stream<const N: usize>(
    vertices: &[Vertex],
    lines: &LineMap,
    diagnostics: &mut Diagnostics,
    field: &str,
    of: impl Fn(&Vertex) -> [f32; N],
) -> Vec<[f32; N]> {
    let mut mended = Tally::default();
    let stream = (0u32..)
        .zip(vertices)
        .map(|(index, vertex)| {
            let stored = of(vertex);
            if stored.iter().all(|number| number.is_finite()) {
                return stored;
            }
            mended.add(index);
            stored.map(|number| if number.is_finite() { number } else { 0.0 })
        })
        .collect();
    if mended.count > 0 {
        diagnostics.add(
            &codes::VERTEX_NOT_FINITE,
            Place::of_rows(&mended, Subject::Vertex, &lines.vertices),
            format!(
                "{} a {field} that is not finite; taken as 0.",
                counted(mended.count, "vertex has", "vertices have")
            ),
        );
    }
    stream
}
