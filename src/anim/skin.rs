//! Vertices moved by a palette: the twin of the vertex shader, step by step.

use glam::{Affine3A, Mat3A, Mat4, Vec3, Vec3A, Vec4};

use super::pose::Palette;
use crate::model::{Influences, Mesh};

/// Vertices whose directions are moved side by side.
const LANES: usize = 4;

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
    if mesh.influences.is_empty() || palette.0.is_empty() {
        mesh.positions.clone_into(&mut out.positions);
        mesh.normals.clone_into(&mut out.normals);
        mesh.tangents.clone_into(&mut out.tangents);
        return;
    }
    let count = mesh.influences.len().min(mesh.positions.len()).min(mesh.normals.len());
    let tangent_count = mesh.tangents.len().min(count);
    // What is there is written over, so it is not cleared.
    out.positions.resize(count, Vec3::ZERO);
    out.normals.resize(count, Vec3::ZERO);
    out.tangents.resize(tangent_count, Vec4::ZERO);
    let bind = mesh.influences.as_chunks().0.iter().zip(mesh.positions.as_chunks().0);
    let moved = out.positions.as_chunks_mut().0.iter_mut();
    let moved = moved.zip(out.normals.as_chunks_mut().0);
    let mut tangents = mesh.tangents.as_chunks().0.iter().zip(out.tangents.as_chunks_mut().0);
    for (((influences, positions), normals), (moved, moved_normals)) in bind.zip(mesh.normals.as_chunks().0).zip(moved)
    {
        let linear = move_positions(palette, influences, positions, moved);
        *moved_normals = linear.normals(normals);
        if let Some((tangents, moved)) = tangents.next() {
            *moved = linear.tangents(tangents);
        }
    }
    // The last few, beside some that are none.
    let last = count - count % LANES;
    let (influences, positions) = (four(&mesh.influences[last..count]), four(&mesh.positions[last..count]));
    let mut moved = [Vec3::ZERO; LANES];
    let linear = move_positions(palette, &influences, &positions, &mut moved);
    put(moved, &mut out.positions[last..]);
    put(
        linear.normals(&four(&mesh.normals[last..count])),
        &mut out.normals[last..],
    );
    let last = last.min(tangent_count);
    put(
        linear.tangents(&four(&mesh.tangents[last..tangent_count])),
        &mut out.tangents[last..],
    );
}

/// Moves the positions of four vertices, and gives what moves their directions.
#[inline(always)]
fn move_positions(
    palette: &Palette,
    influences: &[Influences; LANES],
    positions: &[Vec3; LANES],
    moved: &mut [Vec3; LANES],
) -> LinearLanes {
    let mut linear = [Mat3A::IDENTITY; LANES];
    for lane in 0..LANES {
        let model_from_bind = blended(palette, &influences[lane]);
        moved[lane] = model_from_bind.transform_point3(positions[lane]);
        linear[lane] = model_from_bind.matrix3;
    }
    LinearLanes::new(&linear)
}

/// The positions of [`skin`] alone.
pub fn skin_positions(mesh: &Mesh, palette: &Palette, positions: &mut Vec<Vec3>) {
    if mesh.influences.is_empty() || palette.0.is_empty() {
        mesh.positions.clone_into(positions);
        return;
    }
    positions.resize(mesh.influences.len().min(mesh.positions.len()), Vec3::ZERO);
    let vertices = mesh.influences.iter().zip(&mesh.positions);
    for (moved, (influences, &position)) in positions.iter_mut().zip(vertices) {
        *moved = skin_position(palette, influences, position);
    }
}

/// The position of one vertex, as [`skin`] has it.
#[inline]
pub(crate) fn skin_position(palette: &Palette, influences: &Influences, position: Vec3) -> Vec3 {
    blended(palette, influences).transform_point3(position)
}

/// m = Σ weight · matrix; the identity for a vertex without weights. Most vertices have fewer than four joints, so what has
/// no weight is not multiplied.
#[inline]
fn blended(palette: &Palette, influences: &Influences) -> Affine3A {
    let Influences { joints, weights } = influences;
    let weighed = |slot: usize| {
        let Affine3A { matrix3, translation } = palette.0.get(joints[slot] as usize).unwrap_or(&Affine3A::IDENTITY);
        Affine3A {
            matrix3: *matrix3 * weights[slot],
            translation: *translation * weights[slot],
        }
    };
    let add = |sum: Affine3A, slot: usize| {
        let Affine3A { matrix3, translation } = weighed(slot);
        Affine3A {
            matrix3: sum.matrix3 + matrix3,
            translation: sum.translation + translation,
        }
    };
    let used = Vec4::from_array(*weights).cmpne(Vec4::ZERO).bitmask();
    if used == 0 {
        return Affine3A::IDENTITY;
    }
    let one = weighed(0);
    if used == 0b1 {
        return one;
    }
    let two = add(one, 1);
    if used == 0b11 {
        return two;
    }
    add(add(two, 2), 3)
}

