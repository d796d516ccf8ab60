// Normals and depth of what is in view, packed for the passes of ambient occlusion. The texture has eight bits a channel: every
// device can draw into that. Red and green hold the normal as an octahedron, blue and alpha the depth in 16 bits.

fn octahedral_from_direction(direction: vec3<f32>) -> vec2<f32> {
    let flat = direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    let folded = (1.0 - abs(flat.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), flat.xy >= vec2<f32>(0.0));
    return select(flat.xy, folded, flat.z < 0.0);
}

fn direction_from_octahedral(flat: vec2<f32>) -> vec3<f32> {
    let z = 1.0 - abs(flat.x) - abs(flat.y);
    let folded = (1.0 - abs(flat.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), flat >= vec2<f32>(0.0));
    return normalize(vec3<f32>(select(flat, folded, z < 0.0), z));
}

// `depth` 0..1.
fn packed_geometry(normal: vec3<f32>, depth: f32) -> vec4<f32> {
    let steps = floor(clamp(depth, 0.0, 1.0) * 65535.0 + 0.5);
    let high = floor(steps / 256.0);
    return vec4<f32>(octahedral_from_direction(normal) * 0.5 + 0.5, high / 255.0, (steps - high * 256.0) / 255.0);
}

fn normal_of(packed: vec4<f32>) -> vec3<f32> {
    return direction_from_octahedral(packed.rg * 2.0 - 1.0);
}

// 0..1; 1 where there is nothing.
fn depth_of(packed: vec4<f32>) -> f32 {
    return (floor(packed.b * 255.0 + 0.5) * 256.0 + floor(packed.a * 255.0 + 0.5)) / 65535.0;
}
