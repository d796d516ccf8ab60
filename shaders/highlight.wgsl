// The model or a part of it in one transparent colour, denser where the surface turns away: a highlighted submesh, a ghost.

struct Highlight {
    // sRGB, straight alpha.
    @size(32) color_srgb: vec4<f32>,
}

@group(3) @binding(0) var<uniform> highlight: Highlight;

struct HighlightVertex {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
}

fn highlight_vertex(vertex: Skinned) -> HighlightVertex {
    let rows = transpose(camera.world_from_model);
    let world = transform(rows[0], rows[1], rows[2], vertex);
    return HighlightVertex(camera.clip_from_world * vec4<f32>(world.position, 1.0), world.position, world.normal);
}

@vertex
fn vertex_static(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> HighlightVertex {
    return highlight_vertex(Skinned(position, normal, vec4<f32>(0.0)));
}

@vertex
fn vertex_skinned(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> HighlightVertex {
    return highlight_vertex(skin(Skinned(position, normal, vec4<f32>(0.0)), joints, weights));
}

@fragment
fn fragment(vertex: HighlightVertex) -> @location(0) vec4<f32> {
    let to_eye = towards_eye(vertex.world_position);
    let facing = abs(dot(normalize_or(vertex.world_normal, to_eye), to_eye));
    let alpha = highlight.color_srgb.a * (0.35 + 0.65 * pow(1.0 - facing, 1.5));
    return vec4<f32>(linear_from_srgb(highlight.color_srgb.rgb) * alpha, alpha);
}
