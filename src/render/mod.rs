//! Draws a [`RenderFrame`] with wgpu, on Vulkan, Metal, DirectX 12, GL, WebGPU and WebGL2 alike.
//!
//! A model is uploaded once. A frame writes small uniforms, and of the instances and their bones what differs. For each light that the picture shows it
//! then draws the light's maps: shadow map, ambient occlusion and contact map. At last it draws the picture itself into a
//! multisampled [`Target`]: what is behind, the model, lines. A [`Compositor`] brings the resolved target onto a surface, and
//! [`read_back`] turns it into bytes, so a browser, a snapshot, the command line and the tests all see the same pixels.
//!
//! Only what WebGL2 has is used: no storage buffers and no compute. Joint matrices come from a texture, and textures that are drawn
//! into and then read have eight bits a channel.

mod blending;
mod buffers;
mod composite;
pub mod device;
mod environment;
#[doc(hidden)]
pub mod for_tests;
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
mod target;
mod timing;
mod triangles;
mod uniforms;

pub use buffers::{Queue, UploadError};
pub use composite::Compositor;
pub use device::{GpuAnswer, GpuError, ProbeError, probe, watched};
pub use instances::BoneTexture;
pub use maps::MaterialImages;
pub use picture::{Picture, PictureError, PictureTarget};
pub use read_back::{ReadBackError, read_back, read_back_blocking};
pub use target::{SampleCount, Target};

use crate::image::Image;
use crate::model::{Handedness, Material, Model};
use crate::scene::{FrameCost, Light, Pass, RenderFrame, ViewMode};
use buffers::bind_group;
use environment::Environments;
use instances::{InstanceRange, Instances, Roster, pose_count, poses};
use light_maps::GeometryMap;
use light_passes::{Common, LightPasses, Samplers};
use maps::{MapTextures, one_texel};
use model::{GpuModel, Posed};
use overlays::Overlays;
use pipelines::Pipelines;
use recipe::{Cut, Draw, Faces, Maps, ModelDraw, Purpose, Shading};
use timing::{FrameEncoder, FrameTimer};

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
    /// The lights that were shown so far.
    lights: Vec<LightPasses>,
    instances: Instances,
    overlays: Overlays,
    /// Bound where a program's layout has bones but none are read.
    no_bones: BoneTexture,
    maps: MapTextures,
    model: Option<GpuModel>,
    shape: Shape,
    /// For ambient occlusion; has room for the last picture that had it.
    geometry: Option<GeometryMap>,
    /// Size that the textures of the window's last picture have room for, pixels. None before the first.
    window: Option<[u32; 2]>,
    /// None where the device tells no times.
    timer: Option<FrameTimer>,
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

/// Textures of ambient occlusion are kept for a window that is so many times smaller: a picture that moves may have a quarter of the
/// pixels of one at rest, which may have twice the room that it needs.
const MOST_TIMES: u64 = 8;

