//! Where the faces of a cube map are.

use glam::Vec3A;

/// Towards the point `across` and `down` a face of a cube map, −1 … 1 from its left and its upper edge; not of unit length. Faces are +x, −x,
/// +y, −y, +z, −z, as D3D and WebGPU have them.
pub(crate) fn cube_direction(face: usize, across: f32, down: f32) -> Vec3A {
    match face {
        0 => Vec3A::new(1.0, -down, -across),
        1 => Vec3A::new(-1.0, -down, across),
        2 => Vec3A::new(across, 1.0, down),
        3 => Vec3A::new(across, -1.0, -down),
        4 => Vec3A::new(across, -down, 1.0),
        _ => Vec3A::new(-across, -down, -1.0),
    }
}
