// What the programs of ambient occlusion share: reading the neighbourhood of a pixel from normals and depth in view.

@group(1) @binding(0) var geometry_map: texture_2d<f32>;

// A pixel of the band that is drawn in the map of the whole picture.
fn in_map(pixel: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(pixel.x, pixel.y + camera.first_map_row);
}

// The pixel of the band that is nearest to one of the whole map.
fn in_band(pixel: vec2<i32>) -> vec2<i32> {
    let above = vec2<i32>(0, i32(camera.first_map_row));
    let size = min(vec2<i32>(camera.map_size) - above, vec2<i32>(textureDimensions(geometry_map)));
    return clamp(pixel - above, vec2<i32>(0), size - 1);
}

fn geometry_at(pixel: vec2<i32>) -> vec4<f32> {
    return textureLoad(geometry_map, in_band(pixel), 0);
}

// Distance along the view, world units.
fn distance_of(packed: vec4<f32>) -> f32 {
    return mix(camera.depth_near, camera.depth_far, depth_of(packed));
}

// The point of the world at a position in the view and a distance along it.
fn world_at(ndc: vec2<f32>, along: f32) -> vec3<f32> {
    return camera.eye + ndc.x * camera.eye_per_x + ndc.y * camera.eye_per_y
        + along * (camera.forward + ndc.x * camera.forward_per_x + ndc.y * camera.forward_per_y);
}

fn ndc_of_pixel(pixel: vec2<f32>) -> vec2<f32> {
    let uv = pixel / camera.map_size;
    return uv * vec2<f32>(2.0, -2.0) + vec2<f32>(-1.0, 1.0) - camera.jitter;
}

fn pixel_of_ndc(ndc: vec2<f32>) -> vec2<f32> {
    return (ndc * vec2<f32>(0.5, -0.5) + 0.5) * camera.map_size;
}

// What is stored of a pixel: the fraction of the environment that it sees, and its depth, for who enlarges it.
fn stored_occlusion(visible: f32, packed: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(visible, packed.ba, 1.0);
}