/// The linear parts of four matrices side by side: their columns as x, y and z, each of these for the four vertices, so that
/// one instruction works on four vertices.
struct LinearLanes {
    columns: [[Vec4; 3]; 3],
    /// The cofactor matrices: inverse transpose times the determinant. They are right for normals under any scale and need no
    /// division. Where a matrix mirrors, the determinant's sign would turn the normal inside out.
    cofactor: [[Vec4; 3]; 3],
    /// −1 where the matrix mirrors, else 1.
    side: Vec4,
}

impl LinearLanes {
    #[inline(always)]
    fn new([a, b, c, d]: &[Mat3A; LANES]) -> Self {
        let x_axis = lanes_of(a.x_axis, b.x_axis, c.x_axis, d.x_axis);
        let y_axis = lanes_of(a.y_axis, b.y_axis, c.y_axis, d.y_axis);
        let z_axis = lanes_of(a.z_axis, b.z_axis, c.z_axis, d.z_axis);
        let cofactor = [cross(y_axis, z_axis), cross(z_axis, x_axis), cross(x_axis, y_axis)];
        let mirrored = dot(x_axis, cofactor[0]).cmplt(Vec4::ZERO);
        Self {
            columns: [x_axis, y_axis, z_axis],
            cofactor,
            side: Vec4::select(mirrored, Vec4::NEG_ONE, Vec4::ONE),
        }
    }

    #[inline(always)]
    fn normals(&self, [a, b, c, d]: &[Vec3; LANES]) -> [Vec3; LANES] {
        let normal = lanes_of((*a).into(), (*b).into(), (*c).into(), (*d).into());
        let [x, y, z] = times(&self.cofactor, normal);
        let [x, y, z] = direction_or([x * self.side, y * self.side, z * self.side], normal);
        let [a, b, c, d] = lanes([x, y, z, Vec4::ZERO]);
        [a.truncate(), b.truncate(), c.truncate(), d.truncate()]
    }

    #[inline(always)]
    fn tangents(&self, tangents: &[Vec4; LANES]) -> [Vec4; LANES] {
        let [x, y, z, w] = lanes(*tangents);
        let [x, y, z] = direction_or(times(&self.columns, [x, y, z]), [x, y, z]);
        lanes([x, y, z, w * self.side])
    }
}

#[inline(always)]
fn times([x_axis, y_axis, z_axis]: &[[Vec4; 3]; 3], vectors: [Vec4; 3]) -> [Vec4; 3] {
    let row = |row: usize| dot([x_axis[row], y_axis[row], z_axis[row]], vectors);
    [row(0), row(1), row(2)]
}

#[inline]
fn cross([ax, ay, az]: [Vec4; 3], [bx, by, bz]: [Vec4; 3]) -> [Vec4; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

#[inline]
fn dot([ax, ay, az]: [Vec4; 3], [bx, by, bz]: [Vec4; 3]) -> Vec4 {
    ax * bx + ay * by + az * bz
}

/// The vectors at unit length, or others where they have no length.
#[inline(always)]
fn direction_or([x, y, z]: [Vec4; 3], otherwise: [Vec4; 3]) -> [Vec4; 3] {
    let per_length = dot([x, y, z], [x, y, z]).sqrt().recip();
    let has_length = per_length.cmpgt(Vec4::ZERO) & per_length.cmplt(Vec4::INFINITY);
    let (x, y, z) = (x * per_length, y * per_length, z * per_length);
    if has_length.all() {
        return [x, y, z];
    }
    let [x_or, y_or, z_or] = otherwise;
    [
        Vec4::select(has_length, x, x_or),
        Vec4::select(has_length, y, y_or),
        Vec4::select(has_length, z, z_or),
    ]
}

/// The x, y and z of four vectors side by side.
#[inline(always)]
fn lanes_of(a: Vec3A, b: Vec3A, c: Vec3A, d: Vec3A) -> [Vec4; 3] {
    let [x, y, z, _] = lanes([a.extend(0.0), b.extend(0.0), c.extend(0.0), d.extend(0.0)]);
    [x, y, z]
}

/// From four vectors to their x, y, z and w side by side, and back.
#[inline(always)]
fn lanes([a, b, c, d]: [Vec4; LANES]) -> [Vec4; 4] {
    let turned = Mat4::from_cols(a, b, c, d).transpose();
    [turned.x_axis, turned.y_axis, turned.z_axis, turned.w_axis]
}

/// Less than four values, and what stands in for the rest.
fn four<T: Copy + Default>(few: &[T]) -> [T; LANES] {
    let mut four = [T::default(); LANES];
    four[..few.len()].copy_from_slice(few);
    four
}

/// Puts as many of four values as there is room for.
fn put<T: Copy>(four: [T; LANES], places: &mut [T]) {
    places.copy_from_slice(&four[..places.len()]);
}
