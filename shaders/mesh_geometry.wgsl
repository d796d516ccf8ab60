// The model's normals and depth.

struct GeometryPoint {
    @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) cut_place: vec3<f32>,
    @location(3) @interpolate(flat) front_sign: f32,
}

fn geometry_point(world: Skinned, maps: MapVertex, front_sign: f32) -> GeometryPoint {
    let clip = camera.clip_from_world * vec4<f32>(world.position, 1.0);
    return GeometryPoint(clip, world.position, world.normal, cut_place(maps), front_sign);
}

@vertex
fn vertex_static(
    instance: Instance,
    maps: MapVertex,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
) -> GeometryPoint {
    let vertex = Skinned(position, normal, vec4<f32>(0.0));
    return geometry_point(in_world(instance, vertex), maps, instance.front_sign);
}

@vertex
fn vertex_skinned(
    instance: Instance,
    maps: MapVertex,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> GeometryPoint {
    let vertex = Skinned(position, normal, vec4<f32>(0.0));
    return geometry_point(posed_in_world(instance, vertex, joints, weights), maps, instance.front_sign);
}

fn seen(point: GeometryPoint, clockwise: bool) -> vec4<f32> {
    let side = select(-1.0, 1.0, clockwise) * point.front_sign;
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
    if alpha_at(point.cut_place) < least_solid_alpha() {
        discard;
    }
    return seen(point, clockwise);
}
