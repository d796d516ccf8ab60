//! From light to colours of a screen, linear 0 … 1: the twin of `tone_map.wgsl`, which says what the numbers are.

use glam::Vec3;

const OFFSET: f32 = 0.016;
const SHOULDER: f32 = 0.8 - OFFSET;
const DESATURATION: f32 = 0.15;

/// Light after an exposure of so many stops more.
pub(crate) fn exposed(radiance: Vec3, stops: f32) -> Vec3 {
    radiance * stops.exp2()
}

/// The Khronos PBR neutral tone mapper, its offset set for the studio. `radiance` is not negative.
pub(crate) fn tone_mapped(radiance: Vec3) -> Vec3 {
    let least = radiance.min_element();
    let offset = if least < 2.0 * OFFSET {
        least - least * least / (4.0 * OFFSET)
    } else {
        OFFSET
    };
    let color = radiance - offset;
    let peak = color.max_element();
    if peak < SHOULDER {
        return color;
    }
    let room = 1.0 - SHOULDER;
    let new_peak = 1.0 - room * room / (peak + room - SHOULDER);
    let whiteness = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    (color * (new_peak / peak)).lerp(Vec3::splat(new_peak), whiteness)
}
