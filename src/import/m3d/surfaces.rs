//! From the file's materials and subsets to ours: what is drawn with what.

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Code, Subject, codes};
use crate::format::{self, Dialect, Document, LineMap, Subset};
use crate::model::{AlphaMode, Material, Reflectance, Submesh, unique_names};
use crate::sorting;

/// The ranges to draw. May add one default material for subsets that have none.
pub(super) fn submeshes_from_document(
    document: &Document,
    lines: &LineMap,
    materials: &mut Vec<Material>,
    diagnostics: &mut Diagnostics,
) -> Vec<Submesh> {
    let triangle_count = document.triangles.len() as u32;
    let file_materials = materials.len() as u32;
    if document.subsets.is_empty() {
        if triangle_count == 0 {
            return Vec::new();
        }
        if materials.is_empty() {
            materials.push(default_material(materials));
        }
        if document.dialect == Dialect::Text {
            return vec![Submesh {
                triangle_start: 0,
                triangle_count,
                material: 0,
            }];
        }
        diagnostics.add(
            &codes::NO_SUBSETS,
            Place::default(),
            format!("The file has no subset; all {triangle_count} triangles are drawn with the first material."),
        );
        return vec![Submesh {
            triangle_start: 0,
            triangle_count,
            material: 0,
        }];
    }

    let mut without_material = None;
    let submeshes: Vec<Submesh> = (0u32..)
        .zip(&document.subsets)
        .map(|(index, subset)| {
            let (triangle_start, triangle_count) = clamped(index, subset, triangle_count, lines, diagnostics);
            if index >= file_materials {
                without_material.get_or_insert(index);
            }
            Submesh {
                triangle_start,
                triangle_count,
                material: index.min(file_materials),
            }
        })
        .collect();
    if let Some(first) = without_material {
        materials.push(default_material(materials));
        let count = document.subsets.len() - first as usize;
        diagnostics.add(
            &codes::SUBSET_WITHOUT_MATERIAL,
            Place::of(Subject::Subset(first), &lines.subsets),
            format!(
                "{} no material; drawn in a default grey.",
                counted(count, "subset has", "subsets have")
            ),
        );
    }
    note_coverage(&submeshes, triangle_count, lines, diagnostics);
    note_relative_indices(document, lines, diagnostics);
    submeshes
}

/// The part of a subset's range that exists.
fn clamped(
    index: u32,
    subset: &Subset,
    triangle_count: u32,
    lines: &LineMap,
    diagnostics: &mut Diagnostics,
) -> (u32, u32) {
    let start = subset.face_start.min(triangle_count);
    let count = subset.face_count.min(triangle_count - start);
    if (start, count) != (subset.face_start, subset.face_count) {
        let (first, wanted) = (subset.face_start, subset.face_count);
        diagnostics.add(
            &codes::SUBSET_OUT_OF_RANGE,
            Place::of(Subject::Subset(index), &lines.subsets),
            format!(
                "Subset {index} asks for {wanted} triangles from {first} on, but the file has {triangle_count}; {count} of \
                 them are drawn.",
            ),
        );
    }
    (start, count)
}

/// Triangles in no range are not drawn; triangles in several are drawn shared.
fn note_coverage(submeshes: &[Submesh], triangle_count: u32, lines: &LineMap, diagnostics: &mut Diagnostics) {
    let mut ranges: Vec<(u32, u32)> = submeshes
        .iter()
        .filter(|submesh| submesh.triangle_count > 0)
        .map(|submesh| (submesh.triangle_start, submesh.triangle_start + submesh.triangle_count))
        .collect();
    sorting::sort(&mut ranges);
    let (mut drawn_to, mut shared_to) = (0, 0);
    let (mut undrawn, mut shared) = (Tally::default(), Tally::default());
    for (start, end) in ranges {
        if start > drawn_to {
            undrawn.add_range(drawn_to..start);
        }
        let shared_end = drawn_to.min(end);
        shared.add_range(start.max(shared_to)..shared_end);
        shared_to = shared_to.max(shared_end);
        drawn_to = drawn_to.max(end);
    }
    undrawn.add_range(drawn_to..triangle_count);
    let mut note = |code: &Code, triangles: &Tally, rule: &str| {
        if triangles.count > 0 {
            let belong = counted(triangles.count, "triangle belongs", "triangles belong");
            let place = Place::of_rows(triangles, Subject::Triangle, &lines.triangles);
            diagnostics.add(code, place, format!("{belong} to {rule}."));
        }
    };
    note(&codes::TRIANGLES_UNDRAWN, &undrawn, "no subset; not drawn");
    note(&codes::TRIANGLES_SHARED, &shared, "more than one subset");
}

