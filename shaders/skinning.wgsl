// Vertex blending. Twin: `anim/skin.rs`, same steps, same names.

// Three texels a joint: the rows of model_from_bind (3x4). JOINTS_PER_ROW joints in a row of the texture.
@group(1) @binding(0) var bones: texture_2d<f32>;

const JOINTS_PER_ROW: u32 = 256u;

struct Skinned {
    position: vec3<f32>,
    normal: vec3<f32>,
    tangent: vec4<f32>,
}

// A 3x4 matrix.
struct Rows {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
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

fn transform_position(rows: Rows, position: vec3<f32>) -> vec3<f32> {
    let point = vec4<f32>(position, 1.0);
    return vec3<f32>(dot(rows.x, point), dot(rows.y, point), dot(rows.z, point));
}

// When the matrix mirrors, normals stay on their side of the surface; the bitangent follows
// the surface, so it changes to the other side of normal and tangent.
fn transform(rows: Rows, vertex: Skinned) -> Skinned {
    let determinant = dot(rows.x.xyz, cross(rows.y.xyz, rows.z.xyz));
    let side = select(1.0, -1.0, determinant < 0.0);
    // `cofactor` holds rows, so the vector stands on the left.
    let normal = vertex.normal * cofactor(rows.x.xyz, rows.y.xyz, rows.z.xyz) * side;
    let tangent = vec3<f32>(
        dot(rows.x.xyz, vertex.tangent.xyz),
        dot(rows.y.xyz, vertex.tangent.xyz),
        dot(rows.z.xyz, vertex.tangent.xyz),
    );
    return Skinned(
        transform_position(rows, vertex.position),
        normalize_or(normal, vertex.normal),
        vec4<f32>(normalize_or(tangent, vertex.tangent.xyz), vertex.tangent.w * side),
    );
}

// The matrices of up to four joints, blended by weight.
fn blended(joints: vec4<u32>, weights: vec4<f32>) -> Rows {
    var rows = Rows(vec4<f32>(0.0), vec4<f32>(0.0), vec4<f32>(0.0));
    for (var i = 0u; i < 4u; i++) {
        let weight = weights[i];
        if weight != 0.0 {
            rows.x += weight * bone_row(joints[i], 0u);
            rows.y += weight * bone_row(joints[i], 1u);
            rows.z += weight * bone_row(joints[i], 2u);
        }
    }
    return rows;
}

// Moves a vertex by up to four joints. With all weights zero it stays in bind space.
fn skin(vertex: Skinned, joints: vec4<u32>, weights: vec4<f32>) -> Skinned {
    if all(weights == vec4<f32>(0.0)) {
        return vertex;
    }
    return transform(blended(joints, weights), vertex);
}

// The position of `skin` alone.
fn skin_position(position: vec3<f32>, joints: vec4<u32>, weights: vec4<f32>) -> vec3<f32> {
    if all(weights == vec4<f32>(0.0)) {
        return position;
    }
    return transform_position(blended(joints, weights), position);
}
