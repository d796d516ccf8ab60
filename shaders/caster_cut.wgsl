// The parts of the model that alpha cuts, as the key light sees them: what is cut away casts no shadow.

struct CutVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) tex_coord: vec2<f32>,
}

fn cut_vertex(vertex: Skinned, tex_coord: vec2<f32>) -> CutVertex {
    return CutVertex(light.shadow_clip_from_world * camera.world_from_model * vec4<f32>(vertex.position, 1.0), tex_coord);
}

@vertex
fn vertex_static(@location(0) position: vec3<f32>, @location(3) tex_coord: vec2<f32>) -> CutVertex {
    return cut_vertex(Skinned(position, vec3<f32>(0.0), vec4<f32>(0.0)), tex_coord);
}

@vertex
fn vertex_skinned(
    @location(0) position: vec3<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> CutVertex {
    return cut_vertex(skin(Skinned(position, vec3<f32>(0.0), vec4<f32>(0.0)), joints, weights), tex_coord);
}

@fragment
fn fragment(vertex: CutVertex) {
    if textureSample(diffuse_map, map_sampler, vertex.tex_coord).a < material.alpha_clip {
        discard;
    }
}
