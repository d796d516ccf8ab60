//! The soft dark on the ground under what is near it: the model seen from straight below, blurred.

use glam::Vec2;

use super::model::{GpuModel, Posed};
use super::pipelines::Pipelines;
use super::recipe::{Draw, ModelDraw};
use super::target::{FRACTION_FORMAT, PassTargets, begin_pass, flat_texture};
use crate::scene::Aabb;

/// Texels along each edge: it is blurred anyway.
const SIZE: u32 = 256;
/// Half the width of the map in half widths of the scene: the blur needs room.
const MARGIN: f32 = 1.4;

/// What the map covers of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ContactFit {
    /// World x and z.
    pub(super) center: Vec2,
    pub(super) half_width: f32,
}

impl ContactFit {
    pub(super) fn new(world_bounds: &Aabb) -> Self {
        let (center, size) = (world_bounds.center(), world_bounds.size());
        Self {
            center: Vec2::new(center.x, center.z),
            half_width: (size.x.max(size.z).max(size.y * 0.1) * 0.5 * MARGIN).max(1e-20),
        }
    }
}

/// The map, and what it is blurred through.
pub(super) struct ContactMap {
    map: wgpu::TextureView,
    between: wgpu::TextureView,
    map_group: wgpu::BindGroup,
    between_group: wgpu::BindGroup,
}

impl ContactMap {
    pub(super) fn new(device: &wgpu::Device, pipelines: &Pipelines) -> Self {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let share = |label| flat_texture(device, label, [SIZE; 2], FRACTION_FORMAT, usage);
        let group = |view| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("contact"),
                layout: &pipelines.layouts.texels,
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(view),
                }],
            })
        };
        let (map, between) = (share("contact"), share("contact, half blurred"));
        Self {
            map_group: group(&map),
            between_group: group(&between),
            map,
            between,
        }
    }

    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.map
    }

    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame_group: &wgpu::BindGroup,
        model: &GpuModel,
        posed: Posed<'_>,
    ) {
        let over_black = |view| PassTargets {
            color: Some((view, wgpu::Color::BLACK)),
            ..PassTargets::default()
        };
        {
            let mut pass = begin_pass(encoder, "contact", over_black(&self.map));
            pass.set_bind_group(0, frame_group, &[]);
            model.draw_shape(&mut pass, posed, ModelDraw::Contact);
        }
        let rows = (Draw::ContactBlurRows, &self.map_group, &self.between);
        let columns = (Draw::ContactBlurColumns, &self.between_group, &self.map);
        // Two narrow blurs are as wide as one that reads many more texels.
        for (draw, source, target) in [rows, columns, rows, columns] {
            let mut pass = begin_pass(encoder, "contact blur", over_black(target));
            pass.set_pipeline(&posed.pipelines.get(draw));
            pass.set_bind_group(0, source, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}
