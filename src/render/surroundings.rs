//! What the model's shaders know of the world around it, as bind group 2.

use super::layouts::Layouts;

/// The textures that are bound, one light's or the other's.
pub(super) struct Surroundings<'a> {
    pub(super) shadow: &'a wgpu::TextureView,
    pub(super) occlusion: &'a wgpu::TextureView,
    pub(super) contact: &'a wgpu::TextureView,
    pub(super) sky: &'a wgpu::TextureView,
}

/// Samplers of the group.
pub(super) struct Samplers {
    shadow: wgpu::Sampler,
    surroundings: wgpu::Sampler,
}

impl Samplers {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let linear = wgpu::SamplerDescriptor {
            label: Some("surroundings"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        };
        Self {
            shadow: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("shadow map"),
                mipmap_filter: wgpu::MipmapFilterMode::Nearest,
                compare: Some(wgpu::CompareFunction::LessEqual),
                ..linear
            }),
            surroundings: device.create_sampler(&linear),
        }
    }

    pub(super) fn group(
        &self,
        device: &wgpu::Device,
        layouts: &Layouts,
        surroundings: &Surroundings<'_>,
    ) -> wgpu::BindGroup {
        use wgpu::BindingResource as Resource;
        let resources = [
            Resource::TextureView(surroundings.shadow),
            Resource::Sampler(&self.shadow),
            Resource::TextureView(surroundings.occlusion),
            Resource::TextureView(surroundings.contact),
            Resource::TextureView(surroundings.sky),
            Resource::Sampler(&self.surroundings),
        ];
        let entries = (0..).zip(resources);
        let entries: Vec<_> = entries
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("surroundings"),
            layout: &layouts.surroundings,
            entries: &entries,
        })
    }
}
