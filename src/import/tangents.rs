//! Tangents: unit length and a sign of ±1, computed from the texture coordinates where the file has none.

use glam::{DVec2, DVec3, Vec3, Vec4};

use super::normals::{at_unit_length, is_direction};
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Code, Subject, codes};
use crate::model::Mesh;

/// Makes the tangents of a mesh unit vectors with a sign of ±1. The normals are unit vectors already. Tangents that are zero or
/// not finite follow the u axis of the triangles around; where the texture coordinates give no direction, they are any vector
/// square to the normal. `lines` gives the line of each tangent in the file, or none; it is asked only if there is something to tell.
pub(super) fn mend_tangents(mesh: &mut Mesh, lines: impl Fn() -> Vec<u32>, diagnostics: &mut Diagnostics) {
    let (mut missing, mut signs) = (Tally::default(), Tally::default());
    for (index, tangent) in (0u32..).zip(&mesh.tangents) {
        if !is_direction(tangent.truncate()) {
            missing.add(index);
        } else if tangent.w.abs() != 1.0 {
            signs.add(index);
        }
    }
    let axes = if missing.count > 0 {
        texture_axes(mesh)
    } else {
        Vec::new()
    };
    for (index, tangent) in mesh.tangents.iter_mut().enumerate() {
        let direction = tangent.truncate();
        *tangent = if is_direction(direction) {
            let sign = if tangent.w < 0.0 { -1.0 } else { 1.0 };
            at_unit_length(direction).extend(sign)
        } else {
            axes[index].tangent(mesh.normals[index])
        };
    }
    let mut warn = |code: &Code, tally: Tally, rule: &str| {
        if tally.count > 0 {
            let place = Place::of_rows(&tally, Subject::Vertex, &lines());
            diagnostics.add(
                code,
                place,
                format!("{} {rule}", counted(tally.count, "vertex has", "vertices have")),
            );
        }
    };
    let rule = "a tangent that is zero or not finite; computed from the texture coordinates.";
    warn(&codes::TANGENTS_MISSING, missing, rule);
    warn(
        &codes::TANGENT_SIGN,
        signs,
        "a tangent whose fourth number is not 1 or −1; its sign is kept.",
    );
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

/// For each vertex the sum over its triangles, each weighted by its area. Triangles without an area on the surface or in
/// the texture say nothing.
fn texture_axes(mesh: &Mesh) -> Vec<TextureAxes> {
    let mut axes = vec![TextureAxes::default(); mesh.vertex_count()];
    for corners in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|corner| corners[corner] as usize);
        let position = |vertex: usize| mesh.positions[vertex].as_dvec3();
        let texture = |vertex: usize| mesh.tex_coords[vertex].as_dvec2();
        let (edge_1, edge_2) = (position(b) - position(a), position(c) - position(a));
        let (step_1, step_2): (DVec2, DVec2) = (texture(b) - texture(a), texture(c) - texture(a));
        let texture_area = step_1.perp_dot(step_2);
        let area = edge_1.cross(edge_2).length();
        let along_u = (edge_1 * step_2.y - edge_2 * step_1.y) * texture_area.signum();
        let along_v = (edge_2 * step_1.x - edge_1 * step_2.x) * texture_area.signum();
        if texture_area == 0.0 {
            continue;
        }
        for corner in [a, b, c] {
            axes[corner].along_u += along_u.normalize_or_zero() * area;
            axes[corner].along_v += along_v.normalize_or_zero() * area;
        }
    }
    axes
}
