// The model under the studio light.

// As in Filament. A smoother surface would look no sharper: the cube that it mirrors has no finer texels.
const LEAST_ROUGHNESS: f32 = 0.045;

fn surface_color(point: SurfacePoint) -> vec3<f32> {
    if point.substance.is_unlit {
        return srgb_from_linear(point.substance.base_color);
    }
    var key_visible = own_light(point.flat_normal, point.smooth_normal, light.to_key);
    if key_visible > 0.0 {
        key_visible *= key_arrival(point);
    }
    let surface = StudioSurface(
        point.substance.albedo,
        point.substance.fresnel0,
        // The alpha scales 1 - roughness, as in the book's shader. Other formats define glossiness the same way (glTF's
        // KHR_materials_pbrSpecularGlossiness: 1 - roughness).
        widened(max(1.0 - point.substance.shininess, LEAST_ROUGHNESS), point.widening),
        point.normal,
        point.smooth_normal,
        point.to_eye,
        point.occlusion,
    );
    let lights = StudioLights(light.to_key, light.key_color, key_visible, light.key_mirrored, light.to_rim, light.rim_color);
    let radiance = studio_light(surface, lights) + point.substance.emissive;
    return srgb_from_linear(tone_mapped(exposed(radiance, camera.exposure_stops)));
}
