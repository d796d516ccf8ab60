//! The first triangle that a ray hits.

use glam::{Affine3A, Vec3, Vec3A};

use super::Ray;
use crate::model::Mesh;

/// Where a ray hits a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the submesh.
    pub submesh: usize,
    /// Index of the triangle in the mesh.
    pub triangle: usize,
    /// Barycentric weights of the triangle's corners: 0…1, with a sum of 1.
    pub barycentric: Vec3,
    /// The nearest corner, as an index into the mesh's vertices.
    pub vertex: u32,
    /// The point, world space.
    pub position: Vec3,
    /// Distance from the ray's origin, world units.
    pub distance: f32,
}

/// The first triangle along a ray that `is_solid` accepts, from either side. `is_solid` is asked about candidates in no
/// particular order. `positions` are the posed vertices, model space. `sides` is a buffer to use again.
///
/// Edges are tested by products that are equal but for their sign in two neighbouring triangles, so no ray slips
/// through between triangles with common corners (as in "Watertight Ray/Triangle Intersection", Woop, Benthin, Wald
/// 2013, which shears space where this turns it).
pub fn pick(
    mesh: &Mesh,
    positions: &[Vec3],
    world_from_model: Affine3A,
    ray: Ray,
    sides: &mut Vec<u8>,
    is_solid: impl Fn(&Hit) -> bool,
) -> Option<Hit> {
    let ray_from_model = ray.ray_from_world() * world_from_model;
    sides.clear();
    sides.extend(positions.iter().map(|&position| sides_of(position, &ray_from_model)));
    let sides = sides.as_slice();
    let side = |corner: u32| sides.get(corner as usize).copied().unwrap_or(0);
    let mut nearest: Option<Hit> = None;
    for (submesh, range) in mesh.submeshes.iter().enumerate() {
        let mut triangles = mesh.triangles_of(range).iter();
        while let Some(corners) = triangles.next() {
            // Nearly all lie on one side of the ray.
            if side(corners[0]) & side(corners[1]) & side(corners[2]) != 0 {
                continue;
            }
            let end = range.triangle_start as usize + range.triangle_count as usize;
            let triangle = end - triangles.len() - 1;
            let [Some(a), Some(b), Some(c)] = corners.map(|corner| positions.get(corner as usize)) else {
                continue;
            };
            let [a, b, c] = [a, b, c].map(|&position| ray_from_model.transform_point3(position));
            let Some((barycentric, distance)) = meet(a, b, c) else {
                continue;
            };
            if nearest.is_some_and(|nearest| nearest.distance <= distance) {
                continue;
            }
            let hit = Hit {
                submesh,
                triangle,
                barycentric,
                vertex: nearest_corner(*corners, [a, b, c], distance),
                position: ray.origin + ray.direction * distance,
                distance,
            };
            if is_solid(&hit) {
                nearest = Some(hit);
            }
        }
    }
    nearest
}

/// On which sides of the z axis a point lies in the space of a ray: a bit each for right, above, left and below. None for a side on whose
/// border it is.
#[inline]
fn sides_of(position: Vec3, ray_from_model: &Affine3A) -> u8 {
    // x and y of what is greater than 0, and of what is less.
    const ACROSS: u32 = 0b0011_0011;
    let point = ray_from_model.transform_point3a(position.into());
    let (more, less) = (point.cmpgt(Vec3A::ZERO), point.cmplt(Vec3A::ZERO));
    ((more.bitmask() | less.bitmask() << 4) & ACROSS) as u8
}

/// Where the z axis, from 0 on, hits a triangle: barycentric weights, and z.
#[inline]
fn meet(a: Vec3, b: Vec3, c: Vec3) -> Option<(Vec3, f32)> {
    let edge = |from: Vec3, to: Vec3| from.x * to.y - from.y * to.x;
    let areas = Vec3::new(edge(b, c), edge(c, a), edge(a, b));
    if !(areas.cmpge(Vec3::ZERO).all() || areas.cmple(Vec3::ZERO).all()) {
        return None;
    }
    let barycentric = areas / areas.element_sum();
    let z = barycentric.dot(Vec3::new(a.z, b.z, c.z));
    // A triangle seen on its edge has no area, and the quotient is NaN.
    (z >= 0.0 && z.is_finite()).then_some((barycentric, z))
}

fn nearest_corner(corners: [u32; 3], in_ray: [Vec3; 3], distance: f32) -> u32 {
    let from_hit = in_ray.map(|corner| (corner - Vec3::Z * distance).length_squared());
    let [a, b, c] = from_hit;
    let index = if a <= b && a <= c {
        0
    } else if b <= c {
        1
    } else {
        2
    };
    corners[index]
}

/// What the vertices of a mesh have, at a hit: interpolated between the corners as the renderer does. Without values it is 0.
pub fn value_at<T>(mesh: &Mesh, of_vertices: &[T], hit: &Hit) -> T
where
    T: Copy + std::ops::Mul<f32, Output = T> + std::iter::Sum,
{
    let corners = mesh.indices.as_chunks::<3>().0.get(hit.triangle);
    let corners = corners.into_iter().flatten();
    let weights = corners.zip(hit.barycentric.to_array());
    weights
        .filter_map(|(&corner, weight)| Some(*of_vertices.get(corner as usize)? * weight))
        .sum()
}
