// The model's triangles. Both sides are drawn, so that a file with holes or turned triangles still shows.

struct MeshVertex {
    // Every program computes the same bits, so that what is drawn over the model meets its depth.
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) world_tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) @interpolate(flat) front_sign: f32,
}

fn mesh_vertex(world: Skinned, tex_coord: vec2<f32>, front_sign: f32) -> MeshVertex {
    let clip = camera.clip_from_world * vec4<f32>(world.position, 1.0);
    return MeshVertex(clip, world.position, world.normal, world.tangent, tex_coord, front_sign);
}

@vertex
fn vertex_static(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
) -> MeshVertex {
    return mesh_vertex(in_world(instance, Skinned(position, normal, tangent)), tex_coord, instance.front_sign);
}

@vertex
fn vertex_skinned(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> MeshVertex {
    let vertex = Skinned(position, normal, tangent);
    return mesh_vertex(posed_in_world(instance, vertex, joints, weights), tex_coord, instance.front_sign);
}
