// The model under the studio light.

// What a white surface that faces the light shows: a warm key, a cool rim. Twins in `tests/common/twins/studio.rs`.
const KEY_COLOR: vec3<f32> = vec3<f32>(1.00, 0.975, 0.93);
const RIM_COLOR: vec3<f32> = vec3<f32>(0.50, 0.66, 0.95);

// A smoother surface would sparkle where a pixel covers several bumps of the normal map.
const LEAST_ROUGHNESS: f32 = 0.08;

fn surface_color(point: SurfacePoint) -> vec3<f32> {
    if point.substance.is_unlit {
        return srgb_from_linear(point.substance.base_color);
    }
    // Surfaces that face away from the key shadow themselves. The light fades out before that angle, since on coarse triangles with
    // smooth normals the map would show each triangle's edge, and jagged.
    var key_visible = 0.0;
    let facing_key = dot(point.smooth_normal, light.to_key);
    let own_light = smoothstep(0.0, 0.4, facing_key) * smoothstep(-0.1, 0.0, dot(point.flat_normal, light.to_key));
    if own_light > 0.0 {
        key_visible = own_light * key_arrival(point);
    }
    let surface = StudioSurface(
        point.substance.albedo,
        point.substance.fresnel0,
        // The alpha scales 1 - roughness, as in the book's shader. Other formats define glossiness the same way (glTF's
        // KHR_materials_pbrSpecularGlossiness: 1 - roughness).
        max(1.0 - point.substance.shininess, LEAST_ROUGHNESS),
        point.normal,
        point.smooth_normal,
        point.to_eye,
        point.occlusion,
    );
    let lights = StudioLights(light.to_key, KEY_COLOR, key_visible, light.to_rim, RIM_COLOR);
    let radiance = studio_light(surface, lights) + point.substance.emissive;
    return srgb_from_linear(tone_mapped(exposed(radiance, camera.exposure_stops)));
}
