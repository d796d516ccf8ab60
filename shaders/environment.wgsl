// Light from all around. Twins: `light::Prefiltered`, `light::BrdfTable`; of the struct: `shaders::Environment`.

struct Environment {
    // Irradiance over pi as spherical harmonics, all constants in them: 1; y, z, x; xy, yz, 3z² - 1, xz, x² - y².
    sh: array<vec4<f32>, 9>,
    // The world -> the environment, about y: the world's (turn_cos, 0, turn_sin) is the environment's x.
    turn_cos: f32,
    turn_sin: f32,
    // Multiplies all its light.
    intensity: f32,
    // Levels of `environment_specular`; 0 where it is not to be read.
    specular_level_count: f32,
}

@group(2) @binding(3) var<uniform> environment: Environment;
// Level l of n is blurred for the roughness r whose r (2 - r) is l / (n - 1).
@group(2) @binding(4) var environment_specular: texture_cube<f32>;
// Scale and bias of fresnel0: the root of n·v to the right, roughness down; entries lie in the middles of texels, the first at
// 0, the last at 1. In blue how much of a lobe the lamp fills: to the right the root of the sine of half the angle between them.
@group(2) @binding(5) var brdf_table: texture_2d<f32>;
// Linear and clamped, for both textures.
@group(2) @binding(6) var environment_sampler: sampler;

fn environment_from_world(direction: vec3<f32>) -> vec3<f32> {
    let x = direction.x * environment.turn_cos + direction.z * environment.turn_sin;
    let z = direction.z * environment.turn_cos - direction.x * environment.turn_sin;
    return vec3<f32>(x, direction.y, z);
}

// What a white surface with this normal shows.
fn environment_diffuse(normal: vec3<f32>) -> vec3<f32> {
    let n = environment_from_world(normal);
    let linear = environment.sh[1].rgb * n.y + environment.sh[2].rgb * n.z + environment.sh[3].rgb * n.x;
    let quadratic = environment.sh[4].rgb * (n.x * n.y) + environment.sh[5].rgb * (n.y * n.z)
        + environment.sh[6].rgb * (3.0 * n.z * n.z - 1.0) + environment.sh[7].rgb * (n.x * n.z)
        + environment.sh[8].rgb * (n.x * n.x - n.y * n.y);
    return max(environment.sh[0].rgb + linear + quadratic, vec3<f32>(0.0)) * environment.intensity;
}

// What a mirror of this roughness shows in a direction of any length. Without the cube it is the same in all directions.
fn environment_specular_light(direction: vec3<f32>, roughness: f32) -> vec3<f32> {
    if environment.specular_level_count < 1.0 {
        return max(environment.sh[0].rgb, vec3<f32>(0.0)) * environment.intensity;
    }
    let level = roughness * (2.0 - roughness) * (environment.specular_level_count - 1.0);
    let towards = environment_from_world(direction);
    return textureSampleLevel(environment_specular, environment_sampler, towards, level).rgb * environment.intensity;
}

fn brdf_entry(across: f32, down: f32) -> vec3<f32> {
    let side = vec2<f32>(textureDimensions(brdf_table));
    let place = (vec2<f32>(across, down) * (side - 1.0) + 0.5) / side;
    return textureSampleLevel(brdf_table, environment_sampler, place, 0.0).rgb;
}

fn brdf_lookup(n_dot_v: f32, roughness: f32) -> vec2<f32> {
    return brdf_entry(sqrt(max(n_dot_v, 0.0)), roughness).rg;
}

// The fraction of what a surface of this roughness mirrors that the lamp fills. `mirrored` is where its lobe is strongest; both
// directions are of unit length.
fn lamp_lookup(mirrored: vec3<f32>, to_lamp: vec3<f32>, roughness: f32) -> f32 {
    return brdf_entry(sqrt(0.5 * distance(mirrored, to_lamp)), roughness).b;
}
