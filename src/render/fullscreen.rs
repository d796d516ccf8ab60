//! A program that fills a picture from textures, in one triangle.

use super::buffers::{bind_group, layout};
use super::pipelines::module;
use crate::shaders::Program;

pub(super) struct FullscreenPass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    name: &'static str,
}

impl FullscreenPass {
    /// For passes with one colour attachment of `format`, one sample and no depth. `bindings` are those of group 0.
    pub(super) fn new(
        device: &wgpu::Device,
        program: &Program,
        fragment: &str,
        bindings: &[wgpu::BindingType],
        format: wgpu::TextureFormat,
    ) -> Self {
        let in_fragment = |&ty| (wgpu::ShaderStages::FRAGMENT, ty);
        let entries: Vec<_> = bindings.iter().map(in_fragment).collect();
        let layout = layout(device, program.name, &entries);
        let module = module(device, program);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(program.name),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(program.name),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self {
            pipeline,
            layout,
            name: program.name,
        }
    }

    /// The bindings, filled.
    pub(super) fn group<'a>(
        &self,
        device: &wgpu::Device,
        resources: impl IntoIterator<Item = wgpu::BindingResource<'a>>,
    ) -> wgpu::BindGroup {
        bind_group(device, self.name, &self.layout, resources)
    }

    pub(super) fn fill(&self, pass: &mut wgpu::RenderPass<'_>, group: &wgpu::BindGroup) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
    }
}
