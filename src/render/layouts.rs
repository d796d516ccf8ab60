//! Bind group layouts that pipelines share. Groups of what draws the model: 0 frame, 1 bones, 2 surroundings, 3 material or line.

use super::bones::BoneTexture;
use crate::shaders;

pub(super) struct Layouts {
    pub(super) frame: wgpu::BindGroupLayout,
    pub(super) bones: wgpu::BindGroupLayout,
    pub(super) surroundings: wgpu::BindGroupLayout,
    pub(super) material: wgpu::BindGroupLayout,
    /// A colour and a length.
    pub(super) line: wgpu::BindGroupLayout,
    /// Normals and depth, and what is to be smoothed.
    pub(super) around: wgpu::BindGroupLayout,
    /// One texture that is read texel by texel.
    pub(super) texels: wgpu::BindGroupLayout,
    /// Holds the place of a group that a program does not read.
    pub(super) nothing: wgpu::BindGroupLayout,
}

impl Layouts {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let layout = |label, entries: &[(wgpu::ShaderStages, wgpu::BindingType)]| {
            let entries: Vec<_> = (0..)
                .zip(entries)
                .map(|(binding, &(visibility, ty))| wgpu::BindGroupLayoutEntry {
                    binding,
                    visibility,
                    ty,
                    count: None,
                })
                .collect();
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries: &entries,
            })
        };
        let (vertex, fragment) = (wgpu::ShaderStages::VERTEX, wgpu::ShaderStages::FRAGMENT);
        let filtered = wgpu::TextureSampleType::Float { filterable: true };
        let flat = |sample_type| (fragment, texture(sample_type, wgpu::TextureViewDimension::D2));
        let cube = (fragment, texture(filtered, wgpu::TextureViewDimension::Cube));
        let sampler = |ty| (fragment, wgpu::BindingType::Sampler(ty));
        let filtering = sampler(wgpu::SamplerBindingType::Filtering);
        Self {
            frame: layout("frame", &[(vertex | fragment, uniform::<shaders::Frame>())]),
            bones: BoneTexture::layout(device),
            surroundings: layout(
                "surroundings",
                &[
                    flat(wgpu::TextureSampleType::Depth),
                    sampler(wgpu::SamplerBindingType::Comparison),
                    flat(filtered),
                    flat(filtered),
                    (fragment, uniform::<shaders::Environment>()),
                    cube,
                    flat(filtered),
                    filtering,
                    cube,
                ],
            ),
            material: layout(
                "material",
                &[
                    (fragment, uniform::<shaders::Material>()),
                    flat(filtered),
                    flat(filtered),
                    filtering,
                ],
            ),
            line: layout("line", &[(vertex | fragment, uniform::<shaders::Line>())]),
            around: layout("around", &[flat(filtered), flat(filtered)]),
            texels: layout("texels", &[flat(filtered)]),
            nothing: layout("nothing", &[]),
        }
    }
}

fn uniform<T>() -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: std::num::NonZeroU64::new(size_of::<T>() as u64),
    }
}

fn texture(sample_type: wgpu::TextureSampleType, view_dimension: wgpu::TextureViewDimension) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type,
        view_dimension,
        multisampled: false,
    }
}
