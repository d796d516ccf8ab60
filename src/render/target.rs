//! What is drawn into: textures, the passes that fill them, and the target of a whole frame.

/// Samples of each pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SampleCount {
    /// No antialiasing, for devices that cannot do better.
    One,
    /// What WebGPU and WebGL2 promise.
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

/// The view of a texture with one level and one sample a texel.
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

/// What a render pass draws into. All of it is cleared first.
#[derive(Clone, Copy, Default)]
pub(super) struct PassTargets<'a> {
    /// Colours, and what they are cleared to.
    pub(super) color: Option<(&'a wgpu::TextureView, wgpu::Color)>,
    /// The samples of `color` are resolved into this and then dropped: tilers never write them to memory.
    pub(super) resolved: Option<&'a wgpu::TextureView>,
    /// Depth, cleared to the farthest.
    pub(super) depth: Option<&'a wgpu::TextureView>,
    /// Whether a later pass reads the depth.
    pub(super) depth_is_kept: bool,
    /// Left, top, width and height of the pixels that are drawn; without it, all.
    pub(super) scissor: Option<[u32; 4]>,
}

/// Opens a render pass: every pass of the renderer begins here.
pub(super) fn begin_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    targets: PassTargets<'_>,
) -> wgpu::RenderPass<'a> {
    let store = |is_kept| {
        if is_kept {
            wgpu::StoreOp::Store
        } else {
            wgpu::StoreOp::Discard
        }
    };
    let color = targets.color.map(|(view, clear)| wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: targets.resolved,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(clear),
            store: store(targets.resolved.is_none()),
        },
    });
    let depth = targets.depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(1.0),
            store: store(targets.depth_is_kept),
        }),
        stencil_ops: None,
    });
    let colors = [color];
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: if targets.color.is_some() { &colors } else { &[] },
        depth_stencil_attachment: depth,
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    if let Some([left, top, width, height]) = targets.scissor {
        pass.set_scissor_rect(left, top, width, height);
    }
    pass
}

/// An offscreen picture of a given size: multisampled colour and depth, and the resolved picture.
pub struct Target {
    samples: SampleCount,
    resolved: wgpu::Texture,
    resolved_view: wgpu::TextureView,
    /// None with one sample: then `resolved` is drawn into.
    multisampled_view: Option<wgpu::TextureView>,
    depth_view: wgpu::TextureView,
}

impl Target {
    /// With four samples a pixel. Sizes are in pixels, clamped to 1…the device's limit.
    pub fn new(device: &wgpu::Device, width: u32, height: u32) -> Self {
        Self::with_samples(device, width, height, SampleCount::default())
    }

    /// With as many samples as the [`Renderer`](super::Renderer) that draws into it.
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

    /// Changes the size and loses the picture. Does nothing when it has that size.
    pub fn resize(&mut self, device: &wgpu::Device, width: u32, height: u32) {
        let limit = device.limits().max_texture_dimension_2d;
        if self.size() != [width.clamp(1, limit), height.clamp(1, limit)] {
            *self = Self::with_samples(device, width, height, self.samples);
        }
    }

    /// The picture: one sample a pixel, sRGB, premultiplied alpha. A resize replaces the texture.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.resolved
    }

    /// View of [`Target::texture`] for compositing.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.resolved_view
    }

    /// Fills the picture with a colour, through the same pass that a frame is drawn with.
    pub(super) fn fill(&self, device: &wgpu::Device, queue: &wgpu::Queue, color: wgpu::Color) {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("fill") });
        drop(self.begin_pass(&mut encoder, color));
        queue.submit([encoder.finish()]);
    }

    /// A pass over a picture of this colour.
    pub(super) fn begin_pass<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        color: wgpu::Color,
    ) -> wgpu::RenderPass<'a> {
        let (view, resolved) = match &self.multisampled_view {
            Some(samples) => (samples, Some(&self.resolved_view)),
            None => (&self.resolved_view, None),
        };
        let targets = PassTargets {
            color: Some((view, color)),
            resolved,
            depth: Some(&self.depth_view),
            ..PassTargets::default()
        };
        begin_pass(encoder, "picture", targets)
    }
}
