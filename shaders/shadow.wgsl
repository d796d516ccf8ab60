// How much of the key light reaches a point.

// Sunflower disc: each tap turns on by the golden angle, so that the density is even.
const GOLDEN_TURN: mat2x2<f32> = mat2x2<f32>(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

// A disc of more texels shows its few taps as grain.
const MOST_SHADOW_TEXELS: f32 = 256.0;
// A narrower one shows the map's own steps.
const LEAST_SHADOW_TEXELS: f32 = 1.5;
// Steeper surfaces are as good as edge on: their plane says nothing of what is beside the point.
const LEAST_FACING: f32 = 0.2;

// Receivers may lie beyond the box that the map covers; casters never do.
const FARTHEST: f32 = 0.9999;

// A point of the world in the shadow map, in texels, and its depth. Depths below 0 are more than `beside` texels outside the map: the
// texels at its edge are empty, and stand for what is beside it.
fn in_shadow_map(world_position: vec3<f32>, side: f32, beside: f32) -> vec3<f32> {
    let clip = light.shadow_clip_from_world * vec4<f32>(world_position, 1.0);
    let place = (clip.xy * vec2<f32>(0.5, -0.5) + 0.5) * side;
    if any(place < vec2<f32>(-beside)) || any(place > vec2<f32>(side + beside)) {
        return vec3<f32>(0.0, 0.0, -1.0);
    }
    return vec3<f32>(place, min(clip.z, FARTHEST));
}

// The fraction of the key light that reaches a point: 1 lit, 0 in shadow, blurred over `radius_texels` of the map, as the book has it.
// Points outside the map are lit.
fn even_visibility(world_position: vec3<f32>, radius_texels: f32) -> f32 {
    let side = f32(textureDimensions(shadow_map).x);
    let place = in_shadow_map(world_position, side, radius_texels);
    if light.key_shadow == 0u || place.z < 0.0 {
        return 1.0;
    }
    var lit = 0.0;
    var direction = vec2<f32>(1.0, 0.0);
    for (var i = 0u; i < light.shadow_taps; i++) {
        let offset = sqrt((f32(i) + 0.5) / f32(light.shadow_taps)) * direction;
        direction = GOLDEN_TURN * direction;
        lit += textureSampleCompareLevel(shadow_map, shadow_sampler, (place.xy + offset * radius_texels) / side, place.z);
    }
    return lit / f32(light.shadow_taps);
}

// The same, as soft as the lamp makes it: what hides it is looked for, and the farther it is away, the wider is the penumbra (Fernando
// 2005, "Percentage-Closer Soft Shadows"). `normal` is that of the plane in which the point lies, unit, and `turn` how far the taps are
// turned, radians.
fn soft_visibility(world_position: vec3<f32>, normal: vec3<f32>, turn: f32) -> f32 {
    let side = f32(textureDimensions(shadow_map).x);
    let facing = clamp(dot(normal, light.to_key), 0.0, 1.0);
    // What lies in the texel that the point is in may differ from it by so much.
    let off_surface = normal * (1.5 * light.shadow_texel * sqrt(1.0 - facing * facing));
    let place = in_shadow_map(world_position + off_surface, side, MOST_SHADOW_TEXELS);
    if light.key_shadow == 0u || place.z < 0.0 {
        return 1.0;
    }
    // How the plane's depth grows from texel to texel. The rows of the matrix are the light's axes, scaled.
    let matrix = light.shadow_clip_from_world;
    let right = normalize(vec3<f32>(matrix[0].x, matrix[1].x, matrix[2].x));
    let up = normalize(vec3<f32>(matrix[0].y, matrix[1].y, matrix[2].y));
    let depth_per_texel = light.shadow_texel / light.shadow_depth;
    let slope = vec2<f32>(dot(normal, right), -dot(normal, up)) * (depth_per_texel / max(facing, LEAST_FACING));
    let bias = 0.5 * depth_per_texel;

    // What hides the lamp lies in the cone from the point to it, which is looked through more closely where it is narrow. Where nothing is
    // found in it, what is nearest to it says how soft a shadow ends there.
    let texels_per_depth = light.lamp_tangent / depth_per_texel;
    let search = clamp(texels_per_depth * place.z, LEAST_SHADOW_TEXELS, MOST_SHADOW_TEXELS);
    let start = vec2<f32>(cos(turn), sin(turn));
    let search_taps = light.shadow_taps / 2u;
    var found = 0.0;
    var reaches = 0.0;
    var nearest = vec2<f32>(1e30, 0.0);
    var direction = start;
    for (var i = 0u; i < search_taps; i++) {
        let part = (f32(i) + 0.5) / f32(search_taps);
        let away = part * part * search;
        let offset = away * direction;
        direction = GOLDEN_TURN * direction;
        let depth = textureSampleLevel(shadow_depth_map, shadow_depth_sampler, (place.xy + offset) / side, 0.0).r;
        if depth < min(place.z + dot(slope, offset) - bias, FARTHEST) {
            let reach = texels_per_depth * (place.z - depth);
            let in_cone = f32(away <= max(reach, LEAST_SHADOW_TEXELS));
            found += in_cone;
            reaches += in_cone * reach;
            if away - reach < nearest.x {
                nearest = vec2<f32>(away - reach, reach);
            }
        }
    }
    if nearest.x == 1e30 {
        return 1.0;
    }
    let reach = select(nearest.y, reaches / max(found, 1.0), found > 0.0);
    let radius = clamp(reach, LEAST_SHADOW_TEXELS, MOST_SHADOW_TEXELS);
    var lit = 0.0;
    for (var i = 0u; i < light.shadow_taps; i++) {
        let offset = sqrt((f32(i) + 0.5) / f32(light.shadow_taps)) * radius * direction;
        direction = GOLDEN_TURN * direction;
        let depth = min(place.z + dot(slope, offset) - bias, FARTHEST);
        lit += textureSampleCompareLevel(shadow_map, shadow_sampler, (place.xy + offset) / side, depth);
    }
    return lit / f32(light.shadow_taps);
}
