// Smooths the contact map along rows, then columns: red narrowly, green widely.

@group(0) @binding(0) var sharp_map: texture_2d<f32>;

// The map on both sides of a pixel, `away` from it.
fn beside(pixel: vec2<i32>, away: vec2<i32>) -> vec2<f32> {
    let last = vec2<i32>(textureDimensions(sharp_map)) - 1;
    let before = textureLoad(sharp_map, max(pixel - away, vec2<i32>(0)), 0).rg;
    return before + textureLoad(sharp_map, min(pixel + away, last), 0).rg;
}

// Gaussians of sigma 1.2 in red and 7 in green, which is taken from every second texel. Their weights are numbers, since `exp` at each
// texel took longer than all the rest.
fn smoothed(pixel: vec2<i32>, step: vec2<i32>) -> vec4<f32> {
    let narrow = 0.33335 * textureLoad(sharp_map, pixel, 0).r
        + 0.23556 * beside(pixel, step).r
        + 0.08312 * beside(pixel, step * 2).r
        + 0.01465 * beside(pixel, step * 3).r;
    let wide = 0.11570 * textureLoad(sharp_map, pixel, 0).g
        + 0.11107 * beside(pixel, step * 2).g
        + 0.09827 * beside(pixel, step * 4).g
        + 0.08013 * beside(pixel, step * 6).g
        + 0.06021 * beside(pixel, step * 8).g
        + 0.04170 * beside(pixel, step * 10).g
        + 0.02662 * beside(pixel, step * 12).g
        + 0.01566 * beside(pixel, step * 14).g
        + 0.00849 * beside(pixel, step * 16).g;
    return vec4<f32>(narrow, wide, 0.0, 1.0);
}

@fragment
fn fragment_rows(view: FullscreenVertex) -> @location(0) vec4<f32> {
    return smoothed(vec2<i32>(view.clip.xy), vec2<i32>(1, 0));
}

@fragment
fn fragment_columns(view: FullscreenVertex) -> @location(0) vec4<f32> {
    return smoothed(vec2<i32>(view.clip.xy), vec2<i32>(0, 1));
}
