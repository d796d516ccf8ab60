//! Which `.wgsl` files make which program, and the Rust twins of the structs in them.
//!
//! WGSL has no includes, so a program is a list of small files, joined in order. The list is data: the renderer compiles it, and
//! a test without a GPU validates it, translates it to GLSL ES 3.00 and compares the twins with what the shader sees.

mod layout;
mod light_layout;

pub use layout::{Frame, GeometryVertex, Highlight, InfluenceVertex, Line, Material};
pub use light_layout::Environment;

/// Joints in a row of the bone texture, three texels each: 768 texels, well below the 2 048 that every device has.
/// Twin of `JOINTS_PER_ROW` in `skinning.wgsl`.
pub const JOINTS_PER_ROW: u32 = 256;

/// One WGSL file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShaderFile {
    /// File name, for messages.
    pub name: &'static str,
    /// Its text.
    pub source: &'static str,
}

/// Files that are compiled together.
#[derive(Clone, Copy, Debug)]
pub struct Program {
    /// Name to show in GPU debuggers and errors.
    pub name: &'static str,
    /// In order.
    pub files: &'static [ShaderFile],
}

impl Program {
    /// The files joined into one source.
    pub fn source(&self) -> String {
        self.files.iter().map(|file| file.source).collect()
    }
}

macro_rules! shader_file {
    ($name:literal) => {
        ShaderFile {
            name: $name,
            source: include_str!(concat!("../../shaders/", $name)),
        }
    };
}

const AROUND_WGSL: ShaderFile = shader_file!("around.wgsl");
const BACKDROP_WGSL: ShaderFile = shader_file!("backdrop.wgsl");
const CASTER_WGSL: ShaderFile = shader_file!("caster.wgsl");
const CASTER_CUT_WGSL: ShaderFile = shader_file!("caster_cut.wgsl");
const COLOR_WGSL: ShaderFile = shader_file!("color.wgsl");
const COMPOSITE_WGSL: ShaderFile = shader_file!("composite.wgsl");
const CONTACT_WGSL: ShaderFile = shader_file!("contact.wgsl");
const CONTACT_BLUR_WGSL: ShaderFile = shader_file!("contact_blur.wgsl");
const ENVIRONMENT_WGSL: ShaderFile = shader_file!("environment.wgsl");
const FRAME_WGSL: ShaderFile = shader_file!("frame.wgsl");
const FULLSCREEN_WGSL: ShaderFile = shader_file!("fullscreen.wgsl");
const GEOMETRY_WGSL: ShaderFile = shader_file!("geometry.wgsl");
const HIGHLIGHT_WGSL: ShaderFile = shader_file!("highlight.wgsl");
const LINES_WGSL: ShaderFile = shader_file!("lines.wgsl");
const MATERIAL_WGSL: ShaderFile = shader_file!("material.wgsl");
const MESH_WGSL: ShaderFile = shader_file!("mesh.wgsl");
const MESH_BOOK_WGSL: ShaderFile = shader_file!("mesh_book.wgsl");
const MESH_GEOMETRY_WGSL: ShaderFile = shader_file!("mesh_geometry.wgsl");
const MESH_INSPECT_WGSL: ShaderFile = shader_file!("mesh_inspect.wgsl");
const MESH_STUDIO_WGSL: ShaderFile = shader_file!("mesh_studio.wgsl");
const MESH_VERTEX_WGSL: ShaderFile = shader_file!("mesh_vertex.wgsl");
const NORMAL_MAP_WGSL: ShaderFile = shader_file!("normal_map.wgsl");
const OCCLUSION_BLUR_WGSL: ShaderFile = shader_file!("occlusion_blur.wgsl");
const OCCLUSION_BOOK_WGSL: ShaderFile = shader_file!("occlusion_book.wgsl");
const OCCLUSION_STUDIO_WGSL: ShaderFile = shader_file!("occlusion_studio.wgsl");
const PBR_WGSL: ShaderFile = shader_file!("pbr.wgsl");
const STUDIO_WGSL: ShaderFile = shader_file!("studio.wgsl");
const PROBE_WGSL: ShaderFile = shader_file!("probe.wgsl");
const SKIN_VIEW_WGSL: ShaderFile = shader_file!("skin_view.wgsl");
const SHADOW_WGSL: ShaderFile = shader_file!("shadow.wgsl");
const SURFACE_WGSL: ShaderFile = shader_file!("surface.wgsl");
const SURROUNDINGS_WGSL: ShaderFile = shader_file!("surroundings.wgsl");

/// Vertex blending alone: in every program that draws the model, and in the test that compares it with its CPU twin.
pub const SKINNING_WGSL: ShaderFile = shader_file!("skinning.wgsl");

/// The studio light, after its parts: `studio_light` is what a surface's shader calls.
pub const STUDIO_LIGHT: [ShaderFile; 3] = [PBR_WGSL, ENVIRONMENT_WGSL, STUDIO_WGSL];

/// From light to colours of a screen.
pub const TONE_MAP_WGSL: ShaderFile = shader_file!("tone_map.wgsl");

/// The light of the books' demos.
pub const BOOK_WGSL: ShaderFile = shader_file!("book.wgsl");

/// The model under the studio light.
pub const MESH_STUDIO: Program = Program {
    name: "mesh-studio",
    files: &[
        FRAME_WGSL,
        SKINNING_WGSL,
        COLOR_WGSL,
        SURROUNDINGS_WGSL,
        SHADOW_WGSL,
        MATERIAL_WGSL,
        NORMAL_MAP_WGSL,
        MESH_VERTEX_WGSL,
        SURFACE_WGSL,
        ENVIRONMENT_WGSL,
        PBR_WGSL,
        STUDIO_WGSL,
        TONE_MAP_WGSL,
        MESH_STUDIO_WGSL,
        MESH_WGSL,
    ],
};

