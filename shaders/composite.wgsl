// Copies the finished picture onto a surface that takes encoded values, as egui's does.

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;
// The part of the texture that the picture fills, from the top left, and its last texels' centres.
@group(0) @binding(2) var<uniform> filled: Filled;

struct Filled {
    part: vec2<f32>,
    last: vec2<f32>,
}

@fragment
fn fragment(view: FullscreenVertex) -> @location(0) vec4<f32> {
    let uv = min((view.ndc * vec2<f32>(0.5, -0.5) + 0.5) * filled.part, filled.last);
    // The picture is premultiplied in linear light. What is transparent shows black, which is what lies under it.
    let texel = textureSampleLevel(picture, picture_sampler, uv, 0.0);
    let straight = texel.rgb / max(texel.a, 1e-6);
    return vec4<f32>(srgb_from_linear(straight) * texel.a, 1.0);
}
