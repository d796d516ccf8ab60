//! How each piece of the figure is laid flat. Pieces end where regions do, so seams run where a tailor or a mould would put
//! them, and each lies on its maps so that panel lines fall on places that suit them.
//!
//! Tubes wrap by a whole number, so a repeating texture shows no seam. No chart is mirrored: the bitangent is
//! `cross(normal, tangent)` everywhere, as renderers that leave `tangent.w` unread take it.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2, DVec3};

use crate::maps;
use crate::materials::{CROWN_HEIGHT, Region};
use crate::rig::{ARM, FORWARD, Limb, PALM, Rig, Side};

/// Repeats per metre of the suit's cloth.
const CLOTH: f64 = 2.8;
/// Of sleeves, stripes and cuffs, so that one repeat goes round an arm.
const ROUND_ARM: f64 = 3.0;
/// Of legs, so that one repeat goes round, and from the knee to the hip.
const ROUND_LEG: f64 = 2.27;
/// Of moulded parts and of rubber.
const MOULDED: f64 = 4.0;
/// The middle of a texture.
const MIDDLE: DVec2 = DVec2::splat(0.5);

/// The chart of a triangle of `region` with these corners.
pub(crate) fn chart(rig: &Rig, region: Region, corners: [DVec3; 3]) -> Chart {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let side = if a.x + b.x + c.x < 0.0 { Side::Right } else { Side::Left };
    match region {
        Region::Helmet | Region::Crown | Region::EarCup | Region::Visor | Region::Neck => head(region, side),
        Region::Sleeve | Region::Stripe | Region::Cuff => arm(rig, region, side),
        Region::Palm | Region::Hand => hand(rig, side, normal),
        Region::Leg | Region::KneePad | Region::Boot => leg(rig, region, side),
        Region::Foot | Region::Sole => foot(rig, side, normal),
        Region::Trunk | Region::Yoke | Region::Gusset | Region::Belt | Region::Badge => trunk(region),
        Region::Pack => pack(normal),
    }
}

fn head(region: Region, side: Side) -> Chart {
    let sideways = DVec3::X * side.sign();
    match region {
        Region::Helmet => upright(CROWN_HEIGHT, 3.0, 3.1, DVec2::new(0.5, 0.0)),
        Region::Crown => Chart::dome(DVec3::new(0.0, 1.638, 0.004), DVec3::Y, DVec3::NEG_Z, 0.165 * 2.5),
        Region::EarCup => Chart::dome(
            DVec3::new(0.152 * side.sign(), 1.624, 0.014),
            sideways,
            DVec3::NEG_Y,
            0.048 * MOULDED,
        ),
        Region::Visor => facing_front(DVec3::Y * 1.618, maps::PANE_PER_METRE, maps::PANE_MIDDLE),
        _ => upright(1.45, 2.0, MOULDED, MIDDLE),
    }
}

fn trunk(region: Region) -> Chart {
    match region {
        // A tube from shoulder to shoulder, with cloth laid over it from front to back.
        Region::Yoke => Chart::Tube {
            origin: DVec3::new(0.0, 1.335, 0.002),
            axis: DVec3::X,
            front: DVec3::Y,
            repeats: TAU * 0.1 * CLOTH,
            per_metre: CLOTH,
            origin_uv: MIDDLE,
        },
        Region::Gusset => Chart::flat(DVec3::Y * 0.8, DVec3::NEG_Y, DVec3::Z * CLOTH, CLOTH, MIDDLE),
        Region::Belt => upright(0.995, 3.0, MOULDED, MIDDLE),
        Region::Badge => facing_front(DVec3::Y * 1.275, maps::BADGE_PER_METRE, maps::BADGE_MIDDLE),
        // Seams at the sides and along the belt.
        _ => upright(0.995, 2.0, CLOTH, DVec2::new(0.5, 0.0)),
    }
}

fn arm(rig: &Rig, region: Region, side: Side) -> Chart {
    let v = match region {
        Region::Stripe => 0.12,
        Region::Cuff => -1.055,
        _ => 0.0,
    };
    Chart::Tube {
        origin: rig.origin(side, Limb::UpperArm),
        axis: side.mirror(ARM),
        front: FORWARD,
        repeats: 1.0,
        per_metre: ROUND_ARM,
        origin_uv: DVec2::new(0.5, v),
    }
}

fn hand(rig: &Rig, side: Side, normal: DVec3) -> Chart {
    let along = side.mirror(ARM);
    let knuckles = rig.origin(side, Limb::Hand) + along * 0.082;
    let axes = [along, side.mirror(PALM), DVec3::Z];
    // A hand fits between the rivets of one panel.
    on_block(knuckles, axes, [3.6; 3], normal)
}

