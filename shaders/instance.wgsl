// One of the model's instances: where it stands, how it is posed, and its colour. Twin: `shaders::Instance`.

struct Instance {
    // Rows of world_from_model (3x4).
    @location(7) row_x: vec4<f32>,
    @location(8) row_y: vec4<f32>,
    @location(9) row_z: vec4<f32>,
    // Colour of a highlight or a ghost: sRGB, straight alpha.
    @location(10) tint_srgb: vec4<f32>,
    // Where its joints begin in the bones.
    @location(11) first_joint: u32,
    // +1 when clockwise triangles show their front in the world, -1 when counter-clockwise ones do.
    @location(12) front_sign: f32,
}

fn world_from_model(instance: Instance) -> Rows {
    return Rows(instance.row_x, instance.row_y, instance.row_z);
}

// A vertex of bind space in the world.
fn in_world(instance: Instance, vertex: Skinned) -> Skinned {
    return transform(world_from_model(instance), vertex);
}

// The same, moved by the instance's bones.
fn posed_in_world(instance: Instance, vertex: Skinned, joints: vec4<u32>, weights: vec4<f32>) -> Skinned {
    return in_world(instance, skin(vertex, joints + instance.first_joint, weights));
}

// The positions of both alone, for what needs no normals.
fn position_in_world(instance: Instance, position: vec3<f32>) -> vec3<f32> {
    return transform_position(world_from_model(instance), position);
}

fn posed_position_in_world(instance: Instance, position: vec3<f32>, joints: vec4<u32>, weights: vec4<f32>) -> vec3<f32> {
    return position_in_world(instance, skin_position(position, joints + instance.first_joint, weights));
}
