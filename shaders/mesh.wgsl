// The model's triangles. Drawn from both sides: a file with holes or turned triangles still shows.

struct MeshVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) world_tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
}

fn mesh_vertex(vertex: Skinned, tex_coord: vec2<f32>) -> MeshVertex {
    let rows = transpose(frame.world_from_model);
    let world = transform(rows[0], rows[1], rows[2], vertex);
    let clip = frame.clip_from_world * vec4<f32>(world.position, 1.0);
    return MeshVertex(clip, world.position, world.normal, world.tangent, tex_coord);
}

@vertex
fn vertex_static(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
) -> MeshVertex {
    return mesh_vertex(Skinned(position, normal, tangent), tex_coord);
}

@vertex
fn vertex_skinned(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> MeshVertex {
    return mesh_vertex(skin(Skinned(position, normal, tangent), joints, weights), tex_coord);
}

// The surface at a pixel under the lights, ready to be stored; texels as the maps give them.
fn lit(mesh: MeshVertex, clockwise: bool, diffuse_texel: vec3<f32>, normal_texel: vec3<f32>) -> vec3<f32> {
    // Of the triangle itself, whatever its vertices say; its sign does not matter yet.
    let flat_normal = normalize_or(cross(dpdx(mesh.world_position), dpdy(mesh.world_position)), frame.forward);
    let side = select(-1.0, 1.0, clockwise) * frame.front_sign;
    var to_eye = -frame.forward;
    if frame.is_perspective > 0.5 {
        to_eye = normalize(frame.eye - mesh.world_position);
    }
    let vertex_normal = normalize_or(mesh.world_normal, to_eye * side);
    let smooth_normal = vertex_normal * side;
    // From behind, a bump is a dent: the relief has one shape, seen from its other side.
    let normal = mapped_normal(normal_texel, vertex_normal, mesh.world_tangent) * side;
    // What faces away from the key lies in its own shadow. Towards there the light fades before the map says so: on coarse
    // triangles with smooth normals the map would draw each triangle's edge, and draw it jagged.
    var key_visible = 0.0;
    let facing_key = dot(smooth_normal, frame.to_key);
    let flat_facing_key = dot(flat_normal, frame.to_key) * select(-1.0, 1.0, dot(flat_normal, to_eye) > 0.0);
    let own_light = smoothstep(0.0, 0.4, facing_key) * smoothstep(-0.1, 0.0, flat_facing_key);
    if own_light > 0.0 {
        // Grazing light walks further over the surface inside one texel, so the start moves further off it.
        let off_surface = smooth_normal * frame.shadow_texel * (3.0 - 2.0 * facing_key);
        key_visible = own_light * key_visibility(mesh.world_position + off_surface, 2.5);
    }
    let albedo = material.albedo * diffuse_texel;
    let surface = Surface(albedo, material.fresnel0, max(material.roughness, 0.08), normal, to_eye);
    let color = soft_shoulder(shade(surface, frame.to_key, frame.to_rim, key_visible));
    return dithered_linear_from_srgb(srgb_from_linear(color), mesh.clip.xy);
}

@fragment
fn fragment(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let diffuse_texel = textureSample(diffuse_map, map_sampler, mesh.tex_coord);
    let normal_texel = textureSample(normal_map, map_sampler, mesh.tex_coord);
    return vec4<f32>(lit(mesh, clockwise, diffuse_texel.rgb, normal_texel.rgb), 1.0);
}

// What alpha cuts, a whole pixel or nothing.
@fragment
fn fragment_cut(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let diffuse_texel = textureSample(diffuse_map, map_sampler, mesh.tex_coord);
    let normal_texel = textureSample(normal_map, map_sampler, mesh.tex_coord);
    let color = lit(mesh, clockwise, diffuse_texel.rgb, normal_texel.rgb);
    // After the derivatives, which some devices lose with the neighbours that are cut away.
    if diffuse_texel.a < material.alpha_clip {
        discard;
    }
    return vec4<f32>(color, 1.0);
}

// The same cut with a smooth edge: alpha is the share of the pixel's samples that the surface covers.
@fragment
fn fragment_cut_smooth(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let diffuse_texel = textureSample(diffuse_map, map_sampler, mesh.tex_coord);
    let normal_texel = textureSample(normal_map, map_sampler, mesh.tex_coord);
    let alpha_per_pixel = fwidth(diffuse_texel.a);
    let color = lit(mesh, clockwise, diffuse_texel.rgb, normal_texel.rgb);
    // The line where alpha passes the limit, one pixel wide whatever the slope of the map.
    let coverage = clamp((diffuse_texel.a - material.alpha_clip) / max(alpha_per_pixel, 1e-4) + 0.5, 0.0, 1.0);
    if coverage <= 0.0 {
        discard;
    }
    return vec4<f32>(color, coverage);
}