/// A range of columns of the picture, pixels, under one light. Two lights are two draws of one frame, each inside its columns: no blending,
/// no second target, and each shows what it alone would show.
type Columns = (Light, std::ops::Range<u32>);

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
        let timer = FrameTimer::new(device, queue);
        let queue = Queue::new(queue);
        let nothing = bind_group(device, "nothing", &pipelines.layouts.nothing, []);
        Self {
            options,
            lights: Vec::new(),
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
            model: None,
            shape: Shape::default(),
            geometry: None,
            window: None,
        }
    }

    /// Uploads a model, which replaces the last one. On an error the last one stays.
    pub fn set_model(&mut self, model: &Model) -> Result<(), UploadError> {
        let Common {
            device,
            queue,
            pipelines,
            ..
        } = &self.common;
        self.model = Some(GpuModel::upload(device, queue, &pipelines.layouts, &self.maps, model)?);
        self.shape.replace();
        Ok(())
    }

    /// Gives each material of the model its maps, in the order of the model's materials; materials beyond the slice have none.
    /// All maps are replaced. An image is uploaded once, however many materials have it, and stays in GPU memory until a call lacks
    /// it, even when another model came meanwhile. Returns how many images were uploaded. Does nothing without a model.
    pub fn set_maps(&mut self, maps: &[MaterialImages<'_>]) -> usize {
        let Common {
            device,
            queue,
            pipelines,
            ..
        } = &self.common;
        let Some(model) = &mut self.model else { return 0 };
        self.shape.replace();
        let uploaded = self.maps.update(device, queue, maps);
        model.set_maps(device, queue, &pipelines.layouts, &self.maps, maps);
        uploaded
    }

    /// Replaces the values of the model's materials, in their order; their maps stay. Does nothing without a model.
    pub fn set_materials(&mut self, materials: &[Material]) {
        let Common {
            device,
            queue,
            pipelines,
            ..
        } = &self.common;
        if let Some(model) = &mut self.model {
            model.set_materials(device, queue, &pipelines.layouts, materials);
            self.shape.replace();
        }
    }

    /// Sets a cube map as the environment; without one, the project's own comes back. False, and nothing changes, when the image is no
    /// cube map.
    pub fn set_sky(&mut self, image: Option<&Image>) -> bool {
        let Common {
            device,
            queue,
            environments,
            ..
        } = &mut self.common;
        environments.set_sky(device, queue, image)
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
        let occlusion = self.lights.iter().flat_map(LightPasses::view_textures);
        let geometry = self.geometry.iter().flat_map(GeometryMap::textures);
        geometry.chain(occlusion).collect()
    }

    /// Drops them where they have more than so many times the texels that a picture of this size needs.
    fn drop_view_textures(&mut self, times: u64, size: [u32; 2]) {
        if self.geometry.as_ref().is_some_and(|map| map.exceeds(times, size)) {
            self.geometry = None;
            self.lights.iter_mut().for_each(LightPasses::forget_view);
        }
    }

    /// Draws a frame and submits it. A skinned model with an empty palette is drawn in bind space. Returns what it cost; nobody waits
    /// for the GPU's times, which are those of an earlier frame.
    pub fn render(&mut self, frame: &RenderFrame<'_>, target: &mut Target) -> FrameCost {
        self.window = Some(target.capacity());
        self.drop_view_textures(MOST_TIMES, target.capacity());
        let mut encoder = FrameEncoder::new(&self.common.device, "frame");
        if let Some(timer) = &mut self.timer {
            timer.begin_frame(&mut encoder);
        }
        let cost = self.draw(frame, target, &mut encoder);
        let Some(timer) = &mut self.timer else {
            self.common.queue.inner.submit([encoder.commands.finish()]);
            return cost;
        };
        timer.submit(&self.common.queue.inner, encoder);
        FrameCost {
            gpu_secs: timer.latest(),
            ..cost
        }
    }

    /// Draws a frame. Returns what is known of its cost.
    fn draw(&mut self, frame: &RenderFrame<'_>, target: &mut Target, encoder: &mut FrameEncoder) -> FrameCost {
        self.common.environments.write(&self.common.queue, frame);
        let Common { device, queue, .. } = &self.common;
        let mut posed_anew = false;
        if let Some(model) = &mut self.model {
            if let Some(bones) = &mut model.bones {
                let ghosts = frame.ghosts.palettes.iter().map(|palette| &palette.0[..]);
                bones.write(queue, poses(frame).chain(ghosts));
                posed_anew = bones.first_changed(pose_count(frame));
            }
            if let Some(colors) = &frame.vertex_colors {
                model.set_colors(device, queue, colors);
            }
            let mirrors = frame.world_from_model.matrix3.determinant() < 0.0;
            let is_clockwise = (model.handedness == Handedness::Right) == mirrors;
            let sides = [(Faces::Counterclockwise, -1.0), (Faces::Clockwise, 1.0)];
            let (front, front_sign) = sides[usize::from(is_clockwise)];
            model.front = front;
            self.instances
                .write(device, queue, frame, model.bones.as_ref(), front_sign);
        }
        self.overlays.write(device, queue, frame);
        self.shape.update(frame, self.instances.roster(), posed_anew);
        let parts = parts(frame, target.size());
        for (light, _) in &parts {
            if self.lights.iter().all(|passes| passes.light() != *light) {
                self.lights
                    .push(LightPasses::new(&self.common, *light, self.options.shadow_map_side));
            }
        }

        let has_room = |map: &GeometryMap| map.has_room(target.size());
        if frame.options.draws(Pass::AmbientOcclusion) && !self.geometry.as_ref().is_some_and(has_room) {
            self.drop_view_textures(0, target.size());
            self.geometry = Some(GeometryMap::new(&self.common.device, target.capacity()));
        }
        let pipelines = &self.common.pipelines;
        let model = self.model.as_ref().map(|model| {
            let bones = model.bones.as_ref().filter(|_| !frame.palette.0.is_empty());
            let posed = Posed {
                pipelines,
                bones: bones.unwrap_or(&self.no_bones),
                instances: self.instances.all(),
                skinned: bones.is_some(),
                hidden: frame.hidden_submeshes,
            };
            (model, posed)
        });
        let columns_of = |light| parts.iter().find(|part| part.0 == light).map(|(_, columns)| columns);
        for passes in &mut self.lights {
            if columns_of(passes.light()).is_none() {
                continue;
            }
            passes.write(&self.common.queue, frame, target.size());
            let is_read = frame.draws_under(Pass::AmbientOcclusion, passes.light());
            if let (true, Some(model), Some(map)) = (is_read, model, &mut self.geometry) {
                let model = with(model, self.instances.in_sight());
                passes.draw_geometry(&self.common, encoder, map, (self.shape.revision_in_sight, model));
            }
        }
        for passes in &mut self.lights {
            if let Some(columns) = columns_of(passes.light()) {
                let (geometry, shape) = (self.geometry.as_ref(), (self.shape.revision, model));
                passes.draw(&self.common, encoder, frame, (columns, geometry), shape);
            }
        }
        let own = model.map(|model| with(model, self.instances.own()));
        pipelines.set_samples(target.samples());
        self.draw_picture(frame, target, &parts, own, encoder);
        let [draws, vertices] = model.map_or([0; 2], |(model, _)| model.take_drawn());
        FrameCost {
            draws,
            vertices,
            uploaded_bytes: self.common.queue.take_bytes(),
            ..FrameCost::default()
        }
    }

    /// Draws a frame into a target of its own. The picture's pixels come with what the device answered: it may have too little
    /// memory for the size.
    ///
    /// # Errors
    /// When the device draws no picture of this size.
    pub fn picture(&mut self, frame: &RenderFrame<'_>, size: [u32; 2]) -> Result<Picture, PictureError> {
        self.picture_into(frame, &mut PictureTarget::new(size))
    }

    /// The same into a target that is there, for one picture after another. Its pixels stay readable when the next is drawn.
    ///
    /// # Errors
    /// When the device draws no picture of this size.
    pub fn picture_into(
        &mut self,
        frame: &RenderFrame<'_>,
        target: &mut PictureTarget,
    ) -> Result<Picture, PictureError> {
        let (device, queue) = (self.common.device.clone(), self.common.queue.inner.clone());
        Picture::start(&device, &queue, self.options.samples, target, |target| {
            // Its times would be taken for those of the window.
            let mut encoder = FrameEncoder::new(&self.common.device, "picture");
            self.draw(frame, target, &mut encoder);
            self.common.queue.inner.submit([encoder.commands.finish()]);
            // A window at rest would hold what a large picture took.
            if let Some(window) = self.window {
                self.drop_view_textures(1, window);
            }
        })
    }

    fn draw_picture(
        &self,
        frame: &RenderFrame<'_>,
        target: &Target,
        parts: &[Columns],
        model: Option<(&GpuModel, Posed<'_>)>,
        encoder: &mut FrameEncoder,
    ) {
        let height = target.size()[1];
        let options = &frame.options;
        let Common {
            device,
            pipelines,
            nothing,
            ..
        } = &self.common;
        let is_lit = options.view_mode == ViewMode::Lit;
        // Colours of the skin are the own instance's alone.
        let colored = frame.vertex_colors.is_some();
        // The backdrop replaces all that the model leaves, alpha too. Smooth edges store no alpha: it is there from the beginning.
        let mut pass = target.begin_pass(encoder, wgpu::Color::BLACK);
        let begin_part = |pass: &mut wgpu::RenderPass<'_>, (light, columns): &Columns| {
            let passes = self.lights.iter().find(|passes| passes.light() == *light);
            let Some((passes, lighting)) = passes.and_then(|passes| Some((passes, passes.lighting_group()?))) else {
                return false;
            };
            pass.set_scissor_rect(columns.start, 0, columns.len() as u32, height);
            pass.set_bind_group(0, passes.frame_group(), &[]);
            pass.set_bind_group(2, lighting, &[]);
            true
        };
        for part in parts {
            if let Some((model, own)) = model
                && begin_part(&mut pass, part)
            {
                let shading = if is_lit { Shading::Lit(part.0) } else { Shading::Inspect };
                let instances = if colored {
                    self.instances.crowd_in_sight()
                } else {
                    self.instances.in_sight()
                };
                if instances.count > 0 {
                    let (_, posed) = with((model, own), instances);
                    model.draw(&mut pass, posed, Purpose::Picture(shading));
                }
                if colored {
                    pass.set_bind_group(2, nothing, &[]);
                    model.draw(&mut pass, own, Purpose::SkinView);
                }
            }
        }
        // Backgrounds from the right: Mesa's software rasteriser fills one column too many at the left of a scissor rectangle.
        for part in parts.iter().rev() {
            if begin_part(&mut pass, part) {
                pass.set_pipeline(&pipelines.get(Draw::Backdrop));
                pass.set_bind_group(1, nothing, &[]);
                pass.draw(0..3, 0..1);
            }
        }
        // After the background, which shows through it.
        let blended = model
            .filter(|_| is_lit)
            .map(|(model, _)| model.blended(frame, !colored));
        for part in parts.iter().rev() {
            if let (Some(model), Some(order)) = (model, &blended)
                && !order.is_empty()
                && begin_part(&mut pass, part)
            {
                let (model, posed) = with(model, self.instances.in_sight());
                let draw = ModelDraw::Mesh(Shading::Lit(part.0), Cut::Blended, Maps::All);
                model.draw_blended(&mut pass, posed, order, draw);
            }
        }
        for part in parts {
            if !begin_part(&mut pass, part) {
                continue;
            }
            if let Some(model) = model {
                pass.set_bind_group(2, nothing, &[]);
                self.overlays
                    .draw_over_model(device, &mut pass, frame, model, &self.instances);
            }
            self.overlays.draw_shapes(&mut pass, pipelines, nothing, target.size());
        }
        // GL resolves the samples by a copy, which the scissor would cut.
        let [width, height] = target.size();
        pass.set_scissor_rect(0, 0, width, height);
    }
}

/// A model drawn with other instances.
fn with<'a>((model, posed): (&'a GpuModel, Posed<'a>), instances: InstanceRange<'a>) -> (&'a GpuModel, Posed<'a>) {
    (model, Posed { instances, ..posed })
}

/// Which light shows in which columns of the picture, from the left.
fn parts(frame: &RenderFrame<'_>, [width, _]: [u32; 2]) -> Vec<Columns> {
    let Some(fraction) = frame.options.split else {
        return vec![(frame.options.light, 0..width)];
    };
    let at = ((fraction.clamp(0.0, 1.0) * width as f32).round() as u32).min(width);
    let light = frame.options.light;
    let mut parts = vec![(light.other(), 0..at), (light, at..width)];
    parts.retain(|(_, columns)| !columns.is_empty());
    parts
}
