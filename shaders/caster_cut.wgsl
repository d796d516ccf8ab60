// The parts of the model that alpha cuts, as the key light sees them: what is cut away casts no shadow.

struct CutVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) tex_coord: vec2<f32>,
}

fn cut_vertex(world: Skinned, tex_coord: vec2<f32>) -> CutVertex {
    return CutVertex(light.shadow_clip_from_world * vec4<f32>(world.position, 1.0), tex_coord);
}

@vertex
fn vertex_static(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(3) tex_coord: vec2<f32>,
) -> CutVertex {
    return cut_vertex(in_world(instance, Skinned(position, vec3<f32>(0.0), vec4<f32>(0.0))), tex_coord);
}

@vertex
fn vertex_skinned(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> CutVertex {
    let vertex = Skinned(position, vec3<f32>(0.0), vec4<f32>(0.0));
    return cut_vertex(posed_in_world(instance, vertex, joints, weights), tex_coord);
}

@fragment
fn fragment(vertex: CutVertex) {
    if textureSample(diffuse_map, map_sampler, vertex.tex_coord).a < material.alpha_clip {
        discard;
    }
}
