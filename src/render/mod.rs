//! Draws a [`RenderFrame`] with wgpu, on Vulkan, Metal, DirectX 12, GL, WebGPU and WebGL2 alike.
//!
//! A model is uploaded once. A frame writes small uniforms, and of the instances and their bones what differs. For each light that the picture shows it
//! then draws the light's maps: shadow map, ambient occlusion and contact map. At last it draws the picture itself into a
//! multisampled [`Target`]: what is behind, the model, lines. A [`Compositor`] brings the resolved target onto a surface, and
//! [`read_back`] turns it into bytes, so a browser, a snapshot, the command line and the tests all see the same pixels.
//!
//! Only what WebGL2 has is used: no storage buffers and no compute. Joint matrices come from a texture, and textures that are drawn
//! into and then read have eight bits a channel, but for the mean of a picture at rest, which is left out where half floats cannot be drawn.

mod accumulator;
mod affordable;
mod band;
mod blending;
mod buffers;
mod composite;
pub mod device;
mod draw;
mod environment;
#[doc(hidden)]
pub mod for_tests;
mod fullscreen;
mod instances;
mod light_fit;
mod light_maps;
mod light_passes;
mod maps;
mod materials;
mod model;
mod overlays;
mod picture;
mod pipelines;
mod read_back;
mod recipe;
mod samples;
mod target;
mod timing;
mod triangles;
mod uniforms;
mod view;

pub use accumulator::Accumulator;
pub use buffers::{Queue, UploadError};
pub use composite::Compositor;
pub use device::{GpuAnswer, GpuError, ProbeError, probe, watched};
pub use instances::BoneTexture;
pub use maps::MaterialImages;
pub use picture::{MOST_UNDER_LAYER, Picture, PictureError, PictureTarget, prove};
pub use read_back::{ReadBackError, read_back, read_back_blocking};
pub use target::{SampleCount, Target};

use crate::image::Image;
use crate::model::{Material, Model};
use crate::scene::{FrameCost, RenderFrame, ViewMode};
use crate::slices::Slices;
use buffers::bind_group;
use environment::Environments;
use instances::{Instances, Roster};
use light_passes::{Common, Samplers};
use maps::{MapTextures, one_texel};
use model::GpuModel;
use overlays::Overlays;
use picture::PictureMean;
use pipelines::Pipelines;
use recipe::Draw;
use timing::{FrameEncoder, FrameTimer};
use view::{MOST_TIMES, View};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RendererOptions {
    /// Of each pixel of its targets; see [`device::sample_count`].
    pub samples: SampleCount,
    /// Texels along each edge of the shadow maps.
    pub shadow_map_side: u32,
}

impl Default for RendererOptions {
    /// What WebGPU and WebGL2 promise, and all detail.
    fn default() -> Self {
        Self {
            samples: SampleCount::default(),
            shadow_map_side: 2048,
        }
    }
}

/// Draws one model at a time. Resources are made when a frame first needs them; later frames make nothing.
pub struct Renderer {
    common: Common,
    options: RendererOptions,
    window: View,
    /// Of the samples of a picture at rest.
    at_rest: View,
    instances: Instances,
    overlays: Overlays,
    /// Bound where a program's layout has bones but none are read.
    no_bones: BoneTexture,
    maps: MapTextures,
    model: Option<GpuModel>,
    shape: Shape,
    /// Size that the textures of the window's last picture have room for, pixels. None before the first.
    window_capacity: Option<[u32; 2]>,
    /// None where the device tells no times.
    timer: Option<FrameTimer>,
    /// The same of samples at rest.
    sample_timer: Option<FrameTimer>,
}

/// What of the model the maps show: all but its colours. Kept to see when it changes.
#[derive(Default)]
struct Shape {
    hidden: Vec<bool>,
    skinned: bool,
    roster: Roster,
    revision: u64,
    /// Counts these, and changes of which instances are in sight.
    revision_in_sight: u64,
}

impl Shape {
    /// Another model, or other holes in it.
    fn replace(&mut self) {
        self.revision += 1;
        self.revision_in_sight += 1;
    }

