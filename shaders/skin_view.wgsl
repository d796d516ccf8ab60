// The model in colours of its vertices, made on the CPU from its skin weights.

struct SkinViewVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) cut_place: vec3<f32>,
    @location(3) color_srgb: vec3<f32>,
}

fn skin_view_vertex(world: Skinned, maps: MapVertex, color_srgb: vec4<f32>) -> SkinViewVertex {
    let clip = camera.clip_from_world * vec4<f32>(world.position, 1.0);
    return SkinViewVertex(clip, world.position, world.normal, cut_place(maps), color_srgb.rgb);
}

@vertex
fn vertex_static(
    instance: Instance,
    maps: MapVertex,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(6) color_srgb: vec4<f32>,
) -> SkinViewVertex {
    let vertex = Skinned(position, normal, vec4<f32>(0.0));
    return skin_view_vertex(in_world(instance, vertex), maps, color_srgb);
}

@vertex
fn vertex_skinned(
    instance: Instance,
    maps: MapVertex,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
    @location(6) color_srgb: vec4<f32>,
) -> SkinViewVertex {
    let vertex = Skinned(position, normal, vec4<f32>(0.0));
    return skin_view_vertex(posed_in_world(instance, vertex, joints, weights), maps, color_srgb);
}

// The exact colour where the surface faces the viewer, so that it matches the legend; darker where it turns away, to show shape.
fn seen_color(vertex: SkinViewVertex) -> vec4<f32> {
    let to_eye = towards_eye(vertex.world_position);
    let facing = abs(dot(normalize_or(vertex.world_normal, to_eye), to_eye));
    let shade = mix(0.45, 1.0, smoothstep(0.0, 0.8, facing));
    return vec4<f32>(linear_from_srgb(vertex.color_srgb * shade), 1.0);
}

@fragment
fn fragment(vertex: SkinViewVertex) -> @location(0) vec4<f32> {
    return seen_color(vertex);
}

@fragment
fn fragment_cut(vertex: SkinViewVertex) -> @location(0) vec4<f32> {
    if alpha_at(vertex.cut_place) < material.alpha_clip {
        discard;
    }
    return seen_color(vertex);
}
