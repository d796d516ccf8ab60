// The studio: its environment, a soft key that casts shadows, a cool rim. Twin: `tests/common/twins/studio.rs`.

// The key is a soft box, not a point: its mirror image is spread by this much of alpha.
const KEY_SIZE: f32 = 0.08;

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
    // Unit; behind the model.
    to_rim: vec3<f32>,
    rim_color: vec3<f32>,
}

// Radiance towards the eye; linear, may exceed 1.
fn studio_light(surface: StudioSurface, lights: StudioLights) -> vec3<f32> {
    let n_dot_v = clamp(dot(surface.normal, surface.to_eye), 1e-3, 1.0);
    let weights = reflectance(surface.albedo, surface.fresnel0, brdf_lookup(n_dot_v, surface.roughness));
    return studio_environment(surface, weights, n_dot_v)
        + studio_key(surface, weights, n_dot_v, lights)
        + studio_rim(surface, weights, n_dot_v, lights);
}

fn studio_environment(surface: StudioSurface, weights: Reflectance, n_dot_v: f32) -> vec3<f32> {
    let alpha = surface.roughness * surface.roughness;
    let mirrored = reflect(-surface.to_eye, surface.normal);
    let towards = dominant_direction(surface.normal, mirrored, alpha);
    let seen = specular_occlusion(n_dot_v, surface.ambient_occlusion, alpha) * horizon_fade(mirrored, surface.smooth_normal);
    let mirror_light = environment_specular_light(towards, surface.roughness) * seen;
    let diffuse_light = environment_diffuse(surface.normal) * surface.ambient_occlusion;
    return weights.single * mirror_light + (weights.multiple + weights.diffuse) * diffuse_light;
}

fn studio_key(surface: StudioSurface, weights: Reflectance, n_dot_v: f32, lights: StudioLights) -> vec3<f32> {
    let n_dot_l = dot(surface.normal, lights.to_key);
    if n_dot_l <= 0.0 {
        return vec3<f32>(0.0);
    }
    let alpha = min(surface.roughness * surface.roughness + KEY_SIZE, 1.0);
    let lobe = specular_lobe(
        surface.normal, surface.to_eye, lights.to_key, n_dot_l, n_dot_v, surface.fresnel0, alpha);
    // The light already includes Lambert's 1/pi. The lobe does not want it, hence the PI.
    return lights.key_color * (lights.key_visible * n_dot_l) * (weights.diffuse + PI * weights.boost * lobe);
}

// The rim has no specular lobe: from so low it would overexpose every flat top. It scales with all that the surface reflects, and is
// strongest where the surface turns away from the viewer. It casts no shadows, so ambient occlusion keeps it out of creases.
fn studio_rim(surface: StudioSurface, weights: Reflectance, n_dot_v: f32, lights: StudioLights) -> vec3<f32> {
    let edge = 1.0 - n_dot_v;
    let facing = max(dot(surface.normal, lights.to_rim), 0.0) * (0.2 + 0.8 * edge * edge);
    let given_back = weights.diffuse + weights.single + weights.multiple;
    return lights.rim_color * (facing * surface.ambient_occlusion) * given_back;
}
