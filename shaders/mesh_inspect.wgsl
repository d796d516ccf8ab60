// One property of the surface at a time, without light. The numbers are `scene::ViewMode`'s, in the order of its menu.

const BASE_COLOR: u32 = 1u;
const NORMAL_MAP: u32 = 2u;
const SHADING_NORMAL: u32 = 3u;
const TANGENT: u32 = 4u;
const TEX_COORDS: u32 = 5u;
const ROUGHNESS: u32 = 6u;
const METALLIC: u32 = 7u;
const MATERIAL: u32 = 8u;
const DEPTH: u32 = 9u;
const AMBIENT_OCCLUSION: u32 = 10u;
const SHADOW: u32 = 11u;

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
        case BASE_COLOR: {
            return srgb_from_linear(point.made.base_color);
        }
        case NORMAL_MAP: {
            if material.normal_channels == 0u {
                return FLAT;
            }
            let xy = point.made.normal_texel.rg;
            let away = xy * 2.0 - 1.0;
            let z = sqrt(max(1.0 - dot(away, away), 0.0)) * 0.5 + 0.5;
            return vec3<f32>(xy, select(point.made.normal_texel.b, z, material.normal_channels == 2u));
        }
        case SHADING_NORMAL: {
            return direction_color(point.normal);
        }
        case TANGENT: {
            let unit = normalize_or(point.tangent.xyz, vec3<f32>(0.0));
            return direction_color(unit) * select(0.6, 1.0, point.tangent.w >= 0.0);
        }
        case TEX_COORDS: {
            return checker(point.tex_coord) * facing_shade(point);
        }
        case ROUGHNESS: {
            return vec3<f32>(1.0 - point.made.shininess);
        }
        case METALLIC: {
            return vec3<f32>(point.made.metallic);
        }
        case MATERIAL: {
            return material.identity_srgb.rgb * facing_shade(point);
        }
        case DEPTH: {
            let along = dot(point.world_position - camera.eye, camera.forward);
            return vec3<f32>(1.0 - clamp((along - camera.depth_near) / (camera.depth_far - camera.depth_near), 0.0, 1.0));
        }
        case AMBIENT_OCCLUSION: {
            return vec3<f32>(point.occlusion);
        }
        case SHADOW: {
            return vec3<f32>(key_arrival(point));
        }
        default: {
            return vec3<f32>(1.0, 0.0, 1.0);
        }
    }
}
