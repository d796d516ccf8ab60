//! Pipelines and the bind group layouts they share. Groups: 0 frame, 1 bones, 2 shadow map, 3 material.

use super::bones::BoneTexture;
use super::target::{COLOR_FORMAT, DEPTH_FORMAT, SampleCount};
use crate::shaders::{self, GeometryVertex, InfluenceVertex, Program};

pub(super) struct Layouts {
    pub(super) frame: wgpu::BindGroupLayout,
    pub(super) bones: wgpu::BindGroupLayout,
    pub(super) shadow: wgpu::BindGroupLayout,
    pub(super) material: wgpu::BindGroupLayout,
    /// Holds the place of a group that a program does not read.
    pub(super) nothing: wgpu::BindGroupLayout,
}

/// One program for models with and without joints.
pub(super) struct PosedPipelines {
    pub(super) skinned: wgpu::RenderPipeline,
    pub(super) unskinned: wgpu::RenderPipeline,
}

pub(super) struct Pipelines {
    pub(super) layouts: Layouts,
    pub(super) mesh: PosedPipelines,
    /// For materials that alpha cuts: whole pixels.
    pub(super) mesh_cut: PosedPipelines,
    /// The same with smooth edges, for pictures that are opaque already: alpha chooses samples and is not stored. Not smooth
    /// with one sample a pixel.
    pub(super) mesh_cut_smooth: PosedPipelines,
    pub(super) caster: PosedPipelines,
    pub(super) caster_cut: PosedPipelines,
    pub(super) backdrop: wgpu::RenderPipeline,
}

const GEOMETRY: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Float32x2];
const INFLUENCES: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![4 => Uint32x4, 5 => Float32x4];

/// Keeps the map's own steps from shadowing the surface that made them; the mesh shader adds an offset along the normal.
const CASTER_BIAS: wgpu::DepthBiasState = wgpu::DepthBiasState {
    constant: 2,
    slope_scale: 2.5,
    clamp: 0.0,
};

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device, samples: SampleCount) -> Self {
        let layouts = Layouts::new(device);
        let Layouts {
            frame,
            bones,
            shadow,
            material,
            nothing,
        } = &layouts;
        let picture = |fragment, depth_write, depth_compare| Pass {
            fragment: Some(fragment),
            color: Some(COLOR_FORMAT.into()),
            alpha_to_coverage: false,
            depth: wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(depth_write),
                depth_compare: Some(depth_compare),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            },
            samples: samples.count(),
        };
        let shadow_pass = |fragment| Pass {
            fragment,
            color: None,
            alpha_to_coverage: false,
            depth: wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState::default(),
                bias: CASTER_BIAS,
            },
            samples: 1,
        };

        let model = |fragment| picture(fragment, true, wgpu::CompareFunction::Less);
        let cut_smooth = match samples {
            SampleCount::One => model("fragment_cut"),
            SampleCount::Four => Pass {
                color: Some(wgpu::ColorTargetState {
                    write_mask: wgpu::ColorWrites::COLOR,
                    ..COLOR_FORMAT.into()
                }),
                alpha_to_coverage: true,
                ..model("fragment_cut_smooth")
            },
        };

        let mesh = Builder::new(device, &shaders::MESH, &[frame, bones, shadow, material]);
        let caster = Builder::new(device, &shaders::CASTER, &[frame, bones]);
        let caster_cut = Builder::new(device, &shaders::CASTER_CUT, &[frame, bones, nothing, material]);
        let backdrop = Builder::new(device, &shaders::BACKDROP, &[frame, bones, shadow]);
        Self {
            mesh: mesh.posed(&model("fragment")),
            mesh_cut: mesh.posed(&model("fragment_cut")),
            mesh_cut_smooth: mesh.posed(&cut_smooth),
            caster: caster.posed(&shadow_pass(None)),
            caster_cut: caster_cut.posed(&shadow_pass(Some("fragment"))),
            backdrop: backdrop.build(
                "vertex",
                &[],
                &picture("fragment", false, wgpu::CompareFunction::Always),
            ),
            layouts,
        }
    }
}

