//! Colours of the skin views, and the legends that explain them.

use glam::Vec3;

use super::srgb8_from_linear;
use crate::anim::SkinView;
use crate::model::{JointIndex, Skeleton};

/// One stop of a legend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegendStop {
    /// The value that has this colour.
    pub value: f32,
    /// sRGB.
    pub color_srgb: [u8; 4],
}

const fn stop(value: f32, [red, green, blue]: [u8; 3]) -> LegendStop {
    LegendStop {
        value,
        color_srgb: [red, green, blue, 0xFF],
    }
}

/// A weight of 0 is a grey that both backdrops show; the least weight above it is blue.
const WEIGHT: [LegendStop; 6] = [
    stop(0.0, [0x68, 0x70, 0x7E]),
    stop(0.1, [0x2F, 0x5F, 0xD0]),
    stop(0.3, [0x1F, 0xA6, 0xC4]),
    stop(0.5, [0x45, 0xBF, 0x6A]),
    stop(0.75, [0xF0, 0xC2, 0x3B]),
    stop(1.0, [0xE6, 0x45, 0x2E]),
];

const INFLUENCE_COUNT: [LegendStop; 5] = [
    stop(0.0, [0x8A, 0x8F, 0x99]),
    stop(1.0, [0x3B, 0x7D, 0xE0]),
    stop(2.0, [0x3F, 0xB9, 0x8A]),
    stop(3.0, [0xF0, 0xC2, 0x3B]),
    stop(4.0, [0xE6, 0x55, 0x3A]),
];

/// Compressed is blue, stretched is red, unchanged is white.
const STRETCH: [LegendStop; 5] = [
    stop(0.5, [0x1F, 0x56, 0xC8]),
    stop(0.8, [0x7F, 0xB2, 0xF0]),
    stop(1.0, [0xE6, 0xE8, 0xEB]),
    stop(1.25, [0xF2, 0xA0, 0x6B]),
    stop(2.0, [0xC8, 0x2A, 0x2A]),
];

/// Vertices without a joint.
const NO_JOINT_SRGB: [u8; 4] = [0x8A, 0x8F, 0x99, 0xFF];

/// The stops of a view's legend, by ascending value. Colours between stops are interpolated, except for counts. Empty
/// where each joint has a colour of its own.
pub fn legend(view: SkinView) -> &'static [LegendStop] {
    match view {
        SkinView::Weight => &WEIGHT,
        SkinView::InfluenceCount => &INFLUENCE_COUNT,
        SkinView::DominantJoint => &[],
        SkinView::Stretch => &STRETCH,
    }
}

/// A colour for each value, interpolated between the stops. A value beyond the ends has the colour of the nearest end,
/// NaN that of the first.
pub fn colors_of_values(stops: &[LegendStop], values: &[f32], colors_srgb: &mut Vec<[u8; 4]>) {
    colors_srgb.clear();
    colors_srgb.extend(values.iter().map(|&value| color_at(stops, value)));
}

/// A colour for each number of influences, 0…4.
pub fn colors_of_counts(counts: &[u8], colors_srgb: &mut Vec<[u8; 4]>) {
    colors_srgb.clear();
    let color = |&count: &u8| INFLUENCE_COUNT[usize::from(count).min(INFLUENCE_COUNT.len() - 1)].color_srgb;
    colors_srgb.extend(counts.iter().map(color));
}

/// The colour of each vertex's joint; grey without. `of_joints` are those of [`joint_colors`].
pub fn colors_of_joints(joints: &[Option<JointIndex>], of_joints: &[[u8; 4]], colors_srgb: &mut Vec<[u8; 4]>) {
    colors_srgb.clear();
    let color = |joint: &Option<JointIndex>| joint.and_then(|joint| of_joints.get(joint.index()));
    colors_srgb.extend(
        joints
            .iter()
            .map(|joint| color(joint).copied().unwrap_or(NO_JOINT_SRGB)),
    );
}

