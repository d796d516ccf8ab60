//! Brings a finished picture, and what lies over it, onto a surface or into another picture.

use super::accumulator::Accumulator;
use super::buffers::uniform_buffer;
use super::fullscreen::FullscreenPass;
use super::pipelines::{filtered_texture, uniform};
use super::target::{COLOR_FORMAT, Target, flat_texture};
use crate::shaders;

/// Draws a target's picture, or the mean of many, into someone else's render pass. [`Compositor::prepare`] comes before the pass,
/// [`Compositor::paint`] inside it.
pub struct Compositor {
    pass: FullscreenPass,
    sampler: wgpu::Sampler,
    uniform: wgpu::Buffer,
    /// Lies over the picture where nothing else does.
    nothing: wgpu::TextureView,
    /// The views that the group shows, and the group.
    source: Option<([wgpu::TextureView; 2], wgpu::BindGroup)>,
}

impl Compositor {
    /// Over black, encoded as egui's surface wants it: for passes with one colour attachment of `format` (not an sRGB one: the shader
    /// encodes), one sample and no depth.
    pub fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Self {
        Self::with_fragment(device, format, "fragment")
    }

    /// Into the picture of a [`Target`] with one sample a pixel, as transparent as what is shown.
    pub(super) fn into_picture(device: &wgpu::Device) -> Self {
        Self::with_fragment(device, COLOR_FORMAT, "fragment_picture")
    }

    fn with_fragment(device: &wgpu::Device, format: wgpu::TextureFormat, fragment: &str) -> Self {
        let bindings = [
            filtered_texture(),
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
            uniform::<shaders::Composite>(),
            filtered_texture(),
        ];
        // Where a pixel of the picture is one of the surface, which is the case unless the picture is drawn coarser, what is filtered
        // is one texel.
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("composite"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let texture = wgpu::TextureUsages::TEXTURE_BINDING;
        Self {
            pass: FullscreenPass::new(device, &shaders::COMPOSITE, fragment, &bindings, format),
            sampler,
            uniform: uniform_buffer::<shaders::Composite>(device, "composite"),
            // Textures begin transparent.
            nothing: flat_texture(device, "nothing", [1; 2], COLOR_FORMAT, texture),
            source: None,
        }
    }

    /// Sets what to show: the target's picture, or a mean of many in its place. What lies over the model is the target's. Makes a bind
    /// group only when it is in other textures than before.
    pub fn prepare(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, target: &Target, mean: Option<&Accumulator>) {
        let filled = target.filled();
        let composite = shaders::Composite {
            picture: mean.map_or(filled, Accumulator::filled),
            layer: filled,
            is_root: f32::from(u8::from(mean.is_some())),
            dithers: f32::from(u8::from(mean.is_some_and(Accumulator::dithers))),
            first_row: mean.map_or(0.0, Accumulator::first_row),
            ..Default::default()
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&composite));
        let picture = mean.map_or(target.view(), Accumulator::view);
        let views = [picture, target.over().unwrap_or(&self.nothing)];
        if self.source.as_ref().is_some_and(|(shown, _)| shown.each_ref() == views) {
            return;
        }
        let resources = [
            wgpu::BindingResource::TextureView(views[0]),
            wgpu::BindingResource::Sampler(&self.sampler),
            self.uniform.as_entire_binding(),
            wgpu::BindingResource::TextureView(views[1]),
        ];
        let group = self.pass.group(device, resources);
        self.source = Some((views.map(Clone::clone), group));
    }

    /// Fills the pass's viewport with the picture; the caller has set it (egui sets it to the callback's rectangle).
    /// Draws nothing before the first [`Compositor::prepare`].
    pub fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some((_, group)) = &self.source {
            self.pass.fill(pass, group);
        }
    }
}
