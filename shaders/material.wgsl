// What a surface is made of. Twin: `shaders::Material`.

struct Material {
    // Multiplies the diffuse map.
    albedo: vec3<f32>,
    roughness: f32,
    fresnel0: vec3<f32>,
    // What lies below this alpha is cut away; 0 keeps everything.
    alpha_clip: f32,
    // Channels of the normal map: 3, 2 (z follows from x and y), or 0 without one.
    @size(16) normal_channels: u32,
}

@group(3) @binding(0) var<uniform> material: Material;
// Each is one texel that changes nothing where the material has no such map.
@group(3) @binding(1) var diffuse_map: texture_2d<f32>;
@group(3) @binding(2) var normal_map: texture_2d<f32>;
@group(3) @binding(3) var map_sampler: sampler;
