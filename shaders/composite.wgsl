// Copies the finished picture onto a surface that takes encoded values, as egui's does.

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;
// The part of the texture that the picture fills, from the top left, and its last texels' centres.
@group(0) @binding(2) var<uniform> filled: Filled;
// What lies over the picture, transparent elsewhere.
@group(0) @binding(3) var layer: texture_2d<f32>;

struct Filled {
    part: vec2<f32>,
    last: vec2<f32>,
}

// The sRGB encoding to a tenth of a step of eight bits, so that a colour that comes back from eight bits is rounded to the same step.
// It is drawn in every pixel of the window, and roots take a fraction of the time of `pow`.
fn nearly_srgb(linear: vec3<f32>) -> vec3<f32> {
    let root = sqrt(linear);
    let high = 0.8337582 * root + 0.2981013 * sqrt(root) - 0.0553164 * linear - 0.0769017;
    return select(high, linear * 12.92, linear <= vec3<f32>(0.0031308));
}

@fragment
fn fragment(view: FullscreenVertex) -> @location(0) vec4<f32> {
    let uv = min((view.ndc * vec2<f32>(0.5, -0.5) + 0.5) * filled.part, filled.last);
    // The picture is premultiplied in linear light. What is transparent shows black, which is what lies under it.
    let under = textureSampleLevel(picture, picture_sampler, uv, 0.0);
    let over = textureSampleLevel(layer, picture_sampler, uv, 0.0);
    let texel = over + under * (1.0 - over.a);
    let straight = texel.rgb / max(texel.a, 1e-6);
    return vec4<f32>(nearly_srgb(straight) * texel.a, 1.0);
}
