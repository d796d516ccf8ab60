// From light to colours of a screen, linear 0 … 1. Twin: `tests/common/twins/tone_map.rs`.
//
// The Khronos PBR neutral tone mapper: base colours stay what they are, and what is brighter bends towards white without
// turning its hue.

// What is subtracted: the light that a surface which mirrors 4 % adds to its base colour. The original has 0.04, for an environment of 1; the studio's
// are 0.4 on the mean, and more than they add would leave base colours too deep.
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
    // A parabola brings dark colours to 0 as the light does.
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
