//! Texture coordinates: each piece of the figure is laid flat in its own way, so that seams run along its borders. Tubes are
//! unrolled round their limb and wrap by a whole number, so a repeating texture shows no seam; blocks are projected along
//! their nearest axis. No chart is mirrored: the bitangent is `cross(normal, tangent)` everywhere, as renderers that leave
//! `tangent.w` unread take it.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2, DVec3};

use super::materials::{CROWN_HEIGHT, Region};
use super::rig::{ARM, FORWARD, Limb, PALM, Rig, Side};

/// A way to lay a part of the skin flat.
#[derive(Clone, Copy, Debug)]
pub(super) enum Chart {
    /// Round `axis` through `origin`, `repeats` times across; u is `origin_uv.x` at `front` and grows from there to
    /// cross(axis, front), v is `origin_uv.y` at `origin` and grows along `axis`.
    Tube {
        origin: DVec3,
        axis: DVec3,
        front: DVec3,
        repeats: f64,
        per_metre: f64,
        origin_uv: DVec2,
    },
    /// Straight down onto two axes, whose lengths are repeats per metre; `origin_uv` at `origin`.
    Flat {
        origin: DVec3,
        u: DVec3,
        v: DVec3,
        origin_uv: DVec2,
    },
    /// True distances and directions from the pole of a ball, where the texture has its middle.
    Dome {
        centre: DVec3,
        pole: DVec3,
        u: DVec3,
        v: DVec3,
        repeats_per_radian: f64,
    },
}

/// A chart and its number: charts with equal numbers are equal.
pub(super) type NumberedChart = (u32, Chart);

/// Repeats per metre of the suit's cloth.
const CLOTH: f64 = 2.8;
/// Repeats per metre of moulded parts.
const MOULDED: f64 = 4.0;
/// Cosine between a normal and the way out of its chart below which the chart says little about directions there.
const LEAST_FACING: f64 = 0.3;
/// The middle of a texture.
const MIDDLE: DVec2 = DVec2::splat(0.5);

