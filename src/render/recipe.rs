//! What is drawn, and what each thing is drawn with: program, entry points, blending, depth.

use std::collections::BTreeSet;

use super::target::{COLOR_FORMAT, CONTACT_FORMAT, DEPTH_FORMAT, GEOMETRY_FORMAT, SampleCount};
use crate::scene::Light;
use crate::shaders::{self, Program};

/// What colours the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Shading {
    Lit(Light),
    Inspect,
}

/// What of a material its program reads. Each has programs of its own, so that neither pays for the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Maps {
    /// The diffuse and the normal map, both sampled as the books do: all that a .m3d file has.
    #[default]
    Two,
    /// All maps, each sampled in a way of its own, and colours of vertices: all that a glTF file has.
    All,
}

/// What alpha does to a material, as it is with its maps. In the order in which they are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Alpha {
    #[default]
    Whole,
    Cut,
    Blended,
    /// Blended as a map or colours of vertices say: hair and leaves, which overlap themselves.
    BlendedByTexel,
}

impl Alpha {
    pub(super) fn is_blended(self) -> bool {
        matches!(self, Self::Blended | Self::BlendedByTexel)
    }
}

/// Which triangles are drawn, by the way that their corners run on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Faces {
    All,
    Clockwise,
    Counterclockwise,
}

impl Faces {
    /// The other sides of the same triangles.
    pub(super) fn turned(self) -> Self {
        match self {
            Self::All => Self::All,
            Self::Clockwise => Self::Counterclockwise,
            Self::Counterclockwise => Self::Clockwise,
        }
    }
}

/// All of a material that decides which pipelines draw it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Kind {
    pub(super) alpha: Alpha,
    pub(super) maps: Maps,
    pub(super) double_sided: bool,
}

impl Kind {
    /// What is drawn of its triangles where `front` are their fronts.
    pub(super) fn faces(self, front: Faces) -> Faces {
        if self.double_sided { Faces::All } else { front }
    }
}

/// Which pixels alpha leaves of what is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Cut {
    Whole,
    /// Whole pixels.
    Hard,
    /// With smooth edges: alpha chooses the samples of a pixel and is not stored. With one sample a pixel it is [`Cut::Hard`].
    Smooth,
    /// Those of a blended material that are opaque.
    OpaquePart,
    /// The others of it, blended over what is there.
    Blended,
    /// Each pixel whole or not at all, with alpha as the chance: the mean of many pictures is as if all were sorted.
    Stochastic,
}

/// For what the model's triangles are drawn with their materials.
#[derive(Clone, Copy)]
pub(super) enum Purpose {
    Picture(Shading),
    /// One of many pictures of which a mean is made.
    Sample(Shading),
    SkinView,
    Caster,
    Geometry,
    Contact,
}

impl Purpose {
    /// How materials of a kind are drawn for it: of blended ones what is drawn before anything is blended.
    pub(super) fn draw(self, kind: Kind) -> ModelDraw {
        let cut = match (kind.alpha, self) {
            (Alpha::Whole, _) => Cut::Whole,
            (Alpha::BlendedByTexel, Self::Sample(Shading::Lit(_))) => Cut::Stochastic,
            (
                Alpha::Blended | Alpha::BlendedByTexel,
                Self::Picture(Shading::Lit(_)) | Self::Sample(Shading::Lit(_)),
            ) => Cut::OpaquePart,
            // A property that is seen through another could not be read off: blended surfaces show theirs alone.
            (_, Self::Picture(_) | Self::Sample(_)) => Cut::Smooth,
            _ => Cut::Hard,
        };
        // Where nothing is cut, these read none.
        let maps_of_cut = if cut == Cut::Whole { Maps::Two } else { kind.maps };
        match self {
            Self::Picture(shading) | Self::Sample(shading) => ModelDraw::Mesh(shading, cut, kind.maps),
            Self::SkinView => ModelDraw::SkinView(cut, kind.maps),
            Self::Geometry => ModelDraw::Geometry(cut, kind.maps),
            Self::Caster => ModelDraw::Caster(cut, maps_of_cut),
            Self::Contact => ModelDraw::Contact(cut, maps_of_cut),
        }
    }
}

/// What is drawn of the model's triangles or vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ModelDraw {
    Mesh(Shading, Cut, Maps),
    /// The model in the colours of its vertices.
    SkinView(Cut, Maps),
    Caster(Cut, Maps),
    Geometry(Cut, Maps),
    /// As from above, and what faces down is seen.
    Contact(Cut, Maps),
    Edges,
    Normals,
    Tangents,
    Highlight,
}

impl ModelDraw {
    /// Whether it reads normals, tangents or texture coordinates of vertices, not positions alone.
    pub(super) fn reads_surface(self) -> bool {
        !matches!(
            self,
            Self::Caster(Cut::Whole, _) | Self::Contact(Cut::Whole, _) | Self::Edges
        )
    }

    /// Whether it reads colours of vertices that were made from the skin.
    pub(super) fn reads_colors(self) -> bool {
        matches!(self, Self::SkinView(..))
    }

