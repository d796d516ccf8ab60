// Smooths the contact map along rows, then columns.

@group(0) @binding(0) var sharp_map: texture_2d<f32>;

const BLUR_RADIUS: i32 = 9;
const BLUR_SIGMA: f32 = 4.0;

fn smoothed(pixel: vec2<i32>, step: vec2<i32>) -> vec4<f32> {
    let last = vec2<i32>(textureDimensions(sharp_map)) - 1;
    var sum = 0.0;
    var weights = 0.0;
    for (var i = -BLUR_RADIUS; i <= BLUR_RADIUS; i++) {
        let weight = exp(-f32(i * i) / (2.0 * BLUR_SIGMA * BLUR_SIGMA));
        sum += weight * textureLoad(sharp_map, clamp(pixel + step * i, vec2<i32>(0), last), 0).r;
        weights += weight;
    }
    return vec4<f32>(sum / weights);
}

@fragment
fn fragment_rows(view: FullscreenVertex) -> @location(0) vec4<f32> {
    return smoothed(vec2<i32>(view.clip.xy), vec2<i32>(1, 0));
}

@fragment
fn fragment_columns(view: FullscreenVertex) -> @location(0) vec4<f32> {
    return smoothed(vec2<i32>(view.clip.xy), vec2<i32>(0, 1));
}
