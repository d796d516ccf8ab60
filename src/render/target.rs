//! Where a frame is drawn: multisampled colour and depth, and the resolved picture.

/// Samples a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SampleCount {
    /// Without antialiasing, where a device cannot do better.
    One,
    /// As WebGPU and WebGL2 promise.
    #[default]
    Four,
}

impl SampleCount {
    pub(super) fn count(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Four => 4,
        }
    }
}

/// Linear light goes in, the hardware encodes as sRGB. Alpha is premultiplied.
pub(super) const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
pub(super) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Normals and depth in view; see `geometry.wgsl`.
pub(super) const GEOMETRY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// One number from 0 to 1 a pixel.
pub(super) const FRACTION_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

/// A texture with one level and one sample a texel, as its view.
pub(super) fn flat_texture(
    device: &wgpu::Device,
    label: &str,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// A pass that fills a texture with a colour and draws over it.
pub(super) fn begin_color_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    view: &wgpu::TextureView,
    clear: wgpu::Color,
    depth: Option<&wgpu::TextureView>,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(clear),
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(1.0),
                store: wgpu::StoreOp::Discard,
            }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

/// An offscreen picture of a given size.
pub struct Target {
    samples: SampleCount,
    resolved: wgpu::Texture,
    resolved_view: wgpu::TextureView,
    /// Not there with one sample: then the picture is drawn straight.
    multisampled_view: Option<wgpu::TextureView>,
    depth_view: wgpu::TextureView,
}

impl Target {
    /// With four samples a pixel. Sizes are in pixels, brought into 1…the device's limit.
    pub fn new(device: &wgpu::Device, width: u32, height: u32) -> Self {
        Self::with_samples(device, width, height, SampleCount::default())
    }

    /// As many samples as the [`Renderer`](super::Renderer) that draws into it.
    pub fn with_samples(device: &wgpu::Device, width: u32, height: u32, samples: SampleCount) -> Self {
        let limit = device.limits().max_texture_dimension_2d;
        let (width, height) = (width.clamp(1, limit), height.clamp(1, limit));
        let texture = |label, format, sample_count, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let resolved = texture(
            "picture",
            COLOR_FORMAT,
            1,
            attachment | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
        );
        let multisampled = (samples != SampleCount::One)
            .then(|| texture("picture, multisampled", COLOR_FORMAT, samples.count(), attachment));
        let depth = texture("depth", DEPTH_FORMAT, samples.count(), attachment);
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self {
            samples,
            resolved_view: view(&resolved),
            multisampled_view: multisampled.as_ref().map(view),
            depth_view: view(&depth),
            resolved,
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.resolved.width(), self.resolved.height()]
    }

    /// Takes another size. Nothing happens when it has that size; else the picture is lost.
    pub fn resize(&mut self, device: &wgpu::Device, width: u32, height: u32) {
        let limit = device.limits().max_texture_dimension_2d;
        if self.size() != [width.clamp(1, limit), height.clamp(1, limit)] {
            *self = Self::with_samples(device, width, height, self.samples);
        }
    }

    /// The picture: one sample a pixel, sRGB, premultiplied alpha. Another texture after a resize.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.resolved
    }

    /// View of [`Target::texture`] for compositing.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.resolved_view
    }

    /// Fills the picture with a colour, by way of all that a frame is drawn into.
    pub(super) fn fill(&self, device: &wgpu::Device, queue: &wgpu::Queue, color: wgpu::Color) {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("fill") });
        drop(self.begin_cleared_pass(&mut encoder, color));
        queue.submit([encoder.finish()]);
    }

    /// Cleared to nothing, alpha 0.
    pub(super) fn begin_pass<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        self.begin_cleared_pass(encoder, wgpu::Color::TRANSPARENT)
    }

    fn begin_cleared_pass<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        color: wgpu::Color,
    ) -> wgpu::RenderPass<'a> {
        let (view, resolve_target, store) = match &self.multisampled_view {
            // Only the resolved picture is wanted: tilers then never write the samples to memory.
            Some(samples) => (samples, Some(&self.resolved_view), wgpu::StoreOp::Discard),
            None => (&self.resolved_view, None, wgpu::StoreOp::Store),
        };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(color),
                    store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth_view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        })
    }
}
