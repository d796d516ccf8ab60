// How near the model is above the ground, seen from straight below: 1 on the ground, fading with height, soon in red and later in green.

struct ContactVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) height: f32,
}

fn contact_vertex(world: vec3<f32>) -> ContactVertex {
    let in_map = (world.xz - ground.contact_center) / ground.contact_half_width;
    return ContactVertex(vec4<f32>(in_map, 0.5, 1.0), world.y - ground.height);
}

@vertex
fn vertex_static(instance: Instance, @location(0) position: vec3<f32>) -> ContactVertex {
    return contact_vertex(position_in_world(instance, position));
}

@vertex
fn vertex_skinned(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> ContactVertex {
    return contact_vertex(posed_position_in_world(instance, position, joints, weights));
}

// The heights at which half of it is gone, in units of the books' demo.
const HALF_HEIGHTS: vec2<f32> = vec2<f32>(0.04, 0.25);

fn nearness(height: f32) -> vec4<f32> {
    return vec4<f32>(exp2(-max(height, 0.0) / (HALF_HEIGHTS * light.book_unit)), 0.0, 1.0);
}

@fragment
fn fragment(vertex: ContactVertex) -> @location(0) vec4<f32> {
    return nearness(vertex.height);
}