/// Indices are absolute in every known file. A later subset whose indices all lie below its `VertexStart`, but would fill
/// its vertex range when counted from there, was most likely written for a loader that adds `VertexStart`.
fn note_relative_indices(document: &Document, lines: &LineMap, diagnostics: &mut Diagnostics) {
    let highest = HighestIndices::new(&document.triangles);
    for (index, subset) in (0u32..).zip(&document.subsets) {
        let Some(highest) = highest.of(subset) else {
            continue;
        };
        let fits = subset.vertex_count > 0
            && highest == subset.vertex_count - 1
            && u64::from(subset.vertex_start) + u64::from(subset.vertex_count) <= document.vertices.len() as u64;
        if fits && highest < subset.vertex_start {
            diagnostics.add(
                &codes::INDICES_LOOK_RELATIVE,
                Place::of(Subject::Subset(index), &lines.subsets),
                format!(
                    "The triangles of subset {index} name only vertices before its VertexStart {}; they are taken as they \
                     stand, but look counted from there.",
                    subset.vertex_start
                ),
            );
        }
    }
}

/// The highest vertex index in any range of triangles, without a look at each of them: subsets may overlap.
struct HighestIndices {
    /// A tree: node i has the highest of nodes 2i and 2i + 1. The second half are the triangles in their order.
    nodes: Vec<u32>,
}

impl HighestIndices {
    fn new(triangles: &[[u32; 3]]) -> Self {
        let mut nodes = vec![0; triangles.len()];
        nodes.extend(triangles.iter().map(|&[a, b, c]| a.max(b).max(c)));
        for node in (1..triangles.len()).rev() {
            nodes[node] = nodes[2 * node].max(nodes[2 * node + 1]);
        }
        Self { nodes }
    }

    /// `None` for a subset of no triangles.
    fn of(&self, subset: &Subset) -> Option<u32> {
        let count = self.nodes.len() / 2;
        let start = (subset.face_start as usize).min(count);
        let end = start.saturating_add(subset.face_count as usize).min(count);
        // The nodes that together cover the range, from the triangles upward.
        let (mut low, mut high) = (start + count, end + count);
        let mut highest = None;
        while low < high {
            if low % 2 == 1 {
                highest = highest.max(Some(self.nodes[low]));
                low += 1;
            }
            if high % 2 == 1 {
                high -= 1;
                highest = highest.max(Some(self.nodes[high]));
            }
            low /= 2;
            high /= 2;
        }
        highest
    }
}

/// What a subset without a material is drawn with.
pub(super) fn default_material(others: &[Material]) -> Material {
    let names = others.iter().map(|material| material.name.as_str()).chain(["default"]);
    let name = unique_names(names, "material", |_, _| ()).pop().unwrap_or_default();
    Material {
        name,
        ..Material::default()
    }
}

/// One material for each of the file's.
pub(super) fn materials_from_document(
    document: &Document,
    lines: &LineMap,
    diagnostics: &mut Diagnostics,
) -> Vec<Material> {
    let names = unique_names(
        document.materials.iter().map(|material| material.name.as_str()),
        "material",
        |index, name| {
            diagnostics.add(
                &codes::DUPLICATE_MATERIAL_NAME,
                Place::of(Subject::Material(index), &lines.materials),
                format!("Another material has the same name; this one is shown as \"{name}\"."),
            );
        },
    );
    document
        .materials
        .iter()
        .zip(names)
        .map(|(material, name)| Material {
            name,
            diffuse: finite(material.diffuse),
            reflectance: reflectance(material.reflectance),
            alpha: AlphaMode::clipped(material.alpha_clip),
            diffuse_map: material.diffuse_map.clone().map(Into::into),
            normal_map: material.normal_map.clone().map(Into::into),
            ..Material::default()
        })
        .collect()
}

fn reflectance(stored: format::Reflectance) -> Reflectance {
    match stored {
        format::Reflectance::Fresnel { fresnel0, roughness } => Reflectance::Fresnel {
            fresnel0: finite(fresnel0),
            roughness: finite([roughness])[0],
        },
        format::Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity,
        } => Reflectance::Phong {
            ambient: finite(ambient),
            specular: finite(specular),
            spec_power: finite([spec_power])[0],
            reflectivity: finite(reflectivity),
        },
    }
}

/// Shading must not see a NaN: one such pixel spreads through every blur. Zero adds nothing.
fn finite<const N: usize>(numbers: [f32; N]) -> [f32; N] {
    numbers.map(|number| if number.is_finite() { number } else { 0.0 })
}
