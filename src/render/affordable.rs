//! How large a picture may be, by what its textures take.

use super::target::{COLOR_FORMAT, DEPTH_FORMAT, GEOMETRY_FORMAT, MEAN_FORMAT, SampleCount, Target, pixels};

/// The most that the textures of a picture in a window may take. 4K with four samples a pixel would take 285 MiB.
const MOST_BYTES: u64 = 192 << 20;
/// The most that those of the mean of one at rest may take: 5120 × 2880 fit.
const MOST_BYTES_AT_REST: u64 = 576 << 20;
/// Textures of a mean, one texel a pixel each: colour, depth, two means, normals with depth, ambient occlusion.
const OF_MEAN: [wgpu::TextureFormat; 6] = [
    COLOR_FORMAT,
    DEPTH_FORMAT,
    MEAN_FORMAT,
    MEAN_FORMAT,
    GEOMETRY_FORMAT,
    GEOMETRY_FORMAT,
];
/// Those of what lies over it: colour and depth.
const OF_LAYER: [wgpu::TextureFormat; 2] = [COLOR_FORMAT, DEPTH_FORMAT];

fn texel_bytes(formats: &[wgpu::TextureFormat]) -> u64 {
    let of = |format: &wgpu::TextureFormat| u64::from(format.block_copy_size(None).unwrap_or_default());
    formats.iter().map(of).sum()
}

/// What a picture that is drawn at once takes for each of its pixels: colour and depth of each sample, and the colour that several become.
pub(super) fn bytes_of_drawn(samples: SampleCount) -> u64 {
    let resolved = match samples {
        SampleCount::One => 0,
        SampleCount::Four => texel_bytes(&[COLOR_FORMAT]),
    };
    u64::from(samples.count()) * texel_bytes(&[COLOR_FORMAT, DEPTH_FORMAT]) + resolved
}

/// What the mean of a picture takes for each of its pixels.
pub(super) fn bytes_of_mean() -> u64 {
    texel_bytes(&OF_MEAN)
}

/// The same with the layer over it, as in a window.
pub fn bytes_at_rest() -> u64 {
    bytes_of_mean() + texel_bytes(&OF_LAYER)
}

impl Target {
    /// By how much the sides of a picture in a window have to be smaller so that its textures do not take too much memory: at most 1.
    pub fn affordable_scale(size: [u32; 2], samples: SampleCount) -> f32 {
        let bytes = pixels(size) * bytes_of_drawn(samples);
        (MOST_BYTES as f32 / bytes.max(1) as f32).sqrt().min(1.0)
    }

    /// The same of the mean of a picture at rest.
    pub fn affordable_mean_scale(size: [u32; 2]) -> f32 {
        let bytes = pixels(size) * bytes_at_rest();
        (MOST_BYTES_AT_REST as f32 / bytes.max(1) as f32).sqrt().min(1.0)
    }
}
