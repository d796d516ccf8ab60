//! Which `.wgsl` files make which program, and the Rust twins of the structs in them.
//!
//! WGSL has no includes, so a program is a list of small files, joined in order. The list is data: the renderer compiles it, and
//! a test without a GPU validates it, translates it to GLSL ES 3.00 and compares the twins with what the shader sees.

mod layout;

pub use layout::{
    Accumulation, Camera, Composite, Environment, Ground, InfluenceVertex, Instance, Light, Line, MapPlace, Material,
    MaterialMaps, MoreMapsVertex, PositionVertex, SurfaceVertex,
};

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
            name: concat!($name, ".wgsl"),
            source: include_str!(concat!("../../shaders/", $name, ".wgsl")),
        }
    };
}

/// Vertex blending alone: in every program that draws the model, and in the test that compares it with its CPU twin.
pub const SKINNING_WGSL: ShaderFile = shader_file!("skinning");

/// The studio light, after its parts: `studio_light` is what a surface's shader calls.
pub const STUDIO_LIGHT: [ShaderFile; 3] = [shader_file!("pbr"), shader_file!("environment"), shader_file!("studio")];

/// From light to colours of a screen.
pub const TONE_MAP_WGSL: ShaderFile = shader_file!("tone_map");

/// The light of the books' demos.
pub const BOOK_WGSL: ShaderFile = shader_file!("book");

/// Makes a constant for each program, named by its files, and the list of them all.
macro_rules! programs {
    ($($(#[doc = $doc:literal])* $program:ident $name:literal [$($file:literal)*])*) => {
        $(
            $(#[doc = $doc])*
            pub const $program: Program = Program {
                name: $name,
                files: &[$(shader_file!($file)),*],
            };
        )*

        /// Every program there is.
        pub const PROGRAMS: &[Program] = &[$($program),*];
    };
}

programs! {
    /// The model under the studio light.
    MESH_STUDIO "mesh-studio" [
        "camera" "light" "skinning" "instance" "color" "lighting" "shadow" "material" "two_maps" "normal_map" "mesh_vertex"
        "mesh_two_maps" "surface" "environment" "pbr" "studio" "tone_map" "mesh_studio" "mesh"
    ]

    /// The same with all maps.
    MESH_STUDIO_ALL "mesh-studio-all" [
        "camera" "light" "skinning" "instance" "color" "lighting" "shadow" "material" "all_maps" "normal_map" "mesh_vertex"
        "mesh_all_maps" "surface" "environment" "pbr" "studio" "tone_map" "mesh_studio" "mesh" "mesh_blended"
    ]

    /// The model under the light of the books' demos.
    MESH_BOOK "mesh-book" [
        "camera" "light" "skinning" "instance" "color" "lighting" "shadow" "material" "two_maps" "normal_map" "mesh_vertex"
        "mesh_two_maps" "surface" "environment" "book" "mesh_book" "mesh"
    ]

    /// The same with all maps.
    MESH_BOOK_ALL "mesh-book-all" [
        "camera" "light" "skinning" "instance" "color" "lighting" "shadow" "material" "all_maps" "normal_map" "mesh_vertex"
        "mesh_all_maps" "surface" "environment" "book" "mesh_book" "mesh" "mesh_blended"
    ]

    /// One property of the model's surface, without light.
    MESH_INSPECT "mesh-inspect" [
        "camera" "light" "skinning" "instance" "color" "lighting" "shadow" "material" "two_maps" "normal_map" "mesh_vertex"
        "mesh_two_maps" "environment" "surface" "mesh_inspect" "mesh"
    ]

    /// The same with all maps.
    MESH_INSPECT_ALL "mesh-inspect-all" [
        "camera" "light" "skinning" "instance" "color" "lighting" "shadow" "material" "all_maps" "normal_map" "mesh_vertex"
        "mesh_all_maps" "environment" "surface" "mesh_inspect" "mesh"
    ]

    /// The model in colours of its vertices.
    SKIN_VIEW "skin-view" ["camera" "skinning" "instance" "color" "material" "two_maps" "skin_view"]

    /// The same with all maps.
    SKIN_VIEW_ALL "skin-view-all" ["camera" "skinning" "instance" "color" "material" "all_maps" "skin_view"]

    /// The model's depth from the key light.
    CASTER "caster" ["light" "skinning" "instance" "caster"]

    /// The same for materials that alpha cuts.
    CASTER_CUT "caster-cut" ["light" "skinning" "instance" "material" "two_maps" "caster_cut"]

    /// The same with all maps.
    CASTER_CUT_ALL "caster-cut-all" ["light" "skinning" "instance" "material" "all_maps" "caster_cut"]

    /// Normals and depth of what is in view.
    MESH_GEOMETRY "mesh-geometry" ["camera" "skinning" "instance" "material" "two_maps" "geometry" "mesh_geometry"]

    /// The same with all maps.
    MESH_GEOMETRY_ALL "mesh-geometry-all" [
        "camera" "skinning" "instance" "material" "all_maps" "geometry" "mesh_geometry"
    ]

    /// Ambient occlusion of the DirectX 12 book.
    OCCLUSION_BOOK "occlusion-book" ["camera" "light" "color" "geometry" "occlusion" "fullscreen" "occlusion_book"]

    /// Ambient occlusion by horizons.
    OCCLUSION_STUDIO "occlusion-studio" ["camera" "light" "color" "geometry" "occlusion" "fullscreen" "occlusion_studio"]

    /// Blurs ambient occlusion, but not across edges.
    OCCLUSION_BLUR "occlusion-blur" ["camera" "light" "geometry" "occlusion" "fullscreen" "occlusion_blur"]

    /// How near the model is above the ground.
    CONTACT "contact" ["light" "ground" "skinning" "instance" "contact"]

    /// The same of materials that alpha cuts.
    CONTACT_CUT "contact-cut" ["light" "ground" "skinning" "instance" "contact" "material" "two_maps" "contact_cut"]

    /// The same with all maps.
    CONTACT_CUT_ALL "contact-cut-all" [
        "light" "ground" "skinning" "instance" "contact" "material" "all_maps" "contact_cut"
    ]

    /// Blurs the contact map.
    CONTACT_BLUR "contact-blur" ["fullscreen" "contact_blur"]

    /// Backdrop or sky, grid and the shadows on the ground.
    BACKDROP "backdrop" [
        "camera" "light" "ground" "color" "lighting" "environment" "shadow" "tone_map" "fullscreen" "backdrop"
    ]

    /// Edges, normals, tangents, boxes, axes.
    LINES "lines" ["camera" "skinning" "instance" "color" "lines"]

    /// The model or a part of it in one transparent colour.
    HIGHLIGHT "highlight" ["camera" "skinning" "instance" "color" "highlight"]

    /// The mean of many pictures.
    ACCUMULATE "accumulate" ["color" "fullscreen" "accumulate"]

    /// The finished picture onto a surface.
    COMPOSITE "composite" ["color" "fullscreen" "composite"]

    /// Known triangles, by which a device is tried.
    PROBE "probe" ["skinning" "probe"]
}
