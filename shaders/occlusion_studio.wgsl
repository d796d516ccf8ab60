// Ambient occlusion by horizons: in a few planes through the view ray the highest occluders on both sides are found, and what is
// open between them is integrated in closed form (Jimenez, Wu, Pesce and Jarabo 2016, "Practical Realtime Strategies for Accurate
// Indirect Occlusion", section 4).

const SLICES: i32 = 3;
const STEPS: i32 = 5;
const FEW_SLICES: i32 = 2;
const FEW_STEPS: i32 = 3;
const HALF_PI: f32 = 1.5707963;
// Farther pixels would cost more than they add: a part of the picture's height.
const MOST_REACH: f32 = 0.12;

// The fraction of a slice that is open between the normal and a horizon. Angles are from the view ray.
fn open_arc(horizon: f32, normal_angle: f32) -> f32 {
    return 0.25 * (cos(normal_angle) - cos(2.0 * horizon - normal_angle) + 2.0 * horizon * sin(normal_angle));
}

// Cosine of the highest occluder from the view ray, on one side of a slice.
fn horizon_cosine(pixel: vec2<f32>, step: vec2<f32>, start: f32, point: vec3<f32>, to_eye: vec3<f32>, lowest: f32) -> f32 {
    let steps = select(FEW_STEPS, STEPS, light.fine_occlusion == 1u);
    var highest = lowest;
    for (var i = 0; i < steps; i++) {
        let fraction = (f32(i) + start) / f32(steps);
        // Denser near the point, and never the point itself.
        let at = pixel + step * fraction * fraction + normalize(step);
        let packed = geometry_at(vec2<i32>(floor(at)));
        let away = world_at(ndc_of_pixel(floor(at) + 0.5), distance_of(packed)) - point;
        let distance = length(away);
        let cosine = dot(away, to_eye) / max(distance, 1e-20);
        let near = clamp(1.0 - distance * distance / (light.occlusion_radius * light.occlusion_radius), 0.0, 1.0);
        if depth_of(packed) < 1.0 {
            highest = max(highest, mix(lowest, cosine, near));
        }
    }
    return highest;
}

@fragment
fn fragment(view: FullscreenVertex) -> @location(0) vec4<f32> {
    let pixel = in_map(view.clip.xy);
    let packed = geometry_at(vec2<i32>(pixel));
    if depth_of(packed) >= 1.0 {
        return vec4<f32>(1.0);
    }
    let normal = normal_of(packed);
    let along = distance_of(packed);
    // The point moves a little towards the viewer, since depth is rounded.
    let point = world_at(view.ndc - camera.jitter, along - (camera.depth_far - camera.depth_near) * 3e-5);
    let to_eye = towards_eye(point);
    let world_per_pixel = length(camera.eye_per_y + along * camera.forward_per_y) * 2.0 / camera.map_size.y;
    let reach = min(light.occlusion_radius / world_per_pixel, MOST_REACH * camera.map_size.y);
    let right = normalize(camera.eye_per_x + camera.forward_per_x);
    let up = normalize(camera.eye_per_y + camera.forward_per_y);
    let noise = turned_noise(pixel, light.noise_turn);
    let start = 0.25 + 0.75 * fract(noise * 7.0 + 0.37);

    let slices = select(FEW_SLICES, SLICES, light.fine_occlusion == 1u);
    var open = 0.0;
    for (var i = 0; i < slices; i++) {
        let angle = (f32(i) + noise) * (3.14159265 / f32(slices));
        let heading = vec2<f32>(cos(angle), sin(angle));
        let across = right * heading.x + up * heading.y;
        let in_slice = across - to_eye * dot(across, to_eye);
        let axis = normalize(cross(in_slice, to_eye));
        let projected = normal - axis * dot(normal, axis);
        let projected_length = max(length(projected), 1e-4);
        let cosine = clamp(dot(projected, to_eye) / projected_length, -1.0, 1.0);
        let normal_angle = sign(dot(projected, in_slice)) * acos(cosine);
        // Pixel rows go down.
        let step = vec2<f32>(heading.x, -heading.y) * reach;
        let lowest_ahead = cos(min(normal_angle + HALF_PI, 3.14159265));
        let lowest_behind = cos(max(normal_angle - HALF_PI, -3.14159265));
        let ahead = acos(clamp(horizon_cosine(pixel, step, start, point, to_eye, lowest_ahead), -1.0, 1.0));
        let behind = -acos(clamp(horizon_cosine(pixel, -step, start, point, to_eye, lowest_behind), -1.0, 1.0));
        let ahead_angle = normal_angle + min(ahead - normal_angle, HALF_PI);
        let behind_angle = normal_angle + max(behind - normal_angle, -HALF_PI);
        open += projected_length * (open_arc(ahead_angle, normal_angle) + open_arc(behind_angle, normal_angle));
    }
    return stored_occlusion(clamp(open / f32(slices), 0.0, 1.0), packed);
}
