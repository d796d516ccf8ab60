//! Brings a finished picture onto a surface.

use super::buffers::uniform_buffer;
use super::target::{COLOR_FORMAT, Target, flat_texture};
use crate::shaders;

/// Draws a target's picture into someone else's render pass, encoded as egui's surface wants it, over black.
/// [`Compositor::prepare`] comes before the pass, [`Compositor::paint`] inside it.
pub struct Compositor {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    /// The part of the texture that the picture fills, and where its last texels are.
    filled: wgpu::Buffer,
    /// Lies over the picture where nothing else does.
    nothing: wgpu::TextureView,
    /// The views that the group shows, and the group.
    source: Option<([wgpu::TextureView; 2], wgpu::BindGroup)>,
}

impl Compositor {
    /// For passes with one colour attachment of `format` (not an sRGB one: the shader encodes), one sample and no depth.
    pub fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Self {
        let texture = |binding| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: true },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            count: None,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("composite"),
            entries: &[
                texture(0),
                wgpu::BindGroupLayoutEntry {
                    binding: 1,
                    visibility: wgpu::ShaderStages::FRAGMENT,
                    ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
                    count: None,
                },
                wgpu::BindGroupLayoutEntry {
                    binding: 2,
                    visibility: wgpu::ShaderStages::FRAGMENT,
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Uniform,
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                    count: None,
                },
                texture(3),
            ],
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(shaders::COMPOSITE.name),
            source: wgpu::ShaderSource::Wgsl(shaders::COMPOSITE.source().into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("composite"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("composite"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format,
                    blend: None,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        });
        // While a window is resized, the old picture is stretched, and so is one that is drawn with fewer pixels. Otherwise each pixel
        // is one texel.
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("composite"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        Self {
            pipeline,
            layout,
            sampler,
            filled: uniform_buffer::<shaders::Filled>(device, "filled"),
            // Textures begin transparent.
            nothing: flat_texture(
                device,
                "nothing",
                [1; 2],
                COLOR_FORMAT,
                wgpu::TextureUsages::TEXTURE_BINDING,
            ),
            source: None,
        }
    }

    /// Sets the picture to show. Makes a bind group only when the target has another texture than before.
    pub fn prepare(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, target: &Target) {
        let (texture, [width, height]) = (target.texture(), target.filled());
        let half_texel = [texture.width(), texture.height()].map(|side| 0.5 / side as f32);
        let filled = shaders::Filled {
            part: [width, height],
            last: [width - half_texel[0], height - half_texel[1]],
        };
        queue.write_buffer(&self.filled, 0, bytemuck::bytes_of(&filled));
        let views = [target.view(), target.over().unwrap_or(&self.nothing)];
        if self.source.as_ref().is_some_and(|(shown, _)| shown.each_ref() == views) {
            return;
        }
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("composite"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(views[0]),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::Sampler(&self.sampler),
                },
                wgpu::BindGroupEntry {
                    binding: 2,
                    resource: self.filled.as_entire_binding(),
                },
                wgpu::BindGroupEntry {
                    binding: 3,
                    resource: wgpu::BindingResource::TextureView(views[1]),
                },
            ],
        });
        self.source = Some((views.map(Clone::clone), group));
    }

    /// Fills the pass's viewport with the picture; the caller has set it (egui sets it to the callback's rectangle).
    /// Draws nothing before the first [`Compositor::prepare`].
    pub fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some((_, group)) = &self.source {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}
