//! The mean of many pictures of a scene at rest, each with one sample a pixel.

use super::band::Band;
use super::buffers::{Queue, uniform_buffer};
use super::fullscreen::FullscreenPass;
use super::pipelines::{filtered_texture, uniform};
use super::samples::noise_turn;
use super::target::{MEAN_FORMAT, PassTargets, Target, begin_pass, filled_part, flat_texture};
use super::timing::{FrameEncoder, PassSecs};
use crate::scene::TimedPass;
use crate::shaders;

/// The mean of the pictures so far, in one of two textures: each picture is added on the way from one to the other.
pub struct Accumulator {
    pass: FullscreenPass,
    uniform: wgpu::Buffer,
    means: [wgpu::TextureView; 2],
    /// The picture that is added, and the groups that read each mean with it.
    source: Option<(wgpu::TextureView, [wgpu::BindGroup; 2])>,
    /// Of the pictures.
    band: Band,
    count: u32,
    /// What the GPU took for them, as far as it tells.
    gpu_secs: Option<f32>,
    dithers: bool,
}

impl Accumulator {
    /// For targets with textures of this size.
    pub fn new(device: &wgpu::Device, target: &Target) -> Self {
        let bindings = [
            filtered_texture(),
            filtered_texture(),
            uniform::<shaders::Accumulation>(),
        ];
        Self {
            pass: FullscreenPass::new(device, &shaders::ACCUMULATE, "fragment", &bindings, MEAN_FORMAT),
            uniform: uniform_buffer::<shaders::Accumulation>(device, "accumulation"),
            means: means(device, target),
            source: None,
            band: target.band(),
            count: 0,
            gpu_secs: None,
            dithers: false,
        }
    }

    /// Follows a target that was resized, and forgets the pictures.
    pub fn follow(&mut self, device: &wgpu::Device, target: &Target) {
        if self.capacity() != target.capacity() {
            self.means = means(device, target);
            self.source = None;
        }
        self.restart();
    }

    fn capacity(&self) -> [u32; 2] {
        let texture = self.means[0].texture();
        [texture.width(), texture.height()]
    }

    /// All its textures.
    #[doc(hidden)]
    pub fn textures(&self) -> [&wgpu::Texture; 2] {
        self.means.each_ref().map(wgpu::TextureView::texture)
    }

    /// How many pictures the mean is of.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Forgets them: another scene begins.
    pub fn restart(&mut self) {
        (self.count, self.gpu_secs) = (0, None);
    }

    /// About how long the GPU took for all of them, seconds: none where it does not tell, or not yet.
    pub fn gpu_secs(&self) -> Option<f32> {
        self.gpu_secs
    }

    /// A picture was added; the last of which the times of passes came took these.
    pub(super) fn note_secs(&mut self, passes: Option<PassSecs>) {
        if let Some(passes) = passes {
            self.gpu_secs = Some(self.gpu_secs.unwrap_or_default() + passes.iter().sum::<f32>());
        }
    }

    /// The mean, as roots.
    pub(super) fn view(&self) -> &wgpu::TextureView {
        &self.means[(self.count % 2) as usize]
    }

    /// See [`Target::filled`].
    pub(super) fn filled(&self) -> [f32; 4] {
        filled_part(self.band.size(), self.capacity())
    }

    /// Of the whole picture, the first that the mean has.
    pub(super) fn first_row(&self) -> f32 {
        self.band.first_row as f32
    }

    /// Whether the mean is rounded to bytes with noise: it has finer steps than they have.
    pub(super) fn dithers(&self) -> bool {
        self.dithers
    }

    /// Adds the picture of a target, which was dithered or not.
    pub(super) fn add(
        &mut self,
        device: &wgpu::Device,
        queue: &Queue,
        encoder: &mut FrameEncoder,
        target: &Target,
        dithers: bool,
    ) {
        (self.band, self.dithers) = (target.band(), dithers);
        let accumulation = shaders::Accumulation {
            share: 1.0 / (self.count + 1) as f32,
            turn: noise_turn(self.count),
            first_row: self.first_row(),
            ..Default::default()
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&accumulation));
        if self.source.as_ref().is_none_or(|(picture, _)| picture != target.view()) {
            let group = |index: usize| {
                let resources = [
                    wgpu::BindingResource::TextureView(&self.means[index]),
                    wgpu::BindingResource::TextureView(target.view()),
                    self.uniform.as_entire_binding(),
                ];
                self.pass.group(device, resources)
            };
            self.source = Some((target.view().clone(), [0, 1].map(group)));
        }
        let from = (self.count % 2) as usize;
        if let Some((_, groups)) = &self.source {
            let targets = PassTargets {
                color: Some((&self.means[1 - from], wgpu::Color::TRANSPARENT)),
                filled: Some(Band::all(target.size())),
                ..PassTargets::default()
            };
            let mut pass = begin_pass(encoder, TimedPass::Picture, targets);
            self.pass.fill(&mut pass, &groups[from]);
        }
        self.count += 1;
    }
}

fn means(device: &wgpu::Device, target: &Target) -> [wgpu::TextureView; 2] {
    let usages = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
    [0, 1].map(|_| flat_texture(device, "mean", target.capacity(), MEAN_FORMAT, usages))
}
