//! The figure as the DirectX 12 book's demo shows it. The demo mirrors z, scales by 0.05 and turns round, since its soldier is
//! right-handed and 72 units high; it takes bitangents from the mirrored model, plays one clip, and reads maps as DDS.

use bindpose::check::book::DEMO_CLIP;
use bindpose::format::Document;

use crate::document::round;

/// Units of the file in a metre: 1.8 m are the height of the book's soldier.
pub(crate) const UNITS_PER_METRE: f64 = 40.0;

/// From metres, left-handed: x is mirrored, lengths are in the demo's units, the first clip and the maps have the names that it knows.
pub(crate) fn for_the_demo(mut document: Document) -> Document {
    for vertex in &mut document.vertices {
        vertex.position = place(vertex.position);
        vertex.normal = direction(vertex.normal);
        let [x, y, z, sign] = vertex.tangent;
        let [x, y, z] = direction([x, y, z]);
        // A mirror turns cross(normal, tangent) round.
        vertex.tangent = [x, y, z, -sign];
    }
    for offset in &mut document.bone_offsets {
        *offset = transform(*offset);
    }
    for clip in &mut document.clips {
        for key in clip.bones.iter_mut().flat_map(|bone| &mut bone.keyframes) {
            key.translation = place(key.translation);
            let [x, y, z, w] = key.rotation;
            key.rotation = [x, 0.0 - y, 0.0 - z, w];
        }
    }
    if let Some(clip) = document.clips.first_mut() {
        DEMO_CLIP.clone_into(&mut clip.name);
    }
    let maps = document.materials.iter_mut();
    for name in maps
        .flat_map(|material| [&mut material.diffuse_map, &mut material.normal_map])
        .flatten()
    {
        *name = name.replace(".png", ".dds");
    }
    document
}

/// Without a negative zero.
fn direction([x, y, z]: [f32; 3]) -> [f32; 3] {
    [0.0 - x, y, z]
}

fn place(metres: [f32; 3]) -> [f32; 3] {
    direction(metres).map(|length| round(f64::from(length) * UNITS_PER_METRE, 4))
}

/// M A M, where M mirrors x: what was done before is done to mirrored vectors. The last row of the file's matrix is its translation.
fn transform(mut matrix: [f32; 16]) -> [f32; 16] {
    // Row 0 and column 0, but for the number that they share.
    for index in [1, 2, 3, 4, 8, 12] {
        matrix[index] = 0.0 - matrix[index];
    }
    for length in &mut matrix[12..15] {
        *length = round(f64::from(*length) * UNITS_PER_METRE, 5);
    }
    matrix
}
