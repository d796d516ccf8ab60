//! Small pictures of the open model's maps.

use std::collections::HashMap;

use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

use crate::image::{Channels, Image};
use crate::session::{Session, UsedMap};

/// Longest side of the level that is shown, in texels.
const MOST_TEXELS: u32 = 64;

/// Thumbnails by path of the map, made when they are first seen.
#[derive(Default)]
pub(super) struct Thumbnails {
    maps_revision: u64,
    textures: HashMap<String, Option<TextureHandle>>,
}

impl std::fmt::Debug for Thumbnails {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Thumbnails({})", self.textures.len())
    }
}

impl Thumbnails {
    /// The thumbnail of a map; none when it has no level small enough.
    pub(super) fn of(&mut self, ctx: &Context, session: &Session, map: &UsedMap<'_>) -> Option<TextureId> {
        if self.maps_revision != session.maps_revision() {
            self.maps_revision = session.maps_revision();
            self.textures.clear();
        }
        let path = &map.file.path;
        if !self.textures.contains_key(path) {
            let texture = small_level(map.image)
                .map(|level| ctx.load_texture(format!("thumbnail {path}"), level, TextureOptions::LINEAR));
            self.textures.insert(path.clone(), texture);
        }
        self.textures.get(path)?.as_ref().map(TextureHandle::id)
    }
}

/// The largest level that is no larger than a thumbnail needs, without its alpha: a cut-out would hide half of it.
fn small_level(image: &Image) -> Option<ColorImage> {
    let small = |&level: &u32| {
        let (width, height) = image.level_size(level);
        width.max(height) <= MOST_TEXELS
    };
    let level = (0..image.level_count()).find(small)?;
    let (width, height) = image.level_size(level);
    let mut texels = image.to_rgba8(0, level)?;
    for texel in texels.as_chunks_mut::<4>().0 {
        texel[3] = 255;
        if image.channels() == Channels::RedGreen {
            texel[2] = rebuilt_z(texel[0], texel[1]);
        }
    }
    Some(ColorImage::from_rgba_unmultiplied(
        [width as usize, height as usize],
        &texels,
    ))
}

/// The third part of a direction of which a map holds two: such maps look as people know them.
fn rebuilt_z(x: u8, y: u8) -> u8 {
    let [x, y] = [x, y].map(|encoded| f32::from(encoded) / 127.5 - 1.0);
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    ((z + 1.0) * 127.5).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_straight_out_of_the_map_is_blue() {
        assert_eq!(rebuilt_z(128, 128), 255);
        assert_eq!(rebuilt_z(255, 128), 128);
        assert_eq!(rebuilt_z(255, 255), 128, "longer than 1");
    }

    #[test]
    fn the_largest_level_that_is_small_enough_is_shown() {
        let image = Image::from_rgba8(200, 2, [9, 8, 7, 0].repeat(400), "PNG").expect("a picture");
        assert!(small_level(&image).is_none(), "200 texels and no other level");
        let image = Image::from_rgba8(64, 2, [9, 8, 7, 0].repeat(128), "PNG").expect("a picture");
        let level = small_level(&image).expect("64 texels");
        assert_eq!(
            (level.size, level.pixels[5]),
            ([64, 2], egui::Color32::from_rgb(9, 8, 7))
        );
    }
}
