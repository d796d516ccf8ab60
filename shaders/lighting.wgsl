// The studio: neutral surroundings, a soft warm key, a cool rim. All linear; intensities are in units where 1 shows as white.

const PI: f32 = 3.14159265;

const SKY: vec3<f32> = vec3<f32>(0.44, 0.48, 0.55);
const HORIZON: vec3<f32> = vec3<f32>(0.29, 0.30, 0.325);
const GROUND: vec3<f32> = vec3<f32>(0.11, 0.105, 0.105);

const KEY: vec3<f32> = vec3<f32>(1.08, 1.05, 1.00);
// The key is a soft box, not a point: its mirror image is spread by this much of alpha.
const KEY_SIZE: f32 = 0.08;

// From behind, opposite to the key: separates the silhouette from the backdrop.
const RIM: vec3<f32> = vec3<f32>(0.50, 0.66, 0.95);

struct Surface {
    albedo: vec3<f32>,
    fresnel0: vec3<f32>,
    // 0 smooth, 1 rough.
    roughness: f32,
    // Unit, on the side of the viewer.
    normal: vec3<f32>,
    // Unit, towards the viewer.
    to_eye: vec3<f32>,
}

// Light that falls on a surface from all around.
fn surrounding_light(normal: vec3<f32>) -> vec3<f32> {
    let above = mix(HORIZON, SKY, smoothstep(0.0, 1.0, normal.y));
    return mix(GROUND, above, smoothstep(-1.0, 0.25, normal.y));
}

// Light that comes from one direction of the surroundings, blurred by roughness.
fn surrounding_mirror(direction: vec3<f32>, roughness: f32) -> vec3<f32> {
    let edge = mix(0.08, 1.0, roughness);
    let sky = mix(HORIZON, SKY * 1.25, smoothstep(0.0, 1.0, direction.y));
    return mix(GROUND, sky, smoothstep(-edge, edge, direction.y));
}

fn fresnel(fresnel0: vec3<f32>, cos_angle: f32) -> vec3<f32> {
    let grazing = 1.0 - clamp(cos_angle, 0.0, 1.0);
    let squared = grazing * grazing;
    return fresnel0 + (vec3<f32>(1.0) - fresnel0) * (squared * squared * grazing);
}

// GGX lobe with the height-correlated visibility term in Hammon's approximation.
fn specular(surface: Surface, to_light: vec3<f32>, n_dot_l: f32) -> vec3<f32> {
    let halfway = normalize(to_light + surface.to_eye);
    let n_dot_h = clamp(dot(surface.normal, halfway), 0.0, 1.0);
    let n_dot_v = max(dot(surface.normal, surface.to_eye), 1e-3);
    let alpha = min(surface.roughness * surface.roughness + KEY_SIZE, 1.0);
    let alpha_squared = alpha * alpha;
    let spread = n_dot_h * n_dot_h * (alpha_squared - 1.0) + 1.0;
    let distribution = alpha_squared / (PI * spread * spread);
    let visibility = 0.5 / mix(2.0 * n_dot_l * n_dot_v, n_dot_l + n_dot_v, alpha);
    return fresnel(surface.fresnel0, dot(surface.to_eye, halfway)) * (distribution * visibility);
}

// Light from one direction that leaves towards the eye.
fn directional(surface: Surface, to_light: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    let n_dot_l = dot(surface.normal, to_light);
    if n_dot_l <= 0.0 {
        return vec3<f32>(0.0);
    }
    // Lights are given as what a white surface shows, so the Lambert 1/pi is in them and the lobe takes it back.
    return light * n_dot_l * (surface.albedo + PI * specular(surface, to_light, n_dot_l));
}

fn shade(surface: Surface, to_key: vec3<f32>, to_rim: vec3<f32>, key_visible: f32) -> vec3<f32> {
    let n_dot_v = clamp(dot(surface.normal, surface.to_eye), 0.0, 1.0);
    let mirrored = reflect(-surface.to_eye, surface.normal);
    let ambient = surface.albedo * surrounding_light(surface.normal)
        + fresnel(surface.fresnel0, n_dot_v) * (1.0 - 0.7 * surface.roughness)
            * surrounding_mirror(mirrored, surface.roughness);
    // Diffuse only: a lobe this low would burn every flat top. What turns away from the viewer catches the most.
    let edge = 1.0 - n_dot_v;
    let rim = RIM * max(dot(surface.normal, to_rim), 0.0) * (0.2 + 0.8 * edge * edge) * (surface.albedo + surface.fresnel0);
    // What the key does not reach lies deeper in the figure as a rule, and so sees less of the surroundings too.
    return ambient * (0.78 + 0.22 * key_visible) + directional(surface, to_key, KEY) * key_visible + rim;
}

// Keeps what is below the shoulder as it is and bends what is above towards white without clipping a hue.
fn soft_shoulder(color: vec3<f32>) -> vec3<f32> {
    let shoulder = 0.7;
    let over = max(color - shoulder, vec3<f32>(0.0));
    return min(color, vec3<f32>(shoulder)) + (1.0 - shoulder) * (over / (over + (1.0 - shoulder)));
}
