// The parts of the model that alpha cuts, as the key light sees them: what is cut away casts no shadow.

struct CutVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) tex_coord: vec2<f32>,
}

fn cut_vertex(world_position: vec3<f32>, tex_coord: vec2<f32>) -> CutVertex {
    return CutVertex(light.shadow_clip_from_world * vec4<f32>(world_position, 1.0), tex_coord);
}

@vertex
fn vertex_static(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(3) tex_coord: vec2<f32>,
) -> CutVertex {
    return cut_vertex(position_in_world(instance, position), tex_coord);
}

@vertex
fn vertex_skinned(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> CutVertex {
    return cut_vertex(posed_position_in_world(instance, position, joints, weights), tex_coord);
}

@fragment
fn fragment(vertex: CutVertex) {
    if textureSample(diffuse_map, map_sampler, vertex.tex_coord).a < material.alpha_clip {
        discard;
    }
}
