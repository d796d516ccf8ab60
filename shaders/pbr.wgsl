// How a surface reflects light: formulas alone, without bindings. Twin: `tests/common/twins/pbr.rs`.
//
// Roughness is perceptual. Alpha is its square; the distribution of the micro-facets takes alpha.

// What a surface mirrors at grazing angles: everything, unless it mirrors less than any real material does face on.
fn fresnel90(fresnel0: vec3<f32>) -> f32 {
    return clamp(dot(fresnel0, vec3<f32>(50.0 / 3.0)), 0.0, 1.0);
}

// What becomes of light that falls on a surface evenly from all around. With an albedo of 1 the fractions sum to 1.
struct Reflectance {
    // Mirrored in one bounce.
    single: vec3<f32>,
    // Mirrored after more bounces between the micro-facets, so without direction.
    multiple: vec3<f32>,
    // Entered the surface and came back: the albedo of what is not mirrored.
    diffuse: vec3<f32>,
}

// Fdez-Agüera 2019. `at_grazing` is the fraction mirrored at grazing angles; `scale_bias` are the entries of the table for the view and
// the roughness.
fn reflectance(albedo: vec3<f32>, fresnel0: vec3<f32>, at_grazing: f32, scale_bias: vec2<f32>) -> Reflectance {
    let grazing = vec3<f32>(at_grazing);
    let single = fresnel0 * scale_bias.x + grazing * scale_bias.y;
    // The mean of Schlick's curve over the hemisphere.
    let average = fresnel0 + (grazing - fresnel0) / 21.0;
    // The light that a perfect mirror of this roughness does not reflect in the first bounce.
    let trapped = 1.0 - min(scale_bias.x + scale_bias.y, 1.0);
    // Each further bounce has `average * trapped` of the one before: a geometric series.
    let boost = 1.0 / (1.0 - min(average, vec3<f32>(1.0)) * trapped);
    let multiple = single * (boost - 1.0);
    let diffuse = albedo * max(1.0 - single - multiple, vec3<f32>(0.0));
    return Reflectance(single, multiple, diffuse);
}

// Sheen: the distribution of fibres by Estevez and Kulla 2017, named Charlie, with alpha as the square of roughness, over the denominator
// of Neubelt and Pettineo 2013, as glTF's KHR_materials_sheen allows. The fraction of light of one direction, per steradian. Roughness is
// 0.2 or more; n·v is above 0.
fn sheen_lobe(n_dot_l: f32, n_dot_v: f32, n_dot_h: f32, roughness: f32) -> f32 {
    let inverse = 1.0 / (roughness * roughness);
    let sine = sqrt(max(1.0 - n_dot_h * n_dot_h, 1e-6));
    let distribution = (2.0 + inverse) * pow(sine, inverse) / 6.2831853;
    return distribution / (4.0 * (n_dot_l + n_dot_v - n_dot_l * n_dot_v));
}

// What `sheen_lobe` gives back of light from all around, at most 1: a fit to its sum over all directions, off by 0.03 at most. Less
// roughness than 0.2 it does not know.
fn sheen_albedo(n_dot_v: f32, roughness: f32) -> f32 {
    let level = -0.335 - 0.324 * roughness + 0.206 / roughness;
    let slope = 0.455 * roughness - 1.343 / roughness;
    return min(exp(level + slope * n_dot_v - 0.579 * roughness * sqrt(n_dot_v)), 1.0);
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

// What ambient occlusion leaves where light goes from surface to surface before it arrives: more than `visible` for bright ones (Jimenez et
// al. 2016, section 5).
fn multi_bounce(visible: f32, albedo: vec3<f32>) -> vec3<f32> {
    let a = 2.0404 * albedo - 0.3324;
    let b = -4.7951 * albedo + 0.6417;
    let c = 2.7552 * albedo + 0.6903;
    return max(vec3<f32>(visible), ((visible * a + b) * visible + c) * visible);
}

// Roughness of a surface whose normals differ within a pixel by as much as adds `widening` to the square of alpha (Kaplanyan et al. 2016).
fn widened(roughness: f32, widening: f32) -> f32 {
    let alpha = roughness * roughness;
    return sqrt(sqrt(clamp(alpha * alpha + widening, 0.0, 1.0)));
}
