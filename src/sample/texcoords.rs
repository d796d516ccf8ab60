//! Texture coordinates: tubes are unrolled round their limb, blocks and ends are projected along their nearest axis, all at
//! one density. Seams split vertices; a tube's coordinates wrap by a whole number, so a repeating texture shows no seam.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::materials::Region;
use super::rig::{ARM, CENTRE_COUNT, FORWARD, HEAD, Limb, NECK, PALM, Rig, Side, joint};

/// Repeats of a texture per metre.
const DENSITY: f64 = 4.0;
/// Cosine between the normal and a tube's axis, or its way round, past which the skin does not lie along the tube.
const END: f64 = 0.8;

/// A way to lay a part of the skin flat.
#[derive(Clone, Copy, Debug)]
pub(super) enum Chart {
    /// Round `axis` through `origin`, `repeats` times across; u starts opposite `front` and grows through it to `side`.
    Tube {
        origin: DVec3,
        axis: DVec3,
        front: DVec3,
        side: DVec3,
        repeats: f64,
    },
    /// Straight down onto two axes.
    Flat { u: DVec3, v: DVec3 },
}

/// A chart and its number: charts with equal numbers are equal.
pub(super) type NumberedChart = (u32, Chart);

/// The chart of a triangle that is moved most by `joint`, with its corners and their normals.
pub(super) fn chart(rig: &Rig, region: Region, joint: usize, points: [DVec3; 3], normals: [DVec3; 3]) -> NumberedChart {
    let centre = (points[0] + points[1] + points[2]) / 3.0;
    let normal = (points[1] - points[0]).cross(points[2] - points[0]).normalize();
    let side = if centre.x < 0.0 { Side::Right } else { Side::Left };
    let (part, tube, block) = part(rig, region, joint, side);
    if let Some((origin, axis, repeats)) = tube {
        let round = |point: DVec3| axis.cross(point - origin).normalize();
        let lies_along =
            |point: DVec3, normal: DVec3| normal.dot(axis).abs() < END && normal.dot(round(point)).abs() < END;
        if lies_along(centre, normal)
            && points
                .into_iter()
                .zip(normals)
                .all(|(point, normal)| lies_along(point, normal))
        {
            let side = axis.cross(FORWARD).normalize();
            return (
                part * 8,
                Chart::Tube {
                    origin,
                    axis,
                    front: FORWARD,
                    side,
                    repeats,
                },
            );
        }
    }
    // The axis that the face itself follows most is looked along; the other two become u and v.
    let along = block.map(|axis| normal.dot(axis));
    let size = along.map(f64::abs);
    let looked = if size[0] >= size[1] && size[0] >= size[2] {
        0
    } else if size[1] >= size[2] {
        1
    } else {
        2
    };
    let number = part * 8 + 1 + 2 * looked as u32 + u32::from(along[looked] < 0.0);
    let v = block[if looked == 1 { 2 } else { 1 }];
    let u = block[if looked == 0 { 2 } else { 0 }];
    (number, Chart::Flat { u, v: -v })
}

type Tube = (DVec3, DVec3, f64);

/// Number of the part, its tube where it has one, and the axes of its block.
fn part(rig: &Rig, region: Region, moved_by: usize, side: Side) -> (u32, Option<Tube>, [DVec3; 3]) {
    let upright = [DVec3::X, DVec3::Y, DVec3::Z];
    let of_side = |number: u32| number + side as u32;
    if matches!(region, Region::Visor | Region::Pack) {
        return (region as u32, None, upright);
    }
    let trunk = DVec3::new(0.0, 1.0, 0.0);
    if moved_by < CENTRE_COUNT {
        let repeats = if moved_by == HEAD { 4.0 } else { 3.0 };
        let number = if moved_by == HEAD {
            10
        } else if moved_by == NECK {
            11
        } else {
            12
        };
        return (number, Some((trunk, DVec3::NEG_Y, repeats)), upright);
    }
    let is = |limbs: &[Limb]| limbs.iter().any(|limb| joint(side, *limb) == moved_by);
    let origin = |limb| rig.origin(side, limb);
    if is(&[Limb::Clavicle]) {
        (12, Some((trunk, DVec3::NEG_Y, 3.0)), upright)
    } else if is(&[Limb::UpperArm, Limb::Forearm]) {
        (
            of_side(14),
            Some((origin(Limb::UpperArm), side.mirror(ARM), 1.0)),
            upright,
        )
    } else if is(&[Limb::Thigh, Limb::Shin]) {
        (of_side(16), Some((origin(Limb::Shin), DVec3::NEG_Y, 2.0)), upright)
    } else if is(&[Limb::Foot, Limb::Toe]) {
        (of_side(18), None, upright)
    } else {
        (of_side(20), None, [side.mirror(ARM), side.mirror(PALM), DVec3::Z])
    }
}

impl Chart {
    /// Texture coordinates; those of a tube lie within half its repeats of `near`, so that a triangle stays whole.
    pub(super) fn tex_coords(&self, point: DVec3, near: Option<DVec2>) -> DVec2 {
        match *self {
            Chart::Tube {
                origin,
                axis,
                front,
                side,
                repeats,
            } => {
                let offset = point - origin;
                let turn = offset.dot(side).atan2(offset.dot(front)) / TAU;
                let u = (turn + 0.5) * repeats;
                let wraps = near.map_or(0.0, |near| ((near.x - u) / repeats).round());
                DVec2::new(u + wraps * repeats, offset.dot(axis) * DENSITY)
            }
            Chart::Flat { u, v } => DVec2::new(point.dot(u), point.dot(v)) * DENSITY,
        }
    }

    /// Unit tangent across `normal` along growing u, and the sign of w · cross(normal, tangent) that makes growing v.
    pub(super) fn tangent(&self, point: DVec3, normal: DVec3) -> (DVec3, f64) {
        let (along_u, along_v) = match *self {
            Chart::Tube {
                origin,
                axis,
                front,
                side,
                ..
            } => {
                let offset = point - origin;
                (side * offset.dot(front) - front * offset.dot(side), axis)
            }
            Chart::Flat { u, v } => (u, v),
        };
        let tangent = (along_u - normal * along_u.dot(normal)).normalize();
        let sign = if normal.cross(tangent).dot(along_v) < 0.0 {
            -1.0
        } else {
            1.0
        };
        (tangent, sign)
    }
}
