// One triangle that covers the view, behind everything.

struct FullscreenVertex {
    @builtin(position) clip: vec4<f32>,
    // -1..1, y up.
    @location(0) ndc: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> FullscreenVertex {
    let ndc = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0;
    return FullscreenVertex(vec4<f32>(ndc, 1.0, 1.0), ndc);
}
