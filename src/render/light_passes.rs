//! All that belongs to one light: the uniforms of a frame under it, its shadow, ambient occlusion and contact maps, and the bind
//! group through which shaders read them with the environment.

use std::ops::Range;

use super::band::Band;
use super::buffers::{Queue, bind_group, uniform_buffer};
use super::environment::Environments;
use super::light_maps::{ContactMap, GeometryMap, OcclusionMap, ShadowMap};
use super::model::{GpuModel, Posed};
use super::pipelines::Pipelines;
use super::timing::FrameEncoder;
use super::uniforms::{camera_uniform, contact_fit, ground_uniform, light_uniform};
use crate::scene::{Light, Pass, RenderFrame};
use crate::shaders;

pub(super) struct Common {
    pub(super) device: wgpu::Device,
    pub(super) queue: Queue,
    pub(super) pipelines: Pipelines,
    pub(super) samplers: Samplers,
    pub(super) environments: Environments,
    /// Bound where a program's layout has an empty group.
    pub(super) nothing: wgpu::BindGroup,
    /// Bound as the ambient occlusion where none is drawn: the environment reaches every pixel.
    pub(super) white: wgpu::TextureView,
    /// Bound as the contact map where none is drawn: nothing is near the ground.
    pub(super) black: wgpu::TextureView,
}

pub(super) struct Samplers {
    shadow: wgpu::Sampler,
    /// Reads one texel of the shadow map. GL calls a depth texture incomplete whose filter is linear and that is compared with nothing.
    shadow_depth: wgpu::Sampler,
    environment: wgpu::Sampler,
}

impl Samplers {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let linear = wgpu::SamplerDescriptor {
            label: Some("environment"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        };
        Self {
            environment: device.create_sampler(&linear),
            shadow_depth: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("shadow map, unfiltered"),
                ..Default::default()
            }),
            shadow: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("shadow map"),
                mipmap_filter: wgpu::MipmapFilterMode::Nearest,
                compare: Some(wgpu::CompareFunction::LessEqual),
                ..linear
            }),
        }
    }
}

/// The textures that differ between lights and frames: shadow map, ambient occlusion, contact map, specular cube, sky.
type LightingViews<T> = [T; 5];

pub(super) struct LightPasses {
    light: Light,
    camera: wgpu::Buffer,
    light_uniform: wgpu::Buffer,
    ground: wgpu::Buffer,
    written: (shaders::Camera, shaders::Light, shaders::Ground),
    frame_group: wgpu::BindGroup,
    shadow: ShadowMap,
    occlusion: Option<OcclusionMap>,
    contact: Option<ContactMap>,
    /// The bind groups, and the textures that they are made of.
    lighting: Option<(LightingViews<wgpu::TextureView>, [wgpu::BindGroup; 2])>,
}

impl LightPasses {
    pub(super) fn new(common: &Common, light: Light, shadow_map_side: u32) -> Self {
        let device = &common.device;
        let camera = uniform_buffer::<shaders::Camera>(device, "camera");
        let light_uniform = uniform_buffer::<shaders::Light>(device, "light");
        let ground = uniform_buffer::<shaders::Ground>(device, "ground");
        let resources = [&camera, &light_uniform, &ground].map(wgpu::Buffer::as_entire_binding);
        Self {
            light,
            frame_group: bind_group(device, "frame", &common.pipelines.layouts.frame, resources),
            camera,
            light_uniform,
            ground,
            written: Default::default(),
            shadow: ShadowMap::new(device, shadow_map_side),
            occlusion: None,
            contact: None,
            lighting: None,
        }
    }

    pub(super) fn light(&self) -> Light {
        self.light
    }

    pub(super) fn frame_group(&self) -> &wgpu::BindGroup {
        &self.frame_group
    }

    /// The backdrop's group 1, with the contact map, and group 2; none before the first [`LightPasses::draw`].
    pub(super) fn lit_groups(&self) -> Option<&[wgpu::BindGroup; 2]> {
        self.lighting.as_ref().map(|(_, groups)| groups)
    }

    /// Drops what reads the geometry in view.
    pub(super) fn forget_view(&mut self) {
        (self.occlusion, self.lighting) = (None, None);
    }

    pub(super) fn view_textures(&self) -> impl Iterator<Item = &wgpu::Texture> {
        self.occlusion.iter().flat_map(OcclusionMap::textures)
    }

