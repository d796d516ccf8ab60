//! Vertices and triangles.

use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

use glam::{Vec2, Vec4};
use serde_json::{Value, json};

use super::binary::{Binary, Target, UNSIGNED_BYTE, UNSIGNED_INT, UNSIGNED_SHORT};
use super::skeleton::is_unweighted;
use super::space::Space;
use crate::model::{Influences, Model, Object, Submesh};
use crate::sorting;

/// Primitives that name no more vertices than this together share them all, as the model has them.
const FEW_VERTICES: usize = 4096;

/// Triangles that submeshes draw and that no others overlap, and the vertices that stand for them.
struct Part {
    triangles: Range<usize>,
    /// Places in the list of written vertices.
    rows: Range<usize>,
    /// In ascending order.
    vertices: Rc<Vec<u32>>,
}

/// The mesh of each object, or one where there are none; those where no submesh has a triangle are left out. Primitives of a mesh whose
/// triangles overlap share indices and vertices; others have vertices of their own, unless that would hardly make them fewer. `has_maps` says
/// that something is looked up by texture coordinates.
pub(super) fn meshes<'a>(
    model: &'a Model,
    space: &Space,
    (turned, has_maps): (&[bool], bool),
    unmoving: Option<usize>,
    binary: &mut Binary,
) -> Vec<(Option<&'a Object>, Value)> {
    let drawn = |of: Range<usize>| -> Vec<&Submesh> {
        let submeshes = model.mesh.submeshes[of].iter();
        submeshes.filter(|submesh| submesh.triangle_count > 0).collect()
    };
    let whole = model
        .objects
        .is_empty()
        .then(|| (None, drawn(0..model.mesh.submeshes.len())));
    let objects = model
        .objects
        .iter()
        .map(|object| (Some(object), drawn(object.submeshes.clone())));
    let mut meshes: Vec<(Option<&Object>, Vec<&Submesh>)> = whole.into_iter().chain(objects).collect();
    meshes.retain(|(_, submeshes)| !submeshes.is_empty());
    if meshes.is_empty() {
        return Vec::new();
    }
    let (mut parts, mut parts_of) = (Vec::new(), Vec::with_capacity(meshes.len()));
    for ((_, submeshes), vertices) in meshes.iter().zip(vertices_of(model, &meshes)) {
        let start = parts.len();
        add_parts(model, submeshes, vertices, &mut parts);
        parts_of.push(start..parts.len());
    }
    let attributes = attributes(model, space, (turned, has_maps), unmoving, &parts, binary);
    // The greatest number of a type ends strips.
    let is_short = parts.iter().all(|part| part.vertices.len() < usize::from(u16::MAX));
    let (component, size) = if is_short {
        (UNSIGNED_SHORT, 2)
    } else {
        (UNSIGNED_INT, 4)
    };
    let mut bytes = Vec::new();
    // Of submeshes that overlap the first one decides.
    let turned_round = model.turned_submeshes();
    let mut turned_at: HashMap<usize, bool> = HashMap::new();
    for (submesh, is_turned) in model.mesh.submeshes.iter().zip(turned_round) {
        if submesh.triangle_count > 0 {
            turned_at.entry(submesh.triangle_start as usize).or_insert(is_turned);
        }
    }
    let mut starts = Vec::with_capacity(parts.len());
    for part in &parts {
        bytes.resize(bytes.len().next_multiple_of(size), 0);
        starts.push(bytes.len());
        let corners = &model.mesh.indices[3 * part.triangles.start..3 * part.triangles.end];
        let is_turned = turned_at.get(&part.triangles.start).copied().unwrap_or_default();
        // Ours run with the clock, seen from outside; but for those of a submesh that is wound otherwise than the model.
        let front = move |&[a, b, c]: &[u32; 3]| if is_turned { [a, b, c] } else { [a, c, b] };
        let against = corners.as_chunks().0.iter().flat_map(front);
        let (first, all) = (part.vertices.first().copied().unwrap_or_default(), &part.vertices);
        let is_range = all.last().is_some_and(|last| (last - first) as usize + 1 == all.len());
        // A part has no more vertices than the mesh.
        let rows = against.map(|corner| match is_range {
            true => corner - first,
            false => all.partition_point(|&vertex| vertex < corner) as u32,
        });
        if is_short {
            bytes.extend(rows.flat_map(|row| (row as u16).to_le_bytes()));
        } else {
            bytes.extend(rows.flat_map(u32::to_le_bytes));
        }
    }
    let view = binary.view(&bytes, Target::Indices);
    let mut made: HashMap<(usize, u32), usize> = HashMap::new();
    let mut primitives = |(submeshes, of_mesh): (&[&Submesh], &Range<usize>)| -> Vec<Value> {
        let primitives = submeshes.iter().map(|submesh| {
            let start = submesh.triangle_start as usize;
            let part = parts[of_mesh.clone()].partition_point(|part| part.triangles.end <= start);
            let part = of_mesh.start + part;
            let offset = starts[part] + 3 * size * (start - parts[part].triangles.start);
            let count = 3 * submesh.triangle_count;
            let indices = made.entry((offset, count));
            let indices =
                *indices.or_insert_with(|| binary.accessor(view, offset, count as usize, component, "SCALAR"));
            json!({ "attributes": attributes[part], "indices": indices, "material": submesh.material })
        });
        primitives.collect()
    };
    let meshes = meshes.into_iter().zip(&parts_of);
    let meshes = meshes.map(|((object, submeshes), parts)| {
        let primitives = primitives((&submeshes, parts));
        (object, json!({ "primitives": primitives }))
    });
    meshes.collect()
}

