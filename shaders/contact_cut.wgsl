// The parts of the model that alpha cuts, as `contact.wgsl` has the others: what is cut away is near nothing.

struct CutContactVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) height: f32,
    @location(1) cut_place: vec3<f32>,
}

fn cut_contact_vertex(contact: ContactVertex, maps: MapVertex) -> CutContactVertex {
    return CutContactVertex(contact.clip, contact.height, cut_place(maps));
}

@vertex
fn cut_static(instance: Instance, maps: MapVertex, @location(0) position: vec3<f32>) -> CutContactVertex {
    return cut_contact_vertex(contact_vertex(position_in_world(instance, position)), maps);
}

@vertex
fn cut_skinned(
    instance: Instance,
    maps: MapVertex,
    @location(0) position: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> CutContactVertex {
    return cut_contact_vertex(contact_vertex(posed_position_in_world(instance, position, joints, weights)), maps);
}

@fragment
fn fragment_cut(vertex: CutContactVertex) -> @location(0) vec4<f32> {
    if alpha_at(vertex.cut_place) < least_solid_alpha() {
        discard;
    }
    return nearness(vertex.height);
}
