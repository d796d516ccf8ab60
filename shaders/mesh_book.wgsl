// The model under the light of the books' demos.

// Where normals turn within the pixel, a mirrored ray turns twice as far. Of `widening`: see `bend_of`.
fn sky_srgb(direction: vec3<f32>, widening: f32) -> vec3<f32> {
    if light.reflections < 0.5 {
        return vec3<f32>(0.0);
    }
    let texel = sky_light(direction, 2.0 * sqrt(widening / 0.6));
    return srgb_from_linear(clamp(texel, vec3<f32>(0.0), vec3<f32>(1.0)));
}

fn surface_color(point: SurfacePoint) -> vec3<f32> {
    if point.substance.is_unlit {
        return srgb_from_linear(point.substance.base_color);
    }
    let to_lights = array<vec3<f32>, 3>(light.to_key, light.to_book_light_1, light.to_book_light_2);
    var key_visible = 1.0;
    if dot(point.normal, light.to_key) > 0.0 {
        key_visible = key_arrival(point);
    }
    let mirrored = reflect(-point.to_eye, point.normal);
    var color: vec3<f32>;
    if material.is_phong == 0u {
        let surface = BookSurface(
            book_albedo(point.substance),
            point.substance.fresnel0,
            point.substance.shininess,
            point.normal,
            point.to_eye,
        );
        color = book_light(surface, to_lights, key_visible, point.occlusion)
            + book_reflectance(surface, mirrored) * sky_srgb(mirrored, point.widening);
    } else {
        let surface = PhongSurface(
            srgb_from_linear(point.substance.diffuse_texel.rgb),
            material.ambient,
            material.book_albedo,
            material.specular,
            material.spec_power,
            point.normal,
            point.to_eye,
        );
        color = phong_light(surface, to_lights, key_visible, point.occlusion)
            + material.reflectivity * sky_srgb(mirrored, point.widening);
    }
    color += srgb_from_linear(clamp(point.substance.emissive, vec3<f32>(0.0), vec3<f32>(1.0)));
    return clamp(color, vec3<f32>(0.0), vec3<f32>(1.0));
}

// The colour of a point that is blended, and its alpha.
fn blended_color(point: SurfacePoint) -> vec4<f32> {
    return vec4<f32>(surface_color(point), clamp(point.substance.diffuse_texel.a, 0.0, 1.0));
}
