//! From the parts to the file's words, every number rounded to the decimals that matter.

use std::collections::BTreeMap;

use bindpose::format::{AnimationClip, Dialect, Document, Subset, Vertex};
use glam::{DMat4, DVec2, DVec3};

use crate::charts::{self, Chart};
use crate::materials::Material;
use crate::order;
use crate::rig::Rig;
use crate::skin::Skin;
use crate::weights::Influences;

/// The whole document.
pub(crate) fn document(skin: &Skin, influences: &[Influences], rig: &Rig, clips: Vec<AnimationClip>) -> Document {
    let mut document = Document {
        dialect: Dialect::D3d12,
        materials: Material::ALL.map(Material::entry).to_vec(),
        bone_offsets: rig
            .joints
            .iter()
            .map(|joint| offset(joint.origin, joint.rotation))
            .collect(),
        bone_parents: rig
            .joints
            .iter()
            .map(|joint| joint.parent.map_or(-1, |parent| parent as i32))
            .collect(),
        clips,
        ..Document::default()
    };
    for (id, material) in Material::ALL.into_iter().enumerate() {
        let (vertex_start, face_start) = (document.vertices.len() as u32, document.triangles.len() as u32);
        add_triangles(&mut document, material, skin, influences, rig);
        document.subsets.push(Subset {
            id: id as u32,
            vertex_start,
            vertex_count: document.vertices.len() as u32 - vertex_start,
            face_start,
            face_count: document.triangles.len() as u32 - face_start,
        });
    }
    document
}

/// Adds the triangles of one material, with vertices of their own, split where charts meet or wrap.
fn add_triangles(document: &mut Document, material: Material, skin: &Skin, influences: &[Influences], rig: &Rig) {
    let mut added = BTreeMap::<(u32, [u32; 2], [u32; 4]), u32>::new();
    let mut triangles = Vec::new();
    for (corners, region) in skin.triangles.iter().zip(&skin.regions) {
        if region.material() != material {
            continue;
        }
        let points = corners.map(|corner| skin.positions[corner as usize]);
        let chart = charts::chart(rig, *region, points);
        let near = chart.tex_coords(points.into_iter().sum::<DVec3>() / 3.0, None);
        triangles.push(corners.map(|corner| {
            let (point, normal) = (skin.positions[corner as usize], skin.normals[corner as usize]);
            let tex_coords = chart.tex_coords(point, Some(near));
            let vertex = vertex(point, normal, chart, tex_coords, influences[corner as usize]);
            let key = (
                corner,
                vertex.tex_coords.map(f32::to_bits),
                vertex.tangent.map(f32::to_bits),
            );
            *added.entry(key).or_insert_with(|| {
                document.vertices.push(vertex);
                document.vertices.len() as u32 - 1
            })
        }));
    }
    // The vertices keep the order in which they lie in space: it compresses best.
    let order = order::for_vertex_cache(&triangles);
    document
        .triangles
        .extend(order.into_iter().map(|place| triangles[place]));
}

fn vertex(point: DVec3, normal: DVec3, chart: Chart, tex_coords: DVec2, influences: Influences) -> Vertex {
    let [x, y, z] = rounded(chart.tangent(point, normal), 4);
    Vertex {
        position: rounded(point, 5),
        tangent: [x, y, z, 1.0],
        normal: rounded(normal, 4),
        tex_coords: tex_coords.to_array().map(|value| round(value, 4)),
        blend_weights: influences.map(|(_, weight)| round(f64::from(weight) / 10_000.0, 4)),
        blend_indices: influences.map(|(joint, _)| joint as u32),
    }
}

/// Joint from bind in the file's order.
fn offset(origin: DVec3, rotation: glam::DQuat) -> [f32; 16] {
    let joint_from_bind = DMat4::from_rotation_translation(rotation, origin).inverse();
    joint_from_bind.to_cols_array().map(|value| round(value, 6))
}

/// Three numbers rounded.
pub(crate) fn rounded(vector: DVec3, decimals: i32) -> [f32; 3] {
    vector.to_array().map(|value| round(value, decimals))
}

/// Rounded to this many decimals, without a negative zero, as the nearest f32: its shortest text is those decimals.
pub(crate) fn round(value: f64, decimals: i32) -> f32 {
    let unit = 10f64.powi(decimals);
    ((value * unit).round() / unit + 0.0) as f32
}
