// All that a glTF file says about a surface: all its maps, each sampled in a way of its own, and colours of vertices. Stands in the place
// of `two_maps.wgsl`.

// Where a map is looked up: a 2x3 matrix, texture coordinates of the mesh -> of the map. Twin: `shaders::MapPlace`.
struct MapPlace {
    // w: 1 where it takes the second texture coordinates, else 0.
    u: vec4<f32>,
    // w: a bit for each channel that is read; the others are 1.
    v: vec4<f32>,
}

// Twin: `shaders::MaterialMaps`.
struct MaterialMaps {
    // In the order of `model::MapSlot`.
    places: array<MapPlace, 9>,
    // Linear light that the surface gives, times the emissive map.
    emissive: vec3<f32>,
    // Times `solid`.
    opacity: f32,
    metallic: f32,
    normal_scale: f32,
    occlusion_strength: f32,
    // Less alpha than this casts no shadow and hides nothing from ambient occlusion.
    least_solid_alpha: f32,
    // A bit for each map that is there, in the order of `model::MapSlot`.
    present: u32,
    // 1 when the diffuse map has alpha.
    has_map_alpha: u32,
    // 1 for metallic-roughness, which Fresnel0 follows from; else the values are those of a book.
    is_metallic_roughness: u32,
    // 1 when it is shown in its own colour without light.
    is_unlit: u32,
    // What is no metal reflects the smaller of this and 1, times `specular`, seen face on; at grazing angles `specular` alone.
    dielectric_fresnel0: vec3<f32>,
    specular: f32,
    // What lies over the surface.
    sheen: vec3<f32>,
    sheen_roughness: f32,
    coat: f32,
    coat_roughness: f32,
    // Fresnel0 that follows from the index of refraction alone.
    boundary_fresnel0: f32,
    // The fraction of what is scattered that is seen: less than 1 where light goes through.
    solid: f32,
    // As the material's, of the normal map of the coat.
    coat_normal_scale: f32,
    coat_normal_channels: u32,
    coat_normal_lengths: u32,
}

const DIFFUSE: u32 = 0u;
const NORMAL: u32 = 1u;
const METALLIC_ROUGHNESS: u32 = 2u;
const OCCLUSION: u32 = 3u;
const EMISSIVE: u32 = 4u;
const SPECULAR: u32 = 5u;
const COAT: u32 = 6u;
const COAT_NORMAL: u32 = 7u;
const SHEEN: u32 = 8u;

@group(3) @binding(1) var<uniform> material_maps: MaterialMaps;
@group(3) @binding(2) var diffuse_map: texture_2d<f32>;
@group(3) @binding(3) var diffuse_sampler: sampler;
@group(3) @binding(4) var normal_map: texture_2d<f32>;
@group(3) @binding(5) var normal_sampler: sampler;
@group(3) @binding(6) var metallic_roughness_map: texture_2d<f32>;
@group(3) @binding(7) var metallic_roughness_sampler: sampler;
@group(3) @binding(8) var material_occlusion_map: texture_2d<f32>;
@group(3) @binding(9) var material_occlusion_sampler: sampler;
@group(3) @binding(10) var emissive_map: texture_2d<f32>;
@group(3) @binding(11) var emissive_sampler: sampler;
@group(3) @binding(12) var specular_map: texture_2d<f32>;
@group(3) @binding(13) var specular_sampler: sampler;
@group(3) @binding(14) var coat_map: texture_2d<f32>;
@group(3) @binding(15) var coat_sampler: sampler;
@group(3) @binding(16) var coat_normal_map: texture_2d<f32>;
@group(3) @binding(17) var coat_normal_sampler: sampler;
@group(3) @binding(18) var sheen_map: texture_2d<f32>;
@group(3) @binding(19) var sheen_sampler: sampler;

// What a vertex has for maps. The colour is linear.
struct MapVertex {
    @location(3) tex_coord: vec2<f32>,
    @location(13) color: vec4<f32>,
    @location(14) second_tex_coord: vec2<f32>,
}

// Texture coordinates of the mesh, first and second -> where a map is looked up.
fn map_place(slot: u32, tex_coords: vec4<f32>) -> vec2<f32> {
    let place = material_maps.places[slot];
    let of_mesh = vec3<f32>(select(tex_coords.xy, tex_coords.zw, place.u.w > 0.5), 1.0);
    return vec2<f32>(dot(place.u.xyz, of_mesh), dot(place.v.xyz, of_mesh));
}

fn is_present(slot: u32) -> bool {
    return (material_maps.present & (1u << slot)) != 0u;
}

// The alpha that a texel of the diffuse map stands for.
fn map_alpha(texel_alpha: f32) -> f32 {
    return select(1.0, texel_alpha, material_maps.has_map_alpha == 1u);
}

fn cut_place(maps: MapVertex) -> vec3<f32> {
    let place = map_place(DIFFUSE, vec4<f32>(maps.tex_coord, maps.second_tex_coord));
    return vec3<f32>(place, material_maps.opacity * maps.color.a);
}

fn alpha_at(cut_place: vec3<f32>) -> f32 {
    return map_alpha(textureSample(diffuse_map, diffuse_sampler, cut_place.xy).a) * cut_place.z;
}

fn least_solid_alpha() -> f32 {
    return material_maps.least_solid_alpha;
}
