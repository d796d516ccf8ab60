// The model or a part of it in one transparent colour, denser where the surface turns away: a highlighted submesh, a ghost.

struct HighlightVertex {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) @interpolate(flat) tint_srgb: vec4<f32>,
}

fn highlight_vertex(world: Skinned, tint_srgb: vec4<f32>) -> HighlightVertex {
    let clip = camera.clip_from_world * vec4<f32>(world.position, 1.0);
    return HighlightVertex(clip, world.position, world.normal, tint_srgb);
}

@vertex
fn vertex_static(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
) -> HighlightVertex {
    return highlight_vertex(in_world(instance, Skinned(position, normal, vec4<f32>(0.0))), instance.tint_srgb);
}

@vertex
fn vertex_skinned(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> HighlightVertex {
    let vertex = Skinned(position, normal, vec4<f32>(0.0));
    return highlight_vertex(posed_in_world(instance, vertex, joints, weights), instance.tint_srgb);
}

@fragment
fn fragment(vertex: HighlightVertex) -> @location(0) vec4<f32> {
    let to_eye = towards_eye(vertex.world_position);
    let facing = abs(dot(normalize_or(vertex.world_normal, to_eye), to_eye));
    let alpha = vertex.tint_srgb.a * (0.35 + 0.65 * pow(1.0 - facing, 1.5));
    return vec4<f32>(linear_from_srgb(vertex.tint_srgb.rgb) * alpha, alpha);
}
