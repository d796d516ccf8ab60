// The ground, its grid and its shadows, and what is behind the model. Twin: `shaders::Ground`.

struct Ground {
    // sRGB-encoded, so that the gradient is even to the eye. Opaque.
    backdrop_center_srgb: vec4<f32>,
    backdrop_edge_srgb: vec4<f32>,
    // Linear colour and opacity.
    grid: vec4<f32>,
    // Of the floor where light falls on it, linear; its alpha is how much of it shows in the middle.
    floor: vec4<f32>,
    background_srgb: vec3<f32>,
    // What is behind the model: 0 the gradient, 1 the sky, 2 `background_srgb`, 3 nothing.
    background: u32,
    // World x and z.
    center: vec2<f32>,
    // Middle of the contact map, world x and z.
    contact_center: vec2<f32>,
    contact_half_width: f32,
    // 1, or 0 without the contact map.
    contact_strength: f32,
    // Fraction of the ground's light that the key's shadow takes.
    shadow_strength: f32,
    // World y of the ground.
    height: f32,
    // World units between lines.
    grid_cell: f32,
    // Distance from the center at which the grid has faded out, and one at which little is left of the floor.
    grid_reach: f32,
    @size(8) floor_reach: f32,
}

@group(0) @binding(2) var<uniform> ground: Ground;