    /// Writes the uniforms for a band of a picture.
    pub(super) fn write(&mut self, common: &Common, frame: &RenderFrame<'_>, band: Band) {
        let (queue, lamps) = (&common.queue, common.environments.lamps());
        let camera = camera_uniform(frame, band);
        let light = light_uniform(frame, self.light, lamps, self.shadow.side());
        let ground = ground_uniform(frame, self.light, lamps);
        queue.write_buffer(&self.camera, 0, bytemuck::bytes_of(&camera));
        queue.write_buffer(&self.light_uniform, 0, bytemuck::bytes_of(&light));
        queue.write_buffer(&self.ground, 0, bytemuck::bytes_of(&ground));
        self.written = (camera, light, ground);
    }

    /// Draws a band of the geometry in view, which both lights read. After [`LightPasses::write`].
    pub(super) fn draw_geometry(
        &self,
        common: &Common,
        encoder: &mut FrameEncoder,
        (map, band): (&mut GeometryMap, Band),
        model: (u64, (&GpuModel, Posed<'_>)),
    ) {
        let frame = (&self.frame_group, &self.written.0, band);
        map.draw(encoder, frame, model, &common.nothing);
    }

    /// Draws the maps that the picture's band will read. `columns` of the picture are those of this light; `geometry` is there when
    /// ambient occlusion is wanted, and the same until [`LightPasses::forget_view`]. After [`LightPasses::write`].
    pub(super) fn draw(
        &mut self,
        common: &Common,
        encoder: &mut FrameEncoder,
        frame: &RenderFrame<'_>,
        (columns, band, geometry): (&Range<u32>, Band, Option<&GeometryMap>),
        (shape_revision, model): (u64, Option<(&GpuModel, Posed<'_>)>),
    ) {
        let (device, pipelines, nothing) = (&common.device, &common.pipelines, &common.nothing);
        let (_, light, ground) = &self.written;
        let group = &self.frame_group;
        let draws = |pass| frame.draws_under(pass, self.light);
        if draws(Pass::Shadow) {
            self.shadow
                .draw(encoder, (group, light), (shape_revision, model), nothing);
        }
        let mut occlusion = &common.white;
        let mut contact = &common.black;
        if let Some(model) = model {
            if let (true, Some(geometry)) = (draws(Pass::AmbientOcclusion), geometry) {
                let fresh = || OcclusionMap::new(device, pipelines, geometry);
                let map = self.occlusion.get_or_insert_with(fresh);
                map.draw(
                    encoder,
                    pipelines,
                    (group, light),
                    (self.light, columns, band),
                    geometry,
                );
                occlusion = map.view();
            }
            if draws(Pass::ContactShadow) {
                let size = contact_fit(frame).map_size;
                let kept = self.contact.take().filter(|map| map.size() == size);
                let fresh = || ContactMap::new(device, pipelines, size);
                let map = self.contact.insert(kept.unwrap_or_else(fresh));
                map.draw(encoder, (group, light, ground), (shape_revision, model), nothing);
                contact = map.view();
            }
        }
        let (specular, sky) = (common.environments.specular(), common.environments.sky(self.light));
        let views = [self.shadow.view(), occlusion, contact, specular, sky];
        let are_bound = |(bound, _): &(LightingViews<_>, _)| bound.iter().zip(views).all(|(bound, view)| bound == view);
        if !self.lighting.as_ref().is_some_and(are_bound) {
            self.lighting = Some((views.map(Clone::clone), lit_groups(common, self.light, views)));
        }
    }
}

fn lit_groups(
    common: &Common,
    light: Light,
    [shadow, occlusion, contact, specular, sky]: LightingViews<&wgpu::TextureView>,
) -> [wgpu::BindGroup; 2] {
    use wgpu::BindingResource::{Sampler, TextureView};
    let (samplers, environments) = (&common.samplers, &common.environments);
    let (device, layouts) = (&common.device, &common.pipelines.layouts);
    let resources = [
        TextureView(shadow),
        Sampler(&samplers.shadow),
        TextureView(occlusion),
        environments.uniforms(light).as_entire_binding(),
        TextureView(specular),
        TextureView(environments.table()),
        Sampler(&samplers.environment),
        TextureView(sky),
        TextureView(shadow),
        Sampler(&samplers.shadow_depth),
    ];
    [
        bind_group(device, "contact", &layouts.texels, [TextureView(contact)]),
        bind_group(device, "lighting", &layouts.lighting, resources),
    ]
}
