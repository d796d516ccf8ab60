//! Pipelines, each built when it is first drawn with: a page that shows the studio light never waits for the others.

use std::cell::RefCell;
use std::collections::HashMap;

use super::layouts::Layouts;
use super::target::{COLOR_FORMAT, DEPTH_FORMAT, SampleCount};
use crate::scene::{Light, OverlayVertex};
use crate::shaders::{self, GeometryVertex, InfluenceVertex, Program};

/// Normals and depth in view; see `geometry.wgsl`.
pub(super) const GEOMETRY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// One share, 0…1.
pub(super) const SHARE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

/// What colours the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Shading {
    Lit(Light),
    Inspect,
}

/// How the alpha of a diffuse map cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Cut {
    /// Not at all.
    Whole,
    /// Whole pixels.
    Hard,
    /// With smooth edges, for pictures that are opaque already: alpha chooses samples and is not stored. As
    /// [`Cut::Hard`] with one sample a pixel.
    Smooth,
}

/// What is drawn of the model's triangles or vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ModelDraw {
    Mesh(Shading, Cut),
    /// In colours of its vertices.
    SkinView(Cut),
    Caster(Cut),
    Geometry(Cut),
    Contact,
    Edges,
    Normals,
    Tangents,
    Highlight,
}

/// What is drawn without the model's buffers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Draw {
    Model {
        draw: ModelDraw,
        skinned: bool,
    },
    Backdrop,
    /// Hidden by the model, or before everything else.
    World {
        shape: WorldShape,
        through: bool,
    },
    Occlusion(Light),
    OcclusionBlurRows,
    OcclusionBlurColumns,
    ContactBlurRows,
    ContactBlurColumns,
}

/// What stands in the world beside the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum WorldShape {
    Lines,
    Triangles,
}

pub(super) struct Pipelines {
    device: wgpu::Device,
    samples: SampleCount,
    pub(super) layouts: Layouts,
    modules: RefCell<HashMap<&'static str, wgpu::ShaderModule>>,
    built: RefCell<HashMap<Draw, wgpu::RenderPipeline>>,
}

const GEOMETRY: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Float32x2];
const INFLUENCES: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![4 => Uint32x4, 5 => Float32x4];
const WORLD_VERTEX: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![0 => Float32x3, 1 => Unorm8x4];
const VERTEX_COLOR: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![6 => Unorm8x4];

/// Keeps the map's own steps from shadowing the surface that made them; the mesh shader adds an offset along the normal.
const CASTER_BIAS: wgpu::DepthBiasState = wgpu::DepthBiasState {
    constant: 2,
    slope_scale: 2.5,
    clamp: 0.0,
};

/// Keeps the greatest value.
const MAX_BLEND: wgpu::BlendState = {
    let max = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Max,
    };
    wgpu::BlendState { color: max, alpha: max }
};

