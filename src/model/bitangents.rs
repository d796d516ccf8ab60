//! Which way bitangents go in the texture, and so the green of normal maps.

use std::ops::Range;

use glam::DVec3;

use super::{Mesh, Model, Submesh};
use crate::sorting;

/// Where the green of a normal map points in its picture, which is where bitangents go: w · cross(normal, tangent).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Green {
    /// Along v, as in the books.
    Down,
    /// Against v, as in glTF.
    Up,
}

/// The sine of a triangle's angle, on the surface or in the texture, below which its directions are rounding errors: half a degree.
const NEEDLE: f64 = 0.01;

impl Model {
    /// Where the green of each material's normal map points, as most corners of its triangles have it. `None` where no corner tells.
    pub fn greens(&self) -> Vec<Option<Green>> {
        let mesh = &self.mesh;
        if mesh.tangents.is_empty() {
            return vec![None; self.materials.len()];
        }
        let (triangles, _) = mesh.indices.as_chunks::<3>();
        // Of all triangles before each: corners whose bitangent goes down less those where it goes up. Submeshes may overlap.
        let mut sums = Vec::with_capacity(triangles.len() + 1);
        let mut sum = 0_i64;
        sums.push(sum);
        for &corners in triangles {
            if let Some(along_v) = mesh.along_v(corners) {
                for vertex in corners {
                    let along = mesh.bitangent(vertex).dot(along_v);
                    sum += i64::from(along > 0.0) - i64::from(along < 0.0);
                }
            }
            sums.push(sum);
        }
        let mut of_materials = vec![0; self.materials.len()];
        for submesh in &mesh.submeshes {
            let start = submesh.triangle_start as usize;
            let end = start + submesh.triangle_count as usize;
            of_materials[submesh.material as usize] += sums[end] - sums[start];
        }
        let green = |down_less_up: i64| match down_less_up {
            1.. => Some(Green::Down),
            0 => None,
            _ => Some(Green::Up),
        };
        of_materials.into_iter().map(green).collect()
    }

    /// Turns the bitangents of the vertices of such materials, so that green of their normal maps means the other direction.
    pub fn turn_bitangents(&mut self, is_such: impl Fn(usize) -> bool) {
        let are_turned = self.vertices_of(is_such);
        for (tangent, is_turned) in self.mesh.tangents.iter_mut().zip(are_turned) {
            if is_turned {
                tangent.w = -tangent.w;
            }
        }
    }

    /// Whether each vertex is one of triangles with such a material.
    pub fn vertices_of(&self, is_such: impl Fn(usize) -> bool) -> Vec<bool> {
        let mut are = vec![false; self.mesh.vertex_count()];
        let (triangles, _) = self.mesh.indices.as_chunks::<3>();
        for triangle in self.triangles_of(is_such) {
            for vertex in triangles[triangle] {
                are[vertex as usize] = true;
            }
        }
        are
    }

    /// The triangles with such a material, each once.
    pub fn triangles_of(&self, is_such: impl Fn(usize) -> bool) -> impl Iterator<Item = usize> {
        let submeshes = self.mesh.submeshes.iter();
        let such = submeshes.filter(|submesh| is_such(submesh.material as usize));
        let range = |submesh: &Submesh| submesh.triangle_start..submesh.triangle_start + submesh.triangle_count;
        let mut ranges: Vec<Range<u32>> = such.map(range).collect();
        sorting::sort_by_key(&mut ranges, |range| range.start);
        let mut end = 0;
        ranges.into_iter().flat_map(move |range| {
            let start = range.start.max(end);
            end = end.max(range.end);
            start as usize..range.end as usize
        })
    }
}

impl Mesh {
    /// w · cross(normal, tangent). The mesh has tangents.
    pub fn bitangent(&self, vertex: u32) -> DVec3 {
        let tangent = self.tangents[vertex as usize];
        let normal = self.normals[vertex as usize];
        (normal.cross(tangent.truncate()) * tangent.w).as_dvec3()
    }

    /// The direction in which v grows on a triangle, of any length. `None` where it is a needle, there or in the texture.
    #[inline]
    pub fn along_v(&self, corners: [u32; 3]) -> Option<DVec3> {
        let [a, b, c] = corners.map(|vertex| vertex as usize);
        let position = |vertex: usize| self.positions[vertex].as_dvec3();
        let coords = |vertex: usize| self.tex_coords[vertex].as_dvec2();
        let (edge_1, edge_2) = (position(b) - position(a), position(c) - position(a));
        let (step_1, step_2) = (coords(b) - coords(a), coords(c) - coords(a));
        let texture_area = step_1.perp_dot(step_2);
        let is_needle = |area_squared: f64, sides_squared: f64| area_squared <= NEEDLE * NEEDLE * sides_squared;
        if is_needle(
            texture_area * texture_area,
            step_1.length_squared() * step_2.length_squared(),
        ) || is_needle(
            edge_1.cross(edge_2).length_squared(),
            edge_1.length_squared() * edge_2.length_squared(),
        ) {
            return None;
        }
        Some((edge_2 * step_1.x - edge_1 * step_2.x) * texture_area.signum())
    }
}
