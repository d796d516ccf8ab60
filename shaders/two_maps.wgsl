// The maps of the books' materials: two, sampled in one way. `all_maps.wgsl` stands in its place for other materials.

// Without such a map each is one texel that changes nothing.
@group(3) @binding(1) var diffuse_map: texture_2d<f32>;
@group(3) @binding(2) var normal_map: texture_2d<f32>;
@group(3) @binding(3) var map_sampler: sampler;

// What a vertex has for maps.
struct MapVertex {
    @location(3) tex_coord: vec2<f32>,
}

// For passes that read alpha alone: where the diffuse map is looked up, and what multiplies its alpha.
fn cut_place(maps: MapVertex) -> vec3<f32> {
    return vec3<f32>(maps.tex_coord, 1.0);
}

fn alpha_at(cut_place: vec3<f32>) -> f32 {
    return textureSample(diffuse_map, map_sampler, cut_place.xy).a;
}

// Less alpha than this casts no shadow and hides nothing from ambient occlusion.
fn least_solid_alpha() -> f32 {
    return material.alpha_clip;
}