fn leg(rig: &Rig, region: Region, side: Side) -> Chart {
    let knee = rig.origin(side, Limb::Shin);
    match region {
        Region::KneePad => facing_front(knee, 5.0, MIDDLE),
        Region::Boot => Chart::Tube {
            origin: rig.origin(side, Limb::Foot),
            axis: DVec3::NEG_Y,
            front: FORWARD,
            repeats: 2.0,
            per_metre: MOULDED,
            origin_uv: DVec2::new(0.5, 0.72),
        },
        // The long seam lies on the inner side, another one goes round the knee.
        _ => Chart::Tube {
            origin: knee,
            axis: DVec3::NEG_Y,
            front: FORWARD,
            repeats: 1.0,
            per_metre: ROUND_LEG,
            origin_uv: DVec2::new(0.25 * side.sign(), 0.0),
        },
    }
}

fn foot(rig: &Rig, side: Side, normal: DVec3) -> Chart {
    let middle = rig.origin(side, Limb::Foot) + DVec3::new(0.0, -0.05, -0.037);
    on_block(middle, [DVec3::NEG_Z, DVec3::NEG_Y, DVec3::X], [MOULDED; 3], normal)
}

fn pack(normal: DVec3) -> Chart {
    let axes = [DVec3::Z, DVec3::NEG_Y, DVec3::X];
    // One panel covers the flat of each large face.
    on_block(DVec3::new(0.0, 1.25, 0.148), axes, [6.0, 5.4, 6.3], normal)
}

/// Round the figure's middle, v down from `height`.
fn upright(height: f64, repeats: f64, per_metre: f64, origin_uv: DVec2) -> Chart {
    Chart::Tube {
        origin: DVec3::Y * height,
        axis: DVec3::NEG_Y,
        front: FORWARD,
        repeats,
        per_metre,
        origin_uv,
    }
}

/// As seen by who stands in front of the figure.
fn facing_front(origin: DVec3, per_metre: f64, origin_uv: DVec2) -> Chart {
    Chart::flat(origin, FORWARD, DVec3::NEG_Y * per_metre, per_metre, origin_uv)
}

/// Against the side of a block which the face follows most. The second axis is v where it can be, the first where it is
/// looked along.
fn on_block(origin: DVec3, axes: [DVec3; 3], per_metre: [f64; 3], normal: DVec3) -> Chart {
    let outwards = |side: usize| {
        if side.is_multiple_of(2) {
            axes[side / 2]
        } else {
            -axes[side / 2]
        }
    };
    let facing = |side: usize| normal.dot(outwards(side));
    let side = (1..6).fold(0, |best, side| if facing(side) > facing(best) { side } else { best });
    let looked = side / 2;
    let down = if looked == 1 { 0 } else { 1 };
    let across = 3 - looked - down;
    Chart::flat(
        origin,
        outwards(side),
        axes[down] * per_metre[down],
        per_metre[across],
        MIDDLE,
    )
}

/// A way to lay a part of the skin flat.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Chart {
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

/// Cosine between a normal and the way out of its chart below which the chart says little about directions there.
const LEAST_FACING: f64 = 0.3;
impl Chart {
    /// Seen from outside with v running down, u runs to the right.
    pub(crate) fn flat(origin: DVec3, outwards: DVec3, v: DVec3, u_per_metre: f64, origin_uv: DVec2) -> Chart {
        let u = v.cross(outwards).normalize() * u_per_metre;
        Chart::Flat {
            origin,
            u,
            v,
            origin_uv,
        }
    }

    /// Likewise, of a ball.
    pub(crate) fn dome(centre: DVec3, pole: DVec3, v: DVec3, repeats_per_radian: f64) -> Chart {
        Chart::Dome {
            centre,
            pole,
            u: v.cross(pole),
            v,
            repeats_per_radian,
        }
    }

    /// Texture coordinates; those of a tube lie within half its repeats of `near`, so that a triangle stays whole.
    pub(crate) fn tex_coords(&self, point: DVec3, near: Option<DVec2>) -> DVec2 {
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
                across.normalize_or_zero() * (angle * repeats_per_radian) + DVec2::splat(0.5)
            }
        }
    }

    /// Unit tangent across `normal`: as near to growing u as cross(normal, tangent) is to growing v.
    pub(crate) fn tangent(&self, point: DVec3, normal: DVec3) -> DVec3 {
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
