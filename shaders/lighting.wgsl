// What light reaches a surface: the key's shadow, ambient occlusion, the contact with the ground, the sky. The environment has a
// file of its own.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;
// Ambient occlusion: the fraction of the environment that reaches each pixel of the view.
@group(2) @binding(2) var occlusion_map: texture_2d<f32>;
// How near the model is above the ground: 1 where it stands, 0 far above or without a model.
@group(2) @binding(3) var contact_map: texture_2d<f32>;
// Bindings 4 to 7 are in environment.wgsl. Linear light, in the environment's axes.
@group(2) @binding(8) var sky_map: texture_cube<f32>;
