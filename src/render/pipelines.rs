//! Bind group layouts, and pipelines, each built when it is first drawn with or, before that, while nothing moves: no page waits for
//! more than it shows.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;

use super::buffers::{flat, layout, texture};
use super::instances::BoneTexture;
use super::recipe::{Draw, Faces, Maps, ModelDraw, Recipe, WorldShape};
use super::target::SampleCount;
use crate::model::MapSlot;
use crate::scene::OverlayVertex;
use crate::shaders::{self, InfluenceVertex, Instance, MoreMapsVertex, PositionVertex, Program, SurfaceVertex};

/// Bind group layouts that pipelines share. Programs that draw the model have these groups: 0 frame, 1 bones, 2 lighting,
/// 3 material or line.
pub(super) struct Layouts {
    pub(super) frame: wgpu::BindGroupLayout,
    pub(super) bones: wgpu::BindGroupLayout,
    pub(super) lighting: wgpu::BindGroupLayout,
    pub(super) material: wgpu::BindGroupLayout,
    pub(super) material_all: wgpu::BindGroupLayout,
    pub(super) line: wgpu::BindGroupLayout,
    /// Normals and depth in view, and the occlusion to be blurred.
    pub(super) occlusion: wgpu::BindGroupLayout,
    /// One texture, read texel by texel.
    pub(super) texels: wgpu::BindGroupLayout,
    /// Empty, for a group that a program does not read.
    pub(super) nothing: wgpu::BindGroupLayout,
}

impl Layouts {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let layout = |label, entries: &[_]| layout(device, label, entries);
        let (vertex, fragment) = (wgpu::ShaderStages::VERTEX, wgpu::ShaderStages::FRAGMENT);
        let filtered = wgpu::TextureSampleType::Float { filterable: true };
        let flat = |sample_type| (fragment, flat(sample_type));
        let cube = (fragment, texture(filtered, wgpu::TextureViewDimension::Cube));
        let sampler = |ty| (fragment, wgpu::BindingType::Sampler(ty));
        let filtering = sampler(wgpu::SamplerBindingType::Filtering);
        Self {
            frame: layout(
                "frame",
                &[
                    (vertex | fragment, uniform::<shaders::Camera>()),
                    (vertex | fragment, uniform::<shaders::Light>()),
                    (vertex | fragment, uniform::<shaders::Ground>()),
                ],
            ),
            bones: BoneTexture::layout(device),
            lighting: layout(
                "lighting",
                &[
                    flat(wgpu::TextureSampleType::Depth),
                    sampler(wgpu::SamplerBindingType::Comparison),
                    flat(filtered),
                    (fragment, uniform::<shaders::Environment>()),
                    cube,
                    flat(filtered),
                    filtering,
                    cube,
                    flat(wgpu::TextureSampleType::Float { filterable: false }),
                    sampler(wgpu::SamplerBindingType::NonFiltering),
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
            material_all: layout("material with all maps", &{
                let map = [flat(filtered), filtering];
                let mut entries = vec![
                    (fragment, uniform::<shaders::Material>()),
                    (vertex | fragment, uniform::<shaders::MaterialMaps>()),
                ];
                entries.extend(MapSlot::ALL.into_iter().flat_map(|_| map));
                entries
            }),
            line: layout("line", &[(vertex | fragment, uniform::<shaders::Line>())]),
            occlusion: layout("occlusion", &[flat(filtered), flat(filtered)]),
            texels: layout("texels", &[flat(filtered)]),
            nothing: layout("nothing", &[]),
        }
    }
}

/// How many samples it is drawn with in pictures with so many a pixel.
fn samples_of(draw: Draw, picture: SampleCount) -> SampleCount {
    if draw.is_in_picture() {
        picture
    } else {
        SampleCount::One
    }
}

pub(super) fn uniform<T>() -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: std::num::NonZeroU64::new(size_of::<T>() as u64),
    }
}

/// A flat texture that a sampler may filter.
pub(super) fn filtered_texture() -> wgpu::BindingType {
    flat(wgpu::TextureSampleType::Float { filterable: true })
}

