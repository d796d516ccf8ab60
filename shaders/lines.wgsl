// Lines over the model and beside it: edges of triangles, vertex normals and tangents, boxes and axes.

struct Line {
    // sRGB, straight alpha.
    color_srgb: vec4<f32>,
    // World units.
    @size(16) length: f32,
}

@group(3) @binding(0) var<uniform> line: Line;

struct LineVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) color_srgb: vec4<f32>,
}

// Moves a point nearer by a small fraction of the distance, so that lines on a surface are not hidden by it.
fn line_vertex(world_position: vec3<f32>, color_srgb: vec4<f32>) -> LineVertex {
    var nearer = world_position;
    if camera.is_perspective > 0.5 {
        nearer += (camera.eye - world_position) * 1e-3;
    } else {
        nearer -= camera.forward * (camera.depth_far - camera.depth_near) * 1e-3;
    }
    return LineVertex(camera.clip_from_world * vec4<f32>(nearer, 1.0), color_srgb);
}

@vertex
fn edge_static(instance: Instance, @location(0) position: vec3<f32>) -> LineVertex {
    return line_vertex(position_in_world(instance, position), line.color_srgb);
}

@vertex
fn edge_skinned(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> LineVertex {
    return line_vertex(posed_position_in_world(instance, position, joints, weights), line.color_srgb);
}

// A line at each vertex of the mesh: `end` is 0 at the vertex and 1 at the tip.
@vertex
fn normal_static(
    instance: Instance,
    @builtin(vertex_index) end: u32,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
) -> LineVertex {
    let world = in_world(instance, Skinned(position, normal, vec4<f32>(0.0)));
    return line_vertex(world.position + world.normal * line.length * f32(end), line.color_srgb);
}

@vertex
fn normal_skinned(
    instance: Instance,
    @builtin(vertex_index) end: u32,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> LineVertex {
    let world = posed_in_world(instance, Skinned(position, normal, vec4<f32>(0.0)), joints, weights);
    return line_vertex(world.position + world.normal * line.length * f32(end), line.color_srgb);
}

@vertex
fn tangent_static(
    instance: Instance,
    @builtin(vertex_index) end: u32,
    @location(0) position: vec3<f32>,
    @location(2) tangent: vec4<f32>,
) -> LineVertex {
    let world = in_world(instance, Skinned(position, vec3<f32>(0.0), tangent));
    return line_vertex(world.position + world.tangent.xyz * line.length * f32(end), line.color_srgb);
}

@vertex
fn tangent_skinned(
    instance: Instance,
    @builtin(vertex_index) end: u32,
    @location(0) position: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> LineVertex {
    let world = posed_in_world(instance, Skinned(position, vec3<f32>(0.0), tangent), joints, weights);
    return line_vertex(world.position + world.tangent.xyz * line.length * f32(end), line.color_srgb);
}

// A vertex in world space.
@vertex
fn world_vertex(@location(0) position: vec3<f32>, @location(1) color_srgb: vec4<f32>) -> LineVertex {
    return line_vertex(position, color_srgb);
}

@fragment
fn fragment(vertex: LineVertex) -> @location(0) vec4<f32> {
    return vec4<f32>(linear_from_srgb(vertex.color_srgb.rgb) * vertex.color_srgb.a, vertex.color_srgb.a);
}
