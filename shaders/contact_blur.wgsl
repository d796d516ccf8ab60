// Smooths the contact map along rows, then columns.

@group(0) @binding(0) var sharp_map: texture_2d<f32>;

// The map on both sides of a pixel, `away` from it.
fn beside(pixel: vec2<i32>, away: vec2<i32>) -> f32 {
    let last = vec2<i32>(textureDimensions(sharp_map)) - 1;
    let before = textureLoad(sharp_map, max(pixel - away, vec2<i32>(0)), 0).r;
    return before + textureLoad(sharp_map, min(pixel + away, last), 0).r;
}

// A Gaussian of sigma 4, cut off at 9 texels. Its weights are numbers, since `exp` at each texel took longer than all the rest.
fn smoothed(pixel: vec2<i32>, step: vec2<i32>) -> vec4<f32> {
    return vec4<f32>(0.10148686 * textureLoad(sharp_map, pixel, 0).r
        + 0.09836444 * beside(pixel, step)
        + 0.08956184 * beside(pixel, step * 2)
        + 0.07660630 * beside(pixel, step * 3)
        + 0.06155489 * beside(pixel, step * 4)
        + 0.04646407 * beside(pixel, step * 5)
        + 0.03294796 * beside(pixel, step * 6)
        + 0.02194807 * beside(pixel, step * 7)
        + 0.01373475 * beside(pixel, step * 8)
        + 0.00807424 * beside(pixel, step * 9));
}

@fragment
fn fragment_rows(view: FullscreenVertex) -> @location(0) vec4<f32> {
    return smoothed(vec2<i32>(view.clip.xy), vec2<i32>(1, 0));
}

@fragment
fn fragment_columns(view: FullscreenVertex) -> @location(0) vec4<f32> {
    return smoothed(vec2<i32>(view.clip.xy), vec2<i32>(0, 1));
}
