//! All that belongs to one light: what the frame is under it, its shadow, its openness, its surroundings.

use std::ops::Range;

use super::contact::ContactMap;
use super::environment::Environments;
use super::frame_uniform::{Part, frame_uniform};
use super::model::{GpuModel, Posed};
use super::occlusion::Occlusion;
use super::pipelines::Pipelines;
use super::shadow::ShadowMap;
use super::surroundings::{Samplers, Surroundings};
use crate::scene::{Light, Pass, RenderFrame};
use crate::shaders;

/// What all stages use.
pub(super) struct Common {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) pipelines: Pipelines,
    pub(super) samplers: Samplers,
    pub(super) environments: Environments,
    /// Bound where a program's layout has an empty group.
    pub(super) nothing: wgpu::BindGroup,
    /// Everything is open.
    pub(super) white: wgpu::TextureView,
    /// Nothing is near the ground.
    pub(super) black: wgpu::TextureView,
}

/// One light's part of the renderer.
pub(super) struct Stage {
    light: Light,
    frame_buffer: wgpu::Buffer,
    frame_group: wgpu::BindGroup,
    shadow: ShadowMap,
    occlusion: Option<Occlusion>,
    contact: Option<ContactMap>,
    surroundings: Surroundings,
}

impl Stage {
    pub(super) fn new(common: &Common, light: Light) -> Self {
        let device = &common.device;
        let frame_buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<shaders::Frame>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let frame_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &common.pipelines.layouts.frame,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: frame_buffer.as_entire_binding(),
            }],
        });
        Self {
            light,
            frame_buffer,
            frame_group,
            shadow: ShadowMap::new(device),
            occlusion: None,
            contact: None,
            surroundings: Surroundings::default(),
        }
    }

    pub(super) fn light(&self) -> Light {
        self.light
    }

    pub(super) fn frame_group(&self) -> &wgpu::BindGroup {
        &self.frame_group
    }

    /// Once [`Stage::draw_around`] was there.
    pub(super) fn surroundings(&self) -> Option<&wgpu::BindGroup> {
        self.surroundings.group()
    }

    /// Draws all that the picture will read: shadow, openness, contact. `size` is the picture's, `columns` are those of this light.
    pub(super) fn draw_around(
        &mut self,
        common: &Common,
        encoder: &mut wgpu::CommandEncoder,
        frame: &RenderFrame<'_>,
        (size, columns): ([u32; 2], &Range<u32>),
        model: Option<(&GpuModel, Posed<'_>)>,
    ) {
        let part = Part {
            light: self.light,
            size,
            winding: model.map_or(1.0, |(model, _)| model.winding),
        };
        let uniform = frame_uniform(frame, part);
        common
            .queue
            .write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(&uniform));

        let draws = |pass| frame.options.draws_under(pass, self.light);
        if draws(Pass::Shadow) {
            let mut pass = self.shadow.begin_pass(encoder);
            if let Some((model, posed)) = model {
                pass.set_bind_group(0, &self.frame_group, &[]);
                pass.set_bind_group(2, &common.nothing, &[]);
                model.draw_caster(&mut pass, posed);
            }
        }
        let Common { device, pipelines, .. } = common;
        let mut openness = &common.white;
        let mut contact = &common.black;
        if let Some((model, posed)) = model {
            if draws(Pass::AmbientOcclusion) {
                if self.occlusion.as_ref().is_none_or(|occlusion| occlusion.size() != size) {
                    self.occlusion = Some(Occlusion::new(device, pipelines, size));
                }
                if let Some(occlusion) = &self.occlusion {
                    occlusion.draw(
                        encoder,
                        &self.frame_group,
                        model,
                        posed,
                        (self.light, columns),
                        &common.nothing,
                    );
                    openness = occlusion.view();
                }
            }
            if draws(Pass::ContactShadow) {
                let map = self.contact.get_or_insert_with(|| ContactMap::new(device, pipelines));
                map.draw(encoder, &self.frame_group, model, posed);
                contact = map.view();
            }
        }
        let environments = &common.environments;
        let views = [
            self.shadow.view(),
            openness,
            contact,
            environments.specular(),
            environments.sky(self.light),
        ];
        self.surroundings.update(
            device,
            &pipelines.layouts,
            &common.samplers,
            environments,
            self.light,
            views,
        );
    }
}
