// How much of the key light reaches a point.

// Sunflower disc: each tap turns on by the golden angle, so that the density is even.
const GOLDEN_COS: f32 = -0.73736888;
const GOLDEN_SIN: f32 = 0.67549029;

// The fraction of the key light that reaches a point: 1 lit, 0 in shadow, blurred over `radius_texels` of the map. Points outside the
// map are lit.
fn key_visibility(world_position: vec3<f32>, radius_texels: f32) -> f32 {
    if light.key_shadow == 0u {
        return 1.0;
    }
    let clip = light.shadow_clip_from_world * vec4<f32>(world_position, 1.0);
    let center = clip.xy * vec2<f32>(0.5, -0.5) + 0.5;
    if any(center < vec2<f32>(0.0)) || any(center > vec2<f32>(1.0)) || clip.z < 0.0 {
        return 1.0;
    }
    // Receivers may lie beyond the box that the map covers; casters never do.
    let depth = min(clip.z, 0.9999);
    let radius = radius_texels / f32(textureDimensions(shadow_map).x);
    var lit = 0.0;
    var direction = vec2<f32>(1.0, 0.0);
    for (var i = 0u; i < light.shadow_taps; i++) {
        let offset = sqrt((f32(i) + 0.5) / f32(light.shadow_taps)) * direction;
        direction = mat2x2<f32>(GOLDEN_COS, GOLDEN_SIN, -GOLDEN_SIN, GOLDEN_COS) * direction;
        lit += textureSampleCompareLevel(shadow_map, shadow_sampler, center + offset * radius, depth);
    }
    return lit / f32(light.shadow_taps);
}
