//! Vertices, triangles and the ranges that are drawn with one material.

use glam::{Vec2, Vec3, Vec4};

use crate::diagnostic::{Fault, Subject, codes};

/// Up to four joints that move a vertex. Weights are normalised: they sum to 1, or all are zero and the vertex stays where
/// bind space has it. Unused slots have joint 0 and weight 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Influences {
    /// Joint indices into the skeleton (parents-first order, not the file's numbering).
    pub joints: [u32; 4],
    /// Weights, 0…1.
    pub weights: [f32; 4],
}

/// Vertex streams in bind space, in the file's order. All streams have one length, or are empty where their doc says so;
/// `influences` are when the model has no joints.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Positions in bind space; finite.
    pub positions: Vec<Vec3>,
    /// Unit normals in bind space.
    pub normals: Vec<Vec3>,
    /// Unit tangents in bind space; w = ±1, bitangent = w · cross(normal, tangent). Empty where the file has none and no normal map
    /// asks for them: [`Mesh::tangents_or_computed`].
    pub tangents: Vec<Vec4>,
    /// Texture coordinates, origin top left, repeating.
    pub tex_coords: Vec<Vec2>,
    /// A second set of texture coordinates; empty where no map takes them.
    pub second_tex_coords: Vec<Vec2>,
    /// Linear colours with alpha that multiply the diffuse colour and opacity of materials; empty where all are white.
    pub colors: Vec<Vec4>,
    /// Which joints move each vertex; empty for a static model.
    pub influences: Vec<Influences>,
    /// Three vertex indices a triangle, each below `positions.len()`; the file's winding.
    pub indices: Vec<u32>,
    /// Ranges drawn with one material, in the file's order.
    pub submeshes: Vec<Submesh>,
}

/// A range of triangles with one material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Submesh {
    /// First triangle.
    pub triangle_start: u32,
    /// Number of triangles; the range lies inside the mesh.
    pub triangle_count: u32,
    /// Index into the model's materials.
    pub material: u32,
}

impl Mesh {
    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    /// The vertices at the corners of a triangle, by its index. None if there is no such triangle.
    pub fn triangle(&self, index: u32) -> Option<[u32; 3]> {
        let start = (index as usize).checked_mul(3)?;
        self.indices.get(start..)?.first_chunk().copied()
    }

    /// Proves that positions are finite, that the streams of the vertices have one length, and that indices come in threes and
    /// name vertices that are there.
    ///
    /// # Errors
    /// When one of them does not hold.
    pub fn check(&self) -> Result<(), Fault> {
        let vertex_count = self.vertex_count();
        let or_none = |length: usize| if length == 0 { vertex_count } else { length };
        let streams = [
            ("normals", self.normals.len()),
            ("tangents", or_none(self.tangents.len())),
            ("texture coordinates", self.tex_coords.len()),
            ("second texture coordinates", or_none(self.second_tex_coords.len())),
            ("colors", or_none(self.colors.len())),
        ];
        for (stream, length) in streams {
            if length != vertex_count {
                return Err(stream_length(stream, length, vertex_count));
            }
        }
        // Nearly always all are sound. Looking at all of them without a branch is the quickest way to know.
        let are_finite = self.positions.iter().fold(true, |are, at| are & at.is_finite());
        let faulty = (!are_finite).then(|| self.positions.iter().position(|at| !at.is_finite()));
        if let Some(vertex) = faulty.flatten() {
            let message = format!("The position of vertex {vertex} holds a number that is not finite.");
            return Err(codes::POSITION_NOT_FINITE.says(message).into());
        }
        if !self.indices.len().is_multiple_of(3) {
            let message = format!("There are {} indices; three make a triangle.", self.indices.len());
            return Err(codes::INCOMPLETE_TRIANGLE.says(message).into());
        }
        let Some(place) = out_of_range(&self.indices, vertex_count) else {
            return Ok(());
        };
        let (triangle, vertex) = ((place / 3) as u32, self.indices[place]);
        let message = format!("Triangle {triangle} names vertex {vertex}, but there are {vertex_count} vertices.");
        let fault = codes::VERTEX_OUT_OF_RANGE.says(message);
        let fault = fault.expected(format!("a vertex below {vertex_count}"));
        Err(fault
            .found(vertex.to_string())
            .about(Subject::Triangle(triangle))
            .into())
    }
}

pub(super) fn stream_length(stream: &str, length: usize, vertex_count: usize) -> Fault {
    let message = format!("There are {length} {stream} for {vertex_count} vertices; every vertex has one.");
    codes::STREAM_LENGTH.says(message).into()
}

/// The first place of an index that names no vertex.
pub(crate) fn out_of_range(indices: &[u32], vertex_count: usize) -> Option<usize> {
    let is_out = |vertex: u32| vertex as usize >= vertex_count;
    let greatest = indices.iter().copied().max()?;
    let first = is_out(greatest).then(|| indices.iter().position(|&vertex| is_out(vertex)));
    first.flatten()
}
