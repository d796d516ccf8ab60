// One property of the surface at a time, without light. Names and numbers are `scene::ViewMode`'s, in the order of its menu.

const VIEW_BASE_COLOR: u32 = 1u;
const VIEW_NORMAL_MAP: u32 = 2u;
const VIEW_NORMAL: u32 = 3u;
const VIEW_TANGENT: u32 = 4u;
const VIEW_UV: u32 = 5u;
const VIEW_ROUGHNESS: u32 = 6u;
const VIEW_METALLIC: u32 = 7u;
const VIEW_MATERIAL: u32 = 8u;
const VIEW_DEPTH: u32 = 9u;
const VIEW_AO: u32 = 10u;
const VIEW_SHADOW: u32 = 11u;

// A normal map's texel on a flat surface, in bytes 128, 128, 255.
const FLAT: vec3<f32> = vec3<f32>(128.0 / 255.0, 128.0 / 255.0, 1.0);

// A direction as a colour: -1..1 on each axis is 0..1 in each channel.
fn direction_color(direction: vec3<f32>) -> vec3<f32> {
    return direction * 0.5 + 0.5;
}

// 8 x 8 fields a tile, u as red and v as green; fields outside the first tile are paler, so that tiling shows.
fn checker(tex_coord: vec2<f32>) -> vec3<f32> {
    let field = floor(tex_coord * 8.0);
    let is_dark = fract((field.x + field.y) * 0.5) > 0.25;
    let inside = fract(tex_coord);
    let color = vec3<f32>(0.15 + 0.8 * inside.x, 0.15 + 0.8 * inside.y, 0.35);
    let is_first_tile = all(tex_coord >= vec2<f32>(0.0)) && all(tex_coord <= vec2<f32>(1.0));
    return mix(vec3<f32>(0.5), color, select(0.55, 1.0, is_first_tile)) * select(1.0, 0.55, is_dark);
}

// Shades a flat colour a little: brighter where the surface faces the viewer.
fn facing_shade(point: SurfacePoint) -> f32 {
    return 0.62 + 0.38 * clamp(dot(point.smooth_normal, point.to_eye), 0.0, 1.0);
}

fn surface_color(point: SurfacePoint) -> vec3<f32> {
    switch camera.view_mode {
        case VIEW_BASE_COLOR: {
            return srgb_from_linear(point.substance.base_color);
        }
        case VIEW_NORMAL_MAP: {
            if material.normal_channels == 0u {
                return FLAT;
            }
            let xy = point.substance.normal_texel.rg;
            let away = xy * 2.0 - 1.0;
            let z = sqrt(max(1.0 - dot(away, away), 0.0)) * 0.5 + 0.5;
            return vec3<f32>(xy, select(point.substance.normal_texel.b, z, material.normal_channels == 2u));
        }
        case VIEW_NORMAL: {
            return direction_color(point.normal);
        }
        case VIEW_TANGENT: {
            let unit = normalize_or(point.tangent.xyz, vec3<f32>(0.0));
            return direction_color(unit) * select(0.6, 1.0, point.tangent.w >= 0.0);
        }
        case VIEW_UV: {
            return checker(point.tex_coord) * facing_shade(point);
        }
        case VIEW_ROUGHNESS: {
            return vec3<f32>(1.0 - point.substance.shininess);
        }
        case VIEW_METALLIC: {
            return vec3<f32>(point.substance.metallic);
        }
        case VIEW_MATERIAL: {
            return material.identity_srgb * facing_shade(point);
        }
        case VIEW_DEPTH: {
            let along = dot(point.world_position - camera.eye, camera.forward);
            return vec3<f32>(1.0 - clamp((along - camera.depth_near) / (camera.depth_far - camera.depth_near), 0.0, 1.0));
        }
        case VIEW_AO: {
            return vec3<f32>(point.occlusion);
        }
        case VIEW_SHADOW: {
            return vec3<f32>(key_arrival(point));
        }
        default: {
            return vec3<f32>(1.0, 0.0, 1.0);
        }
    }
}
