//! Vertices and triangles.

use serde_json::{Value, json};

use super::binary::{Binary, Target, UNSIGNED_BYTE, UNSIGNED_INT, UNSIGNED_SHORT};
use super::skeleton::is_unweighted;
use super::space::Space;
use crate::model::{Influences, Model};

/// The mesh; none where no submesh has a triangle.
pub(super) fn mesh(
    model: &Model,
    space: &Space,
    turned: &[bool],
    unmoving: Option<usize>,
    binary: &mut Binary,
) -> Option<Value> {
    model.mesh.submeshes.iter().find(|submesh| submesh.triangle_count > 0)?;
    let attributes = attributes(model, space, turned, unmoving, binary);
    // The greatest number of a type ends strips.
    let is_short = model.mesh.vertex_count() < usize::from(u16::MAX);
    let (component, size) = if is_short {
        (UNSIGNED_SHORT, 2)
    } else {
        (UNSIGNED_INT, 4)
    };
    let mut bytes = Vec::new();
    let mut ranges = Vec::new();
    let turned_round = model.turned_submeshes();
    let drawn = model.mesh.submeshes.iter().zip(&turned_round);
    for (submesh, &is_turned) in drawn.filter(|(submesh, _)| submesh.triangle_count > 0) {
        bytes.resize(bytes.len().next_multiple_of(size), 0);
        let first = 3 * submesh.triangle_start as usize;
        let corners = &model.mesh.indices[first..first + 3 * submesh.triangle_count as usize];
        ranges.push((submesh.material, bytes.len(), corners.len()));
        // Ours run with the clock, seen from outside; but for those of a submesh that is wound otherwise than the model.
        let front = |&[a, b, c]: &[u32; 3]| if is_turned { [a, b, c] } else { [a, c, b] };
        let against = corners.as_chunks().0.iter().flat_map(front);
        if is_short {
            bytes.extend(against.flat_map(|corner| (corner as u16).to_le_bytes()));
        } else {
            bytes.extend(against.flat_map(u32::to_le_bytes));
        }
    }
    let view = binary.view(&bytes, Target::Indices);
    let primitives: Vec<Value> = ranges
        .into_iter()
        .map(|(material, offset, count)| {
            let indices = binary.accessor(view, offset, count, component, "SCALAR");
            json!({ "attributes": attributes, "indices": indices, "material": material })
        })
        .collect();
    Some(json!({ "primitives": primitives }))
}

/// The accessors of the vertices, which all primitives share. Vertices that no triangle uses are among them. Bitangents of `turned`
/// materials go the other way.
fn attributes(model: &Model, space: &Space, turned: &[bool], unmoving: Option<usize>, binary: &mut Binary) -> Value {
    let mesh = &model.mesh;
    let positions: Vec<[f32; 3]> = mesh.positions.iter().map(|&at| space.vector(at).to_array()).collect();
    let normals: Vec<[f32; 3]> = mesh
        .normals
        .iter()
        .map(|&normal| space.vector(normal).to_array())
        .collect();
    let tex_coords: Vec<[f32; 2]> = mesh.tex_coords.iter().map(|at| at.to_array()).collect();
    let mut attributes = json!({
        "POSITION": binary.floats(&positions, Target::Vertices, true),
        "NORMAL": binary.floats(&normals, Target::Vertices, false),
        "TEXCOORD_0": binary.floats(&tex_coords, Target::Vertices, false),
    });
    if !mesh.tangents.is_empty() {
        let are_turned = model.vertices_of(|material| turned[material]);
        let tangents = mesh.tangents.iter().zip(are_turned).map(|(&tangent, is_turned)| {
            let [x, y, z, sign] = space.tangent(tangent).to_array();
            [x, y, z, if is_turned { -sign } else { sign }]
        });
        let tangents: Vec<[f32; 4]> = tangents.collect();
        attributes["TANGENT"] = json!(binary.floats(&tangents, Target::Vertices, false));
    }
    if !mesh.second_tex_coords.is_empty() {
        let second: Vec<[f32; 2]> = mesh.second_tex_coords.iter().map(|at| at.to_array()).collect();
        attributes["TEXCOORD_1"] = json!(binary.floats(&second, Target::Vertices, false));
    }
    if !mesh.colors.is_empty() {
        let colors: Vec<[f32; 4]> = mesh.colors.iter().map(|color| color.to_array()).collect();
        attributes["COLOR_0"] = json!(binary.floats(&colors, Target::Vertices, false));
    }
    if !mesh.influences.is_empty() {
        let influences = mesh
            .influences
            .iter()
            .map(|influences| slots(model, influences, unmoving));
        let (joints, weights): (Vec<[u16; 4]>, Vec<[f32; 4]>) = influences.unzip();
        let count = joints.len();
        let joints = joints.as_flattened();
        let (bytes, component): (Vec<u8>, u32) = if joints.iter().all(|&joint| joint <= u16::from(u8::MAX)) {
            (joints.iter().map(|&joint| joint as u8).collect(), UNSIGNED_BYTE)
        } else {
            (
                joints.iter().flat_map(|joint| joint.to_le_bytes()).collect(),
                UNSIGNED_SHORT,
            )
        };
        let view = binary.view(&bytes, Target::Vertices);
        attributes["JOINTS_0"] = json!(binary.accessor(view, 0, count, component, "VEC4"));
        attributes["WEIGHTS_0"] = json!(binary.floats(&weights, Target::Vertices, false));
    }
    attributes
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
