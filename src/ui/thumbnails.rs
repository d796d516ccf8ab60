//! Small pictures of the open model's maps.

use std::collections::HashMap;

use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

use crate::image::Image;
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
    texels.iter_mut().skip(3).step_by(4).for_each(|alpha| *alpha = 255);
    Some(ColorImage::from_rgba_unmultiplied(
        [width as usize, height as usize],
        &texels,
    ))
}
