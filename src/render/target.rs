//! What is drawn into: textures, the passes that fill them, and the target of a whole frame.

use super::band::Band;
use super::timing::FrameEncoder;
use crate::scene::TimedPass;

/// Samples of each pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SampleCount {
    /// No antialiasing, for devices that cannot do better.
    One,
    /// What WebGPU and WebGL2 promise.
    #[default]
    Four,
}

impl SampleCount {
    pub fn count(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Four => 4,
        }
    }
}

/// Linear light goes in, the hardware encodes as sRGB. Alpha is premultiplied.
pub(super) const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
pub(super) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Roots of means; see `accumulate.wgsl`.
pub(super) const MEAN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Normals and depth in view; see `geometry.wgsl`.
pub(super) const GEOMETRY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// One number from 0 to 1 a pixel.
pub(super) const CONTACT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg8Unorm;

pub(super) const UPLOADED_AND_READ: wgpu::TextureUsages =
    wgpu::TextureUsages::TEXTURE_BINDING.union(wgpu::TextureUsages::COPY_DST);

/// The view of a texture with one level and one sample a texel.
pub(super) fn flat_texture(
    device: &wgpu::Device,
    label: &str,
    size: [u32; 2],
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::TextureView {
    texture(device, label, size, format, 1, usage).create_view(&wgpu::TextureViewDescriptor::default())
}

/// A texture with one level.
fn texture(
    device: &wgpu::Device,
    label: &str,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
    sample_count: u32,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
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
}

/// What a render pass draws into. All of it is cleared first.
#[derive(Clone, Copy, Default)]
pub(super) struct PassTargets<'a> {
    /// Colours, and what they are cleared to.
    pub(super) color: Option<(&'a wgpu::TextureView, wgpu::Color)>,
    /// Whether the colours are what an earlier pass left; they are then not cleared.
    pub(super) color_is_there: bool,
    /// The samples of `color` are resolved into this and then dropped: tilers never write them to memory.
    pub(super) resolved: Option<&'a wgpu::TextureView>,
    /// Depth, cleared to the farthest.
    pub(super) depth: Option<&'a wgpu::TextureView>,
    /// Whether a later pass reads the depth.
    pub(super) depth_is_kept: bool,
    /// Whether the depth is what an earlier pass kept; it is then not cleared.
    pub(super) depth_is_there: bool,
    /// The part that is filled, from the top left; without it, all.
    pub(super) filled: Option<Band>,
    /// Left, top, width and height of the pixels that are drawn; without it, all.
    pub(super) scissor: Option<[u32; 4]>,
}

/// Opens a render pass: every pass of the renderer begins here.
pub(super) fn begin_pass<'a>(
    encoder: &'a mut FrameEncoder,
    pass: TimedPass,
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
            load: if targets.color_is_there {
                wgpu::LoadOp::Load
            } else {
                wgpu::LoadOp::Clear(clear)
            },
            store: store(targets.resolved.is_none()),
        },
    });
    let depth = targets.depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations {
            load: if targets.depth_is_there {
                wgpu::LoadOp::Load
            } else {
                wgpu::LoadOp::Clear(1.0)
            },
            store: store(targets.depth_is_kept),
        }),
        stencil_ops: None,
    });
    let colors = [color];
    let descriptor = wgpu::RenderPassDescriptor {
        label: Some(pass.name()),
        color_attachments: if targets.color.is_some() { &colors } else { &[] },
        depth_stencil_attachment: depth,
        ..Default::default()
    };
    let mut pass = encoder.begin_pass(pass, &descriptor);
    if let Some(band) = targets.filled {
        band.set_viewport(&mut pass, 1.0);
        pass.set_scissor_rect(0, 0, band.whole[0], band.rows);
    }
    if let Some([left, top, width, height]) = targets.scissor {
        pass.set_scissor_rect(left, top, width, height);
    }
    pass
}

/// Textures that may be larger than the picture have sides of a multiple of this, pixels: a window that is resized needs new ones
/// seldom.
const CAPACITY_STEP: u32 = 128;
/// An offscreen picture: multisampled colour and depth, and the resolved picture. It may fill a part of its textures, from the top left.
pub struct Target {
    samples: SampleCount,
    /// Of the picture.
    band: Band,
    picture: Attachments,
    over: Over,
}

