//! Maps in GPU memory, each picture once, for as long as materials use it.

use std::collections::HashMap;
use std::sync::{Arc, Weak};

use super::map::{self, one_texel};
use super::materials::MaterialImages;
use crate::image::{Image, MapKind};

/// A picture by its address, and how it is read.
type Key = (usize, MapKind);

/// What was uploaded.
pub(super) struct MapTextures {
    /// One white texel: changes no colour, and no normal, as none is read from it.
    white: wgpu::TextureView,
    held: HashMap<Key, Held>,
}

struct Held {
    /// While this lives, no other picture has the address.
    _picture: Weak<Image>,
    view: wgpu::TextureView,
}

impl MapTextures {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        Self {
            white: one_texel(device, queue, "no map", [255; 4]),
            held: HashMap::new(),
        }
    }

    /// Uploads those of the pictures that are not there, and gives the memory of all others back first. How many went up.
    pub(super) fn take_up(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, maps: &[MaterialImages<'_>]) -> usize {
        let of_slots = maps
            .iter()
            .flat_map(|maps| [(maps.diffuse, MapKind::Diffuse), (maps.normal, MapKind::Normal)]);
        let wanted: HashMap<Key, &Arc<Image>> = of_slots
            .filter_map(|(image, kind)| image.map(|image| (key(image, kind), image)))
            .collect();
        self.held.retain(|key, _| wanted.contains_key(key));
        let mut uploaded = 0;
        for (key, image) in wanted {
            self.held.entry(key).or_insert_with(|| {
                uploaded += 1;
                Held {
                    _picture: Arc::downgrade(image),
                    view: map::upload(device, queue, image, key.1),
                }
            });
        }
        uploaded
    }

    /// What a material is bound to for a picture that was taken up, or for none.
    pub(super) fn view(&self, image: Option<&Arc<Image>>, kind: MapKind) -> &wgpu::TextureView {
        let held = image.and_then(|image| self.held.get(&key(image, kind)));
        held.map_or(&self.white, |held| &held.view)
    }

    /// Gives all memory back.
    pub(super) fn clear(&mut self) {
        self.held.clear();
    }
}

fn key(image: &Arc<Image>, kind: MapKind) -> Key {
    (Arc::as_ptr(image).addr(), kind)
}
