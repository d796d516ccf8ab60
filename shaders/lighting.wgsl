// What surrounds the model: the shadow of its first light, how open each pixel is, the ground below, the sky.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;
// Share of the surroundings that reaches each pixel of the view.
@group(2) @binding(2) var occlusion_map: texture_2d<f32>;
// How near the model is above the ground: 1 on it, 0 far above or not there.
@group(2) @binding(3) var contact_map: texture_2d<f32>;
// Bindings 4 to 7 are the environment's.
// Linear light, in the environment's axes.
@group(2) @binding(8) var sky_map: texture_cube<f32>;