/// How what lies over the model is drawn.
#[expect(clippy::large_enum_variant, reason = "there are two of them")]
enum Over {
    /// With the model.
    Together,
    /// Into a layer of its own, so that it can be drawn anew where the model stays.
    Apart {
        /// None until something lies over the model.
        layer: Option<Attachments>,
        /// Depth of what is seen through the model, and of all samples at rest but the first: the first one's depth is kept, so that a
        /// layer can be drawn over their mean. None until it is needed.
        spare_depth: Option<wgpu::TextureView>,
        /// Whether something lies over the model now.
        is_shown: bool,
        /// Whether the model's depth was kept for it.
        has_depth: bool,
    },
}

/// Textures of a picture, or of what lies over it: colour and depth of each sample, and what they are resolved to.
struct Attachments {
    resolved: wgpu::TextureView,
    /// None with one sample: then `resolved` is drawn into.
    multisampled: Option<wgpu::TextureView>,
    depth: wgpu::TextureView,
}

impl Attachments {
    fn new(device: &wgpu::Device, label: &str, size: [u32; 2], samples: SampleCount, depth: wgpu::TextureView) -> Self {
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let read = attachment | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let view = |samples, usage| attachment_view(device, label, size, COLOR_FORMAT, samples, usage);
        Self {
            resolved: view(SampleCount::One, read),
            multisampled: (samples != SampleCount::One).then(|| view(samples, attachment)),
            depth,
        }
    }
}

