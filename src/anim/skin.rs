//! Vertices moved by a palette: the twin of the vertex shader, step by step.

use glam::{Affine3A, Mat3A, Vec3, Vec3A, Vec4};

use super::pose::Palette;
use crate::model::{Influences, Mesh};

/// Moved vertices, in the mesh's order, in model space.
#[derive(Clone, Debug, Default)]
pub struct SkinnedVertices {
    /// Positions.
    pub positions: Vec<Vec3>,
    /// Unit normals.
    pub normals: Vec<Vec3>,
    /// Unit tangents; bitangent = w · cross(normal, tangent), as in the mesh. Empty where the mesh has none.
    pub tangents: Vec<Vec4>,
}

/// All vertices of a mesh moved by a palette: the four matrices of each vertex are blended by weight, then
///
/// - position = `m · p`;
/// - normal = `normalize(cofactor(m) · n)`, negated where `m` mirrors: stays square to the surface under any scale;
/// - tangent = `normalize(m · t)`: lies in the surface; its w is negated where `m` mirrors.
///
/// A vertex without weights, and every vertex of a static mesh, stays in bind space. Matrices that the palette lacks are
/// identities. A matrix that flattens space leaves the direction as it was. Allocates only when `out` is too small.
pub fn skin(mesh: &Mesh, palette: &Palette, out: &mut SkinnedVertices) {
    out.positions.clear();
    out.normals.clear();
    out.tangents.clear();
    if mesh.influences.is_empty() || palette.0.is_empty() {
        out.positions.extend_from_slice(&mesh.positions);
        out.normals.extend_from_slice(&mesh.normals);
        out.tangents.extend_from_slice(&mesh.tangents);
        return;
    }
    let vertices = mesh
        .influences
        .iter()
        .zip(&mesh.positions)
        .zip(&mesh.normals)
        .enumerate();
    for (vertex, ((influences, &position), &normal)) in vertices {
        let model_from_bind = blended(palette, influences);
        let linear = model_from_bind.matrix3;
        out.positions.push(model_from_bind.transform_point3(position));
        let cofactor = Cofactor::of(&linear);
        out.normals.push(cofactor.normal(normal));
        if let Some(&tangent) = mesh.tangents.get(vertex) {
            let direction = Vec3A::from_vec4(tangent);
            let moved = direction_or(linear * direction, direction);
            out.tangents.push(Vec3::from(moved).extend(tangent.w * cofactor.side));
        }
    }
}

/// The positions of [`skin`] alone.
pub fn skin_positions(mesh: &Mesh, palette: &Palette, positions: &mut Vec<Vec3>) {
    positions.clear();
    if mesh.influences.is_empty() || palette.0.is_empty() {
        positions.extend_from_slice(&mesh.positions);
        return;
    }
    let vertices = mesh.influences.iter().zip(&mesh.positions);
    positions.extend(vertices.map(|(influences, &position)| skin_position(palette, influences, position)));
}

/// The position of one vertex, as [`skin`] has it.
#[inline]
pub(crate) fn skin_position(palette: &Palette, influences: &Influences, position: Vec3) -> Vec3 {
    blended(palette, influences).transform_point3(position)
}

/// m = Σ weight · matrix; the identity for a vertex without weights.
#[inline]
fn blended(palette: &Palette, influences: &Influences) -> Affine3A {
    let Influences { joints, weights } = influences;
    if *weights == [0.0; 4] {
        return Affine3A::IDENTITY;
    }
    let mut sum = Affine3A {
        matrix3: Mat3A::ZERO,
        translation: Vec3A::ZERO,
    };
    for (&joint, &weight) in joints.iter().zip(weights) {
        let model_from_bind = palette.0.get(joint as usize).unwrap_or(&Affine3A::IDENTITY);
        sum.matrix3 += model_from_bind.matrix3 * weight;
        sum.translation += model_from_bind.translation * weight;
    }
    sum
}

/// The cofactor matrix is the inverse transpose times the determinant: it is right for normals under any scale and needs
/// no division. Where the matrix mirrors, the determinant's sign would turn the normal inside out.
struct Cofactor {
    matrix: Mat3A,
    /// −1 where the matrix mirrors, else 1.
    side: f32,
}

impl Cofactor {
    #[inline]
    fn of(linear: &Mat3A) -> Self {
        let Mat3A { x_axis, y_axis, z_axis } = *linear;
        let matrix = Mat3A::from_cols(y_axis.cross(z_axis), z_axis.cross(x_axis), x_axis.cross(y_axis));
        let mirrored = x_axis.dot(matrix.x_axis) < 0.0;
        let side = if mirrored { -1.0 } else { 1.0 };
        Self { matrix, side }
    }

    #[inline]
    fn normal(&self, normal: Vec3) -> Vec3 {
        let normal = Vec3A::from(normal);
        direction_or(self.matrix * normal * self.side, normal).into()
    }
}

/// The vector at unit length, or another where it has no length.
#[inline]
fn direction_or(vector: Vec3A, otherwise: Vec3A) -> Vec3A {
    vector.normalize_or(otherwise)
}