/// The chart of a triangle of `region`, with its corners.
pub(super) fn chart(rig: &Rig, region: Region, points: [DVec3; 3]) -> NumberedChart {
    let centre = (points[0] + points[1] + points[2]) / 3.0;
    let normal = (points[1] - points[0]).cross(points[2] - points[0]).normalize();
    let side = if centre.x < 0.0 { Side::Right } else { Side::Left };
    let at = |limb| rig.origin(side, limb);
    let arm = side.mirror(ARM);
    let upright = |height: f64, repeats, per_metre, origin_uv| Chart::Tube {
        origin: DVec3::new(0.0, height, 0.0),
        axis: DVec3::NEG_Y,
        front: FORWARD,
        repeats,
        per_metre,
        origin_uv,
    };
    let round_arm = |repeats, per_metre, origin_uv| Chart::Tube {
        origin: at(Limb::UpperArm),
        axis: arm,
        front: FORWARD,
        repeats,
        per_metre,
        origin_uv,
    };
    let facing_front = |height: f64, per_metre: f64, origin_uv| {
        let x = if region == Region::KneePad {
            at(Limb::Shin).x
        } else {
            0.0
        };
        Chart::flat(
            DVec3::new(x, height, 0.0),
            FORWARD,
            DVec3::NEG_Y * per_metre,
            per_metre,
            origin_uv,
        )
    };
    let (face, chart) = match region {
        Region::Trunk => (0, upright(0.995, 2.0, CLOTH, DVec2::new(0.5, 0.0))),
        Region::Yoke => (
            0,
            Chart::Tube {
                origin: DVec3::new(0.0, 1.335, 0.002),
                axis: DVec3::X,
                front: DVec3::Y,
                repeats: TAU * 0.1 * CLOTH,
                per_metre: CLOTH,
                origin_uv: MIDDLE,
            },
        ),
        Region::Sleeve => (0, round_arm(1.0, 3.0, DVec2::new(0.5, 0.0))),
        Region::Gusset => (
            0,
            Chart::flat(DVec3::new(0.0, 0.8, 0.0), DVec3::NEG_Y, DVec3::Z * CLOTH, CLOTH, MIDDLE),
        ),
        Region::Leg => (
            0,
            Chart::Tube {
                origin: at(Limb::Shin),
                axis: DVec3::NEG_Y,
                front: FORWARD,
                repeats: 1.0,
                per_metre: 2.6,
                // The seam lies on the inner side.
                origin_uv: DVec2::new(0.25 * side.sign(), 0.0),
            },
        ),
        Region::Helmet => (0, upright(CROWN_HEIGHT, 3.0, 3.1, DVec2::new(0.5, 0.0))),
        Region::Crown => (
            0,
            Chart::Dome {
                centre: DVec3::new(0.0, 1.638, 0.004),
                pole: DVec3::Y,
                u: DVec3::X,
                v: DVec3::NEG_Z,
                repeats_per_radian: 0.165 * 2.5,
            },
        ),
        Region::EarCup => (
            0,
            Chart::Dome {
                centre: DVec3::new(0.152 * side.sign(), 1.624, 0.014),
                pole: DVec3::X * side.sign(),
                u: DVec3::Z * side.sign(),
                v: DVec3::NEG_Y,
                repeats_per_radian: 0.048 * MOULDED,
            },
        ),
        Region::Neck => (0, upright(1.45, 2.0, MOULDED, MIDDLE)),
        Region::Belt => (0, upright(0.995, 3.0, MOULDED, MIDDLE)),
        Region::Stripe => (0, round_arm(1.0, 3.0, DVec2::new(0.5, 0.12))),
        Region::Cuff => (0, round_arm(1.0, 3.0, DVec2::new(0.5, -1.03))),
        Region::Boot => (
            0,
            Chart::Tube {
                origin: at(Limb::Foot),
                axis: DVec3::NEG_Y,
                front: FORWARD,
                repeats: 2.0,
                per_metre: MOULDED,
                origin_uv: DVec2::new(0.5, 0.72),
            },
        ),
        Region::Visor => (0, facing_front(1.618, 3.8, super::maps::PANE_MIDDLE)),
        Region::Badge => (0, facing_front(1.275, 3.0, super::maps::BADGE_MIDDLE)),
        Region::KneePad => (0, facing_front(0.49, 5.0, MIDDLE)),
        Region::Palm | Region::Hand => on_block(
            at(Limb::Hand) + arm * 0.082,
            [arm, side.mirror(PALM), DVec3::Z * side.sign()],
            [3.6; 3],
            normal,
        ),
        Region::Foot | Region::Sole => on_block(
            at(Limb::Foot) + DVec3::new(0.0, -0.05, -0.037),
            [DVec3::NEG_Z, DVec3::NEG_Y, DVec3::X],
            [MOULDED; 3],
            normal,
        ),
        // One panel covers the flat of each large face.
        Region::Pack => on_block(
            DVec3::new(0.0, 1.25, 0.148),
            [DVec3::Z, DVec3::NEG_Y, DVec3::X],
            [6.0, 5.4, 6.3],
            normal,
        ),
    };
    let number = (region as u32 * 2 + side as u32) * 8 + face;
    // What runs round the middle is one piece on both sides.
    let one_piece = matches!(
        region,
        Region::Trunk
            | Region::Yoke
            | Region::Gusset
            | Region::Helmet
            | Region::Crown
            | Region::Neck
            | Region::Belt
            | Region::Visor
            | Region::Badge
            | Region::Pack
    );
    let of_left = (region as u32 * 2 + Side::Left as u32) * 8 + face;
    (if one_piece { of_left } else { number }, chart)
}

