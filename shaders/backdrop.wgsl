// Backdrop, floor, grid and the shadows on the ground in one draw wherever the model is not, after it. One draw is rounded and dithered
// once instead of blended several times in eight bits. Without a background the shadows alone are drawn, as black that covers what the
// picture is later laid over.

// How near the model is above the ground: 1 where it stands, 0 far above or without a model. Red for what touches it, green for what is
// above it. In a group of its own, since a program that draws the model binds sixteen textures without it, as many as WebGL2 has.
@group(1) @binding(0) var contact_map: texture_2d<f32>;

// How far from the lightest row, in heights of the view, the backdrop is nearly its edge colour.
const BACKDROP_FALLOFF: f32 = 0.76;
// The lightest row, ndc y: a little above the middle, where the horizon of a three-quarter view lies.
const BACKDROP_ROW: f32 = 0.06;

// Fractions of the ground's light that go where something touches it, and under what is near.
const TOUCH_STRENGTH: f32 = 0.9;
const NEAR_STRENGTH: f32 = 0.35;

// The grid's lines are a point of the screen wide, and in pixels at least so much.
const LEAST_LINE_PIXELS: f32 = 1.0;

fn backdrop_srgb(ndc: vec2<f32>) -> vec3<f32> {
    let offset = vec2<f32>(ndc.x * 0.16, ndc.y - BACKDROP_ROW);
    // The gradient is flat in the middle, so that no crease shows there.
    let away = (sqrt(dot(offset, offset) + 0.012) - 0.11) * BACKDROP_FALLOFF;
    return mix(ground.backdrop_center_srgb.rgb, ground.backdrop_edge_srgb.rgb, clamp(away, 0.0, 1.0));
}

// Coverage of lines at whole numbers of `coordinate`, `width_pixels` wide; `per_pixel` is how far a pixel steps.
fn line_coverage(coordinate: vec2<f32>, per_pixel: vec2<f32>, width_pixels: f32) -> f32 {
    let distance_pixels = (0.5 - abs(fract(coordinate) - 0.5)) / per_pixel;
    let sharp = clamp(vec2<f32>(0.5 + 0.5 * width_pixels) - distance_pixels, vec2<f32>(0.0), vec2<f32>(1.0));
    // Lines that are only a few pixels apart would shimmer, so they fade out before.
    let crowded = smoothstep(vec2<f32>(0.03), vec2<f32>(0.10), per_pixel);
    let lines = sharp * (vec2<f32>(1.0) - crowded);
    return max(lines.x, lines.y);
}

// The fraction of the ground's light that its shadows leave at a point of it.
fn light_left(point: vec3<f32>, pixel: vec2<f32>) -> f32 {
    var left = 1.0;
    if ground.shadow_strength > 0.0 {
        var lit = 1.0;
        if light.is_book == 1u {
            lit = even_visibility(point, light.shadow_radius_texels);
        } else {
            lit = soft_visibility(point, vec3<f32>(0.0, 1.0, 0.0), tap_turn(pixel, light.noise_turn));
        }
        left = 1.0 - ground.shadow_strength * (1.0 - lit);
    }
    if ground.contact_strength > 0.0 {
        let in_contact_map = (point.xz - ground.contact_center) / ground.contact_half_width * vec2<f32>(0.5, -0.5) + 0.5;
        let contact = textureSampleLevel(contact_map, environment_sampler, in_contact_map, 0.0).rg * ground.contact_strength;
        left *= (1.0 - TOUCH_STRENGTH * contact.r) * (1.0 - NEAR_STRENGTH * contact.g);
    }
    return left;
}

// The sky along a ray. Under the studio light it is exposed and toned as the model is; the books show texels as they are.
fn sky_color(ray: vec3<f32>) -> vec3<f32> {
    let pixel_radians = 2.0 * length(camera.forward_per_y) / camera.viewport_pixels.y / length(ray);
    let texel = sky_light(ray, pixel_radians);
    if light.is_book == 1u {
        return clamp(texel, vec3<f32>(0.0), vec3<f32>(1.0));
    }
    return tone_mapped(exposed(texel, camera.exposure_stops));
}

@fragment
fn fragment(view: FullscreenVertex) -> @location(0) vec4<f32> {
    let ndc = view.ndc - camera.jitter;
    let pixel = in_picture(view.clip.xy);
    var color = linear_from_srgb(select(ground.background_srgb, backdrop_srgb(ndc), ground.background == 0u));
    let eye = camera.eye + ndc.x * camera.eye_per_x + ndc.y * camera.eye_per_y;
    let ray = camera.forward + ndc.x * camera.forward_per_x + ndc.y * camera.forward_per_y;
    if ground.background == 1u {
        color = sky_color(ray);
    }
    let behind = color;
    var left = 1.0;
    let along = (ground.height - eye.y) / ray.y;
    if ray.y != 0.0 && along > 0.0 {
        let point = eye + ray * along;
        let away = length(point.xz - ground.center);
        let faded = away / ground.floor_reach;
        color = mix(color, ground.floor.rgb, ground.floor.a * exp(-faded * faded));
        if away < ground.grid_reach {
            // How far the point moves from one pixel to the next. Exact, since screen derivatives would tear at the horizon.
            let along_x = -(camera.eye_per_x.y + along * camera.forward_per_x.y) / ray.y;
            let along_y = -(camera.eye_per_y.y + along * camera.forward_per_y.y) / ray.y;
            let point_x = camera.eye_per_x + along * camera.forward_per_x + along_x * ray;
            let point_y = camera.eye_per_y + along * camera.forward_per_y + along_y * ray;
            let ndc_per_pixel = 2.0 / camera.viewport_pixels;
            let step_x = abs(point_x.xz) * ndc_per_pixel.x;
            let step_y = abs(point_y.xz) * ndc_per_pixel.y;
            let per_pixel = sqrt(step_x * step_x + step_y * step_y) / ground.grid_cell;
            let width = max(camera.viewport_pixels.y / camera.points_high, LEAST_LINE_PIXELS);
            let fade = 1.0 - away / ground.grid_reach;
            let grazing = smoothstep(0.0, 0.12, abs(ray.y) / length(ray));
            let strength = line_coverage(point.xz / ground.grid_cell, per_pixel, width) * fade * fade * grazing;
            color = mix(color, ground.grid.rgb, strength * ground.grid.a);
        }
        // Who looks from below sees through the ground: no shadow lies on that side.
        if ray.y < 0.0 {
            left = light_left(point, pixel);
            color *= left;
        }
    }
    if ground.background == 3u {
        return vec4<f32>(0.0, 0.0, 0.0, dithered(1.0 - left, pixel, light.noise_turn));
    }
    // A plain background is stored exactly, without dither.
    if ground.background == 2u && all(color == behind) {
        return vec4<f32>(behind, 1.0);
    }
    return vec4<f32>(dithered_linear_from_srgb(srgb_from_linear(color), pixel, light.noise_turn), 1.0);
}
