//! Normals: unit length, computed where the file has none; and the hand that a file was made with, which they tell.

use glam::{DVec3, Vec3};

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Subject, codes};
use crate::model::{Handedness, Mesh};
use crate::slices::Slices;

/// Shorter than this is no direction.
const LEAST_LENGTH: f64 = 1e-6;

/// Whether a stored vector can be made a unit vector.
pub(super) fn is_direction(vector: Vec3) -> bool {
    vector.is_finite() && vector.as_dvec3().length_squared() > LEAST_LENGTH * LEAST_LENGTH
}

/// A stored vector at unit length, if it [`is_direction`]. One that is as near to it as numbers are stays, so that a second time changes
/// nothing.
#[inline]
pub(super) fn unit_direction(vector: Vec3) -> Option<Vec3> {
    let wide = vector.as_dvec3();
    let length_squared = wide.length_squared();
    // The square of a finite f32 is finite in f64.
    if !(length_squared > LEAST_LENGTH * LEAST_LENGTH && length_squared < f64::INFINITY) {
        return None;
    }
    let length = length_squared.sqrt();
    let is_unit = (length - 1.0).abs() <= f64::from(f32::EPSILON);
    Some(if is_unit { vector } else { (wide / length).as_vec3() })
}

/// Makes the normals of a mesh unit vectors. Those that are zero or not finite become 0; tells which they are.
pub(super) async fn make_normals_unit(mesh: &mut Mesh, slices: &Slices) -> Tally {
    let mut missing = Tally::default();
    let make_unit = |(index, normal): (u32, &mut Vec3)| {
        *normal = unit_direction(*normal).unwrap_or_else(|| {
            missing.add(index);
            Vec3::ZERO
        });
    };
    slices.for_each((0..).zip(&mut mesh.normals), make_unit).await;
    missing
}

/// Gives normals to the vertices that [`make_normals_unit`] found to have none: the mean of the triangles around, weighted by their area; a
/// vertex without such triangles gets +y. `lines` gives the line of each normal in the file, or none; it is asked only if there is something
/// to tell.
pub(super) fn mend_normals(
    mesh: &mut Mesh,
    missing: &Tally,
    handedness: Handedness,
    lines: impl FnOnce() -> Vec<u32>,
    diagnostics: &mut Diagnostics,
) {
    if missing.count == 0 {
        return;
    }
    diagnostics.add(
        &codes::NORMALS_MISSING,
        Place::of_rows(missing, Subject::Vertex, &lines()),
        format!(
            "{} a normal that is zero or not finite; computed from the triangles.",
            counted(missing.count, "vertex has", "vertices have")
        ),
    );
    let computed = area_weighted(mesh, handedness);
    for (normal, computed) in mesh.normals.iter_mut().zip(computed) {
        if *normal == Vec3::ZERO {
            *normal = computed.try_normalize().unwrap_or(DVec3::Y).as_vec3();
        }
    }
}

/// Sum of the facing sides of the triangles around each vertex, as long as twice their area.
fn area_weighted(mesh: &Mesh, handedness: Handedness) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; mesh.vertex_count()];
    for corners in mesh.indices.as_chunks().0 {
        let side = mesh.side_of(*corners) * handedness.front_sign();
        for corner in corners {
            sums[*corner as usize] += side;
        }
    }
    sums
}

/// Below this fraction of agreeing triangles the answer is a guess. Real files agree on more than 99 %.
const CLEAR_FRACTION: f64 = 0.8;

/// Compares the side that each triangle's winding faces with the side of its normals: both agree in a left-handed file
/// (clockwise fronts), and disagree in a right-handed one. Left without any evidence, as in the books. A corner without a normal, which is 0,
/// says nothing; the others still do.
pub(super) async fn handedness_of(mesh: &Mesh, diagnostics: &mut Diagnostics, slices: &Slices) -> Handedness {
    let (mut agree, mut disagree) = (0u32, 0u32);
    let count = |corners: &[u32; 3]| {
        let normal = |corner: usize| mesh.normals[corners[corner] as usize].as_dvec3();
        let side = mesh.side_of(*corners).dot(normal(0) + normal(1) + normal(2));
        agree += u32::from(side > 0.0);
        disagree += u32::from(side < 0.0);
    };
    slices.for_each(mesh.indices.as_chunks().0, count).await;
    let (handedness, majority) = if disagree > agree {
        (Handedness::Right, disagree)
    } else {
        (Handedness::Left, agree)
    };
    let tested = agree + disagree;
    if f64::from(majority) < CLEAR_FRACTION * f64::from(tested) {
        diagnostics.add(
            &codes::HANDEDNESS_UNCLEAR,
            Place::default(),
            format!("{agree} of {tested} triangles wind as in a left-handed file, the rest as in a right-handed one."),
        );
    }
    handedness
}
