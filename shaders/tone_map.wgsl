// Turns light into colours of a screen, linear 0 … 1. Twin: `tests/common/twins/tone_map.rs`.
//
// The Khronos PBR neutral tone mapper: base colours stay as they are. Brighter colours go towards white and keep their hue.

// The light that a surface with 4 % reflectance adds to its base colour. It is subtracted. The original has 0.04, for an environment
// of 1. The studio's mean is 0.4: subtracting more would make base colours too dark.
const OFFSET: f32 = 0.016;
// Where the shoulder begins: at 0.8, less the offset.
const SHOULDER: f32 = 0.784;
// How fast what lies above the shoulder turns white.
const DESATURATION: f32 = 0.15;

fn exposed(radiance: vec3<f32>, stops: f32) -> vec3<f32> {
    return radiance * exp2(stops);
}

fn tone_mapped(radiance: vec3<f32>) -> vec3<f32> {
    let least = min(radiance.r, min(radiance.g, radiance.b));
    // For dark colours a parabola is subtracted, so that 0 stays 0.
    let offset = select(OFFSET, least - least * least / (4.0 * OFFSET), least < 2.0 * OFFSET);
    let color = radiance - offset;
    let peak = max(color.r, max(color.g, color.b));
    if peak < SHOULDER {
        return color;
    }
    let room = 1.0 - SHOULDER;
    let new_peak = 1.0 - room * room / (peak + room - SHOULDER);
    let whiteness = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    return mix(color * (new_peak / peak), vec3<f32>(new_peak), whiteness);
}
