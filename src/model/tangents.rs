//! Tangents computed from the texture coordinates.

use std::borrow::Cow;

use glam::{DVec3, Vec3, Vec4};

use super::Mesh;
use crate::slices::{Slices, at_once};

impl Mesh {
    /// The tangents, or computed ones where the mesh has none.
    pub fn tangents_or_computed(&self) -> Cow<'_, [Vec4]> {
        if self.tangents.is_empty() {
            Cow::Owned(self.computed_tangents())
        } else {
            Cow::Borrowed(&self.tangents)
        }
    }

    /// A tangent for each vertex: along the u axis of the triangles around, square to the normal, which is a unit vector; w makes the
    /// bitangent go along v. Where the texture coordinates give no direction, it is any vector square to the normal.
    pub fn computed_tangents(&self) -> Vec<Vec4> {
        let axes = at_once(texture_axes(self, |_| true, &Slices::ENDLESS)).into_iter();
        axes.zip(&self.normals)
            .map(|(axes, &normal)| axes.tangent(normal))
            .collect()
    }

    /// The same tangents of some vertices alone: only the triangles around them are looked at closely.
    pub(crate) async fn computed_tangents_of(&self, vertices: &[u32], slices: &Slices) -> Vec<Vec4> {
        let mut is_asked = vec![false; self.vertex_count()];
        vertices.iter().for_each(|&vertex| is_asked[vertex as usize] = true);
        let axes = texture_axes(self, |vertex| is_asked.get(vertex).copied().unwrap_or(false), slices).await;
        let tangent = |&vertex: &u32| axes[vertex as usize].tangent(self.normals[vertex as usize]);
        vertices.iter().map(tangent).collect()
    }
}

/// Where u and v grow on the surface around a vertex.
#[derive(Clone, Copy, Default)]
struct TextureAxes {
    along_u: DVec3,
    along_v: DVec3,
}

impl TextureAxes {
    /// Square to the normal; the sign makes w · cross(normal, tangent) point along v.
    fn tangent(&self, normal: Vec3) -> Vec4 {
        let normal = normal.as_dvec3();
        let across = self.along_u - normal * normal.dot(self.along_u);
        let Some(tangent) = across.try_normalize() else {
            return normal.any_orthonormal_vector().as_vec3().extend(1.0);
        };
        let sign = if normal.cross(tangent).dot(self.along_v) < 0.0 {
            -1.0
        } else {
            1.0
        };
        tangent.as_vec3().extend(sign)
    }
}

/// For each vertex that is asked for the sum over its triangles, each weighted by its area. Triangles without an area on the surface or in
/// the texture are skipped, and those of which the mesh lacks a corner.
async fn texture_axes(mesh: &Mesh, is_asked: impl Fn(usize) -> bool, slices: &Slices) -> Vec<TextureAxes> {
    let mut axes = vec![TextureAxes::default(); mesh.vertex_count()];
    let corner = |at: usize| Some((mesh.positions.get(at)?.as_dvec3(), mesh.tex_coords.get(at)?.as_dvec2()));
    let add = |&[a, b, c]: &[u32; 3]| {
        let (a, b, c) = (a as usize, b as usize, c as usize);
        if !(is_asked(a) || is_asked(b) || is_asked(c)) {
            return;
        }
        let (Some((at_a, on_a)), Some((at_b, on_b)), Some((at_c, on_c))) = (corner(a), corner(b), corner(c)) else {
            return;
        };
        let (edge_1, edge_2) = (at_b - at_a, at_c - at_a);
        let (step_1, step_2) = (on_b - on_a, on_c - on_a);
        let texture_area = step_1.perp_dot(step_2);
        let area = edge_1.cross(edge_2).length();
        if texture_area == 0.0 {
            return;
        }
        let along_u = (edge_1 * step_2.y - edge_2 * step_1.y) * texture_area.signum();
        let along_v = (edge_2 * step_1.x - edge_1 * step_2.x) * texture_area.signum();
        let (along_u, along_v) = (along_u.normalize_or_zero() * area, along_v.normalize_or_zero() * area);
        for corner in [a, b, c] {
            axes[corner].along_u += along_u;
            axes[corner].along_v += along_v;
        }
    };
    slices.for_each(mesh.indices.as_chunks().0, add).await;
    axes
}
