//! Edges of triangles as lines: WebGL2 cannot draw triangles as wires.

use std::ops::Range;

use wgpu::util::DeviceExt as _;

/// Pairs of vertex indices, an edge once for each submesh that has it.
pub(super) struct Edges {
    pub(super) buffer: wgpu::Buffer,
    /// Indices of each submesh's edges, in the order that was asked for.
    pub(super) ranges: Vec<Range<u32>>,
}

impl Edges {
    pub(super) fn new(device: &wgpu::Device, triangles: &[u32], submeshes: impl Iterator<Item = Range<u32>>) -> Self {
        let mut indices: Vec<u32> = Vec::new();
        let ranges = submeshes
            .map(|submesh| {
                let start = indices.len() as u32;
                indices.extend(edges(&triangles[submesh.start as usize..submesh.end as usize]));
                start..indices.len() as u32
            })
            .collect();
        // An empty buffer cannot be bound.
        if indices.is_empty() {
            indices.extend([0, 0]);
        }
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("edges"),
            contents: bytemuck::cast_slice(&indices),
            usage: wgpu::BufferUsages::INDEX,
        });
        Self { buffer, ranges }
    }
}

/// The edges of some triangles, each once, whichever way its triangles run.
fn edges(triangles: &[u32]) -> impl Iterator<Item = u32> {
    let mut edges: Vec<[u32; 2]> = triangles
        .chunks_exact(3)
        .flat_map(|corner| [[corner[0], corner[1]], [corner[1], corner[2]], [corner[2], corner[0]]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges.into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_of_a_square_have_five_edges() {
        let found: Vec<u32> = edges(&[0, 1, 2, 2, 1, 3]).collect();
        assert_eq!(found, [0, 1, 0, 2, 1, 2, 1, 3, 2, 3]);
    }
}
