//! The maps that a picture reads, of all lights that it shows: one set for the window and for pictures by themselves, one for the samples
//! of a picture at rest, which see the model from elsewhere within the pixel and under other points of the lamp.

use super::band::{Band, half};
use super::light_maps::GeometryMap;
use super::light_passes::{Common, LightPasses};
use super::target::Target;
use crate::scene::Light;

/// Textures of ambient occlusion are kept for a window that is so many times smaller: a picture that moves may have a quarter of the
/// pixels of one at rest, which may have twice the room that it needs.
pub(super) const MOST_TIMES: u64 = 8;

#[derive(Default)]
pub(super) struct View {
    /// The lights that were shown so far.
    pub(super) lights: Vec<LightPasses>,
    /// For ambient occlusion; has room for the last picture that had it.
    pub(super) geometry: Option<GeometryMap>,
}

impl View {
    /// The textures whose size goes with the picture's.
    pub(super) fn textures(&self) -> impl Iterator<Item = &wgpu::Texture> {
        let occlusion = self.lights.iter().flat_map(LightPasses::view_textures);
        self.geometry.iter().flat_map(GeometryMap::textures).chain(occlusion)
    }

    /// Drops them where they have more than so many times the texels that a picture of this size needs.
    pub(super) fn drop_textures(&mut self, times: u64, size: [u32; 2]) {
        if self.geometry.as_ref().is_some_and(|map| map.exceeds(times, size)) {
            self.forget_geometry();
        }
    }

    fn forget_geometry(&mut self) {
        self.geometry = None;
        self.lights.iter_mut().for_each(LightPasses::forget_view);
    }

    /// Makes what a light lacks to be shown.
    pub(super) fn add_light(&mut self, common: &Common, light: Light, shadow_map_side: u32) {
        if self.lights.iter().all(|passes| passes.light() != light) {
            self.lights.push(LightPasses::new(common, light, shadow_map_side));
        }
    }

    /// Makes room for ambient occlusion of this band of the maps of a target's picture; of a sample at full size, in a depth of the target
    /// where that is as large.
    pub(super) fn make_room(&mut self, device: &wgpu::Device, target: &mut Target, band: Band, is_sample: bool) {
        let of_target = target.capacity();
        let depth = (is_sample && band == target.band()).then(|| target.depth_beside(device));
        if !self
            .geometry
            .as_ref()
            .is_some_and(|map| map.has_room(band.size(), depth))
        {
            self.forget_geometry();
            let room = if is_sample { of_target } else { half(of_target) };
            let capacity = std::array::from_fn(|axis| room[axis].max(band.size()[axis]));
            self.geometry = Some(GeometryMap::new(device, capacity, depth, is_sample));
        }
    }
}
