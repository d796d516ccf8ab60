//! Maps in GPU memory: each image once, as a texture that shaders sample, for as long as a material has it.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::{Arc, Weak};

use super::buffers::Queue;
use super::target::{UPLOADED_AND_READ, flat_texture};
use crate::image::{Image, ImageFormat, MapKind};
use crate::model::MapSlot;
use crate::scene::map_kind;

/// The images of one material's maps, as far as they are there, with their mips, in the order of [`MapSlot::ALL`]. The same `Arc` is
/// the same image.
pub type MaterialImages<'a> = [Option<&'a Arc<Image>>; MapSlot::ALL.len()];

/// An image by its address, and how it is read.
type Key = (usize, MapKind);

pub(super) struct MapTextures {
    /// One white texel: multiplies by 1, and changes no normal, as none is read from it.
    white: wgpu::TextureView,
    held: HashMap<Key, Held>,
}

struct Held {
    /// Keeps the image's address from being used for another image.
    _image: Weak<Image>,
    view: wgpu::TextureView,
}

impl MapTextures {
    pub(super) fn new(device: &wgpu::Device, queue: &Queue) -> Self {
        Self {
            white: one_texel(device, queue, "no map", [255; 4]),
            held: HashMap::new(),
        }
    }

    /// Frees the images that are in none of these maps, then uploads the missing ones. Returns how many it uploaded.
    pub(super) fn update(&mut self, device: &wgpu::Device, queue: &Queue, maps: &[MaterialImages<'_>]) -> usize {
        let of_slots = maps.iter().flat_map(|images| MapSlot::ALL.into_iter().zip(images));
        let wanted: HashMap<Key, &Arc<Image>> = of_slots
            .filter_map(|(slot, image)| image.map(|image| (key(image, map_kind(slot)), image)))
            .collect();
        self.held.retain(|key, _| wanted.contains_key(key));
        let mut uploaded = 0;
        for (key, image) in wanted {
            self.held.entry(key).or_insert_with(|| {
                uploaded += 1;
                Held {
                    _image: Arc::downgrade(image),
                    view: upload(device, queue, image, key.1),
                }
            });
        }
        uploaded
    }

    /// What a material binds for an image of the last [`MapTextures::update`]; one white texel without an image.
    pub(super) fn view(&self, image: Option<&Arc<Image>>, slot: MapSlot) -> &wgpu::TextureView {
        let held = image.and_then(|image| self.held.get(&key(image, map_kind(slot))));
        held.map_or(&self.white, |held| &held.view)
    }

    pub(super) fn clear(&mut self) {
        self.held.clear();
    }
}

fn key(image: &Arc<Image>, kind: MapKind) -> Key {
    (Arc::as_ptr(image).addr(), kind)
}

/// A texture of one texel, bound where there is nothing else to bind.
pub(super) fn one_texel(device: &wgpu::Device, queue: &Queue, label: &str, texel: [u8; 4]) -> wgpu::TextureView {
    texture_of(device, queue, label, [1; 2], wgpu::TextureFormat::Rgba8Unorm, &texel)
}

/// A flat texture of these texels.
pub(super) fn texture_of(
    device: &wgpu::Device,
    queue: &Queue,
    label: &str,
    size: [u32; 2],
    format: wgpu::TextureFormat,
    texels: &[u8],
) -> wgpu::TextureView {
    let view = flat_texture(device, label, size, format, UPLOADED_AND_READ);
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(texels.len() as u32 / size[1]),
        rows_per_image: None,
    };
    queue.write_texture(view.texture().as_image_copy(), texels, layout, view.texture().size());
    view
}

/// The longest side of a map where the device reads no blocks: phones. Decoded, a map takes four to eight times their memory.
const LONGEST_DECODED_SIDE: u32 = 2048;