/// The vertices that each mesh can take: what lies between its first and its last, and what no triangle uses with those before it; all
/// for one mesh alone.
fn vertices_of(model: &Model, meshes: &[(Option<&Object>, Vec<&Submesh>)]) -> Vec<Range<u32>> {
    let used = meshes.iter().map(|(_, submeshes)| {
        let corners = submeshes
            .iter()
            .flat_map(|submesh| &model.mesh.indices[corners_of(submesh)]);
        corners.fold((u32::MAX, 0), |(first, last), &corner| {
            (first.min(corner), last.max(corner))
        })
    });
    let mut ranges: Vec<Range<u32>> = used.map(|(first, last)| first..last + 1).collect();
    let is_apart = ranges.array_windows().all(|[one, next]| one.end <= next.start);
    if is_apart {
        let ends = ranges.iter().skip(1).map(|range| range.start);
        let ends: Vec<u32> = ends.chain([model.mesh.vertex_count() as u32]).collect();
        let mut start = 0;
        for (range, end) in ranges.iter_mut().zip(ends) {
            (range.start, range.end, start) = (start, end, end);
        }
    }
    ranges
}

fn corners_of(submesh: &Submesh) -> Range<usize> {
    let start = submesh.triangle_start as usize;
    3 * start..3 * (start + submesh.triangle_count as usize)
}

/// Adds the parts of a mesh of these submeshes.
fn add_parts(model: &Model, submeshes: &[&Submesh], all: Range<u32>, parts: &mut Vec<Part>) {
    let mesh = &model.mesh;
    let triangles = submeshes.iter().map(|submesh| corners_of(submesh));
    let mut ranges: Vec<Range<usize>> = triangles.map(|range| range.start / 3..range.end / 3).collect();
    sorting::sort_by_key(&mut ranges, |range| (range.start, range.end));
    // How many submeshes draw each part.
    let mut joined: Vec<(Range<usize>, usize)> = Vec::new();
    for range in &ranges {
        match joined.last_mut() {
            Some((part, count)) if range.start < part.end => (part.end, *count) = (part.end.max(range.end), *count + 1),
            _ => joined.push((range.clone(), 1)),
        }
    }
    let used: Vec<Vec<u32>> = joined
        .iter()
        .map(|(part, _)| {
            let mut vertices = mesh.indices[3 * part.start..3 * part.end].to_vec();
            vertices.sort_unstable();
            vertices.dedup();
            vertices
        })
        .collect();
    let needed: usize = used
        .iter()
        .zip(&joined)
        .map(|(used, (_, count))| used.len() * count)
        .sum();
    let is_shared = ranges.len() * all.len() <= (2 * needed).max(FEW_VERTICES);
    let is_apart = used.windows(2).all(|pair| pair[0].last() < pair[1].first());
    let shared = Rc::new(all.clone().collect::<Vec<_>>());
    let (mut next, mut row) = (all.start, parts.last().map_or(0, |part| part.rows.end));
    let last = used.len() - 1;
    for (index, ((triangles, _), used)) in joined.into_iter().zip(used).enumerate() {
        let vertices = if is_shared {
            Rc::clone(&shared)
        } else if is_apart {
            // Vertices that no triangle uses stay with those before them.
            let behind = used.last().map_or(next, |last| last + 1);
            let end = if index == last { all.end } else { behind };
            let vertices = Rc::new((next..end).collect());
            next = end;
            vertices
        } else {
            Rc::new(used)
        };
        let rows = row..row + vertices.len();
        if !is_shared {
            row = rows.end;
        }
        parts.push(Part {
            triangles,
            rows,
            vertices,
        });
    }
}

