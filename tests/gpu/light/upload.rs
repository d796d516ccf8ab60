//! A room on the GPU: uploaded as a renderer does it, its light read back.

use bindpose::shaders::{self, STUDIO_LIGHT, TONE_MAP_WGSL};
use glam::Vec3;
use wgpu::util::DeviceExt as _;

use super::evaluate::evaluate;
use super::{ANGLES, QUANTITIES, ROUGHNESSES, Room};
use crate::gpu::{Gpu, nothing};

impl Room<'_> {
    /// Uploads as a renderer does: uniform, cube with its levels, table, sampler.
    fn bind(&self, gpu: &Gpu, layout: &wgpu::BindGroupLayout) -> wgpu::BindGroup {
        let (device, queue) = (&gpu.open.device, &gpu.open.queue);
        let level_count = self.prefiltered.level_count();
        let uniform = shaders::Environment {
            sh: self.prefiltered.irradiance().to_uniform(),
            turn_cos: self.turn.0,
            turn_sin: self.turn.1,
            intensity: self.intensity,
            specular_level_count: level_count as f32,
        };
        let uniform = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: bytemuck::bytes_of(&uniform),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let levels = (0..level_count).filter_map(|level| self.prefiltered.level_rgba16f(level));
        // Faces outside, levels inside.
        let levels: Vec<Vec<u16>> = levels.collect();
        let face_levels = (0..6).flat_map(|face| {
            levels
                .iter()
                .map(move |level| &level[face * level.len() / 6..][..level.len() / 6])
        });
        let cube_texels: Vec<u16> = face_levels.flatten().copied().collect();
        let cube = device.create_texture_with_data(
            queue,
            &texture_descriptor(
                self.prefiltered.side(),
                6,
                level_count,
                wgpu::TextureFormat::Rgba16Float,
            ),
            wgpu::util::TextureDataOrder::LayerMajor,
            bytemuck::cast_slice(&cube_texels),
        );
        let table = device.create_texture_with_data(
            queue,
            &texture_descriptor(self.brdf_table.side() as u32, 1, 1, wgpu::TextureFormat::Rgba16Float),
            wgpu::util::TextureDataOrder::LayerMajor,
            bytemuck::cast_slice(&self.brdf_table.to_rgba16f()),
        );
        let cube_view = cube.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::Cube),
            ..Default::default()
        });
        let table_view = table.create_view(&Default::default());
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let resources = [
            uniform.as_entire_binding(),
            wgpu::BindingResource::TextureView(&cube_view),
            wgpu::BindingResource::TextureView(&table_view),
            wgpu::BindingResource::Sampler(&sampler),
        ];
        let entries = resources.into_iter().zip(3..);
        let entries: Vec<_> = entries
            .map(|(resource, binding)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("environment"),
            layout,
            entries: &entries,
        })
    }

    /// The values of all cases, by the shaders.
    pub(super) fn on_gpu(&self, gpu: &Gpu) -> Vec<Vec3> {
        let device = &gpu.open.device;
        let [key_color, rim_color] =
            [self.key_color, self.rim_color].map(|Vec3 { x, y, z }| format!("vec3<f32>({x:?}, {y:?}, {z:?})"));
        let constants = format!(
            "const ANGLES: u32 = {ANGLES}u;\nconst ROUGHNESSES: u32 = {ROUGHNESSES}u;\n\
             const KEY_COLOR: vec3<f32> = {key_color};\nconst RIM_COLOR: vec3<f32> = {rim_color};\n"
        );
        let files = STUDIO_LIGHT.iter().chain([&TONE_MAP_WGSL]).map(|file| file.source);
        let source: String = files.chain([constants.as_str(), include_str!("probe.wgsl")]).collect();
        let (nothing, nothing_group) = nothing(gpu);
        let environment = environment_layout(device);
        let group = self.bind(gpu, &environment);
        let groups = [
            (&nothing, &nothing_group),
            (&nothing, &nothing_group),
            (&environment, &group),
        ];
        evaluate(gpu, source, &groups, [ANGLES, ROUGHNESSES * QUANTITIES])
    }
}

fn texture_descriptor(
    side: u32,
    faces: u32,
    levels: u32,
    format: wgpu::TextureFormat,
) -> wgpu::TextureDescriptor<'static> {
    wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: faces,
        },
        mip_level_count: levels,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    }
}

fn environment_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let texture = |view_dimension| wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension,
        multisampled: false,
    };
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let types = [
        uniform,
        texture(wgpu::TextureViewDimension::Cube),
        texture(wgpu::TextureViewDimension::D2),
        wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
    ];
    let entries = types
        .into_iter()
        .zip(3..)
        .map(|(ty, binding)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        });
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("environment"),
        entries: &entries.collect::<Vec<_>>(),
    })
}
