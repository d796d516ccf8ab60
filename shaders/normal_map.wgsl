// The normal of a surface point, bent by its normal map.

// `normal` is of unit length. `tangent` is in the same space and of any length; its w is the side of the bitangent. A tangent along
// the normal leaves the normal as it is. `scale` multiplies what bends it; `channels` are the map's, as a material has them.
fn mapped_normal(texel: vec3<f32>, scale: f32, channels: u32, normal: vec3<f32>, tangent: vec4<f32>) -> vec3<f32> {
    if channels == 0u {
        return normal;
    }
    // After interpolation it is not square to the normal.
    let along_u = tangent.xyz - normal * dot(normal, tangent.xyz);
    let length_squared = dot(along_u, along_u);
    // Also false for NaN.
    if !(length_squared > 1e-8) {
        return normal;
    }
    let t = along_u * inverseSqrt(length_squared);
    let b = cross(normal, t) * select(-1.0, 1.0, tangent.w >= 0.0);
    let mapped = texel * 2.0 - 1.0;
    var z = mapped.z;
    if channels == 2u {
        z = sqrt(max(1.0 - dot(mapped.xy, mapped.xy), 0.0));
    }
    return normalize_or((t * mapped.x + b * (mapped.y * light.normal_green_sign)) * scale + normal * z, normal);
}
