// The studio: its environment, a soft key that casts shadows, a cool rim. Twin: `tests/common/twins/studio.rs`.

// The lamp is a disc that is seen under 9 degrees from its middle to its edge: 1 / sin² of that is its radiance where a white surface that
// faces it shows 1.
const LAMP_RADIANCE: f32 = 40.863458;

// What the clear coat mirrors face on: an index of refraction of 1.5.
const COAT_FRESNEL0: f32 = 0.04;

struct StudioSurface {
    albedo: vec3<f32>,
    // Mirrored fraction, face on.
    fresnel0: vec3<f32>,
    // The same at grazing angles.
    fresnel90: f32,
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
    // The colour of fibres that lie over the surface; black without any.
    sheen: vec3<f32>,
    // 0.2 or more.
    sheen_roughness: f32,
    // How much of it a clear coat covers, 0 … 1, how rough that is, and its own normal, unit, on the side of the viewer.
    coat: f32,
    coat_roughness: f32,
    coat_normal: vec3<f32>,
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
struct StudioRadiance {
    // Of light that entered the surface and came back.
    scattered: vec3<f32>,
    // Of light that did not enter it.
    mirrored: vec3<f32>,
    // The fraction of light that does not enter, of what comes from all around.
    kept_out: f32,
}

fn studio_light(surface: StudioSurface, lights: StudioLights) -> vec3<f32> {
    let given = studio_radiance(surface, lights);
    return given.scattered + given.mirrored;
}

fn studio_radiance(surface: StudioSurface, lights: StudioLights) -> StudioRadiance {
    let n_dot_v = clamp(dot(surface.normal, surface.to_eye), 1e-3, 1.0);
    let entry = brdf_lookup(n_dot_v, surface.roughness);
    let weights = reflectance(surface.albedo, surface.fresnel0, surface.fresnel90, entry);

    let key = lights.key_color * lights.key_visible;
    let n_dot_l = max(dot(surface.normal, lights.to_key), 0.0);
    let around = environment_diffuse(surface.normal) * multi_bounce(surface.ambient_occlusion, surface.albedo)
        + studio_rim(surface, n_dot_v, lights);
    let even = around + key * n_dot_l;
    let mirrored = weights.single * mirrored_light(surface, surface.normal, n_dot_v, surface.roughness, lights)
        + weights.multiple * even;
    var given = StudioRadiance(weights.diffuse * even, mirrored, largest(weights.single + weights.multiple));

    // Sheen lies over the surface, and a coat over both. What each gives back does not reach what is beneath (glTF's albedo scaling).
    if any(surface.sheen > vec3<f32>(0.0)) {
        let share = sheen_albedo(n_dot_v, surface.sheen_roughness);
        let sum = surface.to_eye + lights.to_key;
        let n_dot_h = clamp(dot(surface.normal, sum) * inverseSqrt(max(dot(sum, sum), 1e-8)), 0.0, 1.0);
        // A white matt surface gives back 1 / pi per steradian.
        let lobe = 3.1415927 * sheen_lobe(n_dot_l, n_dot_v, n_dot_h, surface.sheen_roughness);
        given = beneath(given, largest(surface.sheen) * share, surface.sheen * (around * share + key * (n_dot_l * lobe)));
    }
    if surface.coat > 0.0 {
        let coat_dot_v = clamp(dot(surface.coat_normal, surface.to_eye), 1e-3, 1.0);
        let entry = brdf_lookup(coat_dot_v, surface.coat_roughness);
        let share = surface.coat * (COAT_FRESNEL0 * entry.x + entry.y);
        let light = mirrored_light(surface, surface.coat_normal, coat_dot_v, surface.coat_roughness, lights);
        given = beneath(given, share, share * light);
    }
    return given;
}

// What a layer leaves of what lies beneath it and gives back the fraction `share` of light from all around, here `light`.
fn beneath(given: StudioRadiance, share: f32, light: vec3<f32>) -> StudioRadiance {
    let left = 1.0 - share;
    return StudioRadiance(given.scattered * left, given.mirrored * left + light, 1.0 - (1.0 - given.kept_out) * left);
}

// What a mirror of this normal and roughness shows: the environment, the lamp in its shape, the rim.
fn mirrored_light(
    surface: StudioSurface,
    normal: vec3<f32>,
    n_dot_v: f32,
    roughness: f32,
    lights: StudioLights,
) -> vec3<f32> {
    let alpha = roughness * roughness;
    let mirrored = reflect(-surface.to_eye, normal);
    let towards = normalize(dominant_direction(normal, mirrored, alpha));
    let above = horizon_fade(mirrored, surface.smooth_normal);
    let seen = specular_occlusion(n_dot_v, surface.ambient_occlusion, alpha) * above;
    let lamp_seen = lamp_lookup(towards, lights.to_key, roughness) * LAMP_RADIANCE * above * lights.key_mirrored;
    return environment_specular_light(towards, roughness) * seen + lights.key_color * (lights.key_visible * lamp_seen)
        + studio_rim(surface, n_dot_v, lights);
}

fn largest(color: vec3<f32>) -> f32 {
    return max(color.r, max(color.g, color.b));
}

// The part of the key's light that a surface does not keep from itself, 1 where it faces the key. Where triangles are coarse, so that flat
// and smooth normals disagree, the light fades out before the surface turns away: the shadow map would show each triangle's edge, jagged.
fn own_light(flat_normal: vec3<f32>, smooth_normal: vec3<f32>, to_key: vec3<f32>) -> f32 {
    let coarse = clamp(8.0 * (1.0 - dot(flat_normal, smooth_normal)), 0.02, 1.0);
    return smoothstep(0.0, 0.4 * coarse, dot(smooth_normal, to_key)) * smoothstep(-0.1, 0.0, dot(flat_normal, to_key));
}

// The rim has no specular lobe: from so low it would overexpose every flat top. What a white surface shows of it, mirroring or not: it is
// strongest where the surface turns away from the viewer. It casts no shadows, so ambient occlusion keeps it out of creases.
fn studio_rim(surface: StudioSurface, n_dot_v: f32, lights: StudioLights) -> vec3<f32> {
    let edge = 1.0 - n_dot_v;
    let facing = max(dot(surface.normal, lights.to_rim), 0.0) * (0.2 + 0.8 * edge * edge);
    return lights.rim_color * (facing * surface.ambient_occlusion);
}