/// All that a pipeline is made from.
struct Recipe {
    program: Program,
    vertex: String,
    /// None where depth is all there is to draw.
    fragment: Option<&'static str>,
    topology: wgpu::PrimitiveTopology,
    /// Of the vertex buffers, if the model's are read.
    step_mode: wgpu::VertexStepMode,
    color: Option<wgpu::ColorTargetState>,
    alpha_to_coverage: bool,
    depth: Option<wgpu::DepthStencilState>,
    samples: u32,
}

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device, samples: SampleCount) -> Self {
        Self {
            device: device.clone(),
            samples,
            layouts: Layouts::new(device),
            modules: RefCell::default(),
            built: RefCell::default(),
        }
    }

    /// Builds it at the first call.
    pub(super) fn get(&self, draw: Draw) -> wgpu::RenderPipeline {
        let known = self.built.borrow().get(&draw).cloned();
        known.unwrap_or_else(|| {
            let pipeline = self.build(draw);
            self.built.borrow_mut().insert(draw, pipeline.clone());
            pipeline
        })
    }

    fn module(&self, program: &Program) -> wgpu::ShaderModule {
        let mut modules = self.modules.borrow_mut();
        let module = modules.entry(program.name).or_insert_with(|| {
            self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(program.name),
                source: wgpu::ShaderSource::Wgsl(program.source().into()),
            })
        });
        module.clone()
    }

    /// Nothing is culled: files have holes, flat leaves and turned triangles, and a viewer shows them. Shaders learn the side
    /// from `front_facing`, which here says "clockwise on the screen".
    fn build(&self, draw: Draw) -> wgpu::RenderPipeline {
        let recipe = self.recipe(draw);
        let module = self.module(&recipe.program);
        let groups: Vec<_> = self.groups(draw).into_iter().map(Some).collect();
        let layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(recipe.program.name),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let buffer = |stride, attributes| {
            Some(wgpu::VertexBufferLayout {
                array_stride: stride as u64,
                step_mode: recipe.step_mode,
                attributes,
            })
        };
        let geometry = buffer(size_of::<GeometryVertex>(), &GEOMETRY);
        let influences = buffer(size_of::<InfluenceVertex>(), &INFLUENCES);
        let colors = buffer(size_of::<[u8; 4]>(), &VERTEX_COLOR);
        let buffers = match draw {
            Draw::Model {
                draw: ModelDraw::SkinView(_),
                skinned,
            } => vec![geometry, influences.filter(|_| skinned), colors],
            Draw::Model { skinned: true, .. } => vec![geometry, influences],
            Draw::Model { skinned: false, .. } => vec![geometry],
            Draw::World { .. } => vec![buffer(size_of::<OverlayVertex>(), &WORLD_VERTEX)],
            _ => Vec::new(),
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
                cull_mode: None,
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
            surroundings,
            material,
            line,
            around,
            texels,
            nothing,
        } = &self.layouts;
        match draw {
            Draw::Model { draw, .. } => match draw {
                ModelDraw::Mesh(..) => vec![frame, bones, surroundings, material],
                ModelDraw::Caster(Cut::Whole) | ModelDraw::Contact => vec![frame, bones],
                ModelDraw::Caster(_) | ModelDraw::Geometry(_) | ModelDraw::SkinView(_) => {
                    vec![frame, bones, nothing, material]
                }
                ModelDraw::Edges | ModelDraw::Normals | ModelDraw::Tangents | ModelDraw::Highlight => {
                    vec![frame, bones, nothing, line]
                }
            },
            Draw::Backdrop => vec![frame, nothing, surroundings],
            Draw::World { .. } => vec![frame, nothing, nothing, line],
            Draw::Occlusion(_) | Draw::OcclusionBlurRows | Draw::OcclusionBlurColumns => vec![frame, around],
            Draw::ContactBlurRows | Draw::ContactBlurColumns => vec![texels],
        }
    }

    fn recipe(&self, draw: Draw) -> Recipe {
        let fullscreen = |program, fragment| Recipe {
            program,
            vertex: "vertex".into(),
            fragment: Some(fragment),
            topology: wgpu::PrimitiveTopology::TriangleList,
            step_mode: wgpu::VertexStepMode::Vertex,
            color: Some(SHARE_FORMAT.into()),
            alpha_to_coverage: false,
            depth: None,
            samples: 1,
        };
        match draw {
            Draw::Model { draw, skinned } => self.model_recipe(draw, skinned),
            Draw::Backdrop => Recipe {
                color: Some(COLOR_FORMAT.into()),
                depth: Some(depth(false, wgpu::CompareFunction::Always)),
                samples: self.samples.count(),
                ..fullscreen(shaders::BACKDROP, "fragment")
            },
            Draw::World { shape, through } => {
                let topology = match shape {
                    WorldShape::Lines => wgpu::PrimitiveTopology::LineList,
                    WorldShape::Triangles => wgpu::PrimitiveTopology::TriangleList,
                };
                Recipe {
                    vertex: "world_vertex".into(),
                    // Before everything else there is a depth of its own, in which shapes hide each other.
                    depth: Some(depth(through, wgpu::CompareFunction::LessEqual)),
                    ..self.over_model(shaders::LINES, topology)
                }
            }
            Draw::Occlusion(Light::Book) => fullscreen(shaders::OCCLUSION_BOOK, "fragment"),
            Draw::Occlusion(Light::Studio) => fullscreen(shaders::OCCLUSION_STUDIO, "fragment"),
            Draw::OcclusionBlurRows => fullscreen(shaders::OCCLUSION_BLUR, "fragment_rows"),
            Draw::OcclusionBlurColumns => fullscreen(shaders::OCCLUSION_BLUR, "fragment_columns"),
            Draw::ContactBlurRows => fullscreen(shaders::CONTACT_BLUR, "fragment_rows"),
            Draw::ContactBlurColumns => fullscreen(shaders::CONTACT_BLUR, "fragment_columns"),
        }
    }

    fn model_recipe(&self, draw: ModelDraw, skinned: bool) -> Recipe {
        let entry = |name: &str| format!("{name}_{}", if skinned { "skinned" } else { "static" });
        let solid = |program, fragment, color, samples| Recipe {
            program,
            vertex: entry("vertex"),
            fragment,
            topology: wgpu::PrimitiveTopology::TriangleList,
            step_mode: wgpu::VertexStepMode::Vertex,
            color,
            alpha_to_coverage: false,
            depth: Some(depth(true, wgpu::CompareFunction::Less)),
            samples,
        };
        match draw {
            ModelDraw::Mesh(shading, cut) => {
                let program = match shading {
                    Shading::Lit(Light::Studio) => shaders::MESH_STUDIO,
                    Shading::Lit(Light::Book) => shaders::MESH_BOOK,
                    Shading::Inspect => shaders::MESH_INSPECT,
                };
                let smooth = cut == Cut::Smooth && self.samples != SampleCount::One;
                let fragment = match cut {
                    Cut::Whole => "fragment",
                    Cut::Smooth if smooth => "fragment_cut_smooth",
                    Cut::Hard | Cut::Smooth => "fragment_cut",
                };
                let color = wgpu::ColorTargetState {
                    write_mask: if smooth {
                        wgpu::ColorWrites::COLOR
                    } else {
                        wgpu::ColorWrites::ALL
                    },
                    ..COLOR_FORMAT.into()
                };
                Recipe {
                    alpha_to_coverage: smooth,
                    ..solid(program, Some(fragment), Some(color), self.samples.count())
                }
            }
            ModelDraw::Caster(cut) => {
                let (program, fragment) = match cut {
                    Cut::Whole => (shaders::CASTER, None),
                    Cut::Hard | Cut::Smooth => (shaders::CASTER_CUT, Some("fragment")),
                };
                let mut recipe = solid(program, fragment, None, 1);
                recipe.depth = Some(wgpu::DepthStencilState {
                    bias: CASTER_BIAS,
                    ..depth(true, wgpu::CompareFunction::Less)
                });
                recipe
            }
            ModelDraw::Geometry(cut) => {
                let fragment = match cut {
                    Cut::Whole => "fragment",
                    Cut::Hard | Cut::Smooth => "fragment_cut",
                };
                solid(shaders::MESH_GEOMETRY, Some(fragment), Some(GEOMETRY_FORMAT.into()), 1)
            }
            ModelDraw::SkinView(cut) => {
                let fragment = match cut {
                    Cut::Whole => "fragment",
                    Cut::Hard | Cut::Smooth => "fragment_cut",
                };
                solid(
                    shaders::SKIN_VIEW,
                    Some(fragment),
                    Some(COLOR_FORMAT.into()),
                    self.samples.count(),
                )
            }
            ModelDraw::Contact => {
                let color = wgpu::ColorTargetState {
                    blend: Some(MAX_BLEND),
                    ..SHARE_FORMAT.into()
                };
                Recipe {
                    depth: None,
                    ..solid(shaders::CONTACT, Some("fragment"), Some(color), 1)
                }
            }
            ModelDraw::Edges => Recipe {
                vertex: entry("edge"),
                ..self.over_model(shaders::LINES, wgpu::PrimitiveTopology::LineList)
            },
            ModelDraw::Normals | ModelDraw::Tangents => Recipe {
                vertex: entry(if draw == ModelDraw::Normals {
                    "normal"
                } else {
                    "tangent"
                }),
                // A line a vertex: the mesh's vertices are instances of one line.
                step_mode: wgpu::VertexStepMode::Instance,
                ..self.over_model(shaders::LINES, wgpu::PrimitiveTopology::LineList)
            },
            ModelDraw::Highlight => Recipe {
                vertex: entry("vertex"),
                ..self.over_model(shaders::HIGHLIGHT, wgpu::PrimitiveTopology::TriangleList)
            },
        }
    }

    /// Blended over the finished model, hidden by what is nearer.
    fn over_model(&self, program: Program, topology: wgpu::PrimitiveTopology) -> Recipe {
        Recipe {
            program,
            vertex: String::new(),
            fragment: Some("fragment"),
            topology,
            step_mode: wgpu::VertexStepMode::Vertex,
            color: Some(wgpu::ColorTargetState {
                blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                ..COLOR_FORMAT.into()
            }),
            alpha_to_coverage: false,
            depth: Some(depth(false, wgpu::CompareFunction::LessEqual)),
            samples: self.samples.count(),
        }
    }
}

fn depth(write: bool, compare: wgpu::CompareFunction) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(write),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}
