//! Which `.wgsl` files make which program, and the Rust twins of the structs in them.
//!
//! WGSL has no includes, so a program is a list of small files, joined in order. The list is data: the renderer compiles it, and
//! a test without a GPU validates it, translates it to GLSL ES 3.00 and compares the twins with what the shader sees.

mod layout;
mod light_layout;

pub use layout::{Frame, GeometryVertex, InfluenceVertex, Material};
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

const CASTER_WGSL: ShaderFile = shader_file!("caster.wgsl");
const CASTER_CUT_WGSL: ShaderFile = shader_file!("caster_cut.wgsl");
const BACKDROP_WGSL: ShaderFile = shader_file!("backdrop.wgsl");
const COLOR_WGSL: ShaderFile = shader_file!("color.wgsl");
const COMPOSITE_WGSL: ShaderFile = shader_file!("composite.wgsl");
const ENVIRONMENT_WGSL: ShaderFile = shader_file!("environment.wgsl");
const FRAME_WGSL: ShaderFile = shader_file!("frame.wgsl");
const FULLSCREEN_WGSL: ShaderFile = shader_file!("fullscreen.wgsl");
const LIGHTING_WGSL: ShaderFile = shader_file!("lighting.wgsl");
const MATERIAL_WGSL: ShaderFile = shader_file!("material.wgsl");
const MESH_WGSL: ShaderFile = shader_file!("mesh.wgsl");
const NORMAL_MAP_WGSL: ShaderFile = shader_file!("normal_map.wgsl");
const PBR_WGSL: ShaderFile = shader_file!("pbr.wgsl");
const PROBE_WGSL: ShaderFile = shader_file!("probe.wgsl");
const SHADOW_WGSL: ShaderFile = shader_file!("shadow.wgsl");
const STUDIO_WGSL: ShaderFile = shader_file!("studio.wgsl");

/// Vertex blending alone: in every program that draws the model, and in the test that compares it with its CPU twin.
pub const SKINNING_WGSL: ShaderFile = shader_file!("skinning.wgsl");

/// The studio light, after its parts: `studio_light` is what a surface's shader calls.
pub const STUDIO_LIGHT: [ShaderFile; 3] = [PBR_WGSL, ENVIRONMENT_WGSL, STUDIO_WGSL];

/// From light to colours of a screen.
pub const TONE_MAP_WGSL: ShaderFile = shader_file!("tone_map.wgsl");

/// The model under the studio light.
pub const MESH: Program = Program {
    name: "mesh",
    files: &[
        FRAME_WGSL,
        SKINNING_WGSL,
        COLOR_WGSL,
        SHADOW_WGSL,
        LIGHTING_WGSL,
        MATERIAL_WGSL,
        NORMAL_MAP_WGSL,
        MESH_WGSL,
    ],
};

/// The model's depth from the key light.
pub const CASTER: Program = Program {
    name: "caster",
    files: &[FRAME_WGSL, SKINNING_WGSL, CASTER_WGSL],
};

/// The same for what alpha cuts.
pub const CASTER_CUT: Program = Program {
    name: "caster-cut",
    files: &[FRAME_WGSL, SKINNING_WGSL, MATERIAL_WGSL, CASTER_CUT_WGSL],
};

/// Backdrop, grid and the shadow on the ground.
pub const BACKDROP: Program = Program {
    name: "backdrop",
    files: &[FRAME_WGSL, COLOR_WGSL, SHADOW_WGSL, FULLSCREEN_WGSL, BACKDROP_WGSL],
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
pub const PROGRAMS: [Program; 6] = [MESH, CASTER, CASTER_CUT, BACKDROP, COMPOSITE, PROBE];
