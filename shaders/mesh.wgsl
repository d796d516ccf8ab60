// The model's triangles. Drawn from both sides: a file with holes or turned triangles still shows.

// Twin: `shaders::Material`.
struct Material {
    albedo: vec3<f32>,
    roughness: f32,
    fresnel0: vec3<f32>,
    unused: f32,
}

@group(3) @binding(0) var<uniform> material: Material;

struct MeshVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
}

fn mesh_vertex(vertex: Skinned) -> MeshVertex {
    let rows = transpose(frame.world_from_model);
    let world = transform(rows[0], rows[1], rows[2], vertex);
    return MeshVertex(frame.clip_from_world * vec4<f32>(world.position, 1.0), world.position, world.normal);
}

@vertex
fn vertex_static(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
) -> MeshVertex {
    return mesh_vertex(Skinned(position, normal, tangent));
}

@vertex
fn vertex_skinned(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> MeshVertex {
    return mesh_vertex(skin(Skinned(position, normal, tangent), joints, weights));
}

@fragment
fn fragment(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    // Of the triangle itself, whatever its vertices say; its sign does not matter yet.
    let flat_normal = normalize_or(cross(dpdx(mesh.world_position), dpdy(mesh.world_position)), frame.forward);
    let side = select(-1.0, 1.0, clockwise) * frame.front_sign;
    var to_eye = -frame.forward;
    if frame.is_perspective > 0.5 {
        to_eye = normalize(frame.eye - mesh.world_position);
    }
    let normal = normalize_or(mesh.world_normal, to_eye * side) * side;
    // What faces away from the key lies in its own shadow. Towards there the light fades before the map says so: on coarse
    // triangles with smooth normals the map would draw each triangle's edge, and draw it jagged.
    var key_visible = 0.0;
    let facing_key = dot(normal, frame.to_key);
    let flat_facing_key = dot(flat_normal, frame.to_key) * select(-1.0, 1.0, dot(flat_normal, to_eye) > 0.0);
    let own_light = smoothstep(0.0, 0.4, facing_key) * smoothstep(-0.1, 0.0, flat_facing_key);
    if own_light > 0.0 {
        // Grazing light walks further over the surface inside one texel, so the start moves further off it.
        let off_surface = normal * frame.shadow_texel * (3.0 - 2.0 * facing_key);
        key_visible = own_light * key_visibility(mesh.world_position + off_surface, 2.5);
    }
    let surface = Surface(material.albedo, material.fresnel0, max(material.roughness, 0.08), normal, to_eye);
    let color = soft_shoulder(shade(surface, frame.to_key, frame.to_rim, key_visible));
    return vec4<f32>(dithered_linear_from_srgb(srgb_from_linear(color), mesh.clip.xy), 1.0);
}
