// What every program knows about the frame. Twin: `shaders::Frame`.

struct Frame {
    clip_from_world: mat4x4<f32>,
    world_from_model: mat4x4<f32>,
    shadow_clip_from_world: mat4x4<f32>,
    // A pixel at ndc (x, y) sees along forward + x * forward_per_x + y * forward_per_y,
    // from eye + x * eye_per_x + y * eye_per_y: the one is zero for parallel, the other for perspective projection.
    eye: vec3<f32>,
    // +1 when clockwise triangles show their front in the world, -1 when counter-clockwise ones do.
    front_sign: f32,
    forward: vec3<f32>,
    is_perspective: f32,
    eye_per_x: vec3<f32>,
    ground_height: f32,
    eye_per_y: vec3<f32>,
    // World units between minor lines; ten of them between major lines.
    grid_cell: f32,
    forward_per_x: vec3<f32>,
    // Distance from the middle of the scene where the grid is gone.
    grid_reach: f32,
    forward_per_y: vec3<f32>,
    // World units that a texel of the shadow map covers.
    shadow_texel: f32,
    // Unit vectors towards the lights.
    to_key: vec3<f32>,
    shadow_strength: f32,
    to_rim: vec3<f32>,
    grid_strength: f32,
    // sRGB-encoded, so that the gradient is even to the eye. Opaque.
    backdrop_center_srgb: vec4<f32>,
    backdrop_edge_srgb: vec4<f32>,
    // Colour and opacity.
    grid_minor: vec4<f32>,
    grid_major: vec4<f32>,
    grid_center: vec2<f32>,
    viewport_pixels: vec2<f32>,
    // +1 when the green of normal maps points along the bitangent, -1 when against it.
    normal_green_sign: f32,
    // `scene::ViewMode` by its place in the menu.
    view_mode: u32,
    // 1 when the shadow map holds the model, 0 when nothing is in shadow.
    key_shadow: u32,
    // 1, or 0 where mirrored surroundings are left out.
    reflections: f32,
    // Distances of the nearest and farthest point of the scene along the view.
    depth_near: f32,
    depth_far: f32,
    // Exposure of the studio's light; each doubles it.
    exposure_stops: f32,
    // 1 under the light of the books' demos.
    is_book: u32,
    // Unit vectors towards the second and third of the book's lights.
    to_book_light_1: vec4<f32>,
    to_book_light_2: vec4<f32>,
    // What is behind the model: 0 the gradient, 1 the sky, 2 one colour. And that colour, sRGB.
    background_srgb: vec3<f32>,
    background: u32,
    // Middle of the contact map on the ground, world x and z; half its width; how dark its shadow is.
    contact_center: vec2<f32>,
    contact_half_width: f32,
    contact_strength: f32,
    // How far occluders reach, world units.
    occlusion_radius: f32,
    // One unit of the books' demo in units of this world: the figure there is 3.6 of them tall.
    book_unit: f32,
    // Radius of the disc over which the shadow of the first light is blurred, texels of its map: on the model, on the ground.
    shadow_radius_texels: f32,
    ground_shadow_radius_texels: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// Unit vector from a point of the world towards the viewer.
fn towards_eye(world_position: vec3<f32>) -> vec3<f32> {
    if frame.is_perspective > 0.5 {
        return normalize(frame.eye - world_position);
    }
    return -frame.forward;
}
