//! Tangents: unit length and a sign of ±1, computed from the texture coordinates where the file has none.

use glam::Vec4;

use super::normals::unit_direction;
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Code, Subject, codes};
use crate::model::Mesh;
use crate::slices::Slices;

/// Makes the tangents of a mesh unit vectors with a sign of ±1. The normals are unit vectors already. Tangents that are zero or
/// not finite follow the u axis of the triangles around; where the texture coordinates give no direction, they are any vector
/// square to the normal. `lines` gives the line of each tangent in the file, or none; it is asked only if there is something to tell.
pub(super) async fn mend_tangents(
    mesh: &mut Mesh,
    lines: impl Fn() -> Vec<u32>,
    diagnostics: &mut Diagnostics,
    slices: &Slices,
) {
    let (mut missing, mut signs) = (Vec::new(), Tally::default());
    let mend = |(index, tangent): (u32, &mut Vec4)| {
        let Some(direction) = unit_direction(tangent.truncate()) else {
            return missing.push(index);
        };
        if tangent.w.abs() != 1.0 {
            signs.add(index);
        }
        *tangent = direction.extend(if tangent.w < 0.0 { -1.0 } else { 1.0 });
    };
    slices.for_each((0..).zip(&mut mesh.tangents), mend).await;
    let mut missing_tally = Tally::default();
    if !missing.is_empty() {
        let computed = mesh.computed_tangents_of(&missing, slices).await;
        for (&vertex, computed) in missing.iter().zip(computed) {
            mesh.tangents[vertex as usize] = computed;
            missing_tally.add(vertex);
        }
    }
    let mut warn = |code: &Code, tally: Tally, rule: &str| {
        if tally.count > 0 {
            let place = Place::of_rows(&tally, Subject::Vertex, &lines());
            diagnostics.add(
                code,
                place,
                format!("{} {rule}", counted(tally.count, "vertex has", "vertices have")),
            );
        }
    };
    let rule = "a tangent that is zero or not finite; computed from the texture coordinates.";
    warn(&codes::TANGENTS_MISSING, missing_tally, rule);
    warn(
        &codes::TANGENT_SIGN,
        signs,
        "a tangent whose fourth number is not 1 or −1; its sign is kept.",
    );
}
