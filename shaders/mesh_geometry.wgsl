// The model's normals and depth.

struct GeometryPoint {
    @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) tex_coord: vec2<f32>,
}

fn geometry_point(vertex: Skinned, tex_coord: vec2<f32>) -> GeometryPoint {
    let rows = transpose(camera.world_from_model);
    let world = transform(rows[0], rows[1], rows[2], vertex);
    return GeometryPoint(camera.clip_from_world * vec4<f32>(world.position, 1.0), world.position, world.normal, tex_coord);
}

@vertex
fn vertex_static(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(3) tex_coord: vec2<f32>,
) -> GeometryPoint {
    return geometry_point(Skinned(position, normal, vec4<f32>(0.0)), tex_coord);
}

@vertex
fn vertex_skinned(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> GeometryPoint {
    return geometry_point(skin(Skinned(position, normal, vec4<f32>(0.0)), joints, weights), tex_coord);
}

fn seen(point: GeometryPoint, clockwise: bool) -> vec4<f32> {
    let side = select(-1.0, 1.0, clockwise) * camera.front_sign;
    let along = dot(point.world_position - camera.eye, camera.forward);
    let normal = normalize_or(point.world_normal, -camera.forward) * side;
    return packed_geometry(normal, (along - camera.depth_near) / (camera.depth_far - camera.depth_near));
}

@fragment
fn fragment(point: GeometryPoint, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    return seen(point, clockwise);
}

@fragment
fn fragment_cut(point: GeometryPoint, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let alpha = textureSample(diffuse_map, map_sampler, point.tex_coord).a;
    if alpha < material.alpha_clip {
        discard;
    }
    return seen(point, clockwise);
}
