// Where the viewer stands and how the view is shown. Twin: `shaders::Camera`.

struct Camera {
    clip_from_world: mat4x4<f32>,
    // A pixel at ndc (x, y) sees along forward + x * forward_per_x + y * forward_per_y, from
    // eye + x * eye_per_x + y * eye_per_y. The first two factors are zero in parallel projection, the last two in perspective.
    eye: vec3<f32>,
    is_perspective: f32,
    forward: vec3<f32>,
    // Distances of the nearest and farthest point of the scene along the view.
    depth_near: f32,
    eye_per_x: vec3<f32>,
    depth_far: f32,
    eye_per_y: vec3<f32>,
    // Exposure of the studio light in stops: each doubles it.
    exposure_stops: f32,
    forward_per_x: vec3<f32>,
    // `scene::ViewMode` by its place in the menu.
    view_mode: u32,
    forward_per_y: vec3<f32>,
    // The first row that is drawn: a picture may be drawn in bands.
    first_row: f32,
    viewport_pixels: vec2<f32>,
    // How far the picture is moved, ndc: within its pixels, and back by what the lens moves it. Other than 0 where many are drawn for a mean.
    jitter: vec2<f32>,
    // Size of the maps of normals, depth and ambient occlusion in view, texels. Their textures may be larger.
    map_size: vec2<f32>,
    // Which of many pictures it is that a mean is made of, from 0.
    sample: f32,
    // Height of the picture in points of the screen.
    points_high: f32,
    // The first row of the maps in view that is drawn.
    @size(16) first_map_row: f32,
}

@group(0) @binding(0) var<uniform> camera: Camera;

// A pixel of a band in the whole picture, which is what all that goes with pixels goes with.
fn in_picture(pixel: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(pixel.x, pixel.y + camera.first_row);
}

// Unit vector from a point of the world towards the viewer.
fn towards_eye(world_position: vec3<f32>) -> vec3<f32> {
    if camera.is_perspective > 0.5 {
        return normalize(camera.eye - world_position);
    }
    return -camera.forward;
}