fn color_at(stops: &[LegendStop], value: f32) -> [u8; 4] {
    let above = stops.partition_point(|stop| stop.value <= value);
    let (Some(low), high) = (stops.get(above.saturating_sub(1)), stops.get(above)) else {
        return NO_JOINT_SRGB;
    };
    let Some(high) = high.filter(|high| high.value > low.value) else {
        return low.color_srgb;
    };
    let fraction = ((value - low.value) / (high.value - low.value)).max(0.0);
    std::array::from_fn(|channel| {
        let (low, high) = (f32::from(low.color_srgb[channel]), f32::from(high.color_srgb[channel]));
        (low + (high - low) * fraction).round() as u8
    })
}

/// The golden angle as a fraction of the circle: multiples of it spread evenly.
const GOLDEN_TURN: f32 = 0.381_966;
/// Hues of neighbours are at least this fraction of the circle apart.
const NEIGHBOURS_APART: f32 = 0.125;
/// How many siblings before a joint count as its neighbours.
const SIBLINGS: usize = 2;
/// Lightness and chroma in Oklab at which every hue is bright and inside sRGB, or nearly.
const LIGHTNESS: f32 = 0.74;
const CHROMA: f32 = 0.125;

/// A colour for each joint: hues in steps of the golden angle, where a step that comes too close to the parent's hue or
/// to those of the two siblings before is skipped. Three neighbours exclude at most three quarters of the circle, so a
/// step soon fits.
pub fn joint_colors(skeleton: &Skeleton) -> Vec<[u8; 4]> {
    let mut hues: Vec<f32> = Vec::with_capacity(skeleton.joint_count());
    let mut last_children: Vec<[Option<u32>; SIBLINGS]> = vec![[None; SIBLINGS]; skeleton.joint_count() + 1];
    for (joint, parent) in (0u32..).zip(skeleton.parents()) {
        // Roots are siblings too.
        let siblings = &mut last_children[parent.map_or(skeleton.joint_count(), JointIndex::index)];
        let neighbours = siblings.iter().flatten().map(|&sibling| sibling as usize);
        let neighbours = neighbours.chain(parent.map(JointIndex::index));
        let taken: Vec<f32> = neighbours.map(|neighbour| hues[neighbour]).collect();
        let steps = (joint..joint + 64).map(|step| (step as f32 * GOLDEN_TURN).fract());
        let fits = |hue: &f32| taken.iter().all(|&taken| apart(*hue, taken) >= NEIGHBOURS_APART);
        hues.push(steps.clone().find(fits).unwrap_or_default());
        siblings.rotate_right(1);
        siblings[0] = Some(joint);
    }
    hues.into_iter().map(color_of_hue).collect()
}

/// Distance between two hues the shorter way, 0…0.5 of the circle.
fn apart(a: f32, b: f32) -> f32 {
    let way = (a - b).abs();
    way.min(1.0 - way)
}

/// A hue, 0…1, from Oklab to sRGB (Ottosson 2020, "A perceptual color space for image processing").
fn color_of_hue(hue: f32) -> [u8; 4] {
    let (sine, cosine) = (hue * std::f32::consts::TAU).sin_cos();
    let (a, b) = (CHROMA * cosine, CHROMA * sine);
    let l = LIGHTNESS + 0.396_337_78 * a + 0.215_803_76 * b;
    let m = LIGHTNESS - 0.105_561_346 * a - 0.063_854_17 * b;
    let s = LIGHTNESS - 0.089_484_18 * a - 1.291_485_5 * b;
    let lms = Vec3::new(l * l * l, m * m * m, s * s * s);
    let linear = [
        Vec3::new(4.076_741_7, -3.307_711_6, 0.230_969_94),
        Vec3::new(-1.268_438, 2.609_757_4, -0.341_319_4),
        Vec3::new(-0.004_196_086_3, -0.703_418_6, 1.707_614_7),
    ]
    .map(|row| row.dot(lms));
    let [red, green, blue] = linear.map(srgb8_from_linear);
    [red, green, blue, 0xFF]
}
