// The light of the books' demos. Nothing there is linear: texels, colours and lights are multiplied as they are encoded, and the
// sum goes to the screen as it is. Twin: `tests/common/twins/book.rs`, same steps, same names.

// Strengths of the three lights, and the ambient light (DirectX 12 book, SkinnedMesh demo).
const BOOK_STRENGTH_0: vec3<f32> = vec3<f32>(0.9, 0.9, 0.7);
const BOOK_STRENGTH_1: vec3<f32> = vec3<f32>(0.4, 0.4, 0.4);
const BOOK_STRENGTH_2: vec3<f32> = vec3<f32>(0.2, 0.2, 0.2);
const BOOK_AMBIENT: vec3<f32> = vec3<f32>(0.25, 0.25, 0.35);

struct BookSurface {
    // sRGB-encoded.
    albedo: vec3<f32>,
    fresnel0: vec3<f32>,
    // (1 - roughness) times the alpha of the normal map.
    shininess: f32,
    // Unit.
    normal: vec3<f32>,
    to_eye: vec3<f32>,
}

struct PhongSurface {
    // What the diffuse map has here, sRGB-encoded.
    texel: vec3<f32>,
    ambient: vec3<f32>,
    diffuse: vec3<f32>,
    specular: vec3<f32>,
    power: f32,
    normal: vec3<f32>,
    to_eye: vec3<f32>,
}

fn schlick_fresnel(fresnel0: vec3<f32>, cos_angle: f32) -> vec3<f32> {
    let grazing = 1.0 - clamp(cos_angle, 0.0, 1.0);
    return fresnel0 + (vec3<f32>(1.0) - fresnel0) * (grazing * grazing * grazing * grazing * grazing);
}

// One light of the DirectX 12 book.
fn blinn_phong(surface: BookSurface, to_light: vec3<f32>, strength: vec3<f32>) -> vec3<f32> {
    let lambert = max(dot(to_light, surface.normal), 0.0);
    let power = surface.shininess * 256.0;
    let sum = surface.to_eye + to_light;
    // A light straight ahead of the viewer has no halfway vector; it lights nothing that is seen.
    let halfway = sum * inverseSqrt(max(dot(sum, sum), 1e-8));
    // WGSL does not define pow(0, 0); the books' compiler gives 1.
    let cos_half = max(dot(halfway, surface.normal), 1e-6);
    let lobe = (power + 8.0) / 8.0 * pow(cos_half, power);
    let specular = schlick_fresnel(surface.fresnel0, dot(halfway, to_light)) * lobe;
    // The target stores no more than 1.
    let low = specular / (specular + vec3<f32>(1.0));
    return (surface.albedo + low) * strength * lambert;
}

// All lights of the DirectX 12 book. The first counts as far as it is not in shadow, the ambient light as far as it is not occluded.
fn book_light(surface: BookSurface, to_lights: array<vec3<f32>, 3>, key_visible: f32, occlusion: f32) -> vec3<f32> {
    return occlusion * BOOK_AMBIENT * surface.albedo
        + blinn_phong(surface, to_lights[0], BOOK_STRENGTH_0) * key_visible
        + blinn_phong(surface, to_lights[1], BOOK_STRENGTH_1)
        + blinn_phong(surface, to_lights[2], BOOK_STRENGTH_2);
}

// The fraction of the sky that the DirectX 12 book mirrors. `mirrored` is the direction of the mirrored ray.
fn book_reflectance(surface: BookSurface, mirrored: vec3<f32>) -> vec3<f32> {
    return surface.shininess * schlick_fresnel(surface.fresnel0, dot(surface.normal, mirrored));
}

// One light of the DirectX 11 book, without its ambient light.
fn phong(surface: PhongSurface, to_light: vec3<f32>, strength: vec3<f32>) -> vec3<f32> {
    let lambert = dot(to_light, surface.normal);
    if lambert <= 0.0 {
        return vec3<f32>(0.0);
    }
    let mirrored = reflect(-to_light, surface.normal);
    let lobe = pow(max(dot(mirrored, surface.to_eye), 1e-6), max(surface.power, 1e-3));
    return strength * (lambert * surface.diffuse * surface.texel + lobe * surface.specular);
}

// All lights of the DirectX 11 book.
fn phong_light(surface: PhongSurface, to_lights: array<vec3<f32>, 3>, key_visible: f32, occlusion: f32) -> vec3<f32> {
    return occlusion * BOOK_AMBIENT * surface.ambient * surface.texel
        + phong(surface, to_lights[0], BOOK_STRENGTH_0) * key_visible
        + phong(surface, to_lights[1], BOOK_STRENGTH_1)
        + phong(surface, to_lights[2], BOOK_STRENGTH_2);
}
