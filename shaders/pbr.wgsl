// How a surface reflects light: formulas alone, without bindings. Twin: `tests/common/twins/pbr.rs`.
//
// Roughness is perceptual. Alpha is its square; the distribution of the micro-facets takes alpha.

const PI: f32 = 3.14159265;

// GGX (Walter et al. 2007): how densely micro-facets face `halfway`, per steradian. Both are of unit length.
fn ggx_distribution(normal: vec3<f32>, halfway: vec3<f32>, alpha: f32) -> f32 {
    // sin² by the cross product: 1 - cos² loses all digits where the lobe is narrow.
    let sine = cross(normal, halfway);
    let scaled_cos = dot(normal, halfway) * alpha;
    let ratio = alpha / (dot(sine, sine) + scaled_cos * scaled_cos);
    return ratio * ratio / PI;
}

// Smith's shadowing and masking of GGX, height-correlated and exact (Heitz 2014), over 4 (n·l) (n·v). Both are above 0.
fn smith_visibility(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    let squared = alpha * alpha;
    let towards_light = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - squared) + squared);
    let towards_eye = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - squared) + squared);
    return 0.5 / (towards_light + towards_eye);
}

// What a surface mirrors at grazing angles: everything, unless it mirrors less than any real material does face on.
fn fresnel90(fresnel0: vec3<f32>) -> f32 {
    return clamp(dot(fresnel0, vec3<f32>(50.0 / 3.0)), 0.0, 1.0);
}

// Schlick 1994.
fn fresnel_schlick(fresnel0: vec3<f32>, cos_angle: f32) -> vec3<f32> {
    let grazing = 1.0 - clamp(cos_angle, 0.0, 1.0);
    let squared = grazing * grazing;
    return mix(fresnel0, vec3<f32>(fresnel90(fresnel0)), squared * squared * grazing);
}

// The fraction of light from one direction that is mirrored, per steradian, after one bounce. `n_dot_l` and `n_dot_v` are above 0.
fn specular_lobe(
    normal: vec3<f32>,
    to_eye: vec3<f32>,
    to_light: vec3<f32>,
    n_dot_l: f32,
    n_dot_v: f32,
    fresnel0: vec3<f32>,
    alpha: f32,
) -> vec3<f32> {
    let sum = to_eye + to_light;
    // Their sum is zero only where both graze.
    let halfway = sum * inverseSqrt(max(dot(sum, sum), 1e-8));
    let lobe = ggx_distribution(normal, halfway, alpha) * smith_visibility(n_dot_l, n_dot_v, alpha);
    return fresnel_schlick(fresnel0, dot(to_eye, halfway)) * lobe;
}

// What becomes of light that falls on a surface evenly from all around. With an albedo of 1 the fractions sum to 1.
struct Reflectance {
    // Mirrored in one bounce.
    single: vec3<f32>,
    // Mirrored after more bounces between the micro-facets, so without direction.
    multiple: vec3<f32>,
    // Entered the surface and came back: the albedo of what is not mirrored.
    diffuse: vec3<f32>,
    // By how much all bounces exceed the first, for lights of one direction.
    boost: vec3<f32>,
}

// Fdez-Agüera 2019. `scale_bias` are the entries of the table for the view and the roughness.
fn reflectance(albedo: vec3<f32>, fresnel0: vec3<f32>, scale_bias: vec2<f32>) -> Reflectance {
    let grazing = vec3<f32>(fresnel90(fresnel0));
    let single = fresnel0 * scale_bias.x + grazing * scale_bias.y;
    // The mean of Schlick's curve over the hemisphere.
    let average = fresnel0 + (grazing - fresnel0) / 21.0;
    // The light that a perfect mirror of this roughness does not reflect in the first bounce.
    let trapped = 1.0 - min(scale_bias.x + scale_bias.y, 1.0);
    // Each further bounce has `average * trapped` of the one before: a geometric series.
    let boost = 1.0 / (1.0 - min(average, vec3<f32>(1.0)) * trapped);
    let multiple = single * (boost - 1.0);
    let diffuse = albedo * max(1.0 - single - multiple, vec3<f32>(0.0));
    return Reflectance(single, multiple, diffuse, boost);
}

// Where the lobe of a rough surface is strongest: from the mirrored direction towards the normal (Lagarde and de Rousiers
// 2014). Not of unit length.
fn dominant_direction(normal: vec3<f32>, mirrored: vec3<f32>, alpha: f32) -> vec3<f32> {
    let smoothness = 1.0 - alpha;
    return mix(normal, mirrored, smoothness * (sqrt(smoothness) + alpha));
}

// Fraction of the reflected environment that a point sees whose ambient occlusion is `occlusion`, 0 … 1 (Lagarde and de
// Rousiers 2014).
fn specular_occlusion(n_dot_v: f32, occlusion: f32, alpha: f32) -> f32 {
    let seen = max(n_dot_v + occlusion, 1e-4);
    return clamp(pow(seen, exp2(-16.0 * alpha - 1.0)) - 1.0 + occlusion, 0.0, 1.0);
}

// Fades out mirrored directions that a bump turns below the surface, since they see only the surface itself.
fn horizon_fade(mirrored: vec3<f32>, smooth_normal: vec3<f32>) -> f32 {
    let above = clamp(1.0 + 1.3 * dot(mirrored, smooth_normal), 0.0, 1.0);
    return above * above;
}
