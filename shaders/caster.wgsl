// The model as the key light sees it: depth only.

fn shadow_clip(vertex: Skinned) -> vec4<f32> {
    return light.shadow_clip_from_world * camera.world_from_model * vec4<f32>(vertex.position, 1.0);
}

@vertex
fn vertex_static(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return shadow_clip(Skinned(position, vec3<f32>(0.0), vec4<f32>(0.0)));
}

@vertex
fn vertex_skinned(
    @location(0) position: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> @builtin(position) vec4<f32> {
    return shadow_clip(skin(Skinned(position, vec3<f32>(0.0), vec4<f32>(0.0)), joints, weights));
}
