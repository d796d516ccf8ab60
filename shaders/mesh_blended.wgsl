// How a pixel of a material is stored that alpha blends with what is behind it. What is opaque of it is drawn among the opaque
// materials, with depth, so that hair and leaves hide what is behind them whatever the order of the triangles. The rest is drawn
// after them, farther submeshes first and backs before fronts, without depth: of two panes in one submesh both show, in whatever order
// they come.

// From here on a pixel is opaque. Bytes of 255 that are filtered come to this.
const OPAQUE_ALPHA: f32 = 0.998;

@fragment
fn fragment_opaque_part(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let point = surface_point(mesh, clockwise);
    let color = stored(surface_color(point), point.pixel);
    if point.substance.diffuse_texel.a < OPAQUE_ALPHA {
        discard;
    }
    return vec4<f32>(color, 1.0);
}

@fragment
fn fragment_blended(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let point = surface_point(mesh, clockwise);
    let blended = blended_color(point);
    let color = stored(blended.rgb, point.pixel);
    if point.substance.diffuse_texel.a >= OPAQUE_ALPHA {
        discard;
    }
    return vec4<f32>(color * blended.a, blended.a);
}

// In one of many pictures: a whole pixel or nothing, with its alpha as the chance, and with depth. Fronts and backs differ in the noise, as
// submeshes do, or the one would hide the other wherever both are there.
@fragment
fn fragment_stochastic(mesh: MeshVertex, @builtin(front_facing) clockwise: bool) -> @location(0) vec4<f32> {
    let point = surface_point(mesh, clockwise);
    let blended = blended_color(point);
    let color = stored(blended.rgb, point.pixel);
    let turn = fract(camera.sample * fract(material.threshold_step + select(0.0, 0.41421356, clockwise)));
    if blended.a < OPAQUE_ALPHA * turned_noise(point.pixel, turn) {
        discard;
    }
    return vec4<f32>(color, 1.0);
}