/// The model under the light of the books' demos.
pub const MESH_BOOK: Program = Program {
    name: "mesh-book",
    files: &[
        FRAME_WGSL,
        SKINNING_WGSL,
        COLOR_WGSL,
        SURROUNDINGS_WGSL,
        SHADOW_WGSL,
        MATERIAL_WGSL,
        NORMAL_MAP_WGSL,
        MESH_VERTEX_WGSL,
        SURFACE_WGSL,
        ENVIRONMENT_WGSL,
        BOOK_WGSL,
        MESH_BOOK_WGSL,
        MESH_WGSL,
    ],
};

/// One property of the model's surface, without light.
pub const MESH_INSPECT: Program = Program {
    name: "mesh-inspect",
    files: &[
        FRAME_WGSL,
        SKINNING_WGSL,
        COLOR_WGSL,
        SURROUNDINGS_WGSL,
        SHADOW_WGSL,
        MATERIAL_WGSL,
        NORMAL_MAP_WGSL,
        MESH_VERTEX_WGSL,
        ENVIRONMENT_WGSL,
        SURFACE_WGSL,
        MESH_INSPECT_WGSL,
        MESH_WGSL,
    ],
};

/// The model in colours of its vertices.
pub const SKIN_VIEW: Program = Program {
    name: "skin-view",
    files: &[FRAME_WGSL, SKINNING_WGSL, COLOR_WGSL, MATERIAL_WGSL, SKIN_VIEW_WGSL],
};

/// The model's depth from the first light.
pub const CASTER: Program = Program {
    name: "caster",
    files: &[FRAME_WGSL, SKINNING_WGSL, CASTER_WGSL],
};

/// The same for what alpha cuts.
pub const CASTER_CUT: Program = Program {
    name: "caster-cut",
    files: &[FRAME_WGSL, SKINNING_WGSL, MATERIAL_WGSL, CASTER_CUT_WGSL],
};

/// Normals and depth of what is in view.
pub const MESH_GEOMETRY: Program = Program {
    name: "mesh-geometry",
    files: &[
        FRAME_WGSL,
        SKINNING_WGSL,
        MATERIAL_WGSL,
        GEOMETRY_WGSL,
        MESH_GEOMETRY_WGSL,
    ],
};

/// Ambient occlusion of the DirectX 12 book.
pub const OCCLUSION_BOOK: Program = Program {
    name: "occlusion-book",
    files: &[
        FRAME_WGSL,
        GEOMETRY_WGSL,
        AROUND_WGSL,
        FULLSCREEN_WGSL,
        OCCLUSION_BOOK_WGSL,
    ],
};

/// Ambient occlusion by horizons.
pub const OCCLUSION_STUDIO: Program = Program {
    name: "occlusion-studio",
    files: &[
        FRAME_WGSL,
        GEOMETRY_WGSL,
        AROUND_WGSL,
        FULLSCREEN_WGSL,
        OCCLUSION_STUDIO_WGSL,
    ],
};

/// Smooths ambient occlusion between edges.
pub const OCCLUSION_BLUR: Program = Program {
    name: "occlusion-blur",
    files: &[
        FRAME_WGSL,
        GEOMETRY_WGSL,
        AROUND_WGSL,
        FULLSCREEN_WGSL,
        OCCLUSION_BLUR_WGSL,
    ],
};

/// How near the model is above the ground.
pub const CONTACT: Program = Program {
    name: "contact",
    files: &[FRAME_WGSL, SKINNING_WGSL, CONTACT_WGSL],
};

/// Smooths that.
pub const CONTACT_BLUR: Program = Program {
    name: "contact-blur",
    files: &[FULLSCREEN_WGSL, CONTACT_BLUR_WGSL],
};

/// Backdrop or sky, grid and the shadows on the ground.
pub const BACKDROP: Program = Program {
    name: "backdrop",
    files: &[
        FRAME_WGSL,
        COLOR_WGSL,
        SURROUNDINGS_WGSL,
        ENVIRONMENT_WGSL,
        SHADOW_WGSL,
        TONE_MAP_WGSL,
        FULLSCREEN_WGSL,
        BACKDROP_WGSL,
    ],
};

/// Edges, normals, tangents, boxes, axes.
pub const LINES: Program = Program {
    name: "lines",
    files: &[FRAME_WGSL, SKINNING_WGSL, COLOR_WGSL, LINES_WGSL],
};

/// The model or a part of it in one transparent colour.
pub const HIGHLIGHT: Program = Program {
    name: "highlight",
    files: &[FRAME_WGSL, SKINNING_WGSL, COLOR_WGSL, HIGHLIGHT_WGSL],
};

/// The finished picture onto a surface.
pub const COMPOSITE: Program = Program {
    name: "composite",
    files: &[COLOR_WGSL, FULLSCREEN_WGSL, COMPOSITE_WGSL],
};

/// A known triangle, by which a device is tried.
pub const PROBE: Program = Program {
    name: "probe",
    files: &[PROBE_WGSL],
};

/// Every program there is.
pub const PROGRAMS: [Program; 17] = [
    MESH_STUDIO,
    MESH_BOOK,
    MESH_INSPECT,
    SKIN_VIEW,
    CASTER,
    CASTER_CUT,
    MESH_GEOMETRY,
    OCCLUSION_BOOK,
    OCCLUSION_STUDIO,
    OCCLUSION_BLUR,
    CONTACT,
    CONTACT_BLUR,
    BACKDROP,
    LINES,
    HIGHLIGHT,
    COMPOSITE,
    PROBE,
];