    /// Which maps it reads; none where it reads no material.
    pub(super) fn maps(self) -> Option<Maps> {
        match self {
            Self::Caster(Cut::Whole, _) | Self::Contact(Cut::Whole, _) => None,
            Self::Mesh(_, _, maps)
            | Self::SkinView(_, maps)
            | Self::Caster(_, maps)
            | Self::Contact(_, maps)
            | Self::Geometry(_, maps) => Some(maps),
            Self::Edges | Self::Normals | Self::Tangents | Self::Highlight => None,
        }
    }
}

/// Everything that has a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Draw {
    Model {
        draw: ModelDraw,
        skinned: bool,
        faces: Faces,
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
            Self::Model { draw, .. } => !matches!(
                draw,
                ModelDraw::Caster(..) | ModelDraw::Geometry(..) | ModelDraw::Contact(..)
            ),
            Self::Backdrop | Self::World { .. } => true,
            Self::Occlusion(_)
            | Self::OcclusionBlurRows
            | Self::OcclusionBlurColumns
            | Self::ContactBlurRows
            | Self::ContactBlurColumns => false,
        }
    }

    /// What one key or the pointer may ask for while a model is open, the likeliest first: what the pointer
    /// marks, the other light, view modes, wires, bones, weights, normals. `kinds` are those of the model's materials, and `front` the
    /// fronts of its triangles.
    pub(super) fn within_reach(skinned: bool, kinds: &BTreeSet<Kind>, front: Faces) -> Vec<Self> {
        let of_faces = |draw, faces| Self::Model { draw, skinned, faces };
        let of_model = |draw| of_faces(draw, Faces::All);
        let for_purpose = |purpose: Purpose| {
            kinds
                .iter()
                .map(move |&kind| of_faces(purpose.draw(kind), kind.faces(front)))
        };
        let mut draws = vec![of_model(ModelDraw::Highlight)];
        for light in Light::ALL {
            let shading = Shading::Lit(light);
            draws.extend(for_purpose(Purpose::Picture(shading)));
            for kind in kinds.iter().filter(|kind| kind.alpha.is_blended()) {
                // Backs have a draw of their own.
                let back = if kind.double_sided { front.turned() } else { front };
                let blended = ModelDraw::Mesh(shading, Cut::Blended, kind.maps);
                draws.extend([back, front].map(|faces| of_faces(blended, faces)));
            }
            draws.push(Self::Occlusion(light));
        }
        let below = |&kind: &Kind| of_faces(Purpose::Contact.draw(kind), kind.faces(front).turned());
        draws.extend(kinds.iter().map(below));
        draws.extend([Self::ContactBlurRows, Self::ContactBlurColumns]);
        draws.extend(for_purpose(Purpose::Picture(Shading::Inspect)));
        draws.push(of_model(ModelDraw::Edges));
        draws.extend([WorldShape::Triangles, WorldShape::Lines].map(|shape| Self::World { shape, through: true }));
        draws.extend(for_purpose(Purpose::SkinView));
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

/// Keeps the map's own steps from shadowing the surface that made them; the mesh shader adds an offset along the normal. No constant:
/// its unit is the last bit of the depth as a float, which is nothing.
const CASTER_BIAS: wgpu::DepthBiasState = wgpu::DepthBiasState {
    constant: 0,
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
            color: Some(GEOMETRY_FORMAT.into()),
            alpha_to_coverage: false,
            depth: None,
            samples: 1,
        };
        match draw {
            Draw::Model { draw, skinned, .. } => Self::of_model(draw, skinned, samples),
            Draw::Backdrop => Recipe {
                color: Some(COLOR_FORMAT.into()),
                // It lies at the farthest depth: what the model covers is not shaded.
                depth: Some(depth(false, wgpu::CompareFunction::LessEqual)),
                samples: samples.count(),
                ..fullscreen(shaders::BACKDROP, "fragment")
            },
            Draw::World { shape, through } => match shape {
                WorldShape::Lines => Self::lines("world_line".into(), samples),
                WorldShape::Triangles => Recipe {
                    // Those that are seen through the model have a depth range of their own and hide in it what is behind them.
                    depth: Some(depth(through, wgpu::CompareFunction::LessEqual)),
                    ..Self::on_model(samples, shaders::LINES, "world_vertex".into())
                },
            },
            Draw::Occlusion(Light::Book) => fullscreen(shaders::OCCLUSION_BOOK, "fragment"),
            Draw::Occlusion(Light::Studio) => fullscreen(shaders::OCCLUSION_STUDIO, "fragment"),
            Draw::OcclusionBlurRows => fullscreen(shaders::OCCLUSION_BLUR, "fragment_rows"),
            Draw::OcclusionBlurColumns => fullscreen(shaders::OCCLUSION_BLUR, "fragment_columns"),
            Draw::ContactBlurRows | Draw::ContactBlurColumns => Recipe {
                color: Some(CONTACT_FORMAT.into()),
                ..fullscreen(
                    shaders::CONTACT_BLUR,
                    if draw == Draw::ContactBlurRows {
                        "fragment_rows"
                    } else {
                        "fragment_columns"
                    },
                )
            },
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
            ModelDraw::Mesh(shading, cut, maps) => {
                let program = match (shading, maps) {
                    (Shading::Lit(Light::Studio), Maps::Two) => shaders::MESH_STUDIO,
                    (Shading::Lit(Light::Studio), Maps::All) => shaders::MESH_STUDIO_ALL,
                    (Shading::Lit(Light::Book), Maps::Two) => shaders::MESH_BOOK,
                    (Shading::Lit(Light::Book), Maps::All) => shaders::MESH_BOOK_ALL,
                    (Shading::Inspect, Maps::Two) => shaders::MESH_INSPECT,
                    (Shading::Inspect, Maps::All) => shaders::MESH_INSPECT_ALL,
                };
                let smooth = cut == Cut::Smooth && picture != SampleCount::One;
                let fragment = match cut {
                    Cut::Whole => "fragment",
                    Cut::Smooth if smooth => "fragment_cut_smooth",
                    Cut::Hard | Cut::Smooth => "fragment_cut",
                    Cut::OpaquePart => "fragment_opaque_part",
                    Cut::Blended => "fragment_blended",
                    Cut::Stochastic => "fragment_stochastic",
                };
                let is_blended = cut == Cut::Blended;
                let color = wgpu::ColorTargetState {
                    write_mask: if smooth {
                        wgpu::ColorWrites::COLOR
                    } else {
                        wgpu::ColorWrites::ALL
                    },
                    blend: is_blended.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                    ..COLOR_FORMAT.into()
                };
                Recipe {
                    alpha_to_coverage: smooth,
                    // What is blended hides nothing of what is blended after it; a decal may lie in the surface that it is on.
                    depth: Some(if is_blended {
                        depth(false, wgpu::CompareFunction::LessEqual)
                    } else {
                        depth(true, wgpu::CompareFunction::Less)
                    }),
                    ..solid(program, Some(fragment), Some(color), picture.count())
                }
            }
            ModelDraw::Caster(cut, maps) => {
                let (program, fragment) = match (cut, maps) {
                    (Cut::Whole, _) => (shaders::CASTER, None),
                    (_, Maps::Two) => (shaders::CASTER_CUT, Some("fragment")),
                    (_, Maps::All) => (shaders::CASTER_CUT_ALL, Some("fragment")),
                };
                let mut recipe = solid(program, fragment, None, 1);
                recipe.depth = Some(wgpu::DepthStencilState {
                    bias: CASTER_BIAS,
                    ..depth(true, wgpu::CompareFunction::Less)
                });
                recipe
            }
            ModelDraw::Geometry(cut, maps) => {
                let program = match maps {
                    Maps::Two => shaders::MESH_GEOMETRY,
                    Maps::All => shaders::MESH_GEOMETRY_ALL,
                };
                solid(program, Some(hard_fragment(cut)), Some(GEOMETRY_FORMAT.into()), 1)
            }
            ModelDraw::SkinView(cut, maps) => {
                let program = match maps {
                    Maps::Two => shaders::SKIN_VIEW,
                    Maps::All => shaders::SKIN_VIEW_ALL,
                };
                solid(
                    program,
                    Some(hard_fragment(cut)),
                    Some(COLOR_FORMAT.into()),
                    picture.count(),
                )
            }
            ModelDraw::Contact(cut, maps) => {
                let program = match (cut, maps) {
                    (Cut::Whole, _) => shaders::CONTACT,
                    (_, Maps::Two) => shaders::CONTACT_CUT,
                    (_, Maps::All) => shaders::CONTACT_CUT_ALL,
                };
                let color = wgpu::ColorTargetState {
                    blend: Some(MAX_BLEND),
                    ..CONTACT_FORMAT.into()
                };
                Recipe {
                    vertex: entry(if cut == Cut::Whole { "vertex" } else { "cut" }),
                    depth: None,
                    ..solid(program, Some(hard_fragment(cut)), Some(color), 1)
                }
            }
            ModelDraw::Edges => Self::lines(entry("edge"), picture),
            ModelDraw::Normals => Self::lines(entry("normal"), picture),
            ModelDraw::Tangents => Self::lines(entry("tangent"), picture),
            ModelDraw::Highlight => Self::on_model(picture, shaders::HIGHLIGHT, entry("vertex")),
        }
    }

    /// Lines on the model and beside it: the edges, the mesh's vertices or the pairs of points are instances of one strip.
    fn lines(vertex: String, samples: SampleCount) -> Self {
        Recipe {
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            step_mode: wgpu::VertexStepMode::Instance,
            ..Self::on_model(samples, shaders::LINES, vertex)
        }
    }

    /// Blended over the finished model, and hidden by what is nearer.
    fn on_model(samples: SampleCount, program: Program, vertex: String) -> Self {
        Recipe {
            program,
            vertex,
            fragment: Some("fragment"),
            topology: wgpu::PrimitiveTopology::TriangleList,
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

/// The entry point of programs that cut whole pixels or nothing.
fn hard_fragment(cut: Cut) -> &'static str {
    if cut == Cut::Whole { "fragment" } else { "fragment_cut" }
}

pub(super) fn depth(write: bool, compare: wgpu::CompareFunction) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(write),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}
