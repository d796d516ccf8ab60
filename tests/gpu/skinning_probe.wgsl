// Follows skinning.wgsl: each vertex becomes a texel of each of three rows: position, normal, tangent.

struct Probe {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) value: vec4<f32>,
}

@vertex
fn vertex(
    @builtin(vertex_index) index: u32,
    @builtin(instance_index) row: u32,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> Probe {
    let skinned = skin(Skinned(position, normal, tangent), joints, weights);
    var value = vec4<f32>(skinned.position, 1.0);
    if row == 1u {
        value = vec4<f32>(skinned.normal, 0.0);
    } else if row == 2u {
        value = skinned.tangent;
    }
    let x = (f32(index) + 0.5) / WIDTH * 2.0 - 1.0;
    let y = 1.0 - (f32(row) + 0.5) / 3.0 * 2.0;
    return Probe(vec4<f32>(x, y, 0.0, 1.0), value);
}

@fragment
fn fragment(probe: Probe) -> @location(0) vec4<u32> {
    return bitcast<vec4<u32>>(probe.value);
}
