// What the books' materials are at a point of the model. `mesh_all_maps.wgsl` stands in its place for other materials.

struct MeshVertex {
    // Every program computes the same bits, so that what is drawn over the model meets its depth.
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) world_position: vec3<f32>,
    // At an edge the pixel's middle may lie beside the triangle, where normals turn away from the viewer. Maps are read at the middle all the
    // same: centroids of neighbours are unevenly far apart, and the level of a map, which goes with that, would jump where triangles meet.
    @location(1) @interpolate(perspective, centroid) world_normal: vec3<f32>,
    @location(2) @interpolate(perspective, centroid) world_tangent: vec4<f32>,
    @location(3) tex_coord: vec2<f32>,
    @location(4) @interpolate(flat) front_sign: f32,
}

fn mesh_vertex(world: Skinned, maps: MapVertex, front_sign: f32) -> MeshVertex {
    let clip = camera.clip_from_world * vec4<f32>(world.position, 1.0);
    return MeshVertex(clip, world.position, world.normal, world.tangent, maps.tex_coord, front_sign);
}

fn substance(mesh: MeshVertex) -> Substance {
    let diffuse_texel = textureSample(diffuse_map, map_sampler, mesh.tex_coord);
    let normal_texel = textureSample(normal_map, map_sampler, mesh.tex_coord);
    let base_color = material.albedo * diffuse_texel.rgb;
    let gloss = select(1.0, normal_texel.a, material.normal_channels == 4u);
    return Substance(
        diffuse_texel,
        normal_texel,
        1.0,
        base_color,
        base_color,
        material.fresnel0,
        material.fresnel0,
        1.0,
        Layers(vec3<f32>(0.0), 1.0, 0.0, 1.0, vec3<f32>(1.0), 1.0, 0u, 0u),
        1.0,
        (1.0 - material.roughness) * gloss,
        0.0,
        vec3<f32>(0.0),
        1.0,
        false,
    );
}

// The diffuse colour that the books' light takes, sRGB-encoded: they multiply colours with encoded texels.
fn book_albedo(point: Substance) -> vec3<f32> {
    return material.book_albedo * srgb_from_linear(point.diffuse_texel.rgb);
}
