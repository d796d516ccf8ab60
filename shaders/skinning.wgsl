// Vertex blending. Twin: `anim/skin.rs`, same steps, same names.

// Three texels a joint: the rows of model_from_bind (3x4). JOINTS_PER_ROW joints in a row of the texture.
@group(1) @binding(0) var bones: texture_2d<f32>;

const JOINTS_PER_ROW: u32 = 256u;

struct Skinned {
    position: vec3<f32>,
    normal: vec3<f32>,
    tangent: vec4<f32>,
}

fn bone_row(joint: u32, row: u32) -> vec4<f32> {
    let texel = vec2<u32>((joint % JOINTS_PER_ROW) * 3u + row, joint / JOINTS_PER_ROW);
    return textureLoad(bones, vec2<i32>(texel), 0);
}

// The rows of the inverse transpose times the determinant. It is right for normals under any scale, and exists for any matrix.
fn cofactor(row_x: vec3<f32>, row_y: vec3<f32>, row_z: vec3<f32>) -> mat3x3<f32> {
    return mat3x3<f32>(cross(row_y, row_z), cross(row_z, row_x), cross(row_x, row_y));
}

// `otherwise` for a vector of length zero.
fn normalize_or(v: vec3<f32>, otherwise: vec3<f32>) -> vec3<f32> {
    let length_squared = dot(v, v);
    if length_squared > 0.0 {
        return v * inverseSqrt(length_squared);
    }
    return otherwise;
}

// Transforms by the rows of a 3x4 matrix. When the matrix mirrors, normals stay on their side of the surface; the bitangent follows
// the surface, so it changes to the other side of normal and tangent.
fn transform(row_x: vec4<f32>, row_y: vec4<f32>, row_z: vec4<f32>, vertex: Skinned) -> Skinned {
    let position = vec4<f32>(vertex.position, 1.0);
    let determinant = dot(row_x.xyz, cross(row_y.xyz, row_z.xyz));
    let side = select(1.0, -1.0, determinant < 0.0);
    // `cofactor` holds rows, so the vector stands on the left.
    let normal = vertex.normal * cofactor(row_x.xyz, row_y.xyz, row_z.xyz) * side;
    let tangent = vec3<f32>(
        dot(row_x.xyz, vertex.tangent.xyz),
        dot(row_y.xyz, vertex.tangent.xyz),
        dot(row_z.xyz, vertex.tangent.xyz),
    );
    return Skinned(
        vec3<f32>(dot(row_x, position), dot(row_y, position), dot(row_z, position)),
        normalize_or(normal, vertex.normal),
        vec4<f32>(normalize_or(tangent, vertex.tangent.xyz), vertex.tangent.w * side),
    );
}

// Moves a vertex by up to four joints. With all weights zero it stays in bind space.
fn skin(vertex: Skinned, joints: vec4<u32>, weights: vec4<f32>) -> Skinned {
    if all(weights == vec4<f32>(0.0)) {
        return vertex;
    }
    var row_x = vec4<f32>(0.0);
    var row_y = vec4<f32>(0.0);
    var row_z = vec4<f32>(0.0);
    for (var i = 0u; i < 4u; i++) {
        let weight = weights[i];
        if weight != 0.0 {
            row_x += weight * bone_row(joints[i], 0u);
            row_y += weight * bone_row(joints[i], 1u);
            row_z += weight * bone_row(joints[i], 2u);
        }
    }
    return transform(row_x, row_y, row_z, vertex);
}
