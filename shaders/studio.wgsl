// The studio: its environment, a soft key that casts shadows, a cool rim. Twin: `tests/common/twins/studio.rs`.

// The lamp is a disc that is seen under 9 degrees from its middle to its edge: 1 / sin² of that is its radiance where a white surface that
// faces it shows 1.
const LAMP_RADIANCE: f32 = 40.863458;

struct StudioSurface {
    albedo: vec3<f32>,
    // Mirrored fraction, face on.
    fresnel0: vec3<f32>,
    // 0 smooth, 1 rough.
    roughness: f32,
    // Unit, on the side of the viewer, with the normal map's bumps.
    normal: vec3<f32>,
    // The same without.
    smooth_normal: vec3<f32>,
    // Unit, towards the viewer.
    to_eye: vec3<f32>,
    // Fraction of the environment that the point sees, 0 … 1.
    ambient_occlusion: f32,
}

// Colours are what a white surface that faces the light shows.
struct StudioLights {
    // Unit.
    to_key: vec3<f32>,
    key_color: vec3<f32>,
    // 0 in shadow, 1 lit.
    key_visible: f32,
    // 1 when what mirrors shows it as a disc, 0 when it is seen in the environment.
    key_mirrored: f32,
    // Unit; behind the model.
    to_rim: vec3<f32>,
    rim_color: vec3<f32>,
}

// Radiance towards the eye; linear, may exceed 1.
fn studio_light(surface: StudioSurface, lights: StudioLights) -> vec3<f32> {
    let n_dot_v = clamp(dot(surface.normal, surface.to_eye), 1e-3, 1.0);
    let weights = reflectance(surface.albedo, surface.fresnel0, brdf_lookup(n_dot_v, surface.roughness));
    let alpha = surface.roughness * surface.roughness;
    let mirrored = reflect(-surface.to_eye, surface.normal);
    let towards = normalize(dominant_direction(surface.normal, mirrored, alpha));
    let above = horizon_fade(mirrored, surface.smooth_normal);

    let seen = specular_occlusion(n_dot_v, surface.ambient_occlusion, alpha) * above;
    let mirror_light = environment_specular_light(towards, surface.roughness) * seen;
    let diffuse_light = environment_diffuse(surface.normal) * multi_bounce(surface.ambient_occlusion, surface.albedo);
    let from_environment = weights.single * mirror_light + (weights.multiple + weights.diffuse) * diffuse_light;

    // Of the lamp's light too, what is mirrored once keeps its shape.
    let n_dot_l = max(dot(surface.normal, lights.to_key), 0.0);
    let lamp_seen = lamp_lookup(towards, lights.to_key, surface.roughness) * LAMP_RADIANCE * above * lights.key_mirrored;
    let from_key = lights.key_color * lights.key_visible
        * ((weights.diffuse + weights.multiple) * n_dot_l + weights.single * lamp_seen);
    return from_environment + from_key + studio_rim(surface, weights, n_dot_v, lights);
}

// The part of the key's light that a surface does not keep from itself, 1 where it faces the key. Where triangles are coarse, so that flat
// and smooth normals disagree, the light fades out before the surface turns away: the shadow map would show each triangle's edge, jagged.
fn own_light(flat_normal: vec3<f32>, smooth_normal: vec3<f32>, to_key: vec3<f32>) -> f32 {
    let coarse = clamp(8.0 * (1.0 - dot(flat_normal, smooth_normal)), 0.02, 1.0);
    return smoothstep(0.0, 0.4 * coarse, dot(smooth_normal, to_key)) * smoothstep(-0.1, 0.0, dot(flat_normal, to_key));
}

// The rim has no specular lobe: from so low it would overexpose every flat top. It scales with all that the surface reflects, and is
// strongest where the surface turns away from the viewer. It casts no shadows, so ambient occlusion keeps it out of creases.
fn studio_rim(surface: StudioSurface, weights: Reflectance, n_dot_v: f32, lights: StudioLights) -> vec3<f32> {
    let edge = 1.0 - n_dot_v;
    let facing = max(dot(surface.normal, lights.to_rim), 0.0) * (0.2 + 0.8 * edge * edge);
    let given_back = weights.diffuse + weights.single + weights.multiple;
    return lights.rim_color * (facing * surface.ambient_occlusion) * given_back;
}
