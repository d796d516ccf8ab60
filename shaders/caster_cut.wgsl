// The parts of the model that alpha cuts, as the key light sees them: what is cut away casts no shadow.

struct CutVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) cut_place: vec3<f32>,
}

fn cut_vertex(world_position: vec3<f32>, maps: MapVertex) -> CutVertex {
    return CutVertex(light.shadow_clip_from_world * vec4<f32>(world_position, 1.0), cut_place(maps));
}

@vertex
fn vertex_static(
    instance: Instance,
    maps: MapVertex,
    @location(0) position: vec3<f32>,
) -> CutVertex {
    return cut_vertex(position_in_world(instance, position), maps);
}

@vertex
fn vertex_skinned(
    instance: Instance,
    maps: MapVertex,
    @location(0) position: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> CutVertex {
    return cut_vertex(posed_position_in_world(instance, position, joints, weights), maps);
}

@fragment
fn fragment(vertex: CutVertex) {
    if alpha_at(vertex.cut_place) < least_solid_alpha() {
        discard;
    }
}