/// The accessors of the vertices of each part. Bitangents of `turned` materials go the other way.
fn attributes(
    model: &Model,
    space: &Space,
    (turned, has_maps): (&[bool], bool),
    unmoving: Option<usize>,
    parts: &[Part],
    binary: &mut Binary,
) -> Vec<Value> {
    let mesh = &model.mesh;
    let mut ranges: Vec<Range<usize>> = parts.iter().map(|part| part.rows.clone()).collect();
    ranges.dedup();
    let mut rows = Vec::with_capacity(mesh.vertex_count());
    for part in parts {
        // Parts that share their vertices have the same rows.
        if part.rows.end > rows.len() {
            rows.extend(part.vertices.iter().map(|&vertex| vertex as usize));
        }
    }
    let rows = || rows.iter().copied();
    let mut lists: Vec<(&str, Vec<usize>)> = Vec::new();
    let positions: Vec<[f32; 3]> = rows().map(|row| space.vector(mesh.positions[row]).to_array()).collect();
    lists.push(("POSITION", binary.slices(&positions, Target::Vertices, true, &ranges)));
    let normals: Vec<[f32; 3]> = rows().map(|row| space.vector(mesh.normals[row]).to_array()).collect();
    lists.push(("NORMAL", binary.slices(&normals, Target::Vertices, false, &ranges)));
    let is_second = !mesh.second_tex_coords.is_empty();
    if has_maps || is_second || mesh.tex_coords.iter().any(|at| *at != Vec2::ZERO) {
        let tex_coords: Vec<[f32; 2]> = rows().map(|row| mesh.tex_coords[row].to_array()).collect();
        lists.push((
            "TEXCOORD_0",
            binary.slices(&tex_coords, Target::Vertices, false, &ranges),
        ));
    }
    if !mesh.tangents.is_empty() {
        let are_turned = model.vertices_of(|material| turned[material]);
        let tangents = rows().map(|row| {
            let [x, y, z, sign] = space.tangent(mesh.tangents[row]).to_array();
            [x, y, z, if are_turned[row] { -sign } else { sign }]
        });
        let tangents: Vec<[f32; 4]> = tangents.collect();
        lists.push(("TANGENT", binary.slices(&tangents, Target::Vertices, false, &ranges)));
    }
    if is_second {
        let second: Vec<[f32; 2]> = rows().map(|row| mesh.second_tex_coords[row].to_array()).collect();
        lists.push(("TEXCOORD_1", binary.slices(&second, Target::Vertices, false, &ranges)));
    }
    if !mesh.colors.is_empty() {
        let color = |row: usize| mesh.colors[row].clamp(Vec4::ZERO, Vec4::ONE).to_array();
        let colors: Vec<[f32; 4]> = rows().map(color).collect();
        lists.push(("COLOR_0", binary.slices(&colors, Target::Vertices, false, &ranges)));
    }
    if !mesh.influences.is_empty() {
        let influences = rows().map(|row| slots(model, &mesh.influences[row], unmoving));
        let (joints, weights): (Vec<[u16; 4]>, Vec<[f32; 4]>) = influences.unzip();
        let joints = joints.as_flattened();
        let (bytes, component, size): (Vec<u8>, u32, usize) = if joints.iter().all(|&joint| joint <= u16::from(u8::MAX))
        {
            (joints.iter().map(|&joint| joint as u8).collect(), UNSIGNED_BYTE, 4)
        } else {
            (
                joints.iter().flat_map(|joint| joint.to_le_bytes()).collect(),
                UNSIGNED_SHORT,
                8,
            )
        };
        let view = binary.view(&bytes, Target::Vertices);
        binary.set_stride(view, size, ranges.len());
        let of_parts = ranges
            .iter()
            .map(|part| binary.accessor(view, size * part.start, part.len(), component, "VEC4"));
        lists.push(("JOINTS_0", of_parts.collect()));
        lists.push(("WEIGHTS_0", binary.slices(&weights, Target::Vertices, false, &ranges)));
    }
    // The ranges stand in the order of their parts.
    let places = parts
        .iter()
        .map(|part| ranges.partition_point(|range| range.start < part.rows.start));
    let attributes = places.map(|place| {
        let of_part = lists
            .iter()
            .map(|(name, accessors)| (String::from(*name), json!(accessors[place])));
        Value::Object(of_part.collect())
    });
    attributes.collect()
}

/// Joints and weights as glTF wants them: each joint once, and 0 where there is no weight.
fn slots(model: &Model, influences: &Influences, unmoving: Option<usize>) -> ([u16; 4], [f32; 4]) {
    if let Some(unmoving) = unmoving
        && is_unweighted(influences)
    {
        return ([unmoving as u16, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]);
    }
    let (mut joints, mut weights) = ([0; 4], influences.weights);
    for slot in 0..4 {
        if weights[slot] == 0.0 {
            continue;
        }
        let joint = influences.joints[slot];
        match (0..slot).find(|&before| weights[before] > 0.0 && influences.joints[before] == joint) {
            Some(before) => {
                weights[before] += weights[slot];
                weights[slot] = 0.0;
            }
            None => joints[slot] = model.skeleton.file_bones()[joint as usize] as u16,
        }
    }
    (joints, weights)
}
