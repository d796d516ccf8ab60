// The model's triangles. Drawn from both sides: a file with holes or turned triangles still shows.

struct MeshVertex {
    // The same bits in every program, so that what is drawn over the model meets its depth.
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) world_tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
}

fn mesh_vertex(vertex: Skinned, tex_coord: vec2<f32>) -> MeshVertex {
    let rows = transpose(camera.world_from_model);
    let world = transform(rows[0], rows[1], rows[2], vertex);
    let clip = camera.clip_from_world * vec4<f32>(world.position, 1.0);
    return MeshVertex(clip, world.position, world.normal, world.tangent, tex_coord);
}

@vertex
fn vertex_static(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
) -> MeshVertex {
    return mesh_vertex(Skinned(position, normal, tangent), tex_coord);
}

@vertex
fn vertex_skinned(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> MeshVertex {
    return mesh_vertex(skin(Skinned(position, normal, tangent), joints, weights), tex_coord);
}
