// What a pixel of the model is before any light: its maps, and its normals on the viewer's side.

struct SurfacePoint {
    world_position: vec3<f32>,
    // Unit, towards the viewer.
    to_eye: vec3<f32>,
    // Unit, on the side that is seen: of the triangle itself, of the vertices, and bent by the normal map.
    flat_normal: vec3<f32>,
    smooth_normal: vec3<f32>,
    normal: vec3<f32>,
    // Interpolated from the vertices.
    tangent: vec4<f32>,
    tex_coord: vec2<f32>,
    diffuse_texel: vec4<f32>,
    normal_texel: vec4<f32>,
    // Ambient occlusion: the fraction of the environment that reaches the point.
    occlusion: f32,
}

// Samples maps and takes derivatives, so every pixel of a triangle must call it.
fn surface_point(mesh: MeshVertex, clockwise: bool) -> SurfacePoint {
    let diffuse_texel = textureSample(diffuse_map, map_sampler, mesh.tex_coord);
    let normal_texel = textureSample(normal_map, map_sampler, mesh.tex_coord);
    let derived_normal = normalize_or(cross(dpdx(mesh.world_position), dpdy(mesh.world_position)), camera.forward);
    let side = select(-1.0, 1.0, clockwise) * mesh.front_sign;
    let to_eye = towards_eye(mesh.world_position);
    let vertex_normal = normalize_or(mesh.world_normal, to_eye * side);
    // Seen from behind, a bump is a dent.
    let normal = mapped_normal(normal_texel.rgb, vertex_normal, mesh.world_tangent) * side;
    let in_view = mesh.clip.xy / camera.viewport_pixels;
    return SurfacePoint(
        mesh.world_position,
        to_eye,
        derived_normal * select(-1.0, 1.0, dot(derived_normal, to_eye) > 0.0),
        vertex_normal * side,
        normal,
        mesh.world_tangent,
        mesh.tex_coord,
        diffuse_texel,
        normal_texel,
        textureSampleLevel(occlusion_map, environment_sampler, in_view, 0.0).r,
    );
}

// The DirectX 12 book's shininess: (1 - roughness), times the gloss in the alpha of the normal map where it has one.
fn shininess(point: SurfacePoint) -> f32 {
    return (1.0 - material.roughness) * select(1.0, point.normal_texel.a, material.normal_channels == 4u);
}

// The fraction of the key light that arrives at a point, whichever way its surface faces.
fn key_arrival(point: SurfacePoint) -> f32 {
    // Under grazing light the blur reaches further along the surface, so the point is moved further off it.
    let facing_key = max(dot(point.smooth_normal, light.to_key), 0.0);
    let radius = light.shadow_texel * light.shadow_radius_texels;
    let off_surface = point.smooth_normal * radius * (1.2 - 0.8 * facing_key);
    return key_visibility(point.world_position + off_surface, light.shadow_radius_texels);
}
