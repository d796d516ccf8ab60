// The model under the studio light.

// As in Filament. A smoother surface would look no sharper: the cube that it mirrors has no finer texels.
const LEAST_ROUGHNESS: f32 = 0.045;

// Less roughness of a sheen shows at edges alone, and no fit of its light knows it.
const LEAST_SHEEN_ROUGHNESS: f32 = 0.2;

fn surface_color(point: SurfacePoint) -> vec3<f32> {
    if point.substance.is_unlit {
        return srgb_from_linear(point.substance.base_color);
    }
    let given = given_back(point);
    return srgb_from_linear(shown(given.scattered + given.mirrored + point.substance.emissive));
}

// The colour of a point that is blended, and its alpha. Where light goes through, less is seen of what the surface scatters, and all of
// what it mirrors: alpha is as much larger as that needs.
fn blended_color(point: SurfacePoint) -> vec4<f32> {
    let alpha = clamp(point.substance.diffuse_texel.a, 0.0, 1.0);
    if point.substance.is_unlit || point.substance.solid >= 1.0 {
        return vec4<f32>(surface_color(point), alpha);
    }
    // What enters a metal stays there.
    let solid = mix(point.substance.solid, 1.0, point.substance.metallic);
    let given = given_back(point);
    let color = shown(given.scattered * solid + given.mirrored + point.substance.emissive);
    let opacity = max(mix(solid, 1.0, given.kept_out), largest(color));
    return vec4<f32>(srgb_from_linear(color / opacity), opacity * alpha / point.substance.solid);
}

fn shown(radiance: vec3<f32>) -> vec3<f32> {
    return tone_mapped(exposed(radiance, camera.exposure_stops));
}

fn given_back(point: SurfacePoint) -> StudioRadiance {
    var key_visible = own_light(point.flat_normal, point.smooth_normal, light.to_key);
    if key_visible > 0.0 {
        key_visible *= key_arrival(point);
    }
    let layers = point.substance.layers;
    let surface = StudioSurface(
        point.substance.albedo,
        point.substance.fresnel0,
        fresnel90(point.substance.plain_fresnel0) * point.substance.specular,
        // The alpha scales 1 - roughness, as in the book's shader. Other formats define glossiness the same way (glTF's
        // KHR_materials_pbrSpecularGlossiness: 1 - roughness).
        widened(max(1.0 - point.substance.shininess, LEAST_ROUGHNESS), point.widening),
        point.normal,
        point.smooth_normal,
        point.to_eye,
        point.occlusion,
        layers.sheen,
        max(layers.sheen_roughness, LEAST_SHEEN_ROUGHNESS),
        layers.coat,
        widened(max(layers.coat_roughness, LEAST_ROUGHNESS), point.coat_widening),
        point.coat_normal,
    );
    let lights = StudioLights(light.to_key, light.key_color, key_visible, light.key_mirrored, light.to_rim, light.rim_color);
    return studio_radiance(surface, lights);
}
