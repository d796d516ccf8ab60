//! Texture coordinates and tangents that spoil the maps which a material names.

use glam::DVec3;

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Subject, codes};
use crate::format::{LineMap, VertexField};
use crate::model::{Material, Mesh, Model};

/// The cosine of the angle between a bitangent and the way in which v grows, below which it points clearly the other way: by more than 135°. In the books'
/// files a few slanted triangles come to 131°, and all else agrees.
const AGAINST: f64 = -std::f64::consts::FRAC_1_SQRT_2;

/// Notes subsets that see one point of their maps.
pub(super) fn note_equal_coords(model: &Model, lines: &LineMap, diagnostics: &mut Diagnostics) {
    let has_map = |material: &Material| material.diffuse_map.is_some() || material.normal_map.is_some();
    let ends = ends_of_equal_coords(&model.mesh);
    for (index, submesh) in (0u32..).zip(&model.mesh.submeshes) {
        let end = submesh.triangle_start + submesh.triangle_count;
        let is_one = ends
            .get(submesh.triangle_start as usize)
            .is_some_and(|&end_of_equal| end_of_equal >= end);
        if is_one && submesh.triangle_count > 0 && has_map(&model.materials[submesh.material as usize]) {
            diagnostics.add(
                &codes::TEX_COORDS_EQUAL,
                Place::of(Subject::Subset(index), &lines.subsets),
                format!("All texture coordinates of subset {index} are equal, so its maps show one point."),
            );
        }
    }
}

/// For each triangle the end of the triangles from it on whose corners all have the same texture coordinates. Subsets may overlap, and
/// need no look at each of their triangles then. Empty when no triangle has equal ones.
fn ends_of_equal_coords(mesh: &Mesh) -> Vec<u32> {
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    let coords = |vertex: u32| mesh.tex_coords[vertex as usize];
    let is_one = |&[a, b, c]: &[u32; 3]| coords(a) == coords(b) && coords(b) == coords(c);
    if !triangles.iter().any(is_one) {
        return Vec::new();
    }
    let mut ends = vec![0; triangles.len()];
    for (index, triangle) in triangles.iter().enumerate().rev() {
        ends[index] = match triangles.get(index + 1) {
            _ if !is_one(triangle) => index as u32,
            Some(next) if is_one(next) && coords(next[0]) == coords(triangle[0]) => ends[index + 1],
            _ => index as u32 + 1,
        };
    }
    ends
}

/// Warns of tangents whose sign contradicts the texture coordinates.
pub(super) fn note_tangent_signs(model: &Model, lines: &LineMap, diagnostics: &mut Diagnostics) {
    let mut against = Tally::default();
    tangents_against(model).for_each(|vertex| against.add(vertex));
    if against.count > 0 {
        diagnostics.add(
            &codes::TANGENT_SIGN_AGAINST_UV,
            Place::of_rows(&against, Subject::Vertex, &lines.vertex_lines(VertexField::Tangent)),
            format!(
                "{} a tangent whose sign contradicts the texture coordinates.",
                counted(against.count, "vertex has", "vertices have")
            ),
        );
    }
}

/// Vertices whose tangent's sign says that the texture is mirrored where it is not, or the other way round. Only vertices of normal maps
/// are looked at, and only those of which every triangle contradicts the sign: where mirrored and other triangles share a vertex, no
/// sign is right, and the seam is too thin to be seen.
pub(crate) fn tangents_against(model: &Model) -> impl Iterator<Item = u32> {
    let mesh = &model.mesh;
    let (mut accused, mut cleared) = (vec![false; mesh.vertex_count()], vec![false; mesh.vertex_count()]);
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    for corners in normal_mapped(model).map(|triangle| triangles[triangle]) {
        let Some(along_v) = along_v(mesh, corners) else {
            continue;
        };
        for vertex in corners.map(|vertex| vertex as usize) {
            let tangent = mesh.tangents[vertex];
            let bitangent = (mesh.normals[vertex].cross(tangent.truncate()) * tangent.w).as_dvec3();
            let cosine = bitangent.dot(along_v);
            // Most agree, and need no lengths.
            let is_against = cosine < 0.0 && cosine < AGAINST * bitangent.length() * along_v.length();
            accused[vertex] |= is_against;
            cleared[vertex] |= !is_against;
        }
    }
    let vertices = (0u32..).zip(accused.into_iter().zip(cleared));
    vertices
        .filter(|(_, (accused, cleared))| *accused && !*cleared)
        .map(|(vertex, _)| vertex)
}

/// The triangles of subsets with a normal map, each once.
fn normal_mapped(model: &Model) -> impl Iterator<Item = usize> {
    // How many such subsets begin at a triangle, less those that end there.
    let mut changes = vec![0_i64; model.mesh.triangle_count() + 1];
    for submesh in &model.mesh.submeshes {
        if model.materials[submesh.material as usize].normal_map.is_some() {
            changes[submesh.triangle_start as usize] += 1;
            changes[(submesh.triangle_start + submesh.triangle_count) as usize] -= 1;
        }
    }
    let mut inside = 0;
    let triangles = changes.into_iter().enumerate();
    triangles.filter_map(move |(triangle, change)| {
        inside += change;
        (inside > 0).then_some(triangle)
    })
}

/// The sine of a triangle's angle, on the surface or in the texture, below which its directions are rounding errors: half a degree.
const NEEDLE: f64 = 0.01;

/// The direction in which v grows on a triangle, of any length. `None` where it is a needle, there or in the texture.
fn along_v(mesh: &Mesh, corners: [u32; 3]) -> Option<DVec3> {
    let [a, b, c] = corners.map(|vertex| vertex as usize);
    let position = |vertex: usize| mesh.positions[vertex].as_dvec3();
    let coords = |vertex: usize| mesh.tex_coords[vertex].as_dvec2();
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
