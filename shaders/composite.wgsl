// Brings the finished picture, or the mean of many, and what lies over it onto a surface or into another picture.

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;
@group(0) @binding(2) var<uniform> composite: Composite;
// What lies over the picture, transparent elsewhere.
@group(0) @binding(3) var layer: texture_2d<f32>;

// Twin: `shaders::Composite`.
struct Composite {
    // The part of the texture that the picture fills, from the top left, and its last texel's centre.
    picture: vec4<f32>,
    // The same of the layer.
    layer: vec4<f32>,
    // 1 when the picture is the root of what it shows.
    is_root: f32,
    // 1 when rounding to bytes is dithered.
    dithers: f32,
    // The first row that is drawn of the whole picture.
    @size(8) first_row: f32,
}

// The sRGB encoding to a tenth of a step of eight bits, so that a colour that comes back from eight bits is rounded to the same step.
// It is drawn in every pixel of the window, and roots take a fraction of the time of `pow`.
fn nearly_srgb(linear: vec3<f32>) -> vec3<f32> {
    let root = sqrt(linear);
    let high = 0.8337582 * root + 0.2981013 * sqrt(root) - 0.0553164 * linear - 0.0769017;
    return select(high, linear * 12.92, linear <= vec3<f32>(0.0031308));
}

// Premultiplied, in linear light.
fn composited(ndc: vec2<f32>) -> vec4<f32> {
    let place = ndc * vec2<f32>(0.5, -0.5) + 0.5;
    let texel = textureSampleLevel(picture, picture_sampler, min(place * composite.picture.xy, composite.picture.zw), 0.0);
    let under = select(texel, texel * texel, composite.is_root > 0.5);
    let over = textureSampleLevel(layer, picture_sampler, min(place * composite.layer.xy, composite.layer.zw), 0.0);
    return over + under * (1.0 - over.a);
}

// Less than in single pictures: a mean is not quite what it was made of, and what needs no rounding is to stay.
fn rounding_noise(pixel: vec2<f32>) -> f32 {
    return composite.dithers * dither_noise(pixel + vec2<f32>(0.0, composite.first_row)) * (0.6 / 255.0);
}

// Encoded, over black: what is transparent shows what lies under it.
@fragment
fn fragment(view: FullscreenVertex) -> @location(0) vec4<f32> {
    let texel = composited(view.ndc);
    let straight = texel.rgb / max(texel.a, 1e-6);
    return vec4<f32>((nearly_srgb(straight) + rounding_noise(view.clip.xy)) * texel.a, 1.0);
}

// Linear: the target encodes.
@fragment
fn fragment_picture(view: FullscreenVertex) -> @location(0) vec4<f32> {
    let texel = composited(view.ndc);
    let noise = rounding_noise(view.clip.xy);
    let encoded = clamp(srgb_from_linear(texel.rgb) + noise, vec3<f32>(0.0), vec3<f32>(1.0));
    return vec4<f32>(linear_from_srgb(encoded), texel.a + noise * f32(texel.a < 0.998));
}
