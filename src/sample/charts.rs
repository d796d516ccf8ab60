//! How each piece of the figure is laid flat. Pieces end where regions do, so seams run where a tailor or a mould would put
//! them, and each lies on its maps so that panel lines fall on places that suit them.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::maps;
use super::materials::{CROWN_HEIGHT, Region};
use super::rig::{ARM, FORWARD, Limb, PALM, Rig, Side};
use super::texcoords::Chart;

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
pub(super) fn chart(rig: &Rig, region: Region, corners: [DVec3; 3]) -> Chart {
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
