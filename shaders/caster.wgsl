// The model as the key light sees it: depth only.

@vertex
fn vertex_static(instance: Instance, @location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return light.shadow_clip_from_world * vec4<f32>(position_in_world(instance, position), 1.0);
}

@vertex
fn vertex_skinned(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> @builtin(position) vec4<f32> {
    let world_position = posed_position_in_world(instance, position, joints, weights);
    return light.shadow_clip_from_world * vec4<f32>(world_position, 1.0);
}
