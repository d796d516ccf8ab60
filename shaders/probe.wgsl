// Two triangles of known colours, each moved by a joint of its own: a backend that gets them wrong is not used.

// The second joint is the first of the second row of bones.
const JOINTS = array<u32, 2>(0u, JOINTS_PER_ROW);
// Linear; encoded as sRGB they are (188, 137, 99) and (99, 137, 188).
const COLORS = array<vec3<f32>, 2>(vec3<f32>(0.5, 0.25, 0.125), vec3<f32>(0.125, 0.25, 0.5));

struct Corner {
    @builtin(position) clip_position: vec4<f32>,
    @location(0) @interpolate(flat) color: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    var joints = JOINTS;
    var colors = COLORS;
    let triangle = index / 3u;
    // (−1, −1), (1, −1), (−1, 1).
    let of_triangle = index % 3u;
    let corner = vec2<f32>(f32(of_triangle & 1u), f32(of_triangle >> 1u)) * 2.0 - 1.0;
    let unmoved = Skinned(vec3<f32>(corner, 0.0), vec3<f32>(0.0, 0.0, -1.0), vec4<f32>(1.0, 0.0, 0.0, 1.0));
    let moved = skin(unmoved, vec4<u32>(joints[triangle]), vec4<f32>(1.0, 0.0, 0.0, 0.0));
    return Corner(vec4<f32>(moved.position, 1.0), colors[triangle]);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    return vec4<f32>(corner.color, 1.0);
}
