//! The triangles of a mesh as they are drawn: in ranges of one material, each once a pass, all wound one way, and as edges.
//!
//! They keep the file's order, which the books' exporter makes for the vertex cache: with a cache of 16 it shades 0.72 vertices a
//! triangle of the soldier, where 0.61 is the least.

use std::collections::BTreeMap;
use std::ops::Range;

use super::buffers::{Queue, Uploader};
use super::instances::texels_in_rows;
use super::pipelines::Layouts;
use crate::model::{Mesh, Model};

/// A submesh: a range of indices with one material.
pub struct DrawRange {
    pub submesh: usize,
    pub indices: Range<u32>,
    /// From the first to the last vertex that it uses.
    pub vertices: Range<u32>,
    pub material: u32,
}

/// The submeshes that are drawn: those with triangles and a material.
pub(super) fn draw_ranges(mesh: &Mesh, material_count: usize) -> Vec<DrawRange> {
    let submeshes = mesh.submeshes.iter().enumerate();
    submeshes
        .filter(|(_, submesh)| submesh.triangle_count > 0 && (submesh.material as usize) < material_count)
        .map(|(index, submesh)| {
            let indices = submesh.triangle_start * 3..(submesh.triangle_start + submesh.triangle_count) * 3;
            let used = &mesh.indices[indices.start as usize..indices.end as usize];
            let (first, last) = (used.iter().min(), used.iter().max());
            DrawRange {
                submesh: index,
                indices,
                vertices: first.copied().unwrap_or(0)..last.map_or(0, |last| last + 1),
                material: submesh.material,
            }
        })
        .collect()
}

/// The indices of a model, with the triangles of submeshes turned round that are wound against its hand. A triangle of several submeshes
/// goes with the first of them, as it is drawn.
pub(super) fn wound_one_way(model: &Model) -> Vec<u32> {
    let mut indices = model.mesh.indices.clone();
    let mut met = Drawn::default();
    for (submesh, is_turned) in model.mesh.submeshes.iter().zip(model.turned_submeshes()) {
        let start = submesh.triangle_start * 3;
        let parts = met.add(&(start..start + submesh.triangle_count * 3));
        for part in parts.into_iter().filter(|_| is_turned) {
            let (triangles, _) = indices[part.start as usize..part.end as usize].as_chunks_mut::<3>();
            triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
        }
    }
    indices
}

/// The ranges of indices that a pass has drawn, so that no triangle is drawn twice. A triangle of several submeshes shows the
/// first of them, since all lie at the same depth.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    /// Start -> end of ranges that neither touch nor overlap.
    ends: BTreeMap<u32, u32>,
}

impl Drawn {
    /// The parts of a range that were not drawn, in order.
    pub fn missing(&self, range: &Range<u32>) -> Vec<Range<u32>> {
        if range.is_empty() {
            return Vec::new();
        }
        let before = self.ends.range(..=range.start).next_back();
        let mut from = before.map_or(range.start, |(_, &end)| end.max(range.start));
        let mut parts = Vec::new();
        for (&start, &end) in self.ends.range(range.start + 1..=range.end) {
            parts.push(from..start);
            from = end;
        }
        parts.push(from..range.end);
        parts.retain(|part| !part.is_empty());
        parts
    }

    /// Adds a range. Returns the parts of it that were not drawn before, in order.
    pub fn add(&mut self, range: &Range<u32>) -> Vec<Range<u32>> {
        let parts = self.missing(range);
        if range.is_empty() {
            return parts;
        }
        let mut whole = range.clone();
        let before = self.ends.range(..=range.start).next_back();
        if let Some((&start, &end)) = before.filter(|(_, end)| **end >= range.start) {
            whole = start..end.max(range.end);
        }
        while let Some((&start, &end)) = self.ends.range(whole.start + 1..=range.end).next() {
            self.ends.remove(&start);
            whole.end = whole.end.max(end);
        }
        self.ends.insert(whole.start, whole.end);
        parts
    }

    /// All drawn indices, in as few ranges as possible.
    pub fn ranges(&self) -> impl Iterator<Item = Range<u32>> {
        self.ends.iter().map(|(&start, &end)| start..end)
    }
}

/// Edges as lines, since WebGL2 cannot draw triangles as wires. A submesh has each of its edges once.
pub(super) struct Edges {
    /// Pairs of vertex indices.
    pub(super) buffer: wgpu::Buffer,
    /// The pairs of each submesh in `buffer`, in the order in which they were passed.
    pub(super) ranges: Vec<Range<u32>>,
    /// The mesh's vertices as a texture: a shader of an edge looks up both of its ends there.
    pub(super) vertices: wgpu::BindGroup,
}

impl Edges {
    /// None where no texture is large enough for the vertices: 22 million where its side is 8192, more than the streams of a mesh can have.
    pub(super) fn new(
        (device, queue): (&wgpu::Device, &Queue),
        layouts: &Layouts,
        mesh: &Mesh,
        submeshes: impl Iterator<Item = Range<u32>>,
    ) -> Option<Self> {
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        let ranges = submeshes
            .map(|submesh| {
                let start = pairs.len() as u32;
                let triangles = mesh.indices.get(submesh.start as usize..submesh.end as usize);
                pairs.extend(edges(triangles.unwrap_or_default()));
                start..pairs.len() as u32
            })
            .collect();
        let vertices = (0..mesh.vertex_count()).map(|vertex| {
            let influences = mesh.influences.get(vertex).copied().unwrap_or_default();
            let position = mesh.positions[vertex].extend(0.0).to_array();
            [
                position,
                influences.joints.map(|joint| joint as f32),
                influences.weights,
            ]
        });
        let limits = device.limits();
        let texture = texels_in_rows(device, queue, &layouts.bones, vertices)?;
        let uploader = Uploader { device, queue, limits };
        let usage = wgpu::BufferUsages::VERTEX;
        let buffer = uploader.upload("edges", usage, pairs.len(), pairs.into_iter()).ok()?;
        Some(Self {
            buffer,
            ranges,
            vertices: texture,
        })
    }
}

/// The edges of some triangles, each once, whichever way its triangles go round.
pub fn edges(triangles: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    let mut edges: Vec<[u32; 2]> = triangles
        .chunks_exact(3)
        .flat_map(|corner| [[corner[0], corner[1]], [corner[1], corner[2]], [corner[2], corner[0]]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges.into_iter()
}
