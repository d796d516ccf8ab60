//! Texture coordinates and tangents that spoil the maps which a material names.

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Entry, Places, Subject, codes};
use crate::model::{Front, Green, Material, Mesh, Model};
use crate::slices::{Slices, at_once};

/// The cosine of the angle between a bitangent and the way in which v grows, below which it points clearly the other way: by more than 135°. In the books'
/// files a few slanted triangles come to 131°, and all else agrees.
const AGAINST: f64 = -std::f64::consts::FRAC_1_SQRT_2;

/// Notes subsets that see one point of their maps.
pub(super) fn note_equal_coords(model: &Model, places: &dyn Places, diagnostics: &mut Diagnostics) {
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
                Place::on(Subject::Subset(index), places.line(Entry::Subset(index))),
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
pub(super) async fn note_tangent_signs(
    model: &Model,
    places: &dyn Places,
    diagnostics: &mut Diagnostics,
    slices: &Slices,
) {
    let mut against = Tally::default();
    for vertex in against_in(model, slices).await {
        against.add(vertex);
    }
    if against.count > 0 {
        diagnostics.add(
            &codes::TANGENT_SIGN_AGAINST_UV,
            places.of_rows(&against, Subject::Vertex, Entry::Tangent),
            format!(
                "{} a tangent whose sign contradicts the texture coordinates.",
                counted(against.count, "vertex has", "vertices have")
            ),
        );
    }
}

/// Vertices whose tangent's sign says that the texture is mirrored where it is not, or the other way round. Only vertices of normal maps
/// are looked at, and only those of which every triangle contradicts the sign: where mirrored and other triangles share a vertex, no
/// sign is right, and the seam is too thin to be seen. glTF leaves it to the tangents where the green of its maps points: there a sign
/// contradicts what most of a material's have.
///
/// One triangle that agrees clears its vertices, and the others around these are not asked.
pub(crate) fn tangents_against(model: &Model) -> impl Iterator<Item = u32> {
    at_once(against_in(model, &Slices::ENDLESS)).into_iter()
}

async fn against_in(model: &Model, slices: &Slices) -> Vec<u32> {
    let mesh = &model.mesh;
    let greens = match model.front {
        Front::Negative => Vec::new(),
        Front::Positive => model.greens(),
    };
    let green = |material: usize| greens.get(material).copied().flatten().unwrap_or(Green::Down);
    let (mut accused, mut cleared) = (Vec::new(), vec![false; mesh.vertex_count()]);
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    for (wanted, sign) in [(Green::Down, 1.0), (Green::Up, -1.0)] {
        let is_such = |material: usize| {
            !mesh.tangents.is_empty() && model.materials[material].has_normal_map() && green(material) == wanted
        };
        if !(0..model.materials.len()).any(is_such) {
            continue;
        }
        // First those that can clear three vertices at once: the fewer are left to the others.
        for most_clear in [0, 2] {
            let hear = |triangle: usize| {
                let corners = triangles[triangle];
                let is_clear = corners.map(|vertex| cleared[vertex as usize]);
                if is_clear.into_iter().map(usize::from).sum::<usize>() > most_clear {
                    return;
                }
                let Some(along_v) = mesh.along_v(corners) else {
                    return;
                };
                for (vertex, _) in corners.into_iter().zip(is_clear).filter(|(_, is_clear)| !is_clear) {
                    let bitangent = mesh.bitangent(vertex) * sign;
                    let cosine = bitangent.dot(along_v);
                    // Most agree, and need no lengths.
                    if cosine < 0.0 && cosine < AGAINST * bitangent.length() * along_v.length() {
                        accused.push(vertex);
                    } else {
                        cleared[vertex as usize] = true;
                    }
                }
            };
            slices.for_each(model.triangles_of(is_such), hear).await;
        }
    }
    accused.sort_unstable();
    accused.dedup();
    accused.retain(|&vertex: &u32| !cleared[vertex as usize]);
    accused
}
