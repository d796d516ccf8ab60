// What a pixel of the model is before any light: its maps, and its normals on the viewer's side.

// What lies over a surface, as glTF's extensions have it.
struct Layers {
    sheen: vec3<f32>,
    sheen_roughness: f32,
    // The fraction that a clear coat covers.
    coat: f32,
    coat_roughness: f32,
    // As of the normal map beneath it.
    coat_normal_texel: vec3<f32>,
    coat_normal_scale: f32,
    coat_normal_channels: u32,
    coat_normal_lengths: u32,
}

// What it is made of there, by its material, its maps and its vertices: `substance` gives it. Colours are linear.
struct Substance {
    // Of the diffuse map and the vertices; alpha is the surface's.
    diffuse_texel: vec4<f32>,
    normal_texel: vec4<f32>,
    // Multiplies x and y of the normal map's directions.
    normal_scale: f32,
    // The diffuse colour, metal or not.
    base_color: vec3<f32>,
    // What comes back of light that is not mirrored.
    albedo: vec3<f32>,
    fresnel0: vec3<f32>,
    // The same before glTF's specular extension, whose factor is `specular`; grazing angles follow from these.
    plain_fresnel0: vec3<f32>,
    specular: f32,
    layers: Layers,
    // 1, or the fraction of what is scattered that is seen where light goes through.
    solid: f32,
    // 1 - roughness. The DirectX 12 book's materials have its product with the gloss in the alpha of the normal map.
    shininess: f32,
    // 0..1 for metallic-roughness; the books' materials have none.
    metallic: f32,
    // Light of its own.
    emissive: vec3<f32>,
    // The fraction of the environment that the occlusion map leaves.
    occlusion: f32,
    // Shown in its base colour without light.
    is_unlit: bool,
}

struct SurfacePoint {
    world_position: vec3<f32>,
    // Unit, towards the viewer.
    to_eye: vec3<f32>,
    // Unit, on the side that is seen: of the triangle itself, of the vertices, and bent by the normal map.
    flat_normal: vec3<f32>,
    smooth_normal: vec3<f32>,
    normal: vec3<f32>,
    // How much normals differ within the pixel: what that adds to the square of alpha.
    widening: f32,
    // Of the clear coat: unit, on the side that is seen, bent by its own normal map alone, and how much that differs.
    coat_normal: vec3<f32>,
    coat_widening: f32,
    // Interpolated from the vertices.
    tangent: vec4<f32>,
    tex_coord: vec2<f32>,
    substance: Substance,
    // Ambient occlusion: the fraction of the environment that reaches the point.
    occlusion: f32,
    // Of the picture.
    pixel: vec2<f32>,
}

// The fraction of the environment that reaches a pixel of the picture, which is so far along the view, and farther or nearer by `steep` in
// the next: from the pixels of the smaller map about it that are of the same surface, or else from the one that is nearest to it.
fn occlusion_at(pixel: vec2<f32>, along: f32, steep: f32) -> f32 {
    // Where none is drawn, there is one white texel.
    let above = vec2<i32>(0, i32(camera.first_map_row));
    let last = min(vec2<i32>(camera.map_size) - above, vec2<i32>(textureDimensions(occlusion_map))) - 1;
    let place = pixel / camera.viewport_pixels * camera.map_size - 0.5;
    let first = vec2<i32>(floor(place)) - above;
    let part = place - floor(place);
    let reach = 0.01 * light.book_unit + 2.0 * steep;
    var sum = 0.0;
    var weights = 0.0;
    var nearest = vec2<f32>(1.0, 1e30);
    for (var i = 0; i < 4; i++) {
        let beside = vec2<i32>(i & 1, i >> 1u);
        let texel = textureLoad(occlusion_map, clamp(first + beside, vec2<i32>(0), last), 0).rgb;
        let steps = floor(texel.g * 255.0 + 0.5) * 256.0 + floor(texel.b * 255.0 + 0.5);
        let away = abs(mix(camera.depth_near, camera.depth_far, steps / 65535.0) - along);
        let share = mix(1.0 - part, part, vec2<f32>(beside));
        let weight = share.x * share.y * exp(-away / reach);
        sum += weight * texel.r;
        weights += weight;
        if away < nearest.y {
            nearest = vec2<f32>(texel.r, away);
        }
    }
    return select(nearest.x, sum / weights, weights > 1e-3);
}

// Of normals that turn from one pixel to the next (Filament's constants, after Kaplanyan et al. 2016).
fn bend_of(normal: vec3<f32>) -> f32 {
    let across = dpdx(normal);
    let down = dpdy(normal);
    return min(0.3 * (dot(across, across) + dot(down, down)), 0.2);
}

// Of normals that a smaller level of the normal map has made one of: their mean is the shorter the more they differ (Toksvig 2004).
fn spread_of(texel: vec3<f32>, channels: u32, lengths: u32) -> f32 {
    if lengths == 0u {
        return 0.0;
    }
    var length = length(texel * 2.0 - 1.0);
    if channels == 2u {
        length = texel.b;
    }
    // Less than this is rounding.
    return 2.0 * max(1.0 / max(length, 0.1) - 1.008, 0.0);
}

// Samples maps and takes derivatives, so every pixel of a triangle must call it.
fn surface_point(mesh: MeshVertex, clockwise: bool) -> SurfacePoint {
    let of_maps = substance(mesh);
    let derived_normal = normalize_or(cross(dpdx(mesh.world_position), dpdy(mesh.world_position)), camera.forward);
    let side = select(-1.0, 1.0, clockwise) * mesh.front_sign;
    let to_eye = towards_eye(mesh.world_position);
    let vertex_normal = normalize_or(mesh.world_normal, to_eye * side);
    // Seen from behind, a bump is a dent.
    let texel = of_maps.normal_texel.rgb;
    let normal = mapped_normal(texel, of_maps.normal_scale, material.normal_channels, vertex_normal, mesh.world_tangent) * side;
    let layers = of_maps.layers;
    let coat_normal = mapped_normal(
        layers.coat_normal_texel, layers.coat_normal_scale, layers.coat_normal_channels, vertex_normal, mesh.world_tangent) * side;
    let along = dot(mesh.world_position - camera.eye, camera.forward);
    let pixel = in_picture(mesh.clip.xy);
    return SurfacePoint(
        mesh.world_position,
        to_eye,
        derived_normal * select(-1.0, 1.0, dot(derived_normal, to_eye) > 0.0),
        vertex_normal * side,
        normal,
        bend_of(normal) + spread_of(texel, material.normal_channels, material.normal_lengths),
        coat_normal,
        bend_of(coat_normal) + spread_of(layers.coat_normal_texel, layers.coat_normal_channels, layers.coat_normal_lengths),
        mesh.world_tangent,
        mesh.tex_coord,
        of_maps,
        occlusion_at(pixel, along, fwidth(along)) * of_maps.occlusion,
        pixel,
    );
}

// The fraction of the key light that arrives at a point, whichever way its surface faces.
fn key_arrival(point: SurfacePoint) -> f32 {
    if light.is_book == 0u {
        return soft_visibility(point.world_position, point.flat_normal, tap_turn(point.pixel, light.noise_turn));
    }
    // Under grazing light the blur reaches further along the surface, so the point is moved further off it.
    let facing_key = max(dot(point.smooth_normal, light.to_key), 0.0);
    let radius = light.shadow_texel * light.shadow_radius_texels;
    let off_surface = point.smooth_normal * radius * (1.2 - 0.8 * facing_key);
    return even_visibility(point.world_position + off_surface, light.shadow_radius_texels);
}
