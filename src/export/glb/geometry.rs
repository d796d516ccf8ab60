//! Vertices and triangles.

use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

use glam::{Vec2, Vec4};
use serde_json::{Value, json};

use super::binary::{Binary, Target, UNSIGNED_BYTE, UNSIGNED_INT, UNSIGNED_SHORT};
use super::skeleton::is_unweighted;
use super::space::Space;
use crate::model::{Influences, Model};

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

/// The mesh; none where no submesh has a triangle. Primitives whose triangles overlap share indices and vertices; others have vertices of
/// their own, unless that would hardly make them fewer. `has_maps` says that something is looked up by texture coordinates.
pub(super) fn mesh(
    model: &Model,
    space: &Space,
    (turned, has_maps): (&[bool], bool),
    unmoving: Option<usize>,
    binary: &mut Binary,
) -> Option<Value> {
    let drawn = || model.mesh.submeshes.iter().filter(|submesh| submesh.triangle_count > 0);
    drawn().next()?;
    let parts = parts(model);
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
    let primitives: Vec<Value> = drawn()
        .map(|submesh| {
            let start = submesh.triangle_start as usize;
            let part = parts.partition_point(|part| part.triangles.end <= start);
            let offset = starts[part] + 3 * size * (start - parts[part].triangles.start);
            let count = 3 * submesh.triangle_count;
            let indices = made.entry((offset, count));
            let indices =
                *indices.or_insert_with(|| binary.accessor(view, offset, count as usize, component, "SCALAR"));
            json!({ "attributes": attributes[part], "indices": indices, "material": submesh.material })
        })
        .collect();
    Some(json!({ "primitives": primitives }))
}

fn parts(model: &Model) -> Vec<Part> {
    let mesh = &model.mesh;
    let submeshes = mesh.submeshes.iter().filter(|submesh| submesh.triangle_count > 0);
    let mut ranges: Vec<Range<usize>> = submeshes
        .map(|submesh| {
            let start = submesh.triangle_start as usize;
            start..start + submesh.triangle_count as usize
        })
        .collect();
    ranges.sort_by_key(|range| (range.start, range.end));
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
    let all = mesh.vertex_count();
    let is_shared = ranges.len() * all <= (2 * needed).max(FEW_VERTICES);
    let is_apart = used.windows(2).all(|pair| pair[0].last() < pair[1].first());
    let (shared, mut end) = (Rc::new((0..all as u32).collect::<Vec<_>>()), 0);
    let last = used.len() - 1;
    let parts = joined.into_iter().zip(used).enumerate();
    parts
        .map(|(index, ((triangles, _), used))| {
            let vertices = match (is_shared, is_apart) {
                (true, _) => Rc::clone(&shared),
                // Vertices that no triangle uses stay with those before them.
                (_, true) if index == last => Rc::new((end as u32..all as u32).collect()),
                (_, true) => Rc::new((end as u32..used.last().map_or(0, |last| last + 1)).collect()),
                _ => Rc::new(used),
            };
            let start = if is_shared { 0 } else { end };
            end = start + vertices.len();
            Part {
                triangles,
                rows: start..end,
                vertices,
            }
        })
        .collect()
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
    (0..parts.len())
        .map(|part| {
            let of_part = lists
                .iter()
                .map(|(name, accessors)| (String::from(*name), json!(accessors[part.min(accessors.len() - 1)])));
            Value::Object(of_part.collect())
        })
        .collect()
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
