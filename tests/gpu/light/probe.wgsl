// Follows the files of the studio light and of the tone map: each pixel evaluates one case, its column across ANGLES, its row
// across ROUGHNESSES for each of QUANTITIES in turn.

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let ndc = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0;
    return vec4<f32>(ndc, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let column = u32(position.x);
    let row = u32(position.y);
    let n_dot_v = (f32(column) + 0.5) / f32(ANGLES);
    let roughness = max(f32(row % ROUGHNESSES) / f32(ROUGHNESSES - 1u), 0.05);
    let alpha = roughness * roughness;
    let quantity = row / ROUGHNESSES;
    let to_eye = vec3<f32>(sqrt(1.0 - n_dot_v * n_dot_v), n_dot_v, 0.0);
    let up = vec3<f32>(0.0, 1.0, 0.0);
    let to_light = normalize(vec3<f32>(-0.5, 0.6, 0.3));
    var value = vec3<f32>(0.0);
    if quantity == 0u {
        let tilted = normalize(vec3<f32>(n_dot_v - 0.5, 1.0, 0.2 * roughness));
        value = vec3<f32>(widened(roughness, n_dot_v * 0.2), own_light(up, tilted, to_light), own_light(tilted, up, to_eye));
    } else if quantity == 1u {
        let given = reflectance(vec3<f32>(0.8, 0.5, 0.2), vec3<f32>(0.04, 0.2, 0.6), 0.9, vec2<f32>(n_dot_v, roughness) * 0.5);
        value = given.single + given.multiple * 2.0 + given.diffuse * 3.0;
    } else if quantity == 2u {
        let tilted = normalize(vec3<f32>(0.6, 0.5, 0.2));
        value = vec3<f32>(
            specular_occlusion(n_dot_v, roughness, alpha),
            horizon_fade(reflect(-to_eye, tilted), up),
            dominant_direction(up, reflect(-to_eye, up), alpha).y,
        ) + multi_bounce(n_dot_v, vec3<f32>(roughness, 0.5, 0.9));
    } else if quantity == 3u {
        value = tone_mapped(exposed(vec3<f32>(n_dot_v, roughness, 0.3) * 2.0, roughness * 4.0 - 2.0));
    } else if quantity == 4u {
        value = environment_diffuse(to_eye);
    } else if quantity == 5u {
        value = environment_specular_light(to_eye + vec3<f32>(0.0, 0.0, roughness - 0.5), roughness);
    } else if quantity == 6u {
        value = vec3<f32>(brdf_lookup(n_dot_v, roughness), lamp_lookup(to_eye, to_light, roughness));
    } else if quantity == 7u {
        let sheen_roughness = 0.2 + 0.8 * roughness;
        value = vec3<f32>(
            sheen_albedo(n_dot_v, sheen_roughness),
            sheen_lobe(roughness, n_dot_v, 1.0 - n_dot_v * roughness, sheen_roughness),
            fresnel90(vec3<f32>(0.03 * n_dot_v)),
        );
    } else {
        let lights = StudioLights(to_light, KEY_COLOR, 0.75, 0.9, vec3<f32>(0.0, 0.6, -0.8), RIM_COLOR);
        var surface = StudioSurface(
            vec3<f32>(1.0), vec3<f32>(0.04), 1.0, roughness, up, up, to_eye, 1.0, vec3<f32>(0.0), 1.0, 0.0, 0.05, up);
        if quantity == 9u {
            surface.fresnel0 = vec3<f32>(1.0);
        } else if quantity == 10u {
            surface.coat = 1.0;
            surface.coat_roughness = 1.05 - roughness;
        } else if quantity == 11u {
            surface.sheen = vec3<f32>(1.0);
            surface.sheen_roughness = max(roughness, 0.2);
        } else if quantity >= 12u {
            surface.albedo = vec3<f32>(0.6, 0.4, 0.3);
            surface.normal = normalize(vec3<f32>(0.1, 1.0, -0.2));
            surface.ambient_occlusion = 0.6;
        }
        if quantity == 13u {
            surface.fresnel90 = 0.5;
            surface.sheen = vec3<f32>(0.2, 0.5, 0.3);
            surface.sheen_roughness = 0.6;
            surface.coat = 0.75;
            surface.coat_roughness = 0.2;
        }
        let given = studio_radiance(surface, lights);
        value = studio_light(surface, lights);
        if quantity == 14u {
            value = given.scattered + given.kept_out;
        }
    }
    return bitcast<vec4<u32>>(vec4<f32>(value, 1.0));
}