/// A projection against the side of a block which the face follows most, and the side's number. The second axis is v where
/// it can be, the first where it is looked along.
fn on_block(origin: DVec3, axes: [DVec3; 3], per_metre: [f64; 3], normal: DVec3) -> NumberedChart {
    let outwards = |side: usize| {
        if side.is_multiple_of(2) {
            axes[side / 2]
        } else {
            -axes[side / 2]
        }
    };
    let facing = |side: usize| normal.dot(outwards(side));
    let side = (1..6).fold(0, |best, side| if facing(side) > facing(best) { side } else { best });
    let (looked, outwards) = (side / 2, outwards(side));
    let down = if looked == 1 { 0 } else { 1 };
    let across = 3 - looked - down;
    let chart = Chart::flat(
        origin,
        outwards,
        axes[down] * per_metre[down],
        per_metre[across],
        MIDDLE,
    );
    (side as u32, chart)
}

impl Chart {
    /// Seen from outside with v running down, u runs to the right.
    fn flat(origin: DVec3, outwards: DVec3, v: DVec3, u_per_metre: f64, origin_uv: DVec2) -> Chart {
        Chart::Flat {
            origin,
            u: v.cross(outwards).normalize() * u_per_metre,
            v,
            origin_uv,
        }
    }

    /// Texture coordinates; those of a tube lie within half its repeats of `near`, so that a triangle stays whole.
    pub(super) fn tex_coords(&self, point: DVec3, near: Option<DVec2>) -> DVec2 {
        match *self {
            Chart::Tube {
                origin,
                axis,
                front,
                repeats,
                per_metre,
                origin_uv,
            } => {
                let offset = point - origin;
                let turn = offset.dot(axis.cross(front)).atan2(offset.dot(front)) / TAU;
                let u = turn * repeats + origin_uv.x;
                let wraps = near.map_or(0.0, |near| ((near.x - u) / repeats).round());
                DVec2::new(u + wraps * repeats, offset.dot(axis) * per_metre + origin_uv.y)
            }
            Chart::Flat {
                origin,
                u,
                v,
                origin_uv,
            } => DVec2::new((point - origin).dot(u), (point - origin).dot(v)) + origin_uv,
            Chart::Dome {
                centre,
                pole,
                u,
                v,
                repeats_per_radian,
            } => {
                let offset = point - centre;
                let across = DVec2::new(offset.dot(u), offset.dot(v));
                let angle = across.length().atan2(offset.dot(pole));
                across.normalize_or_zero() * (angle * repeats_per_radian) + MIDDLE
            }
        }
    }

    /// Unit tangent across `normal`: as near to growing u as cross(normal, tangent) is to growing v.
    pub(super) fn tangent(&self, point: DVec3, normal: DVec3) -> DVec3 {
        let (u, v, outwards) = self.axes(point);
        // The chart's directions slide along `outwards` until they lie in the skin. In creases that would go on for ever.
        let facing = normal.dot(outwards).max(LEAST_FACING);
        let in_skin = |axis: DVec3| (axis - outwards * (axis.dot(normal) / facing)).normalize();
        let along_u = in_skin(u) + in_skin(v).cross(normal);
        (along_u - normal * along_u.dot(normal)).normalize()
    }

    /// Unit directions of growing u, of growing v, and out of the chart, each across the others.
    fn axes(&self, point: DVec3) -> (DVec3, DVec3, DVec3) {
        match *self {
            Chart::Tube { origin, axis, .. } => {
                let outwards = (point - origin).reject_from(axis).normalize();
                (axis.cross(outwards), axis, outwards)
            }
            Chart::Flat { u, v, .. } => {
                let (u, v) = (u.normalize(), v.normalize());
                (u, v, u.cross(v))
            }
            Chart::Dome { centre, pole, u, v, .. } => {
                let outwards = (point - centre).normalize();
                let turned = DQuat::from_rotation_arc(pole, outwards);
                (turned * u, turned * v, outwards)
            }
        }
    }
}