/// Uploads a map with its levels: compressed where the device reads the blocks, else decoded, which looks the same.
/// Levels too large for the device are left out; where it reads no blocks, also those larger than [`LONGEST_DECODED_SIDE`].
fn upload(device: &wgpu::Device, queue: &Queue, image: &Image, kind: MapKind) -> wgpu::TextureView {
    let takes_blocks = device.features().contains(wgpu::Features::TEXTURE_COMPRESSION_BC);
    let of_device = device.limits().max_texture_dimension_2d;
    let limit = if takes_blocks {
        of_device
    } else {
        of_device.min(LONGEST_DECODED_SIDE)
    };
    let image = fitting(image, kind, limit);
    let first = first_fitting_level(&image, limit);
    let (width, height) = image.level_size(first);
    let whole_blocks = width % 4 == 0 && height % 4 == 0;
    let compressed = compressed_format(image.format(), kind).filter(|_| whole_blocks && takes_blocks);
    let format = compressed.unwrap_or(match kind {
        MapKind::Diffuse | MapKind::Color => wgpu::TextureFormat::Rgba8UnormSrgb,
        MapKind::Normal | MapKind::Data => wgpu::TextureFormat::Rgba8Unorm,
    });
    let size = |level| {
        let (width, height) = image.level_size(level);
        wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        }
    };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("map"),
        size: size(first),
        mip_level_count: image.level_count() - first,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: UPLOADED_AND_READ,
        view_formats: &[],
    });
    for level in first..image.level_count() {
        let bytes = if compressed.is_some() {
            image.level(0, level).map(Cow::Borrowed)
        } else {
            image.to_rgba8(0, level).map(Cow::Owned)
        };
        let (block_side, _) = format.block_dimensions();
        // The smallest levels are still one block.
        let size = size(level).physical_size(format);
        queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &texture,
                mip_level: level - first,
                origin: wgpu::Origin3d::ZERO,
                aspect: wgpu::TextureAspect::All,
            },
            &bytes.unwrap_or_default(),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: format
                    .block_copy_size(None)
                    .map(|block| size.width / block_side * block),
                rows_per_image: None,
            },
            size,
        );
    }
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// The texture format that holds these blocks as they are; none where the image must be decoded. Colours of one or two channels
/// are decoded since no such format is sRGB, signed values so that shaders see one range. Blocks may hold an alpha that the file
/// says to ignore. They are uploaded all the same: no material cuts by the alpha of an image that says it has none.
fn compressed_format(format: ImageFormat, kind: MapKind) -> Option<wgpu::TextureFormat> {
    use wgpu::TextureFormat as Gpu;
    match (format, kind) {
        (ImageFormat::Bc1, MapKind::Diffuse | MapKind::Color) => Some(Gpu::Bc1RgbaUnormSrgb),
        (ImageFormat::Bc2, MapKind::Diffuse | MapKind::Color) => Some(Gpu::Bc2RgbaUnormSrgb),
        (ImageFormat::Bc3, MapKind::Diffuse | MapKind::Color) => Some(Gpu::Bc3RgbaUnormSrgb),
        (ImageFormat::Bc7, MapKind::Diffuse | MapKind::Color) => Some(Gpu::Bc7RgbaUnormSrgb),
        (ImageFormat::Bc1, MapKind::Normal | MapKind::Data) => Some(Gpu::Bc1RgbaUnorm),
        (ImageFormat::Bc2, MapKind::Normal | MapKind::Data) => Some(Gpu::Bc2RgbaUnorm),
        (ImageFormat::Bc3, MapKind::Normal | MapKind::Data) => Some(Gpu::Bc3RgbaUnorm),
        (ImageFormat::Bc7, MapKind::Normal | MapKind::Data) => Some(Gpu::Bc7RgbaUnorm),
        (ImageFormat::Bc5, MapKind::Normal) => Some(Gpu::Bc5RgUnorm),
        _ => None,
    }
}

/// The image with at least one level that has no side above `limit`.
pub fn fitting(image: &Image, kind: MapKind, limit: u32) -> Cow<'_, Image> {
    let last = image.level_count() - 1;
    let (width, height) = image.level_size(last);
    if width.max(height) <= limit {
        return Cow::Borrowed(image);
    }
    // All levels of the file are too large: smaller ones are made from the smallest.
    let smallest = image.reduced(last, kind, limit);
    smallest.map_or(Cow::Borrowed(image), |smallest| Cow::Owned(smallest.with_mips(kind)))
}

pub fn first_fitting_level(image: &Image, limit: u32) -> u32 {
    let fits = |&level: &u32| {
        let (width, height) = image.level_size(level);
        width.max(height) <= limit
    };
    (0..image.level_count()).find(fits).unwrap_or(image.level_count() - 1)
}
