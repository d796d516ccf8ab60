// Follows the book's light: each pixel evaluates one case, its column across ANGLES, its row across ROUGHNESSES for each
// quantity in turn.

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let ndc = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0;
    return vec4<f32>(ndc, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let column = u32(position.x);
    let row = u32(position.y);
    let n_dot_v = (f32(column) + 0.5) / f32(ANGLES);
    let shininess = f32(row % ROUGHNESSES) / f32(ROUGHNESSES - 1u);
    let to_eye = vec3<f32>(sqrt(1.0 - n_dot_v * n_dot_v), n_dot_v, 0.0);
    let up = vec3<f32>(0.0, 1.0, 0.0);
    let to_lights = array<vec3<f32>, 3>(
        normalize(vec3<f32>(-0.5, 0.6, 0.3)),
        normalize(vec3<f32>(0.7, 0.2, -0.4)),
        normalize(vec3<f32>(0.1, -0.6, 0.3)),
    );
    let dull = BookSurface(vec3<f32>(0.6, 0.4, 0.3), vec3<f32>(0.02, 0.1, 0.6), shininess, up, to_eye);
    let old = PhongSurface(
        vec3<f32>(0.9, 0.7, 0.5), vec3<f32>(0.5), vec3<f32>(0.8, 0.6, 0.4), vec3<f32>(0.1, 0.2, 0.4), shininess * 64.0, up, to_eye);
    var value = vec3<f32>(0.0);
    switch row / ROUGHNESSES {
        case 0u: { value = schlick_fresnel(dull.fresnel0 * shininess, n_dot_v); }
        case 1u: { value = blinn_phong(dull, to_lights[0], BOOK_STRENGTH_0); }
        case 2u: { value = book_light(dull, to_lights, 0.75, 0.5); }
        case 3u: { value = book_reflectance(dull, reflect(-to_eye, up)); }
        case 4u: { value = phong(old, to_lights[0], BOOK_STRENGTH_0); }
        default: { value = phong_light(old, to_lights, 0.75, 0.5); }
    }
    return bitcast<vec4<u32>>(vec4<f32>(value, 1.0));
}
