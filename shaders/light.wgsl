// The lights, the shadow of the first, and how surfaces are lit. Twin: `shaders::Light`.

struct Light {
    shadow_clip_from_world: mat4x4<f32>,
    // Unit vectors towards the lights: the key casts the shadow; the rim is the studio's, the other two are the book's.
    to_key: vec3<f32>,
    // World units that a texel of the shadow map covers.
    shadow_texel: f32,
    to_rim: vec3<f32>,
    // Radius of the disc over which the book's shadows are blurred, texels of the shadow map.
    shadow_radius_texels: f32,
    to_book_light_1: vec3<f32>,
    // How far occluders reach, world units.
    occlusion_radius: f32,
    to_book_light_2: vec3<f32>,
    // One unit of the books' demo in world units: the figure there is 3.6 of them tall.
    book_unit: f32,
    // 1 when the shadow map holds the model, 0 when nothing is in shadow.
    key_shadow: u32,
    // 1, or 0 when the mirrored environment is left out.
    reflections: f32,
    // 1 under the light of the books' demos.
    is_book: u32,
    // +1 when the green of normal maps points along the bitangent, -1 when against it.
    normal_green_sign: f32,
    // 1 when ambient occlusion is to be sampled finely, 0 coarsely.
    fine_occlusion: u32,
    // Samples of the shadow map for each point.
    shadow_taps: u32,
    // World units between the nearest and the farthest depth of the shadow map.
    shadow_depth: f32,
    // How far the noise of taps is turned, 0..1: other than 0 where a picture at rest is drawn many times.
    noise_turn: f32,
    // What a white surface shows that faces one of the studio's lights.
    key_color: vec3<f32>,
    // 1 when what mirrors shows the key as a disc, 0 when it is seen in the environment.
    key_mirrored: f32,
    rim_color: vec3<f32>,
    // Tangent of the angle under which the lamp is seen from its middle to its edge, or the part of it that is drawn now.
    lamp_tangent: f32,
}

@group(0) @binding(1) var<uniform> light: Light;
