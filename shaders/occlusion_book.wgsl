// Ambient occlusion of the DirectX 12 book (chapter 21): points in a hemisphere of fixed size about each point are compared
// with the depth in view. Its lengths are those of the demo, in proportion to the model.

const OFFSET_COUNT: i32 = 14;
// The corners alone.
const FEW_OFFSETS: i32 = 8;
const OFFSET_RADIUS: f32 = 0.5;
const FADE_START: f32 = 0.2;
const FADE_END: f32 = 2.0;
const SURFACE_EPSILON: f32 = 0.05;

// Corners of a cube and centres of its faces, of lengths between 0.25 and 1.
fn offset_vector(index: i32) -> vec3<f32> {
    var length = 0.25 + 0.75 * fract(f32(index) * 0.61803399);
    if index < 8 {
        let corner = vec3<f32>(f32(index & 1), f32((index >> 1u) & 1), f32((index >> 2u) & 1)) * 2.0 - 1.0;
        return corner * 0.57735027 * length;
    }
    var axis = vec3<f32>(0.0);
    axis[(index - 8) >> 1u] = f32((index & 1) * 2 - 1);
    return axis * length;
}

// How much a point `nearer` in front of another darkens it.
fn occlusion_of(nearer: f32) -> f32 {
    let unit = light.book_unit;
    if nearer <= SURFACE_EPSILON * unit {
        return 0.0;
    }
    return clamp((FADE_END * unit - nearer) / ((FADE_END - FADE_START) * unit), 0.0, 1.0);
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
    let point = world_at(view.ndc - camera.jitter, along);
    // Each pixel mirrors the offsets about its own direction. Its two angles come from one evenly spread noise.
    let noise = turned_noise(pixel, light.noise_turn);
    let turn = noise * 6.2831853;
    let lift = 2.0 * fract(noise * 17.0) - 1.0;
    let mirror = vec3<f32>(sqrt(1.0 - lift * lift) * vec2<f32>(cos(turn), sin(turn)), lift);

    let offset_count = select(FEW_OFFSETS, OFFSET_COUNT, light.fine_occlusion == 1u);
    var sum = 0.0;
    for (var i = 0; i < offset_count; i++) {
        let offset = reflect(offset_vector(i), mirror);
        let outward = sign(dot(offset, normal));
        let probe = point + outward * OFFSET_RADIUS * light.book_unit * offset;
        let clip = camera.clip_from_world * vec4<f32>(probe, 1.0);
        let probe_ndc = clip.xy / clip.w;
        let found_along = distance_of(geometry_at(vec2<i32>(floor(pixel_of_ndc(probe_ndc)))));
        let found = world_at(probe_ndc - camera.jitter, found_along);
        let occlusion = occlusion_of(along - found_along);
        // A point that is hardly in front gives no reliable direction.
        if occlusion > 0.0 {
            sum += occlusion * max(dot(normal, normalize(found - point)), 0.0);
        }
    }
    let access = 1.0 - sum / f32(offset_count);
    return stored_occlusion(clamp(access * access, 0.0, 1.0), packed);
}
