//! Draws a [`RenderFrame`] with wgpu, on Vulkan, Metal, DirectX 12, GL, WebGPU and WebGL2 alike.
//!
//! A model is uploaded once; a frame writes one uniform and the bone texture, then records two passes: the model's depth from the
//! key light, and the picture (backdrop with grid and ground shadow, then the model) into a multisampled [`Target`]. The resolved
//! target is what a [`Compositor`] brings onto a surface and what [`read_back`] turns into bytes, so a browser, a snapshot,
//! the command line and the tests all see the same pixels.
//!
//! Only what WebGL2 has is used: no storage buffers, no compute; joint matrices come from a texture.

mod bones;
mod composite;
pub mod device;
mod frame_uniform;
mod gpu_model;
mod look;
mod map;
mod material;
mod materials;
mod pipelines;
mod probe;
mod read_back;
mod shadow;
mod target;
mod upload;

pub use bones::BoneTexture;
pub use composite::Compositor;
pub use materials::MaterialImages;
pub use probe::{ProbeError, probe};
pub use read_back::{ReadBackError, read_back, read_back_blocking};
pub use target::{SampleCount, Target};
pub use upload::UploadError;

use crate::model::Model;
use crate::scene::{Background, RenderFrame};
use gpu_model::GpuModel;
use pipelines::Pipelines;
use shadow::ShadowMap;

/// Draws one model at a time. Pipelines are built here once; nothing is made per frame.
pub struct Renderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipelines: Pipelines,
    frame_buffer: wgpu::Buffer,
    frame_group: wgpu::BindGroup,
    shadow: ShadowMap,
    /// Bound where a program's layout has bones but none are read.
    no_bones: BoneTexture,
    /// Bound where a program's layout has an empty group.
    nothing: wgpu::BindGroup,
    model: Option<GpuModel>,
}

impl Renderer {
    /// For targets with four samples a pixel, which WebGPU and WebGL2 promise.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        Self::with_samples(device, queue, SampleCount::default())
    }

    /// For targets with this many samples; see [`device::sample_count`].
    pub fn with_samples(device: &wgpu::Device, queue: &wgpu::Queue, samples: SampleCount) -> Self {
        let pipelines = Pipelines::new(device, samples);
        let frame_buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<crate::shaders::Frame>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let frame_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &pipelines.layouts.frame,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: frame_buffer.as_entire_binding(),
            }],
        });
        let nothing = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("nothing"),
            layout: &pipelines.layouts.nothing,
            entries: &[],
        });
        Self {
            shadow: ShadowMap::new(device, &pipelines.layouts.shadow),
            no_bones: BoneTexture::new(device, &pipelines.layouts.bones, 0),
            device: device.clone(),
            queue: queue.clone(),
            pipelines,
            frame_buffer,
            frame_group,
            nothing,
            model: None,
        }
    }

    /// Uploads a model, which replaces the one before. On an error that one stays.
    pub fn set_model(&mut self, model: &Model) -> Result<(), UploadError> {
        self.model = Some(GpuModel::upload(
            &self.device,
            &self.queue,
            &self.pipelines.layouts,
            model,
        )?);
        Ok(())
    }

    /// Gives each material of the model its maps, in the order of the model's materials; materials beyond the slice have none.
    /// What was given before is forgotten, and so is all of it with the model. Uploads each picture once, however many
    /// materials name the same one by reference. Does nothing without a model.
    pub fn set_maps(&mut self, maps: &[MaterialImages<'_>]) {
        if let Some(model) = &mut self.model {
            model.set_maps(&self.device, &self.queue, &self.pipelines.layouts, maps);
        }
    }

    /// Draws no model from now on and gives its memory back.
    pub fn clear_model(&mut self) {
        self.model = None;
    }

    /// Draws a frame and submits it. A skinned model with an empty palette is drawn as bind space has it.
    pub fn render(&mut self, frame: &RenderFrame<'_>, target: &mut Target) {
        let model = self.model.as_mut();
        let winding = model.as_ref().map_or(1.0, |model| model.winding);
        let uniform = frame_uniform::frame_uniform(frame, target.size(), winding);
        self.queue
            .write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(&uniform));
        if let Some(bones) = model.and_then(|model| model.bones.as_mut()) {
            bones.write(&self.queue, frame.palette);
        }

        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        self.draw_shadow(frame, &mut encoder);
        self.draw_picture(frame, target, &mut encoder);
        self.queue.submit([encoder.finish()]);
    }

    fn draw_shadow(&self, frame: &RenderFrame<'_>, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = self.shadow.begin_pass(encoder);
        let Some(model) = &self.model else { return };
        pass.set_bind_group(0, &self.frame_group, &[]);
        let Pipelines { caster, caster_cut, .. } = &self.pipelines;
        pass.set_bind_group(2, &self.nothing, &[]);
        model.draw_depth(&mut pass, caster, caster_cut, self.bones_for(model, frame));
    }

    fn draw_picture(&self, frame: &RenderFrame<'_>, target: &Target, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = target.begin_pass(encoder);
        pass.set_bind_group(0, &self.frame_group, &[]);
        pass.set_bind_group(2, self.shadow.group(), &[]);
        if frame.options.background != Background::None {
            pass.set_pipeline(&self.pipelines.backdrop);
            pass.set_bind_group(1, self.no_bones.group(), &[]);
            pass.draw(0..3, 0..1);
        }
        if let Some(model) = &self.model {
            // Samples that alpha leaves out keep what lies behind; where nothing does, the picture needs its alpha itself.
            let cut = match frame.options.background {
                Background::None => &self.pipelines.mesh_cut,
                _ => &self.pipelines.mesh_cut_smooth,
            };
            model.draw(&mut pass, &self.pipelines.mesh, cut, self.bones_for(model, frame));
        }
    }

    /// The bones to draw a model with, and whether they are read.
    fn bones_for<'a>(&'a self, model: &'a GpuModel, frame: &RenderFrame<'_>) -> gpu_model::Posing<'a> {
        match &model.bones {
            Some(bones) if !frame.palette.0.is_empty() => gpu_model::Posing::Skinned(bones),
            _ => gpu_model::Posing::Static(&self.no_bones),
        }
    }
}
