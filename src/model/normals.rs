//! Normals: unit length, computed where the file has none; and the hand that a file was made with, which they tell.

use glam::{DVec3, Vec3};

use super::Handedness;
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Subject, codes};
use crate::format::LineMap;

/// Shorter than this is no direction.
const LEAST_LENGTH: f64 = 1e-6;

/// Whether a stored vector can be made a unit vector.
pub(super) fn is_direction(vector: Vec3) -> bool {
    vector.is_finite() && vector.as_dvec3().length() > LEAST_LENGTH
}

/// Unit normals. Those that are zero or not finite become the mean of the triangles around, weighted by their area; a
/// vertex without such triangles gets +y.
pub(super) fn mended_normals(
    mut normals: Vec<Vec3>,
    positions: &[Vec3],
    indices: &[u32],
    handedness: Handedness,
    lines: &LineMap,
    diagnostics: &mut Diagnostics,
) -> Vec<Vec3> {
    let mut missing = Tally::default();
    for (index, normal) in (0u32..).zip(&normals) {
        if !is_direction(*normal) {
            missing.add(index);
        }
    }
    let computed = if missing.count > 0 {
        diagnostics.add(
            &codes::NORMALS_MISSING,
            Place::of_rows(&missing, Subject::Vertex, &lines.vertices),
            format!(
                "{} a normal that is zero or not finite; computed from the triangles.",
                counted(missing.count, "vertex has", "vertices have")
            ),
        );
        area_weighted(positions, indices, handedness)
    } else {
        Vec::new()
    };
    for (index, normal) in normals.iter_mut().enumerate() {
        let direction = if is_direction(*normal) {
            normal.as_dvec3()
        } else {
            computed[index]
        };
        *normal = direction.try_normalize().unwrap_or(DVec3::Y).as_vec3();
    }
    normals
}

/// Sum of the facing sides of the triangles around each vertex, as long as twice their area.
fn area_weighted(positions: &[Vec3], indices: &[u32], handedness: Handedness) -> Vec<DVec3> {
    let outward = match handedness {
        Handedness::Left => 1.0,
        Handedness::Right => -1.0,
    };
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for corners in indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|corner| corners[corner] as usize);
        let side = facing(positions[a], positions[b], positions[c]) * outward;
        for corner in [a, b, c] {
            sums[corner] += side;
        }
    }
    sums
}

/// Below this share of agreeing triangles the answer is a guess. Real files agree on more than 99 %.
const CLEAR_SHARE: f64 = 0.8;

/// Compares the side that each triangle's winding faces with the side of its normals: both agree in a left-handed file
/// (clockwise fronts), and disagree in a right-handed one. Left without any evidence, as in the books.
pub(super) fn handedness_of(
    positions: &[Vec3],
    normals: &[Vec3],
    indices: &[u32],
    diagnostics: &mut Diagnostics,
) -> Handedness {
    let (mut agree, mut disagree) = (0u32, 0u32);
    for corners in indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|corner| corners[corner] as usize);
        // A corner without a normal says nothing; the others still do.
        let known = [normals[a], normals[b], normals[c]]
            .into_iter()
            .filter(|&normal| is_direction(normal));
        let normal: DVec3 = known.map(Vec3::as_dvec3).sum();
        let side = facing(positions[a], positions[b], positions[c]).dot(normal);
        agree += u32::from(side > 0.0);
        disagree += u32::from(side < 0.0);
    }
    let (handedness, majority) = if disagree > agree {
        (Handedness::Right, disagree)
    } else {
        (Handedness::Left, agree)
    };
    let tested = agree + disagree;
    if f64::from(majority) < CLEAR_SHARE * f64::from(tested) {
        diagnostics.add(
            &codes::HANDEDNESS_UNCLEAR,
            Place::default(),
            format!("{agree} of {tested} triangles wind as in a left-handed file, the rest as in a right-handed one."),
        );
    }
    handedness
}

/// Twice the area of a triangle, along the side from which its corners run clockwise in a left-handed space. In f64, since
/// the square of a large coordinate may not fit an f32.
pub(super) fn facing(a: Vec3, b: Vec3, c: Vec3) -> DVec3 {
    let (a, b, c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
    (b - a).cross(c - a)
}
