//! Models made by hand for the tests of session and interface: a box of 2 × 4 × 1 on the ground, off the middle.

use bindpose::format::{
    self, AnimationClip, BoneAnimation, Dialect, Document, Keyframe, Material, Reflectance, Subset, Vertex,
};
use bindpose::session::File;
use glam::{Quat, Vec3};

/// Keys a second of every clip with more than one key.
pub(crate) const KEYS_PER_SEC: f32 = 30.0;
/// The box that stands at the origin's side, in the file's space.
pub(crate) const BOX: [Vec3; 2] = [Vec3::new(-0.5, 0.0, -1.0), Vec3::new(1.5, 4.0, 0.0)];

/// Name, start, number of keys.
pub(crate) type ClipPlan<'a> = (&'a str, f32, u32);

/// The clips of [`moving`]: a second from 0, two seconds from 0.5, and one of a single key.
pub(crate) const CLIPS: [ClipPlan<'static>; 3] = [("Bend", 0.0, 31), ("Turn", 0.5, 61), ("Still", 0.25, 1)];

/// A file of two bones whose upper one turns.
pub(crate) fn moving(path: &str) -> File {
    file(path, &skinned(&CLIPS))
}

/// A file of two bones that never move.
pub(crate) fn jointed(path: &str) -> File {
    file(path, &skinned(&[]))
}

/// A file without bones.
pub(crate) fn still(path: &str) -> File {
    file(path, &document())
}

/// A file that ends in the middle of its vertices, in the word `Normal` of its tenth vertex.
pub(crate) fn broken(path: &str) -> File {
    let text = format::write(&document());
    let (start, _) = text.match_indices("Normal: ").nth(9).expect("ten vertices");
    File::new(path, text.as_bytes()[..start + "Norm".len()].to_vec())
}

/// Writes a document.
pub(crate) fn file(path: &str, document: &Document) -> File {
    File::new(path, format::write(document).into_bytes())
}

/// The box with two bones and these clips.
pub(crate) fn skinned(clips: &[ClipPlan<'_>]) -> Document {
    let mut document = document();
    let mut offset = [
        1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    ];
    document.bone_offsets.push(offset);
    offset[13] = -2.0;
    document.bone_offsets.push(offset);
    document.bone_parents = vec![-1, 0];
    for vertex in &mut document.vertices {
        let upper = vertex.position[1] / 4.0;
        vertex.blend_weights = [1.0 - upper, upper, 0.0, 0.0];
        vertex.blend_indices = [0, 1, 0, 0];
    }
    document.clips = clips.iter().map(clip).collect();
    document
}

fn clip(&(name, start_secs, keys): &ClipPlan<'_>) -> AnimationClip {
    let key = |index: u32, translation, angle: f32| Keyframe {
        time_secs: start_secs + index as f32 / KEYS_PER_SEC,
        translation,
        scale: [1.0; 3],
        rotation: Quat::from_rotation_z(angle).to_array(),
    };
    let swing = |index: u32| 1.2 * (index as f32 * 0.2).sin();
    let lower = (0..keys).map(|index| key(index, [0.0; 3], 0.0)).collect();
    let upper = (0..keys)
        .map(|index| key(index, [0.0, 2.0, 0.0], swing(index)))
        .collect();
    AnimationClip {
        name: name.to_owned(),
        bones: vec![BoneAnimation { keyframes: lower }, BoneAnimation { keyframes: upper }],
    }
}

/// The box without bones: clockwise fronts, as left-handed files have them.
pub(crate) fn document() -> Document {
    let [min, max] = BOX;
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for side in 0..6 {
        let (axis, sign) = (side / 2, if side % 2 == 0 { 1.0 } else { -1.0 });
        let [normal, u, v] = [0, 1, 2].map(|next| Vec3::AXES[(axis + next) % 3]);
        let first = vertices.len() as u32;
        for (along_u, along_v) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            let unit = normal * sign + u * along_u + v * along_v;
            vertices.push(Vertex {
                position: ((min + max) * 0.5 + (max - min) * 0.5 * unit).to_array(),
                tangent: u.extend(sign).to_array(),
                normal: (normal * sign).to_array(),
                tex_coords: [along_u * 0.5 + 0.5, along_v * 0.5 + 0.5],
                ..Vertex::default()
            });
        }
        let corners = if sign > 0.0 {
            [[0, 1, 2], [0, 2, 3]]
        } else {
            [[0, 2, 1], [0, 3, 2]]
        };
        triangles.extend(corners.map(|corners| corners.map(|corner| first + corner)));
    }
    Document {
        dialect: Dialect::D3d12,
        materials: vec![Material {
            name: "Painted".to_owned(),
            diffuse: [0.7, 0.3, 0.2],
            reflectance: Reflectance::Fresnel {
                fresnel0: [0.04; 3],
                roughness: 0.5,
            },
            alpha_clip: false,
            type_name: "Skinned".to_owned(),
            diffuse_map: None,
            normal_map: None,
        }],
        subsets: vec![Subset {
            id: 0,
            vertex_start: 0,
            vertex_count: vertices.len() as u32,
            face_start: 0,
            face_count: triangles.len() as u32,
        }],
        vertices,
        triangles,
        ..Document::default()
    }
}

/// A cube map of one colour, 32 bits a texel.
pub(crate) fn cube(path: &str, side: u32, color: [u8; 4]) -> File {
    let mut words = [0_u32; 31];
    words[0] = 124;
    words[1] = 0x1007;
    (words[2], words[3]) = (side, side);
    words[18] = 32;
    // Colour and alpha by masks.
    words[19] = 0x41;
    words[21] = 32;
    words[22..26].copy_from_slice(&[0xff, 0xff00, 0xff_0000, 0xff00_0000]);
    // A cube with all of its faces.
    words[27] = 0xfe00;
    let mut bytes = b"DDS ".to_vec();
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    bytes.extend(color.repeat(6 * (side * side) as usize));
    File::new(path, bytes)
}
