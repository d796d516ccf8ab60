// What surrounds the model: the shadow of its first light, how open each pixel is, the ground below, the sky.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;
// Share of the surroundings that reaches each pixel of the view.
@group(2) @binding(2) var occlusion_map: texture_2d<f32>;
// How near the model is above the ground: 1 on it, 0 far above or not there.
@group(2) @binding(3) var contact_map: texture_2d<f32>;
// Linear light.
@group(2) @binding(4) var sky_map: texture_cube<f32>;
@group(2) @binding(5) var surroundings_sampler: sampler;

// A direction of the world in the axes of the surroundings, which may be turned about y.
fn in_environment(direction: vec3<f32>) -> vec3<f32> {
    let turn = frame.environment_turn;
    return vec3<f32>(
        turn.x * direction.x - turn.y * direction.z,
        direction.y,
        turn.y * direction.x + turn.x * direction.z,
    );
}
