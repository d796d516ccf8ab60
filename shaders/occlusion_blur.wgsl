// Smooths occlusion along rows, then columns, but not across edges (DirectX 12 book, chapter 21).

@group(1) @binding(1) var rough_map: texture_2d<f32>;

const BLUR_RADIUS: i32 = 5;
const BLUR_SIGMA: f32 = 2.5;
// How far pixels of one surface lie apart at most, in units of the books' demo: in the book along the view, else from the surface's plane.
const BOOK_APART: f32 = 0.2;
const APART: f32 = 0.02;

fn smoothed(pixel: vec2<i32>, step: vec2<i32>) -> vec4<f32> {
    let packed = geometry_at(pixel);
    // Nothing is there, and nobody reads it.
    if depth_of(packed) >= 1.0 {
        return vec4<f32>(1.0);
    }
    let normal = normal_of(packed);
    let along = distance_of(packed);
    let point = world_at(ndc_of_pixel(vec2<f32>(pixel) + 0.5), along);
    var sum = textureLoad(rough_map, in_band(pixel), 0).r;
    var weights = 1.0;
    for (var i = -BLUR_RADIUS; i <= BLUR_RADIUS; i++) {
        let at = pixel + step * i;
        let beside = geometry_at(at);
        let along_beside = distance_of(beside);
        var apart = abs(along_beside - along);
        if light.is_book == 0u {
            apart = abs(dot(world_at(ndc_of_pixel(vec2<f32>(at) + 0.5), along_beside) - point, normal));
        }
        let is_same_surface = dot(normal_of(beside), normal) >= 0.8
            && apart <= select(APART, BOOK_APART, light.is_book == 1u) * light.book_unit;
        if i != 0 && is_same_surface {
            let weight = exp(-f32(i * i) / (2.0 * BLUR_SIGMA * BLUR_SIGMA));
            sum += weight * textureLoad(rough_map, in_band(at), 0).r;
            weights += weight;
        }
    }
    return stored_occlusion(sum / weights, packed);
}

@fragment
fn fragment_rows(view: FullscreenVertex) -> @location(0) vec4<f32> {
    return smoothed(vec2<i32>(in_map(view.clip.xy)), vec2<i32>(1, 0));
}

@fragment
fn fragment_columns(view: FullscreenVertex) -> @location(0) vec4<f32> {
    return smoothed(vec2<i32>(in_map(view.clip.xy)), vec2<i32>(0, 1));
}
