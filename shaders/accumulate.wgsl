// Adds one more picture of a scene at rest to the mean of those before it. Twin: `shaders::Accumulation`.

struct Accumulation {
    // What the new picture counts: 1 over the number of pictures with it.
    share: f32,
    // Differs from picture to picture.
    turn: f32,
    // The first row that is drawn of the whole picture.
    @size(8) first_row: f32,
}

@group(0) @binding(0) var before: texture_2d<f32>;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var<uniform> accumulation: Accumulation;

@fragment
fn fragment(view: FullscreenVertex) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(view.clip.xy);
    let root = textureLoad(before, pixel, 0);
    let mean = mix(root * root, textureLoad(picture, pixel, 0), accumulation.share);
    // Half floats have 11 bits: of roots they are as fine as the eye wants. The rounding is by chance, or a mean would stand still, and is
    // done here, since devices round in ways of their own.
    let place = view.clip.xy + vec2<f32>(0.0, accumulation.first_row);
    let stored = sqrt(max(mean, vec4<f32>(0.0)));
    let steps = exp2(max(floor(log2(max(stored, vec4<f32>(1e-6)))), vec4<f32>(-14.0)) - 10.0);
    return floor(stored / steps + turned_noise(place, accumulation.turn)) * steps;
}