    /// Follows the frame's instances. `posed_anew` when one of their palettes is another one.
    fn update(&mut self, frame: &RenderFrame<'_>, roster: Roster, posed_anew: bool) {
        let skinned = !frame.palette.0.is_empty();
        if posed_anew
            || self.skinned != skinned
            || self.hidden != frame.hidden_submeshes
            || !self.roster.has_all_of(&roster)
        {
            self.hidden.clear();
            self.hidden.extend_from_slice(frame.hidden_submeshes);
            self.skinned = skinned;
            self.replace();
        } else if self.roster != roster {
            self.revision_in_sight += 1;
        }
        self.roster = roster;
    }
}

impl Renderer {
    /// With so many samples a pixel, and all detail.
    pub fn with_samples(device: &wgpu::Device, queue: &wgpu::Queue, samples: SampleCount) -> Self {
        let options = RendererOptions {
            samples,
            ..RendererOptions::default()
        };
        Self::new(device, queue, options)
    }

    /// Without a model.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, options: RendererOptions) -> Self {
        let pipelines = Pipelines::new(device, options.samples);
        let [timer, sample_timer] = [0; 2].map(|_| FrameTimer::new(device, queue));
        let queue = Queue::new(queue);
        let nothing = bind_group(device, "nothing", &pipelines.layouts.nothing, []);
        Self {
            options,
            window: View::default(),
            at_rest: View::default(),
            instances: Instances::new(device),
            overlays: Overlays::new(device, &pipelines.layouts),
            no_bones: BoneTexture::new(device, &pipelines.layouts.bones, 0),
            maps: MapTextures::new(device, &queue),
            common: Common {
                device: device.clone(),
                pipelines,
                samplers: Samplers::new(device),
                environments: Environments::new(device, &queue),
                nothing,
                white: one_texel(device, &queue, "white", [255; 4]),
                black: one_texel(device, &queue, "black", [0; 4]),
                queue,
            },
            timer,
            sample_timer,
            model: None,
            shape: Shape::default(),
            window_capacity: None,
        }
    }

    /// Uploads a model, which replaces the last one. On an error the last one stays.
    pub fn set_model(&mut self, model: &Model) -> Result<(), UploadError> {
        let common = &self.common;
        let layouts = &common.pipelines.layouts;
        let uploaded = GpuModel::upload(&common.device, &common.queue, layouts, &self.maps, model)?;
        self.model = Some(uploaded);
        self.shape.replace();
        Ok(())
    }

    /// Gives each material of the model its maps, in the order of the model's materials; materials beyond the slice have none.
    /// All maps are replaced. An image is uploaded once, however many materials have it, and stays in GPU memory until a call lacks
    /// it, even when another model came meanwhile. Returns how many images were uploaded. Does nothing without a model.
    pub fn set_maps(&mut self, maps: &[MaterialImages<'_>]) -> usize {
        let (device, queue) = (&self.common.device, &self.common.queue);
        let Some(model) = &mut self.model else { return 0 };
        self.shape.replace();
        let uploaded = self.maps.update(device, queue, maps);
        model.set_maps(device, queue, &self.common.pipelines.layouts, &self.maps, maps);
        uploaded
    }

    /// Replaces the values of the model's materials, in their order; their maps stay. Does nothing without a model.
    pub fn set_materials(&mut self, materials: &[Material]) {
        let common = &self.common;
        if let Some(model) = &mut self.model {
            model.set_materials(&common.device, &common.queue, &common.pipelines.layouts, materials);
            self.shape.replace();
        }
    }

    /// Sets a cube map as the environment; without one, the project's own comes back. False, and nothing changes, when the image is no
    /// cube map.
    pub fn set_sky(&mut self, image: Option<&Image>) -> bool {
        let common = &mut self.common;
        common.environments.set_sky(&common.device, &common.queue, image)
    }

    /// Whether what lights the model has all the texels that it will have.
    pub fn is_refined(&self) -> bool {
        self.common.environments.is_fine()
    }

    /// Works on that in a slice: call it, always with the same slices, while nothing moves. True when the picture is another one for it.
    pub fn refine(&mut self, slices: &Slices) -> bool {
        let common = &mut self.common;
        common.environments.refine(&common.device, &common.queue, slices)
    }

    /// All of it at once, for a frame that no one waits for.
    pub fn refine_for(&mut self, frame: &RenderFrame<'_>) {
        let common = &mut self.common;
        common.environments.write(&common.device, &common.queue, frame);
        while !self.is_refined() {
            self.refine(&Slices::ENDLESS);
        }
    }

    /// Removes the model and frees its memory.
    pub fn clear_model(&mut self) {
        self.model = None;
        self.maps.clear();
        self.shape.replace();
    }

    /// Whether all pipelines are built that one key or the pointer may ask for while this model is open, for targets with each of these
    /// numbers of samples.
    pub fn is_prepared(&self, samples: &[SampleCount]) -> bool {
        self.unprepared(samples).is_none()
    }

    /// Builds one more of these pipelines, which takes a moment: call it while nothing moves. False when all are there.
    pub fn prepare_next(&mut self, samples: &[SampleCount]) -> bool {
        let next = self.unprepared(samples);
        next.is_some_and(|(draw, samples)| {
            self.common.pipelines.set_samples(samples);
            self.common.pipelines.get(draw);
            true
        })
    }

    /// How many pipelines were built so far.
    pub fn pipelines_built(&self) -> usize {
        self.common.pipelines.count()
    }

    /// What was drawn already may have been drawn with another number of samples.
    fn unprepared(&self, samples: &[SampleCount]) -> Option<(Draw, SampleCount)> {
        let (model, pipelines) = (self.model.as_ref()?, &self.common.pipelines);
        let mut wanted = pipelines.drawn();
        wanted.extend(Draw::within_reach(model.bones.is_some(), &model.kinds(), model.front));
        let with_each = |draw| samples.iter().map(move |&samples| (draw, samples));
        let mut wanted = wanted.into_iter().flat_map(with_each);
        wanted.find(|&(draw, samples)| !pipelines.has(draw, samples))
    }

    /// The textures whose size goes with the picture's: those of ambient occlusion. They may have room for larger pictures.
    pub fn view_textures(&self) -> Vec<&wgpu::Texture> {
        self.window.textures().chain(self.at_rest.textures()).collect()
    }

    /// Drops what samples of a picture at rest were drawn with.
    pub fn forget_samples(&mut self) {
        self.at_rest = View::default();
    }

    /// Draws a frame and submits it. A skinned model with an empty palette is drawn in bind space. Returns what it cost; nobody waits
    /// for the GPU's times, which are those of an earlier frame.
    pub fn render(&mut self, frame: &RenderFrame<'_>, target: &mut Target) -> FrameCost {
        self.render_window(frame, target, false)
    }

    /// Draws what lies over the model anew, where the target [can](Target::can_draw_over) and the rest of the picture would be the same.
    pub fn render_over(&mut self, frame: &RenderFrame<'_>, target: &mut Target) -> FrameCost {
        self.render_window(frame, target, true)
    }

    fn render_window(&mut self, frame: &RenderFrame<'_>, target: &mut Target, scene_stays: bool) -> FrameCost {
        if frame.sample.is_none() {
            self.window_capacity = Some(target.capacity());
            self.window.drop_textures(MOST_TIMES, target.capacity());
        }
        let mut encoder = FrameEncoder::timed(&self.common.device, "frame", &mut self.timer);
        let cost = self.draw(frame, target, &mut encoder, scene_stays);
        FrameCost {
            gpu_secs: encoder.submit(&self.common.queue.inner, &mut self.timer),
            ..cost
        }
    }

    /// Draws what lies over the model into the layer of a target that [`Renderer::accumulate`] drew samples of this frame with: over their
    /// mean.
    pub fn render_over_mean(&mut self, frame: &RenderFrame<'_>, target: &mut Target) -> FrameCost {
        // The first sample lies in the middle of the pixels, and its depth is kept.
        let frame = RenderFrame {
            sample: Some(0),
            ..frame.clone()
        };
        self.render_window(&frame, target, true)
    }

    /// Adds one more picture of a frame at rest to a mean, by a target with one sample a pixel. What lies over the model is left out.
    pub fn accumulate(&mut self, frame: &RenderFrame<'_>, target: &mut Target, accumulator: &mut Accumulator) {
        let sample = RenderFrame {
            sample: Some(accumulator.count()),
            ..frame.without_overlays()
        };
        let mut encoder = FrameEncoder::timed(&self.common.device, "sample", &mut self.sample_timer);
        target.depth_beside(&self.common.device);
        self.draw(&sample, target, &mut encoder, false);
        let dithers = frame.options.view_mode == ViewMode::Lit;
        accumulator.add(&self.common.device, &self.common.queue, &mut encoder, target, dithers);
        accumulator.note_secs(encoder.submit(&self.common.queue.inner, &mut self.sample_timer));
    }

    /// Draws a frame into a target of its own. The picture's pixels come with what the device answered: it may have too little
    /// memory for the size.
    ///
    /// # Errors
    /// When the device draws no picture of this size.
    pub fn picture(&mut self, frame: &RenderFrame<'_>, size: [u32; 2]) -> Result<Picture, PictureError> {
        self.picture_into(frame, &mut PictureTarget::new(size))
    }

    /// The same, or a band of it, into a target that is there, for one after another. Its pixels stay readable when the next is drawn.
    ///
    /// # Errors
    /// When the device draws no picture of this size.
    pub fn picture_into(
        &mut self,
        frame: &RenderFrame<'_>,
        target: &mut PictureTarget,
    ) -> Result<Picture, PictureError> {
        let (device, queue) = (self.common.device.clone(), self.common.queue.inner.clone());
        let (samples, group) = (target.samples_of(frame), target.group());
        let per_pixel = if samples > 1 {
            SampleCount::One
        } else {
            self.options.samples
        };
        let bytes = target.bytes(frame, per_pixel);
        Picture::start(&device, &queue, (per_pixel, bytes), target, |target, mean| {
            if samples > 1 {
                self.draw_mean(frame, target, mean, [samples, group]);
            } else {
                self.draw_alone(frame, target, "picture");
            }
            // A window at rest would hold what a large picture took.
            if let Some(window) = self.window_capacity {
                self.window.drop_textures(1, window);
                self.at_rest.drop_textures(0, window);
            }
        })
    }

    fn draw_alone(&mut self, frame: &RenderFrame<'_>, target: &mut Target, label: &str) {
        // Its times would be taken for those of the window.
        let mut encoder = FrameEncoder::new(&self.common.device, label);
        self.draw(frame, target, &mut encoder, false);
        self.common.queue.inner.submit([encoder.commands.finish()]);
    }

    /// Draws the mean of so many pictures into a target, a group at a time, and what lies over the model once.
    fn draw_mean(
        &mut self,
        frame: &RenderFrame<'_>,
        target: &mut Target,
        mean: &mut Option<PictureMean>,
        [samples, group]: [u32; 2],
    ) {
        let (device, per_pixel) = (self.common.device.clone(), self.options.samples);
        let layer = |[width, height]: [u32; 2]| Target::with_samples(&device, width, height, per_pixel).with_layer();
        let mean = mean.get_or_insert_with(|| PictureMean {
            accumulator: Accumulator::new(&device, target),
            over: layer([1; 2]),
            compositor: Compositor::into_picture(&device),
        });
        mean.accumulator.restart();
        for drawn in 1..=samples {
            self.accumulate(frame, target, &mut mean.accumulator);
            if drawn % group == 0 {
                // A device that is lost says so when the picture is read.
                let _ = device.poll(wgpu::PollType::wait_indefinitely());
            }
        }
        if !frame.has_overlays().contains(&true) {
            mean.over = layer([1; 2]);
        } else {
            if mean.over.capacity() != target.capacity() {
                mean.over = layer(target.capacity());
            }
            mean.over.show(target.band());
            self.draw_alone(frame, &mut mean.over, "layer");
        }
        let queue = &self.common.queue.inner;
        mean.compositor
            .prepare(&device, queue, &mean.over, Some(&mean.accumulator));
        let mut encoder = FrameEncoder::new(&device, "mean");
        mean.compositor.paint(&mut target.begin_picture(&mut encoder));
        queue.submit([encoder.commands.finish()]);
    }
}
