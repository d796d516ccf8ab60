// One triangle of a known colour over the lower left half: a backend that gets this wrong is not used.

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    // (−1, −1), (1, −1), (−1, 1).
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    return vec4<f32>(corner, 0.5, 1.0);
}

// Linear; encoded as sRGB it is (188, 137, 99).
@fragment
fn fragment() -> @location(0) vec4<f32> {
    return vec4<f32>(0.5, 0.25, 0.125, 1.0);
}
