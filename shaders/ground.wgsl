// The ground, its grid and its shadows, and what is behind the model. Twin: `shaders::Ground`.

struct Ground {
    // sRGB-encoded, so that the gradient is even to the eye. Opaque.
    backdrop_center_srgb: vec4<f32>,
    backdrop_edge_srgb: vec4<f32>,
    // Linear colour and opacity.
    grid_minor: vec4<f32>,
    grid_major: vec4<f32>,
    background_srgb: vec3<f32>,
    // What is behind the model: 0 the gradient, 1 the sky, 2 `background_srgb`, 3 nothing.
    background: u32,
    // World x and z.
    grid_center: vec2<f32>,
    // Middle of the contact map, world x and z.
    contact_center: vec2<f32>,
    contact_half_width: f32,
    // Fractions of the ground's light that its shadows take.
    contact_strength: f32,
    shadow_strength: f32,
    // Radius of the disc over which the key light's shadow on the ground is blurred, texels of the shadow map.
    shadow_radius_texels: f32,
    // World y of the ground.
    height: f32,
    // World units between minor lines; ten of them lie between major lines.
    grid_cell: f32,
    // Distance from the grid's center at which it has faded out.
    grid_reach: f32,
    grid_strength: f32,
}

@group(0) @binding(2) var<uniform> ground: Ground;