pub(super) fn module(device: &wgpu::Device, program: &Program) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(program.name),
        source: wgpu::ShaderSource::Wgsl(program.source().into()),
    })
}

pub(super) struct Pipelines {
    device: wgpu::Device,
    samples: Cell<SampleCount>,
    pub(super) layouts: Layouts,
    modules: RefCell<HashMap<&'static str, wgpu::ShaderModule>>,
    /// For what, and for how many samples a pixel.
    built: RefCell<HashMap<(Draw, SampleCount), wgpu::RenderPipeline>>,
}

/// Slots of the buffers from which the model is drawn.
pub(super) const INSTANCE_SLOT: u32 = 0;
pub(super) const POSITION_SLOT: u32 = 1;
pub(super) const SURFACE_SLOT: u32 = 2;
pub(super) const INFLUENCE_SLOT: u32 = 3;
pub(super) const COLOR_SLOT: u32 = 4;
pub(super) const MORE_MAPS_SLOT: u32 = 5;

const POSITION: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Float32x3];
const SURFACE: [wgpu::VertexAttribute; 3] = wgpu::vertex_attr_array![1 => Float32x3, 2 => Float32x4, 3 => Float32x2];
const MORE_MAPS: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![13 => Unorm16x4, 14 => Float32x2];
const INFLUENCES: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![4 => Uint32x4, 5 => Float32x4];
const INSTANCE: [wgpu::VertexAttribute; 6] = wgpu::vertex_attr_array![
    7 => Float32x4, 8 => Float32x4, 9 => Float32x4, 10 => Float32x4, 11 => Uint32, 12 => Float32
];
const WORLD_VERTEX: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![0 => Float32x3, 1 => Unorm8x4];
/// Two of them; the colour is the first one's.
const WORLD_LINE: [wgpu::VertexAttribute; 3] = wgpu::vertex_attr_array![0 => Float32x3, 1 => Unorm8x4, 2 => Float32x3];
/// Which vertices an edge joins.
const EDGE: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Uint32x2];
const VERTEX_COLOR: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![6 => Unorm8x4];

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device, samples: SampleCount) -> Self {
        Self {
            device: device.clone(),
            samples: Cell::new(samples),
            layouts: Layouts::new(device),
            modules: RefCell::default(),
            built: RefCell::default(),
        }
    }

    /// Pictures are drawn into targets with so many samples a pixel from here on.
    pub(super) fn set_samples(&self, samples: SampleCount) {
        self.samples.set(samples);
    }

    /// The pipeline that draws this, built at the first call.
    pub(super) fn get(&self, draw: Draw) -> wgpu::RenderPipeline {
        let samples = samples_of(draw, self.samples.get());
        let known = self.built.borrow().get(&(draw, samples)).cloned();
        known.unwrap_or_else(|| {
            let pipeline = self.build(draw, samples);
            self.built.borrow_mut().insert((draw, samples), pipeline.clone());
            pipeline
        })
    }

    /// Whether it is built, for targets with so many samples a pixel.
    pub(super) fn has(&self, draw: Draw, samples: SampleCount) -> bool {
        self.built.borrow().contains_key(&(draw, samples_of(draw, samples)))
    }

    /// What was drawn or prepared so far, for targets with any number of samples.
    pub(super) fn drawn(&self) -> Vec<Draw> {
        self.built.borrow().keys().map(|(draw, _)| *draw).collect()
    }

    pub(super) fn count(&self) -> usize {
        self.built.borrow().len()
    }

    fn module(&self, program: &Program) -> wgpu::ShaderModule {
        let mut modules = self.modules.borrow_mut();
        let made = || module(&self.device, program);
        modules.entry(program.name).or_insert_with(made).clone()
    }

    /// Shaders learn the side from `front_facing`, which here says "clockwise on the screen".
    fn build(&self, draw: Draw, samples: SampleCount) -> wgpu::RenderPipeline {
        let recipe = Recipe::of(draw, samples);
        let module = self.module(&recipe.program);
        let groups: Vec<_> = self.groups(draw).into_iter().map(Some).collect();
        let layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(recipe.program.name),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let buffer = |stride, step_mode, attributes| {
            Some(wgpu::VertexBufferLayout {
                array_stride: stride as u64,
                step_mode,
                attributes,
            })
        };
        let step = recipe.step_mode;
        let step_of_instances = match step {
            wgpu::VertexStepMode::Vertex => wgpu::VertexStepMode::Instance,
            wgpu::VertexStepMode::Instance => wgpu::VertexStepMode::Vertex,
        };
        let instances = buffer(size_of::<Instance>(), step_of_instances, &INSTANCE[..]);
        let positions = buffer(size_of::<PositionVertex>(), step, &POSITION);
        let surface = buffer(size_of::<SurfaceVertex>(), step, &SURFACE);
        let influences = buffer(size_of::<InfluenceVertex>(), step, &INFLUENCES);
        let colors = buffer(size_of::<[u8; 4]>(), step, &VERTEX_COLOR);
        let more_maps = buffer(size_of::<MoreMapsVertex>(), step, &MORE_MAPS);
        let buffers = match draw {
            Draw::Model {
                draw: ModelDraw::Edges, ..
            } => vec![instances, buffer(size_of::<[u32; 2]>(), step, &EDGE)],
            Draw::Model { draw, skinned, .. } => vec![
                instances,
                positions,
                surface.filter(|_| draw.reads_surface()),
                influences.filter(|_| skinned),
                colors.filter(|_| draw.reads_colors()),
                more_maps.filter(|_| draw.maps() == Some(Maps::All)),
            ],
            Draw::World { shape, .. } => vec![match shape {
                WorldShape::Lines => buffer(2 * size_of::<OverlayVertex>(), step, &WORLD_LINE),
                WorldShape::Triangles => buffer(size_of::<OverlayVertex>(), step, &WORLD_VERTEX),
            }],
            _ => Vec::new(),
        };
        let faces = match draw {
            Draw::Model { faces, .. } => faces,
            _ => Faces::All,
        };
        let targets: Vec<_> = recipe.color.into_iter().map(Some).collect();
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(recipe.program.name),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(&recipe.vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                topology: recipe.topology,
                front_face: wgpu::FrontFace::Cw,
                cull_mode: match faces {
                    Faces::All => None,
                    Faces::Clockwise => Some(wgpu::Face::Back),
                    Faces::Counterclockwise => Some(wgpu::Face::Front),
                },
                ..Default::default()
            },
            depth_stencil: recipe.depth,
            multisample: wgpu::MultisampleState {
                count: recipe.samples,
                alpha_to_coverage_enabled: recipe.alpha_to_coverage,
                ..Default::default()
            },
            fragment: recipe.fragment.map(|entry_point| wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    fn groups(&self, draw: Draw) -> Vec<&wgpu::BindGroupLayout> {
        let Layouts {
            frame,
            bones,
            lighting,
            material,
            material_all,
            line,
            occlusion,
            texels,
            nothing,
        } = &self.layouts;
        match draw {
            Draw::Model { draw, .. } => {
                let material = draw.maps().map(|maps| match maps {
                    Maps::Two => material,
                    Maps::All => material_all,
                });
                match (draw, material) {
                    (ModelDraw::Mesh(..), Some(material)) => vec![frame, bones, lighting, material],
                    (_, Some(material)) => vec![frame, bones, nothing, material],
                    // Their vertices lie in a texture as bones do.
                    (ModelDraw::Edges, None) => vec![frame, bones, bones, line],
                    (ModelDraw::Normals | ModelDraw::Tangents, None) => vec![frame, bones, nothing, line],
                    (_, None) => vec![frame, bones],
                }
            }
            Draw::Backdrop => vec![frame, texels, lighting],
            Draw::World { .. } => vec![frame, nothing, nothing, line],
            Draw::Occlusion(_) | Draw::OcclusionBlurRows | Draw::OcclusionBlurColumns => vec![frame, occlusion],
            Draw::ContactBlurRows | Draw::ContactBlurColumns => vec![texels],
        }
    }
}
