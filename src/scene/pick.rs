//! The first triangle that a ray hits.

use glam::{Affine3A, Vec3};

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
/// particular order. `positions` are the posed vertices, model space. `in_ray` is a buffer to use again.
///
/// Edges are tested by products that are equal but for their sign in two neighbouring triangles, so no ray slips
/// through between triangles with common corners (as in "Watertight Ray/Triangle Intersection", Woop, Benthin, Wald
/// 2013, which shears space where this turns it).
pub fn pick(
    mesh: &Mesh,
    positions: &[Vec3],
    world_from_model: Affine3A,
    ray: Ray,
    in_ray: &mut Vec<Vec3>,
    is_solid: impl Fn(&Hit) -> bool,
) -> Option<Hit> {
    let ray_from_model = ray.ray_from_world() * world_from_model;
    in_ray.clear();
    in_ray.extend(
        positions
            .iter()
            .map(|&position| ray_from_model.transform_point3(position)),
    );
    let mut nearest: Option<Hit> = None;
    for (submesh, range) in mesh.submeshes.iter().enumerate() {
        let first = range.triangle_start as usize;
        let corners = mesh.indices.as_chunks::<3>().0.iter().enumerate();
        for (triangle, corners) in corners.skip(first).take(range.triangle_count as usize) {
            let [Some(&a), Some(&b), Some(&c)] = corners.map(|corner| in_ray.get(corner as usize)) else {
                continue;
            };
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
