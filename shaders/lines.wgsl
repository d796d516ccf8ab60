// Lines over the model and beside it: edges of triangles, vertex normals and tangents, boxes and axes. Each is a strip of two triangles on
// the screen, an instance with four corners, and smoothed by its own coverage, so that it needs no more than one sample a pixel.

struct Line {
    // sRGB, straight alpha.
    color_srgb: vec4<f32>,
    // World units.
    @size(16) length: f32,
}

// Of each vertex of the mesh three texels, as of each joint in `bones`: its position, joints, and weights. For edges alone.
@group(2) @binding(0) var vertices: texture_2d<f32>;
@group(3) @binding(0) var<uniform> line: Line;

struct LineVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) color_srgb: vec4<f32>,
    // Distance from the line's middle, pixels, times w: divided by it, it is linear on the screen.
    @location(1) across: f32,
}

// A point of the screen, but never less than a pixel.
fn half_width_pixels() -> f32 {
    return 0.5 * max(camera.viewport_pixels.y / camera.points_high, 1.0);
}

// From a line's middle to where nothing of it is left.
fn reach_pixels() -> f32 {
    return half_width_pixels() + 0.5;
}

// Moves a point nearer by a small fraction of the distance and by what a line reaches, so that lines on a surface, sloped ones too, are not
// hidden by it.
fn line_clip(world_position: vec3<f32>) -> vec4<f32> {
    let reach = reach_pixels() * 2.0 / camera.viewport_pixels.y;
    var nearer = world_position;
    if camera.is_perspective > 0.5 {
        nearer += (camera.eye - world_position) * (1e-3 + reach * length(camera.forward_per_y));
    } else {
        nearer -= camera.forward * ((camera.depth_far - camera.depth_near) * 1e-3 + reach * length(camera.eye_per_y));
    }
    return camera.clip_from_world * vec4<f32>(nearer, 1.0);
}

// A corner of the strip along a line: the first two lie at its beginning.
fn line_corner(corner: u32, from_world: vec3<f32>, to_world: vec3<f32>, color_srgb: vec4<f32>) -> LineVertex {
    var start = line_clip(from_world);
    var end = line_clip(to_world);
    // What is behind the nearest plane has no place on the screen.
    if start.z < 0.0 && end.z > 0.0 {
        start = mix(start, end, start.z / (start.z - end.z));
    } else if end.z < 0.0 && start.z > 0.0 {
        end = mix(end, start, end.z / (end.z - start.z));
    }
    let pixels = camera.viewport_pixels * 0.5;
    let way = (end.xy / end.w - start.xy / start.w) * pixels;
    let along = way * inverseSqrt(max(dot(way, way), 1e-12));
    let across = select(-reach_pixels(), reach_pixels(), corner % 2u == 1u);
    let place = select(start, end, corner >= 2u);
    let beside = vec2<f32>(-along.y, along.x) * across / pixels * place.w;
    return LineVertex(place + vec4<f32>(beside, 0.0, 0.0), color_srgb, across * place.w);
}

fn vertex_texel(vertex: u32, part: u32) -> vec4<f32> {
    let per_row = textureDimensions(vertices).x / 3u;
    let texel = vec2<u32>((vertex % per_row) * 3u + part, vertex / per_row);
    return textureLoad(vertices, vec2<i32>(texel), 0);
}

fn static_in_world(instance: Instance, vertex: u32) -> vec3<f32> {
    return position_in_world(instance, vertex_texel(vertex, 0u).xyz);
}

fn skinned_in_world(instance: Instance, vertex: u32) -> vec3<f32> {
    let joints = vec4<u32>(vertex_texel(vertex, 1u));
    return posed_position_in_world(instance, vertex_texel(vertex, 0u).xyz, joints, vertex_texel(vertex, 2u));
}

@vertex
fn edge_static(instance: Instance, @builtin(vertex_index) corner: u32, @location(0) ends: vec2<u32>) -> LineVertex {
    return line_corner(corner, static_in_world(instance, ends.x), static_in_world(instance, ends.y), line.color_srgb);
}

@vertex
fn edge_skinned(instance: Instance, @builtin(vertex_index) corner: u32, @location(0) ends: vec2<u32>) -> LineVertex {
    return line_corner(corner, skinned_in_world(instance, ends.x), skinned_in_world(instance, ends.y), line.color_srgb);
}

// A line at each vertex of the mesh, from there along a vector.
fn vertex_line(corner: u32, start: vec3<f32>, along: vec3<f32>) -> LineVertex {
    return line_corner(corner, start, start + along * line.length, line.color_srgb);
}

@vertex
fn normal_static(
    instance: Instance,
    @builtin(vertex_index) corner: u32,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
) -> LineVertex {
    let world = in_world(instance, Skinned(position, normal, vec4<f32>(0.0)));
    return vertex_line(corner, world.position, world.normal);
}

@vertex
fn normal_skinned(
    instance: Instance,
    @builtin(vertex_index) corner: u32,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> LineVertex {
    let world = posed_in_world(instance, Skinned(position, normal, vec4<f32>(0.0)), joints, weights);
    return vertex_line(corner, world.position, world.normal);
}

@vertex
fn tangent_static(
    instance: Instance,
    @builtin(vertex_index) corner: u32,
    @location(0) position: vec3<f32>,
    @location(2) tangent: vec4<f32>,
) -> LineVertex {
    let world = in_world(instance, Skinned(position, vec3<f32>(0.0), tangent));
    return vertex_line(corner, world.position, world.tangent.xyz);
}

@vertex
fn tangent_skinned(
    instance: Instance,
    @builtin(vertex_index) corner: u32,
    @location(0) position: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
) -> LineVertex {
    let world = posed_in_world(instance, Skinned(position, vec3<f32>(0.0), tangent), joints, weights);
    return vertex_line(corner, world.position, world.tangent.xyz);
}

@vertex
fn world_line(
    @builtin(vertex_index) corner: u32,
    @location(0) start: vec3<f32>,
    @location(1) color_srgb: vec4<f32>,
    @location(2) end: vec3<f32>,
) -> LineVertex {
    return line_corner(corner, start, end, color_srgb);
}

// A corner of a triangle in the world. It is filled: no edge of it is smoothed here.
@vertex
fn world_vertex(@location(0) position: vec3<f32>, @location(1) color_srgb: vec4<f32>) -> LineVertex {
    return LineVertex(line_clip(position), color_srgb, 0.0);
}

@fragment
fn fragment(vertex: LineVertex) -> @location(0) vec4<f32> {
    let away = abs(vertex.across * vertex.clip.w);
    let alpha = vertex.color_srgb.a * clamp(reach_pixels() - away, 0.0, 1.0);
    return vec4<f32>(linear_from_srgb(vertex.color_srgb.rgb) * alpha, alpha);
}
