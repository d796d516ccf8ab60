//! From the parts to the file's words, every number rounded to the decimals that matter.

use bindpose::format::{AnimationClip, Dialect, Document, Subset, Vertex};
use glam::{DMat4, DVec3};

use crate::atlas::Atlas;
use crate::materials::Material;
use crate::order;
use crate::parts::Kit;
use crate::shape::POSITION_DECIMALS;

/// The whole document.
pub(crate) fn document(kit: &Kit<'_>, clips: Vec<AnimationClip>) -> Document {
    let atlas = Atlas::new(&kit.charts);
    let joints = &kit.rig.joints;
    let mut document = Document {
        dialect: Dialect::D3d12,
        materials: Material::ALL.map(Material::entry).to_vec(),
        bone_offsets: joints
            .iter()
            .map(|joint| offset(joint.origin, joint.rotation))
            .collect(),
        bone_parents: joints
            .iter()
            .map(|joint| joint.parent.map_or(-1, |parent| parent as i32))
            .collect(),
        clips,
        ..Document::default()
    };
    for (id, material) in Material::ALL.into_iter().enumerate() {
        let (vertex_start, face_start) = (document.vertices.len() as u32, document.triangles.len() as u32);
        add_pieces(&mut document, material, kit, &atlas);
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

/// Adds the pieces of one material.
fn add_pieces(document: &mut Document, material: Material, kit: &Kit<'_>, atlas: &Atlas) {
    for piece in kit.pieces.iter().filter(|piece| piece.solid.material == material) {
        let solid = &piece.solid;
        let first = document.vertices.len() as u32;
        document.vertices.extend(solid.corners.iter().map(|corner| {
            let [x, y, z] = rounded(corner.tangent, 3);
            let tex_coords = atlas.tex_coords(piece.chart, corner.chart, solid.chart_size);
            Vertex {
                position: rounded(corner.position, POSITION_DECIMALS),
                tangent: [x, y, z, 1.0],
                normal: rounded(corner.normal, 3),
                tex_coords: tex_coords.to_array().map(|value| round(value, 4)),
                blend_weights: corner.influences.map(|(_, weight)| round(f64::from(weight) / 100.0, 2)),
                blend_indices: corner.influences.map(|(joint, _)| joint as u32),
            }
        }));
        let order = order::for_vertex_cache(&solid.triangles);
        let triangles = order.into_iter().map(|place| solid.triangles[place]);
        document
            .triangles
            .extend(triangles.map(|triangle| triangle.map(|corner| first + corner)));
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
