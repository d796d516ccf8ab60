//! Shader formulas, evaluated once for each pixel of a texture that is read back.

use glam::Vec3;

use crate::gpu::{Gpu, read_texture};

/// The values that the source's `fragment` gives, bit for bit, rows from the top. Groups are bound from 0 on.
pub(super) fn evaluate(
    gpu: &Gpu,
    source: String,
    groups: &[(&wgpu::BindGroupLayout, &wgpu::BindGroup)],
    [width, height]: [u32; 2],
) -> Vec<Vec3> {
    let (device, queue) = (&gpu.open.device, &gpu.open.queue);
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("light probe"),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let layouts: Vec<_> = groups.iter().map(|(layout, _)| Some(*layout)).collect();
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &layouts,
        immediate_size: 0,
    });
    // GL may not draw into floats; every device draws into integers, and bits are bits.
    let format = wgpu::TextureFormat::Rgba32Uint;
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("light probe"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = texture.create_view(&Default::default());
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        for (index, (_, group)) in (0..).zip(groups) {
            pass.set_bind_group(index, *group, &[]);
        }
        pass.draw(0..3, 0..1);
    }
    queue.submit([encoder.finish()]);
    let texels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&read_texture(gpu, &texture, 16));
    texels.into_iter().map(|[x, y, z, _]| Vec3::new(x, y, z)).collect()
}
