//! From the file's vertices and triangles to streams: finite, unit where they must be, every index in range.

use glam::{Vec2, Vec3, Vec4};

use super::influences::influences_from_document;
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::limits::MOST_VERTICES;
use crate::diagnostic::{Fault, Subject, codes};
use crate::format::{Dialect, Document, LineMap, Vertex, VertexField};
use crate::import::normals::{handedness_of, make_normals_unit, mend_normals};
use crate::import::tangents::mend_tangents;
use crate::model::{Handedness, Mesh, Skeleton};
use crate::slices::{Slices, Stage};

/// The mesh, still without submeshes, and the handedness of its space.
pub(super) async fn mesh_from_document(
    document: &Document,
    lines: &LineMap,
    skeleton: &Skeleton,
    diagnostics: &mut Diagnostics,
    slices: &Slices,
) -> Result<(Mesh, Handedness), Fault> {
    let vertices = &document.vertices;
    if vertices.len() > MOST_VERTICES {
        let count = vertices.len();
        let message = format!("There are {count} vertices; the books' 16-bit indices can number {MOST_VERTICES}.");
        diagnostics.add(&codes::MANY_VERTICES, Place::default(), message);
    }
    let positions = finite_stream(vertices, lines, diagnostics, VertexField::Position, |vertex| {
        vertex.position
    });
    slices.pause().await;
    let tex_coords = finite_stream(vertices, lines, diagnostics, VertexField::TexCoords, |vertex| {
        vertex.tex_coords
    });
    slices.pause().await;
    let mut mesh = Mesh {
        positions: positions.into_iter().map(Vec3::from_array).collect(),
        normals: vertices.iter().map(|vertex| Vec3::from_array(vertex.normal)).collect(),
        tangents: vertices.iter().map(|vertex| Vec4::from_array(vertex.tangent)).collect(),
        tex_coords: tex_coords.into_iter().map(Vec2::from_array).collect(),
        indices: document.triangles.as_flattened().to_vec(),
        ..Mesh::default()
    };
    slices.pause().await;
    mesh.check().map_err(|fault| match fault.subject {
        Some(Subject::Triangle(triangle)) => fault.on_line(lines.triangles.get(triangle as usize).copied()).into(),
        _ => fault,
    })?;
    let missing = make_normals_unit(&mut mesh, slices).await;
    let handedness = handedness_of(&mesh, diagnostics, slices).await;
    slices.pause_at(Stage::Building, 2, 4).await;
    let lines_of = |field| move || lines.vertex_lines(field);
    mend_normals(
        &mut mesh,
        &missing,
        handedness,
        lines_of(VertexField::Normal),
        diagnostics,
    );
    mesh.influences = influences_from_document(document, lines, skeleton, diagnostics, slices).await?;
    if document.dialect == Dialect::Text {
        // It has none, and no map that asks for them.
        mesh.tangents = Vec::new();
        return Ok((mesh, handedness));
    }
    mend_tangents(&mut mesh, lines_of(VertexField::Tangent), diagnostics, slices).await;
    Ok((mesh, handedness))
}

/// One field of all vertices, with 0 for what is not a number.
fn finite_stream<const N: usize>(
    vertices: &[Vertex],
    lines: &LineMap,
    diagnostics: &mut Diagnostics,
    field: VertexField,
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
        let name = if field == VertexField::Position {
            "position"
        } else {
            "texture coordinate"
        };
        diagnostics.add(
            &codes::VERTEX_NOT_FINITE,
            Place::of_rows(&mended, Subject::Vertex, &lines.vertex_lines(field)),
            format!(
                "{} a {name} that is not finite; taken as 0.",
                counted(mended.count, "vertex has", "vertices have")
            ),
        );
    }
    stream
}
