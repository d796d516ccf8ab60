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

// The channels of a texel that are read.
fn read_of(slot: u32, texel: vec4<f32>) -> vec4<f32> {
    let channels = vec4<u32>(u32(material_maps.places[slot].v.w));
    return select(NO_TEXEL, texel, (channels & vec4<u32>(1u, 2u, 4u, 8u)) != vec4<u32>(0u));
}

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
    var specular_texel = NO_TEXEL;
    if is_present(SPECULAR) {
        specular_texel = read_of(SPECULAR, textureSample(specular_map, specular_sampler, map_place(SPECULAR, tex_coords)));
    }
    var coat_texel = NO_TEXEL;
    if is_present(COAT) {
        coat_texel = read_of(COAT, textureSample(coat_map, coat_sampler, map_place(COAT, tex_coords)));
    }
    var coat_normal_texel = NO_TEXEL.rgb;
    if is_present(COAT_NORMAL) {
        coat_normal_texel = textureSample(coat_normal_map, coat_normal_sampler, map_place(COAT_NORMAL, tex_coords)).rgb;
    }
    var sheen_texel = NO_TEXEL;
    if is_present(SHEEN) {
        sheen_texel = read_of(SHEEN, textureSample(sheen_map, sheen_sampler, map_place(SHEEN, tex_coords)));
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
        let factor = material_maps.specular * specular_texel.a;
        let dielectric = min(material_maps.dielectric_fresnel0 * specular_texel.rgb, vec3<f32>(1.0)) * factor;
        fresnel0 = mix(dielectric, base_color, metallic);
        plain_fresnel0 = mix(vec3<f32>(material_maps.boundary_fresnel0), base_color, metallic);
        specular = mix(factor, 1.0, metallic);
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
        Layers(
            material_maps.sheen * sheen_texel.rgb,
            material_maps.sheen_roughness * sheen_texel.a,
            material_maps.coat * coat_texel.r,
            material_maps.coat_roughness * coat_texel.g,
            coat_normal_texel,
            material_maps.coat_normal_scale,
            material_maps.coat_normal_channels,
            material_maps.coat_normal_lengths,
        ),
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
