//! What the model's shaders know of the world around it, as bind group 2.

use super::environment::Environments;
use super::pipelines::Layouts;
use crate::scene::Light;

/// The textures that differ between lights and frames: shadow map, openness, contact map, mirrored cube, sky.
pub(super) type Views<'a> = [&'a wgpu::TextureView; 5];

/// The bind group of one light, made anew only when it is of other textures.
#[derive(Default)]
pub(super) struct Surroundings {
    bound: Option<([wgpu::TextureView; 5], wgpu::BindGroup)>,
}

impl Surroundings {
    pub(super) fn update(
        &mut self,
        device: &wgpu::Device,
        layouts: &Layouts,
        samplers: &Samplers,
        environments: &Environments,
        light: Light,
        views: Views<'_>,
    ) {
        let is_bound = |(bound, _): &([wgpu::TextureView; 5], _)| bound.iter().zip(views).all(|(a, b)| a == b);
        if self.bound.as_ref().is_some_and(is_bound) {
            return;
        }
        use wgpu::BindingResource as Resource;
        let [shadow, openness, contact, specular, sky] = views;
        let resources = [
            Resource::TextureView(shadow),
            Resource::Sampler(&samplers.shadow),
            Resource::TextureView(openness),
            Resource::TextureView(contact),
            environments.uniforms(light).as_entire_binding(),
            Resource::TextureView(specular),
            Resource::TextureView(environments.table()),
            Resource::Sampler(&samplers.environment),
            Resource::TextureView(sky),
        ];
        let entries = (0..).zip(resources);
        let entries: Vec<_> = entries
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("surroundings"),
            layout: &layouts.surroundings,
            entries: &entries,
        });
        self.bound = Some((views.map(Clone::clone), group));
    }

    /// Not there before the first [`Surroundings::update`].
    pub(super) fn group(&self) -> Option<&wgpu::BindGroup> {
        self.bound.as_ref().map(|(_, group)| group)
    }
}

/// Samplers of the group.
pub(super) struct Samplers {
    shadow: wgpu::Sampler,
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
            shadow: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("shadow map"),
                mipmap_filter: wgpu::MipmapFilterMode::Nearest,
                compare: Some(wgpu::CompareFunction::LessEqual),
                ..linear
            }),
        }
    }
}
