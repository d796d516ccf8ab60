//! What is drawn, and what each thing is drawn with: program, entry points, blending, depth.

use super::target::{COLOR_FORMAT, DEPTH_FORMAT, FRACTION_FORMAT, GEOMETRY_FORMAT, SampleCount};
use crate::scene::Light;
use crate::shaders::{self, Program};

/// What colours the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Shading {
    Lit(Light),
    Inspect,
}

/// How the alpha of a diffuse map cuts holes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Cut {
    /// Not at all.
    Whole,
    /// Whole pixels.
    Hard,
    /// With smooth edges, over an opaque background: alpha chooses the samples of a pixel and is not stored. With one sample a
    /// pixel it is [`Cut::Hard`].
    Smooth,
}

/// What is drawn of the model's triangles or vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ModelDraw {
    Mesh(Shading, Cut),
    /// The model in the colours of its vertices.
    SkinView(Cut),
    Caster(Cut),
    Geometry(Cut),
    Contact,
    Edges,
    Normals,
    Tangents,
    Highlight,
}

impl ModelDraw {
    /// Whether it reads normals, tangents or texture coordinates of vertices, not positions alone.
    pub(super) fn reads_surface(self) -> bool {
        !matches!(self, Self::Caster(Cut::Whole) | Self::Contact | Self::Edges)
    }

    /// Whether it reads colours of vertices.
    pub(super) fn reads_colors(self) -> bool {
        matches!(self, Self::SkinView(_))
    }
}

/// Everything that has a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Draw {
    Model {
        draw: ModelDraw,
        skinned: bool,
    },
    Backdrop,
    /// Hidden by the model or, with `through`, seen through it.
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

impl Draw {
    /// Whether it is drawn into the picture itself, not into a map that the picture reads.
    pub(super) fn is_in_picture(self) -> bool {
        match self {
            Self::Model { draw, .. } => {
                !matches!(draw, ModelDraw::Caster(_) | ModelDraw::Geometry(_) | ModelDraw::Contact)
            }
            Self::Backdrop | Self::World { .. } => true,
            Self::Occlusion(_)
            | Self::OcclusionBlurRows
            | Self::OcclusionBlurColumns
            | Self::ContactBlurRows
            | Self::ContactBlurColumns => false,
        }
    }

    /// What one key or the pointer may ask for while a model is open, in a picture with a background, the likeliest first: what the
    /// pointer marks, the other light, view modes, wires, bones, weights, normals.
    pub(super) fn within_reach(skinned: bool, has_cuts: bool) -> Vec<Self> {
        let cuts = |cut| [Cut::Whole, cut].into_iter().take(if has_cuts { 2 } else { 1 });
        let mesh = |shading| cuts(Cut::Smooth).map(move |cut| ModelDraw::Mesh(shading, cut));
        let of_model = |draw| Self::Model { draw, skinned };
        let mut draws = vec![of_model(ModelDraw::Highlight)];
        for light in Light::ALL {
            draws.extend(mesh(Shading::Lit(light)).map(of_model));
            draws.push(Self::Occlusion(light));
        }
        draws.extend([
            of_model(ModelDraw::Contact),
            Self::ContactBlurRows,
            Self::ContactBlurColumns,
        ]);
        draws.extend(mesh(Shading::Inspect).map(of_model));
        draws.push(of_model(ModelDraw::Edges));
        draws.extend([WorldShape::Triangles, WorldShape::Lines].map(|shape| Self::World { shape, through: true }));
        draws.extend(cuts(Cut::Hard).map(ModelDraw::SkinView).map(of_model));
        draws.push(of_model(ModelDraw::Normals));
        draws
    }
}

/// What stands in the world beside the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum WorldShape {
    Lines,
    Triangles,
}

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

/// All that a pipeline is made from but for its bind groups.
pub(super) struct Recipe {
    pub(super) program: Program,
    pub(super) vertex: String,
    /// None where only depth is drawn.
    pub(super) fragment: Option<&'static str>,
    pub(super) topology: wgpu::PrimitiveTopology,
    /// Of the vertex buffers.
    pub(super) step_mode: wgpu::VertexStepMode,
    pub(super) color: Option<wgpu::ColorTargetState>,
    pub(super) alpha_to_coverage: bool,
    pub(super) depth: Option<wgpu::DepthStencilState>,
    pub(super) samples: u32,
}

impl Recipe {
    /// The recipe of this, for pictures with so many samples a pixel.
    pub(super) fn of(draw: Draw, samples: SampleCount) -> Self {
        let fullscreen = |program, fragment| Recipe {
            program,
            vertex: "vertex".into(),
            fragment: Some(fragment),
            topology: wgpu::PrimitiveTopology::TriangleList,
            step_mode: wgpu::VertexStepMode::Vertex,
            color: Some(FRACTION_FORMAT.into()),
            alpha_to_coverage: false,
            depth: None,
            samples: 1,
        };
        match draw {
            Draw::Model { draw, skinned } => Self::of_model(draw, skinned, samples),
            Draw::Backdrop => Recipe {
                color: Some(COLOR_FORMAT.into()),
                // It lies at the farthest depth: what the model covers is not shaded.
                depth: Some(depth(false, wgpu::CompareFunction::LessEqual)),
                samples: samples.count(),
                ..fullscreen(shaders::BACKDROP, "fragment")
            },
            Draw::World { shape, through } => {
                let topology = match shape {
                    WorldShape::Lines => wgpu::PrimitiveTopology::LineList,
                    WorldShape::Triangles => wgpu::PrimitiveTopology::TriangleList,
                };
                Recipe {
                    vertex: "world_vertex".into(),
                    // Shapes that are seen through the model have a depth range of their own and hide each other in it.
                    depth: Some(depth(through, wgpu::CompareFunction::LessEqual)),
                    ..Self::over_model(samples, shaders::LINES, topology)
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

    fn of_model(draw: ModelDraw, skinned: bool, picture: SampleCount) -> Self {
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
                let smooth = cut == Cut::Smooth && picture != SampleCount::One;
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
                    ..solid(program, Some(fragment), Some(color), picture.count())
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
                    picture.count(),
                )
            }
            ModelDraw::Contact => {
                let color = wgpu::ColorTargetState {
                    blend: Some(MAX_BLEND),
                    ..FRACTION_FORMAT.into()
                };
                Recipe {
                    depth: None,
                    ..solid(shaders::CONTACT, Some("fragment"), Some(color), 1)
                }
            }
            ModelDraw::Edges => Recipe {
                vertex: entry("edge"),
                ..Self::over_model(picture, shaders::LINES, wgpu::PrimitiveTopology::LineList)
            },
            ModelDraw::Normals | ModelDraw::Tangents => Recipe {
                vertex: entry(if draw == ModelDraw::Normals {
                    "normal"
                } else {
                    "tangent"
                }),
                // A line a vertex: the mesh's vertices are instances of one line.
                step_mode: wgpu::VertexStepMode::Instance,
                ..Self::over_model(picture, shaders::LINES, wgpu::PrimitiveTopology::LineList)
            },
            ModelDraw::Highlight => Recipe {
                vertex: entry("vertex"),
                ..Self::over_model(picture, shaders::HIGHLIGHT, wgpu::PrimitiveTopology::TriangleList)
            },
        }
    }

    /// Blended over the finished model, and hidden by what is nearer.
    fn over_model(samples: SampleCount, program: Program, topology: wgpu::PrimitiveTopology) -> Self {
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
            samples: samples.count(),
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
