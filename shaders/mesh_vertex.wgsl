// The model's triangles.

@vertex
fn vertex_static(
    instance: Instance,
    maps: MapVertex,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
) -> MeshVertex {
    return mesh_vertex(in_world(instance, Skinned(position, normal, tangent)), maps, instance.front_sign);
}

@vertex
fn vertex_skinned(
    instance: Instance,
    maps: MapVertex,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> MeshVertex {
    let vertex = Skinned(position, normal, tangent);
    return mesh_vertex(posed_in_world(instance, vertex, joints, weights), maps, instance.front_sign);
}