impl Layouts {
    fn new(device: &wgpu::Device) -> Self {
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries,
            })
        };
        let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty,
            count: None,
        };
        let uniform = |size: usize| wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: std::num::NonZeroU64::new(size as u64),
        };
        let texture = |sample_type| wgpu::BindingType::Texture {
            sample_type,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let (vertex, fragment) = (wgpu::ShaderStages::VERTEX, wgpu::ShaderStages::FRAGMENT);
        let comparison = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison);
        let frame_size = size_of::<shaders::Frame>();
        let material_size = size_of::<shaders::Material>();
        Self {
            frame: layout("frame", &[entry(0, vertex | fragment, uniform(frame_size))]),
            bones: BoneTexture::layout(device),
            shadow: layout(
                "shadow map",
                &[
                    entry(0, fragment, texture(wgpu::TextureSampleType::Depth)),
                    entry(1, fragment, comparison),
                ],
            ),
            material: layout(
                "material",
                &[
                    entry(0, fragment, uniform(material_size)),
                    entry(
                        1,
                        fragment,
                        texture(wgpu::TextureSampleType::Float { filterable: true }),
                    ),
                    entry(
                        2,
                        fragment,
                        texture(wgpu::TextureSampleType::Float { filterable: true }),
                    ),
                    entry(
                        3,
                        fragment,
                        wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
                    ),
                ],
            ),
            nothing: layout("nothing", &[]),
        }
    }
}

/// What a pipeline draws into.
struct Pass {
    /// Entry point; none where depth is all there is to draw.
    fragment: Option<&'static str>,
    color: Option<wgpu::ColorTargetState>,
    alpha_to_coverage: bool,
    depth: wgpu::DepthStencilState,
    samples: u32,
}

/// A compiled program with its layout.
struct Builder<'a> {
    device: &'a wgpu::Device,
    program: &'a Program,
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
}

impl<'a> Builder<'a> {
    fn new(device: &'a wgpu::Device, program: &'a Program, groups: &[&wgpu::BindGroupLayout]) -> Self {
        let groups: Vec<_> = groups.iter().copied().map(Some).collect();
        Self {
            device,
            program,
            module: device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(program.name),
                source: wgpu::ShaderSource::Wgsl(program.source().into()),
            }),
            layout: device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(program.name),
                bind_group_layouts: &groups,
                immediate_size: 0,
            }),
        }
    }

    fn posed(&self, pass: &Pass) -> PosedPipelines {
        let layout = |stride, attributes| {
            Some(wgpu::VertexBufferLayout {
                array_stride: stride as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes,
            })
        };
        let geometry = layout(size_of::<GeometryVertex>(), &GEOMETRY);
        let influences = layout(size_of::<InfluenceVertex>(), &INFLUENCES);
        PosedPipelines {
            skinned: self.build("vertex_skinned", &[geometry.clone(), influences], pass),
            unskinned: self.build("vertex_static", &[geometry], pass),
        }
    }

    /// Nothing is culled: files have holes, flat leaves and turned triangles, and a viewer shows them. Shaders learn the side
    /// from `front_facing`, which here says "clockwise on the screen".
    fn build(
        &self,
        vertex: &str,
        buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
        pass: &Pass,
    ) -> wgpu::RenderPipeline {
        let targets: Vec<_> = pass.color.iter().cloned().map(Some).collect();
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.program.name),
            layout: Some(&self.layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers,
            },
            primitive: wgpu::PrimitiveState {
                front_face: wgpu::FrontFace::Cw,
                cull_mode: None,
                ..Default::default()
            },
            depth_stencil: Some(pass.depth.clone()),
            multisample: wgpu::MultisampleState {
                count: pass.samples,
                alpha_to_coverage_enabled: pass.alpha_to_coverage,
                ..Default::default()
            },
            fragment: pass.fragment.map(|entry_point| wgpu::FragmentState {
                module: &self.module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
