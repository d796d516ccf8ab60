// How a pixel of the model is stored.
//
// The programs differ in `surface_color`: the final colour of a point, sRGB-encoded.

// Lit colours are dithered. A property is not, since people read its value off the picture.
fn stored(color_srgb: vec3<f32>, pixel: vec2<f32>) -> vec3<f32> {
    if camera.view_mode != 0u {
        return linear_from_srgb(color_srgb);
    }
    return dithered_linear_from_srgb(color_srgb, pixel, light.noise_turn);
}

@fragment
fn fragment(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let point = surface_point(mesh, clockwise);
    return vec4<f32>(stored(surface_color(point), point.pixel), 1.0);
}

// For materials that alpha cuts: a whole pixel or nothing.
@fragment
fn fragment_cut(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let point = surface_point(mesh, clockwise);
    let color = stored(surface_color(point), point.pixel);
    // The discard comes after the derivatives: some devices lose them when a neighbour is discarded.
    if point.substance.diffuse_texel.a < material.alpha_clip {
        discard;
    }
    return vec4<f32>(color, 1.0);
}

// The same cut with a smooth edge: alpha is the fraction of the pixel's samples that the surface covers.
@fragment
fn fragment_cut_smooth(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let point = surface_point(mesh, clockwise);
    let alpha_per_pixel = fwidth(point.substance.diffuse_texel.a);
    let color = stored(surface_color(point), point.pixel);
    // The line where alpha passes the limit, one pixel wide whatever the slope of the map.
    let coverage = clamp((point.substance.diffuse_texel.a - material.alpha_clip) / max(alpha_per_pixel, 1e-4) + 0.5, 0.0, 1.0);
    if coverage <= 0.0 {
        discard;
    }
    return vec4<f32>(color, coverage);
}
