// What a material with all its maps is at a point of the model. Stands in the place of `mesh_two_maps.wgsl`.

struct MeshVertex {
    // As in `mesh_two_maps.wgsl`.
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    // At centroids, and maps at pixels' middles: as in `mesh_two_maps.wgsl`.
    @location(1) @interpolate(perspective, centroid) world_normal: vec3<f32>,
    @location(2) @interpolate(perspective, centroid) world_tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) @interpolate(flat) front_sign: f32,
    @location(5) color: vec4<f32>,
    @location(6) second_tex_coord: vec2<f32>,
}

fn mesh_vertex(world: Skinned, maps: MapVertex, front_sign: f32) -> MeshVertex {
    let clip = camera.clip_from_world * vec4<f32>(world.position, 1.0);
    return MeshVertex(
        clip, world.position, world.normal, world.tangent, maps.tex_coord, front_sign, maps.color, maps.second_tex_coord);
}

// What a map that is not there has everywhere.
const NO_TEXEL: vec4<f32> = vec4<f32>(1.0);

fn substance(mesh: MeshVertex) -> Substance {
    let tex_coords = vec4<f32>(mesh.tex_coord, mesh.second_tex_coord);
    // Only what is there is read. The branches are the same for all pixels of a draw.
    var diffuse_texel = NO_TEXEL;
    if is_present(DIFFUSE) {
        diffuse_texel = textureSample(diffuse_map, diffuse_sampler, map_place(DIFFUSE, tex_coords));
    }
    var normal_texel = NO_TEXEL;
    if is_present(NORMAL) {
        normal_texel = textureSample(normal_map, normal_sampler, map_place(NORMAL, tex_coords));
    }
    var roughness_metallic = NO_TEXEL.gb;
    if is_present(METALLIC_ROUGHNESS) {
        let place = map_place(METALLIC_ROUGHNESS, tex_coords);
        roughness_metallic = textureSample(metallic_roughness_map, metallic_roughness_sampler, place).gb;
    }
    var occlusion = 1.0;
    if is_present(OCCLUSION) {
        let place = map_place(OCCLUSION, tex_coords);
        let texel = textureSample(material_occlusion_map, material_occlusion_sampler, place).r;
        occlusion = mix(1.0, texel, material_maps.occlusion_strength);
    }
    var emissive = material_maps.emissive;
    if is_present(EMISSIVE) {
        emissive *= textureSample(emissive_map, emissive_sampler, map_place(EMISSIVE, tex_coords)).rgb;
    }
    let alpha = map_alpha(diffuse_texel.a) * material_maps.opacity * mesh.color.a;
    diffuse_texel = vec4<f32>(diffuse_texel.rgb * mesh.color.rgb, alpha);
    let base_color = material.albedo * diffuse_texel.rgb;
    let gloss = select(1.0, normal_texel.a, material.normal_channels == 4u);
    var albedo = base_color;
    var fresnel0 = material.fresnel0;
    var shininess = (1.0 - material.roughness) * gloss;
    var plain_fresnel0 = fresnel0;
    var specular = 1.0;
    var metallic = 0.0;
    if material_maps.is_metallic_roughness == 1u {
        metallic = material_maps.metallic * roughness_metallic.y;
        albedo = base_color * (1.0 - metallic);
        fresnel0 = mix(material_maps.dielectric_fresnel0, base_color, metallic);
        plain_fresnel0 = mix(vec3<f32>(material_maps.boundary_fresnel0), base_color, metallic);
        specular = mix(material_maps.specular, 1.0, metallic);
        shininess = 1.0 - material.roughness * roughness_metallic.x;
    }
    return Substance(
        diffuse_texel,
        normal_texel,
        material_maps.normal_scale,
        base_color,
        albedo,
        fresnel0,
        plain_fresnel0,
        specular,
        Layers(material_maps.sheen, material_maps.sheen_roughness, material_maps.coat, material_maps.coat_roughness),
        material_maps.solid,
        shininess,
        metallic,
        emissive,
        occlusion,
        material_maps.is_unlit == 1u,
    );
}

fn book_albedo(point: Substance) -> vec3<f32> {
    if material_maps.is_metallic_roughness == 1u {
        return srgb_from_linear(point.albedo);
    }
    return material.book_albedo * srgb_from_linear(point.diffuse_texel.rgb);
}
