// The model under the studio light.

fn surface_color(point: SurfacePoint) -> vec3<f32> {
    // What faces away from the key lies in its own shadow. Towards there the light fades before the map says so: on coarse
    // triangles with smooth normals the map would draw each triangle's edge, and draw it jagged.
    var key_visible = 0.0;
    let facing_key = dot(point.smooth_normal, frame.to_key);
    let own_light = smoothstep(0.0, 0.4, facing_key) * smoothstep(-0.1, 0.0, dot(point.flat_normal, frame.to_key));
    if own_light > 0.0 {
        key_visible = own_light * key_arrival(point);
    }
    let albedo = material.albedo * point.diffuse_texel.rgb;
    let surface = Surface(albedo, material.fresnel0, max(material.roughness, 0.08), point.normal, point.to_eye);
    let color = soft_shoulder(shade(surface, frame.to_key, frame.to_rim, key_visible));
    return srgb_from_linear(color);
}
