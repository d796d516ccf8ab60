//! The winding test: which hand a file was made with.

use glam::{DVec3, Vec3};

use super::Handedness;
use super::normals::is_direction;
use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place};

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
