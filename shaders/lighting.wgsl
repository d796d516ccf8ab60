// What light reaches a surface: the key's shadow, ambient occlusion, the sky. The environment has a file of its own.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;
// Ambient occlusion, at half the picture's resolution: the fraction of the environment that reaches each pixel of the view, and in green and
// blue how far along the view that pixel is, in 16 bits between the nearest and the farthest.
@group(2) @binding(2) var occlusion_map: texture_2d<f32>;
// Bindings 3 to 6 are in environment.wgsl. Linear light, in the environment's axes.
@group(2) @binding(7) var sky_map: texture_cube<f32>;
// The shadow map once more: WebGL2 reads depths of a texture that it compares with nothing, and only with a sampler that blends none.
@group(2) @binding(8) var shadow_depth_map: texture_2d<f32>;
@group(2) @binding(9) var shadow_depth_sampler: sampler;

// The sky in a direction of any length, of the level whose texels are as large as the angle that a pixel covers there.
fn sky_light(direction: vec3<f32>, pixel_radians: f32) -> vec3<f32> {
    // In the middle of a face a texel covers 2 / side.
    let level = log2(max(0.5 * pixel_radians * f32(textureDimensions(sky_map).x), 1.0));
    return textureSampleLevel(sky_map, environment_sampler, environment_from_world(direction), level).rgb;
}
