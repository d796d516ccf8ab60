// What a surface is made of: the values that every material has. Twin: `shaders::Material`.

struct Material {
    // Linear, multiplies the diffuse map.
    albedo: vec3<f32>,
    roughness: f32,
    fresnel0: vec3<f32>,
    // What has less alpha than this is cut away; 0 keeps everything.
    alpha_clip: f32,
    // The diffuse colour as the books multiply it with encoded texels.
    book_albedo: vec3<f32>,
    // 1 for materials of the DirectX 11 book: the four below are then the file's.
    is_phong: u32,
    ambient: vec3<f32>,
    spec_power: f32,
    specular: vec3<f32>,
    // Channels of the normal map: 4 (alpha is gloss), 3, 2 (z follows from x and y), or 0 without one.
    normal_channels: u32,
    reflectivity: vec3<f32>,
    // 1 when smaller levels of the normal map are means of directions, which are the shorter the more these differ.
    normal_lengths: u32,
    // sRGB, a colour to tell the material from others.
    identity_srgb: vec3<f32>,
    // By how much the noise is turned from sample to sample against which its alpha is compared, 0..1.
    threshold_step: f32,
}

@group(3) @binding(0) var<uniform> material: Material;