fn attachment_view(
    device: &wgpu::Device,
    label: &str,
    size: [u32; 2],
    format: wgpu::TextureFormat,
    samples: SampleCount,
    usage: wgpu::TextureUsages,
) -> wgpu::TextureView {
    let texture = texture(device, label, size, format, samples.count(), usage);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn depth_view(device: &wgpu::Device, size: [u32; 2], samples: SampleCount) -> wgpu::TextureView {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
    attachment_view(device, "depth", size, DEPTH_FORMAT, samples, usage)
}

impl Target {
    /// With so many samples a pixel; see [`device::sample_count`](super::device::sample_count). Sizes are in pixels, clamped to 1…the
    /// device's limit.
    pub fn with_samples(device: &wgpu::Device, width: u32, height: u32, samples: SampleCount) -> Self {
        let size = within_limit(device, [width, height]);
        Self {
            samples,
            band: Band::all(size),
            picture: Attachments::new(device, "picture", size, samples, depth_view(device, size, samples)),
            over: Over::Together,
        }
    }

    /// Draws what lies over the model into a layer of its own.
    #[must_use]
    pub fn with_layer(mut self) -> Self {
        self.over = Over::Apart {
            layer: None,
            spare_depth: None,
            is_shown: false,
            has_depth: false,
        };
        self
    }

    /// Whether what lies over the model is a layer of its own.
    pub(super) fn has_layer(&self) -> bool {
        matches!(self.over, Over::Apart { .. })
    }

    /// Whether what lies over the model can be drawn anew, and the model stays.
    pub fn can_draw_over(&self, [needs_depth, _]: [bool; 2]) -> bool {
        matches!(self.over, Over::Apart { has_depth, .. } if has_depth || !needs_depth)
    }

    /// Whether something lies over the model, and is not drawn yet.
    pub fn lacks_layer(&self, are_there: [bool; 2]) -> bool {
        are_there.contains(&true) && self.over().is_none()
    }

    /// What lies over the model, to be laid over the picture; none where nothing does.
    pub(super) fn over(&self) -> Option<&wgpu::TextureView> {
        match &self.over {
            Over::Apart {
                layer: Some(layer),
                is_shown: true,
                ..
            } => Some(&layer.resolved),
            _ => None,
        }
    }

    /// The depth that this sample at rest, or a picture by itself, is drawn with.
    fn depth_of(&self, sample: Option<u32>) -> &wgpu::TextureView {
        match &self.over {
            Over::Apart {
                spare_depth: Some(spare),
                ..
            } if sample.is_some_and(|sample| sample > 0) => spare,
            _ => &self.picture.depth,
        }
    }

    /// A depth that keeps nothing while samples at rest are drawn, made where there is none: the picture's own, but where a layer reads it.
    pub(super) fn depth_beside(&mut self, device: &wgpu::Device) -> &wgpu::TextureView {
        let (size, samples) = (self.capacity(), self.samples);
        match &mut self.over {
            Over::Together => &self.picture.depth,
            Over::Apart { spare_depth, .. } => spare_depth.get_or_insert_with(|| depth_view(device, size, samples)),
        }
    }

    /// All its textures.
    #[doc(hidden)]
    pub fn textures(&self) -> Vec<&wgpu::Texture> {
        let (layer, spare_depth) = match &self.over {
            Over::Together => (None, None),
            Over::Apart { layer, spare_depth, .. } => (layer.as_ref(), spare_depth.as_ref()),
        };
        let drawn = std::iter::once(&self.picture).chain(layer);
        let colors = drawn.flat_map(|drawn| std::iter::once(&drawn.resolved).chain(&drawn.multisampled));
        let depths = std::iter::once(&self.picture.depth).chain(spare_depth);
        colors.chain(depths).map(wgpu::TextureView::texture).collect()
    }

    /// Of each pixel.
    pub(super) fn samples(&self) -> SampleCount {
        self.samples
    }

    /// Width and height of the picture in pixels, or of the band of it that is drawn.
    pub fn size(&self) -> [u32; 2] {
        self.band.size()
    }

    pub(super) fn band(&self) -> Band {
        self.band
    }

    /// Shows a band of a larger picture next, for which there is room.
    pub(super) fn show(&mut self, band: Band) {
        self.band = band;
    }

    /// Width and height of the textures in pixels.
    pub(super) fn capacity(&self) -> [u32; 2] {
        [self.texture().width(), self.texture().height()]
    }

    /// The picture as fractions of the width and height of [`Target::texture`], and the centre of its last texel.
    pub(super) fn filled(&self) -> [f32; 4] {
        filled_part(self.size(), self.capacity())
    }

    /// Changes the size and loses the picture. Textures with room for the `largest` picture that is to come stay, unless they are more
    /// than twice as large. Returns whether they stayed.
    pub fn resize(&mut self, device: &wgpu::Device, size: [u32; 2], largest: [u32; 2]) -> bool {
        let largest = within_limit(device, std::array::from_fn(|axis| largest[axis].max(size[axis])));
        let capacity = self.capacity();
        let has_room = capacity.iter().zip(largest).all(|(&has, needs)| has >= needs);
        let wanted = within_limit(device, largest.map(|side| side.next_multiple_of(CAPACITY_STEP)));
        let stays = has_room && pixels(capacity) <= 2 * pixels(wanted);
        if !stays {
            let fresh = Self::with_samples(device, wanted[0], wanted[1], self.samples);
            *self = if self.has_layer() { fresh.with_layer() } else { fresh };
        } else if let Over::Apart { has_depth, .. } = &mut self.over {
            *has_depth = false;
        }
        self.band = Band::all(within_limit(device, size));
        stays
    }

    /// The picture: one sample a pixel, sRGB, premultiplied alpha. A resize may replace the texture, and may leave more room in it
    /// than the picture needs.
    pub fn texture(&self) -> &wgpu::Texture {
        self.picture.resolved.texture()
    }

    /// View of [`Target::texture`] for compositing.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.picture.resolved
    }

    /// Fills the picture with a colour, through the same pass that a frame is drawn with.
    pub(super) fn fill(&self, device: &wgpu::Device, queue: &wgpu::Queue, color: wgpu::Color) {
        let mut encoder = FrameEncoder::new(device, "fill");
        drop(self.begin_pass(&mut encoder, color, None));
        queue.submit([encoder.commands.finish()]);
    }

    /// The passes into the layer over the model, one for each kind of [`RenderFrame::has_overlays`](crate::scene::RenderFrame::has_overlays)
    /// that is there: `draw` is told which. What the model can hide meets the depth that was kept of it; what is seen through it has depth of its own.
    pub(super) fn draw_layer(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut FrameEncoder,
        are_there: [bool; 2],
        draw: impl Fn(&mut wgpu::RenderPass<'_>, usize),
    ) {
        if !are_there.contains(&true) {
            return;
        }
        let (size, samples, depth) = (self.capacity(), self.samples, self.depth_beside(device).clone());
        let Over::Apart { layer, .. } = &mut self.over else {
            return;
        };
        let layer = layer.get_or_insert_with(|| Attachments::new(device, "layer", size, samples, depth));
        let last = are_there.iter().rposition(|&is_there| is_there);
        for kind in (0..2).filter(|&kind| are_there[kind]) {
            let view = layer.multisampled.as_ref().unwrap_or(&layer.resolved);
            let is_resolved = layer.multisampled.is_some() && last == Some(kind);
            let on_model = kind == 0;
            let targets = PassTargets {
                color: Some((view, wgpu::Color::TRANSPARENT)),
                color_is_there: kind == 1 && are_there[0],
                resolved: is_resolved.then_some(&layer.resolved),
                depth: Some(if on_model { &self.picture.depth } else { &layer.depth }),
                depth_is_kept: on_model,
                depth_is_there: on_model,
                filled: Some(self.band),
                ..PassTargets::default()
            };
            draw(&mut begin_pass(encoder, TimedPass::Picture, targets), kind);
        }
    }

    /// Says what lies over the model in the next picture, whose depth is kept where it can hide something, and of samples at rest
    /// the first one's, which lies where pictures by themselves do.
    pub(super) fn set_overlays(&mut self, are_there: [bool; 2], scene_is_drawn: bool, sample: Option<u32>) {
        if let Over::Apart {
            is_shown, has_depth, ..
        } = &mut self.over
            && sample.is_none_or(|sample| sample == 0)
        {
            *is_shown = are_there.contains(&true);
            if scene_is_drawn {
                *has_depth = are_there[0] || sample.is_some();
            }
        }
    }

    /// A pass over the picture alone, which has one sample a pixel.
    pub(super) fn begin_picture<'a>(&self, encoder: &'a mut FrameEncoder) -> wgpu::RenderPass<'a> {
        let targets = PassTargets {
            color: Some((&self.picture.resolved, wgpu::Color::TRANSPARENT)),
            filled: Some(Band::all(self.size())),
            ..PassTargets::default()
        };
        begin_pass(encoder, TimedPass::Picture, targets)
    }

    /// A pass over a picture of this colour, or over a sample of one at rest.
    pub(super) fn begin_pass<'a>(
        &self,
        encoder: &'a mut FrameEncoder,
        color: wgpu::Color,
        sample: Option<u32>,
    ) -> wgpu::RenderPass<'a> {
        let Attachments {
            resolved, multisampled, ..
        } = &self.picture;
        let depth = self.depth_of(sample);
        let targets = PassTargets {
            color: Some((multisampled.as_ref().unwrap_or(resolved), color)),
            resolved: multisampled.is_some().then_some(resolved),
            depth: Some(depth),
            depth_is_kept: depth == &self.picture.depth && matches!(self.over, Over::Apart { has_depth: true, .. }),
            filled: Some(self.band),
            ..PassTargets::default()
        };
        begin_pass(encoder, TimedPass::Picture, targets)
    }
}

/// A picture as fractions of the width and height of its texture, and the centre of its last texel.
pub(super) fn filled_part(size: [u32; 2], capacity: [u32; 2]) -> [f32; 4] {
    let [width, height] = std::array::from_fn(|axis| size[axis] as f32 / capacity[axis] as f32);
    let half_texel = capacity.map(|side| 0.5 / side as f32);
    [width, height, width - half_texel[0], height - half_texel[1]]
}

/// How many pixels a picture of this size has.
pub(super) fn pixels([width, height]: [u32; 2]) -> u64 {
    u64::from(width) * u64::from(height)
}

fn within_limit(device: &wgpu::Device, size: [u32; 2]) -> [u32; 2] {
    let limit = device.limits().max_texture_dimension_2d;
    size.map(|side| side.clamp(1, limit))
}
