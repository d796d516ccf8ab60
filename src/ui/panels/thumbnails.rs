//! Small pictures of the open model's maps.

use std::collections::HashMap;
use std::sync::{Arc, Weak};

use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

use crate::image::{Channels, Image};
use crate::session::{Session, UsedMap};

/// Longest side of the level that is shown, in texels.
const MOST_TEXELS: u32 = 64;

/// Thumbnails by path of the map. Each is made when it is first seen, and kept while its image is in use.
#[derive(Default)]
pub(in crate::ui) struct Thumbnails {
    maps_revision: u64,
    textures: HashMap<String, Thumbnail>,
}

struct Thumbnail {
    of: Weak<Image>,
    texture: Option<TextureHandle>,
}

impl std::fmt::Debug for Thumbnails {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Thumbnails({})", self.textures.len())
    }
}

impl Thumbnails {
    /// The thumbnail of a map. None if its texels cannot be read.
    pub(in crate::ui) fn of(&mut self, ctx: &Context, session: &Session, map: &UsedMap<'_>) -> Option<TextureId> {
        if self.maps_revision != session.maps_revision() {
            self.maps_revision = session.maps_revision();
            self.textures.retain(|_, thumbnail| thumbnail.of.strong_count() > 0);
        }
        let path = &map.file.path;
        let known = self.textures.get(path);
        if known.is_none_or(|known| known.of.as_ptr() != Arc::as_ptr(map.image)) {
            let texture = small_picture(map.image)
                .map(|level| ctx.load_texture(format!("thumbnail {path}"), level, TextureOptions::LINEAR));
            let of = Arc::downgrade(map.image);
            self.textures.insert(path.clone(), Thumbnail { of, texture });
        }
        self.textures.get(path)?.texture.as_ref().map(TextureHandle::id)
    }
}

/// The image, no larger than a thumbnail needs, without its alpha, which could hide half of it.
pub fn small_picture(image: &Image) -> Option<ColorImage> {
    let small = |&level: &u32| {
        let (width, height) = image.level_size(level);
        width.max(height) <= MOST_TEXELS
    };
    let last = image.file_level_count().checked_sub(1)?;
    let level = (0..last).find(small).unwrap_or(last);
    let (width, height) = image.level_size(level);
    let texels = image.to_rgba8(0, level)?;
    let (size, mut texels) = shrunk([width as usize, height as usize], &texels);
    for texel in texels.as_chunks_mut::<4>().0 {
        texel[3] = 255;
        if image.channels() == Channels::RedGreen {
            texel[2] = rebuilt_z(texel[0], texel[1]);
        }
    }
    Some(ColorImage::from_rgba_unmultiplied(size, &texels))
}

/// Averages squares of texels so that no side is longer than a thumbnail's. Averages encoded values, which is quick and good enough.
fn shrunk([width, height]: [usize; 2], texels: &[u8]) -> ([usize; 2], Vec<u8>) {
    let square = width.max(height).div_ceil(MOST_TEXELS as usize).max(1);
    let size = [width.div_ceil(square), height.div_ceil(square)];
    let mut small = Vec::with_capacity(size[0] * size[1] * 4);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let mut sum = [0_u32; 4];
            let mut count = 0;
            for row in y * square..((y + 1) * square).min(height) {
                for column in x * square..((x + 1) * square).min(width) {
                    let at = (row * width + column) * 4;
                    for (sum, channel) in sum.iter_mut().zip(&texels[at..at + 4]) {
                        *sum += u32::from(*channel);
                    }
                    count += 1;
                }
            }
            small.extend(sum.map(|sum| (sum / count.max(1)) as u8));
        }
    }
    (size, small)
}

/// The z of a direction whose x and y are in the map, so that the thumbnail has the usual blue.
pub fn rebuilt_z(x: u8, y: u8) -> u8 {
    let [x, y] = [x, y].map(|encoded| f32::from(encoded) / 127.5 - 1.0);
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    ((z + 1.0) * 127.5).round() as u8
}
